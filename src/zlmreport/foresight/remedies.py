"""What to change in a plan so that it sees what it hides: each change is tried, none is advised untried."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import reduce

from zlmreport.foresight.outlook import Prospect, Sight, determined, expected_design, outlook
from zlmreport.foresight.phases import periods_at_phases
from zlmreport.foresight.proposal import Proposal
from zlmreport.foresight.targets import drawn_targets, usual_overrun
from zlmreport.language import Words
from zlmreport.measurement.axis import Axis
from zlmreport.model.axis_model import AxisModel
from zlmreport.model.report import listed
from zlmreport.planning.methods import Method
from zlmreport.simulation.description import Plan

#: With more targets than these or more runs, one more is no remedy worth the time.
_MANY_TARGETS, _MANY_RUNS = 21, 5

_BOUND_TO_POSITION = Words(
    en="in this sequence time runs along with the position",
    de="bei dieser Abfolge läuft die Zeit mit der Position mit",
)
_SAME_PHASE = Words(
    en="all targets lie at the same phase of {periods}",
    de="alle Zielpositionen liegen bei derselben Phase {periods}",
)
_MEASURE_LINEARLY = Words(en="measure by the linear method", de="nach dem Linearverfahren messen")
_RANDOM_FRACTIONS = Words(
    en="choose targets with a random fraction", de="Zielpositionen mit zufälligem Anteil wählen"
)
_MORE_TARGETS = Words(
    en="take {count} targets with random fractions", de="{count} Zielpositionen mit zufälligem Anteil nehmen"
)
_MORE_RUNS = Words(en="measure {runs} runs", de="{runs} Durchläufe messen")
_LIVELIER = Words(
    en="measure while there are larger changes of {logs}",
    de="messen, während sich {logs} stärker ändern",
)
_IMITATED = Words(en="{effect} imitates it", de="{effect} ahmt ihn nach")


@dataclass(frozen=True, slots=True)
class Remedy:
    """What to do about an effect that a plan hides.

    Attributes
    ----------
    reason
        Why the plan hides it; None where nothing better is known than that the model imitates it.
    advice
        What to change.
    share
        What would then be visible of it; None where another measurement is advised.
    """

    reason: Words | None
    advice: Words
    share: float | None


@dataclass(frozen=True, slots=True)
class _Change:
    reason: Words | None
    advice: Words
    changed: Callable[[Plan], Plan]


def remedies(
    prospects: Sequence[Prospect], model: AxisModel, axis: Axis, proposal: Proposal
) -> dict[str, Remedy]:
    """Return what to do about each effect that a plan hides, by its identifier, where something helps.

    Parameters
    ----------
    prospects
        What the plan sees.
    model
        The effects that the job takes for granted.
    axis
        The axis.
    proposal
        The plan.
    """
    plan, expected = proposal.plan, proposal.expected
    blurred = [each for each in prospects if each.sight in {Sight.HIDDEN, Sight.TOO_SMALL}]
    found: dict[str, Remedy] = {}
    for change in _changes(axis, plan, proposal.seed):
        left = [each.effect for each in blurred if each.effect.identifier not in found]
        if not left:
            break
        design = expected_design(axis, change.changed(plan), expected)
        for then in outlook(determined(model, design), design, left, expected):
            if then.sight is Sight.VISIBLE:
                found[then.effect.identifier] = Remedy(change.reason, change.advice, then.visibility.share)
    for each in blurred:
        remedy = _another_measurement(each, model)
        if remedy:
            found.setdefault(each.effect.identifier, remedy)
    return found


def _another_measurement(prospect: Prospect, model: AxisModel) -> Remedy | None:
    """Return what else would show an effect: livelier conditions, or what its author knows."""
    if prospect.sight is Sight.TOO_SMALL:
        return Remedy(None, _LIVELIER.given(logs=", ".join(prospect.logs)), None) if prospect.logs else None
    for confusion in prospect.effect.confusions:
        if confusion.effect in model.identifiers:
            return Remedy(_IMITATED.given(effect=confusion.effect), confusion.told_apart_by, None)
    return None


def _changes(axis: Axis, plan: Plan, seed: int) -> Iterator[_Change]:
    """Yield changes of a plan, each alone, and in the end all together."""
    of_targets, of_sequence = list(_of_targets(axis, plan, seed)), list(_of_sequence(plan))
    yield from (*of_targets, *of_sequence)
    together = [*of_targets[-1:], *of_sequence]
    if len(together) > 1:
        yield _together(together)


def _together(changes: Sequence[_Change]) -> _Change:
    return _Change(
        None,
        listed([change.advice for change in changes]),
        lambda plan: reduce(lambda changed, change: change.changed(changed), changes, plan),
    )


def _of_sequence(plan: Plan) -> Iterator[_Change]:
    if plan.method is not Method.LINEAR:
        reason = None if plan.method is Method.UNIDIRECTIONAL else _BOUND_TO_POSITION
        yield _Change(reason, _MEASURE_LINEARLY, lambda each: replace(each, method=Method.LINEAR))
    if plan.runs < _MANY_RUNS:
        advice = _MORE_RUNS.given(runs=_MANY_RUNS)
        yield _Change(None, advice, lambda each: replace(each, runs=_MANY_RUNS))


def _of_targets(axis: Axis, plan: Plan, seed: int) -> Iterator[_Change]:
    """Yield other targets; the last change has all that those before it have."""
    spread_over = axis if axis.travel else replace(axis, travel=(plan.targets[0], plan.targets[-1]))
    overrun = min(plan.overrun, usual_overrun(spread_over))

    def drawn(each: Plan, count: int) -> Plan:
        return replace(each, targets=drawn_targets(spread_over, count, overrun, None, seed))

    blind = periods_at_phases(axis, plan.targets, 1)
    if blind:
        reason = _SAME_PHASE.given(periods=listed(blind))
        yield _Change(reason, _RANDOM_FRACTIONS, lambda each: drawn(each, len(each.targets)))
    if len(plan.targets) < _MANY_TARGETS:
        advice = _MORE_TARGETS.given(count=_MANY_TARGETS)
        yield _Change(None, advice, lambda each: drawn(each, _MANY_TARGETS))
