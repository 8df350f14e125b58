"""The formats of files that commands take, told apart by their key `schema`."""

from __future__ import annotations

from zlmreport.errors import InputError
from zlmreport.job.tree import Keys, Scalar

JOB = "zlmreport/job/1"
SIMULATION = "zlmreport/simulation/1"
FLEET = "zlmreport/fleet/1"
STEP_GAUGE = "zlmreport/step-gauge/1"

#: What a file is, and which command takes it.
_KINDS = {
    JOB: ("a job", "zlmreport JOB.yaml"),
    FLEET: ("a fleet of jobs", "zlmreport fleet FLEET.yaml"),
    SIMULATION: ("the description of a simulated test", "zlmreport simulate"),
    STEP_GAUGE: ("the calibration of a step gauge", "step_gauge.calibration of a job"),
}


def refuse_other_format(tree: Keys, expected: str) -> None:
    """Refuse a file of another kind by one message, instead of by one for each of its keys.

    Raises
    ------
    InputError
        If its schema is that of another command.
    """
    entry = tree.entries.get("schema")
    named = entry.value if entry else None
    if isinstance(named, Scalar) and named.text != expected and named.text in _KINDS:
        kind, command = _KINDS[named.text]
        wanted, _ = _KINDS[expected]
        raise InputError.at(
            named.place, f"this file is {kind} ({named.text}), and {wanted} is expected; {command} takes it"
        )
