"""From a job to the plan of its test: what the job leaves open is chosen, and named as chosen."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.errors import InputError
from zlmreport.foresight.conditions import Expected
from zlmreport.foresight.numbers import PlannedStandard, chosen_count, chosen_runs
from zlmreport.foresight.targets import drawn_targets, usual_overrun
from zlmreport.job.job import Job
from zlmreport.planning.methods import Method
from zlmreport.quantities.arrays import FloatArray, read_only_floats
from zlmreport.simulation.description import Plan

_SECONDS_PER_MINUTE = 60.0
_USUAL_FEED = 2000.0
_USUAL_DWELL = 5.0
#: In both directions together: a working day.
_MOST_READINGS = 5000


@dataclass(frozen=True, slots=True)
class Proposal:
    """The plan of a test.

    Attributes
    ----------
    plan
        Targets, method, runs, overrun, feed and dwell.
    expected
        What is expected of the readings.
    seed
        Of random fractions.
    has_fractions
        Whether the targets were drawn with it: not where the job lists them, or asks for even ones.
    assumed
        Keys of the job that it does not state and that nothing but custom answers.
    """

    plan: Plan
    expected: Expected
    seed: int
    has_fractions: bool
    assumed: frozenset[str]


def propose(job: Job, standards: Sequence[PlannedStandard]) -> Proposal:
    """Return the plan of a job's test.

    Parameters
    ----------
    job
        The job; its readings need not exist.
    standards
        The standards that it names, each with its own keys: their requirements choose the numbers that the
        job leaves open.

    Raises
    ------
    InputError
        If the axis has no travel and the plan no list of targets, if its targets do not fit, or if there are
        more readings than anybody takes.
    """
    keys, axis = job.keys.plan, job.axis
    if axis.travel is None and keys.targets.positions is None:
        raise InputError.at(
            job.place_of("axis"),
            "axis.travel is missing: targets are spread over it; for example [0, 1000]",
        )
    to_si = axis.position_unit.to_si
    method = Method(job.keys.measurement.method or Method.LINEAR)
    overrun = to_si(keys.overrun) if keys.overrun else usual_overrun(axis)
    seed = seed_of(job.keys.certificate.number) if keys.seed is None else keys.seed
    period = None if keys.targets.fractions_of is None else to_si(keys.targets.fractions_of)

    def drawn(count: int) -> FloatArray:
        return drawn_targets(axis, count, overrun, period, seed)

    try:
        if keys.targets.positions is not None:
            targets = read_only_floats(to_si(np.array(keys.targets.positions)))
        else:
            count = keys.targets.count or chosen_count(axis, method, keys.runs, drawn, standards)
            targets = drawn(count)
    except ValueError as error:
        raise InputError.at(job.place_of("plan.targets"), f"plan.targets: {error}") from error
    runs = keys.runs or chosen_runs(axis, method, targets, standards)
    if 2 * len(targets) * runs > _MOST_READINGS:
        raise InputError.at(
            job.place_of("plan"),
            f"plan: {len(targets)} targets in {runs} runs are more than {_MOST_READINGS} readings; state a "
            "smaller plan.targets.count, or plan.runs",
        )
    feed, dwell = job.keys.measurement.feed, job.keys.measurement.dwell
    plan = Plan(
        targets=targets,
        method=method,
        runs=runs,
        overrun=overrun,
        feed=to_si(feed or _USUAL_FEED) / _SECONDS_PER_MINUTE,
        dwell=dwell or _USUAL_DWELL,
    )
    expected = Expected(axis.deviation_unit.to_si(keys.repeatability), keys.temperature_change)
    has_fractions = keys.targets.positions is None and period != 0
    return Proposal(plan, expected, seed, has_fractions, _assumed(job))


def seed_of(number: str) -> int:
    """Return the seed that belongs to a certificate's number: the same number gives the same targets."""
    return int.from_bytes(hashlib.sha256(number.encode()).digest()[:4], "big")


def _assumed(job: Job) -> frozenset[str]:
    stated = {f"measurement.{key}" for key in job.keys.measurement.model_fields_set}
    stated |= {f"plan.{key}" for key in job.keys.plan.model_fields_set}
    stated |= {"model.effects"} if job.effects else set()
    customary = {"measurement.method", "measurement.feed", "measurement.dwell"}
    customary |= {"plan.repeatability", "plan.temperature_change", "model.effects"}
    return frozenset(customary - stated)
