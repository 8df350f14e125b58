"""What can be changed of a plan so that it sees more: targets, sequence, pace, temperatures."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import reduce

import numpy as np

from zlmreport.language import Words, list_in_words
from zlmreport.measurement.arrays import read_only_floats
from zlmreport.measurement.axis import Axis, find_usual_overrun
from zlmreport.measurement.units import SECONDS_PER_MINUTE
from zlmreport.model.planning.methods import RUN_BY_RUN, Method
from zlmreport.model.planning.plan import AxisPlan, Pause
from zlmreport.model.planning.targets import (
    find_periods_at_phases,
    makes_whole_turns,
    sample_targets,
)

#: With more targets than these or more runs, one more is no remedy worth the time.
_MANY_TARGETS, _MANY_RUNS = 21, 5
_FEWEST_TARGETS = 2
#: Twice as many of both, where two effects are to be told apart.
_FACTOR = 2
#: How often longer the axis rests, and by which factor farther it turns round, to part time from way.
_LONGER, _FARTHER = 6.0, 4.0
#: What warms by 3 K within these minutes: a machine as its hall does, a screw in motion, the air. An ordinary
#: workshop's; no standard states them.
_WARMING = (("axis_temperature", 60.0), ("screw_temperature", 30.0), ("air_temperature", 20.0))
_KELVIN = 3.0

_BOUND_TO_POSITION = Words("in this sequence time runs along with the position")
_SAME_PHASE = Words("all targets lie at the same phase of {periods}")
_MEASURE_BY = {
    Method.LINEAR: Words("measure by the linear method"),
    Method.PENDULUM: Words("measure by the pendulum method"),
}
_RANDOM_FRACTIONS = Words("choose targets with a random fraction")
_MORE_RUNS = Words("measure {runs} runs")
_REST = Words("rest {seconds} s at each target, so that more time passes")
_OVERRUN = Words("turn round {times} times as far beyond the targets")
_WARMER_SESSION = Words(
    "measure again with the axis {change} K warmer or colder, which takes about {minutes} min, and hold "
    "both sessions together"
)
_PAUSE = {
    "axis_temperature": Words(
        "pause half-way, about {minutes} min, until the axis is {change} K warmer or colder"
    ),
    "screw_temperature": Words(
        "let the axis run to and fro half-way, about {minutes} min, until its screw is {change} K warmer"
    ),
    "air_temperature": Words(
        "pause half-way, about {minutes} min, until the air is {change} K warmer or colder"
    ),
}


@dataclass(frozen=True, slots=True)
class PlanChange:
    """A change of a plan."""

    of: str  #: What it changes: two changes of the same do not go together.
    #: What is wrong with the plan as it is; None where nothing better is known than that it sees too little.
    reason: Words | None
    advice: Words  #: What to do.
    changed: Callable[[AxisPlan], AxisPlan]  #: Returns the plan with the change.


def join_changes(changes: Sequence[PlanChange]) -> PlanChange:
    """Return several changes as one."""
    return PlanChange(
        " ".join(change.of for change in changes),
        None,
        list_in_words([change.advice for change in changes]),
        lambda plan: reduce(lambda changed, change: change.changed(changed), changes, plan),
    )


def list_changes(axis: Axis, plan: AxisPlan, seed: int) -> Iterator[PlanChange]:
    """Yield changes that let a plan see what it hides: each alone, and in the end all together."""
    of_targets = list(_list_target_changes(axis, plan, seed, _MANY_TARGETS))
    of_sequence = list(_list_sequence_changes(plan, _MANY_RUNS))
    yield from (*of_targets, *of_sequence)
    last = [*of_targets[-1:], *of_sequence]
    if len(last) > 1:
        yield join_changes(last)


def list_further_changes(
    axis: Axis, plan: AxisPlan, seed: int, period: float | None, *, goes_on: bool
) -> Iterator[PlanChange]:
    """Yield each change that may tell effects apart, or show one.

    `period`: Of an effect in question, m or rad: the targets are to see all its phases.
    `goes_on`: Whether the test can be held together with the one before.
    """
    many = max(_MANY_TARGETS, _FACTOR * len(plan.targets))
    yield from _list_target_changes(axis, plan, seed, many, period)
    yield from _list_sequence_changes(plan, max(_MANY_RUNS, _FACTOR * plan.runs))
    if plan.method is Method.LINEAR:
        yield _change_by_method(Method.PENDULUM, None)
    if plan.method in RUN_BY_RUN:
        yield from (_make_pause(column, minutes) for column, minutes in _WARMING)
    if goes_on:
        yield _change_by_session(Words("measure again, and hold both sessions together"), 0.0, 0.0)
        yield _change_by_session(_WARMER_SESSION, _WARMING[0][1], _KELVIN)
    longer = float(round(_LONGER * plan.dwell)) or plan.dwell
    yield PlanChange("dwell", None, _REST.given(seconds=longer), lambda each: replace(each, dwell=longer))
    yield PlanChange(
        "overrun",
        None,
        _OVERRUN.given(times=_FARTHER),
        lambda each: keep_within_travel(axis, replace(each, overrun=_FARTHER * each.overrun)),
    )


def keep_within_travel(axis: Axis, plan: AxisPlan) -> AxisPlan:
    """Return a plan whose outermost targets leave room to turn round within the travel."""
    if axis.travel is None or makes_whole_turns(axis):
        return plan
    first, last = axis.travel[0] + plan.overrun, axis.travel[1] - plan.overrun
    moved = np.unique(np.clip(plan.targets, first, last))
    if len(moved) < _FEWEST_TARGETS and first < last:  # all lay beside one end
        moved = np.linspace(first, last, len(plan.targets))
    return replace(plan, targets=read_only_floats(moved))


def _change_by_session(advice: Words, minutes: float, change: float) -> PlanChange:
    after = Pause(minutes * SECONDS_PER_MINUTE, change, _WARMING[0][0])
    words = advice.given(minutes=minutes, change=change)
    return PlanChange("session", None, words, lambda each: replace(each, after=after))


def _make_pause(column: str, minutes: float) -> PlanChange:
    pause = Pause(minutes * SECONDS_PER_MINUTE, _KELVIN, column)
    advice = _PAUSE[column].given(minutes=minutes, change=_KELVIN)
    return PlanChange("pause", None, advice, lambda each: replace(each, pause=pause, runs=max(2, each.runs)))


def _change_by_method(method: Method, reason: Words | None) -> PlanChange:
    return PlanChange("method", reason, _MEASURE_BY[method], lambda each: replace(each, method=method))


def _list_sequence_changes(plan: AxisPlan, runs: int) -> Iterator[PlanChange]:
    if plan.method is not Method.LINEAR:
        yield _change_by_method(
            Method.LINEAR, None if plan.method is Method.UNIDIRECTIONAL else _BOUND_TO_POSITION
        )
    if plan.runs < runs:
        advice = _MORE_RUNS.given(runs=runs)
        yield PlanChange("runs", None, advice, lambda each: replace(each, runs=runs))


def _list_target_changes(
    axis: Axis, plan: AxisPlan, seed: int, many: int, period: float | None = None
) -> Iterator[PlanChange]:
    """Yield other targets; the last change has all that those before it have."""
    spread_over = axis if axis.travel else replace(axis, travel=(plan.targets[0], plan.targets[-1]))
    overrun = min(plan.overrun, find_usual_overrun(spread_over))

    def with_targets(each: AxisPlan, count: int, own: float | None) -> AxisPlan:
        return replace(each, targets=sample_targets(spread_over, count, overrun, own, seed))

    blind = find_periods_at_phases(axis, plan.targets, 1)
    if blind or period is not None:
        reason = _SAME_PHASE.given(periods=list_in_words(blind)) if blind else None
        count = len(plan.targets)
        yield PlanChange("targets", reason, _RANDOM_FRACTIONS, lambda each: with_targets(each, count, period))
    if len(plan.targets) < many:
        advice = Words("take {count} targets with random fractions").given(count=many)
        yield PlanChange("targets", None, advice, lambda each: with_targets(each, many, period))
