"""What errors of an I++ DME server mean for a path over a step gauge."""

from __future__ import annotations

from zlmreport.probing.answers import MachineError

#: Errors of a measuring move after which the face counts as missed, and the path goes on.
NO_TOUCH = 1003
NO_SURFACE = 1006
#: The server waits for ``ClearAllErrors``.
NOT_CLEARED = 514

#: What the operator can do, by the number of the error.
_ADVICE = {
    500: "the emergency stop is pressed; release it, bring the machine to a safe place, and start again",
    NOT_CLEARED: "an earlier error is not cleared; clear it at the machine, and start again",
    1001: "the probe touched where nothing should be; look at the gauge and the tip, and start again",
    1008: "the path leaves what the machine can reach; state step_gauge.path.working_volume, and plan again",
    1502: "the machine has no tool of this name; see machine.tool in the job",
    2500: "the path leaves what the machine can reach; state step_gauge.path.working_volume, and plan again",
    2504: "the machine has run into something; look at the gauge and the tip, locate the gauge again, and "
    "start again",
}


def is_missed_face(error: MachineError) -> bool:
    """Whether an error of a measuring move says that the face was not found."""
    return error.number in {NO_TOUCH, NO_SURFACE}


def advice(error: MachineError) -> str:
    """Return what the operator can do."""
    return _ADVICE.get(error.number, "look at the machine, and start again")
