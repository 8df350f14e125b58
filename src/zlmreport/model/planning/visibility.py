"""What a plan will see of each installed effect, and what to change so that it sees what it hides.

Each change is tried, none is advised untried.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.axis import Axis
from zlmreport.model.diagnosis.visibility import Visibility, plan_visibility
from zlmreport.model.effects.axis_model import AxisModel, refuse_collisions
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect, needs_linear_axis, needs_rotary_axis
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.planning.changes import list_changes
from zlmreport.model.planning.methods import find_half_way, make_planned_design
from zlmreport.model.planning.plan import AxisPlan, ExpectedTest, Proposal, expect_conditions

_LIVELIER = Words("measure while there are larger changes of {logs}")
_IMITATED = Words("{effect} imitates it")


class Sight(Enum):
    """How far a plan sees an effect."""

    VISIBLE = "visible"
    #: All that is plausible of it stays below what would be found.
    TOO_SMALL = "too small"
    #: The model imitates all or nearly all of it.
    HIDDEN = "hidden"
    #: The job does not state what it needs, or the test does not have it.
    NOT_TESTABLE = "not testable"
    #: It belongs to axes of the other kind.
    OTHER_AXIS = "other axis"


@dataclass(frozen=True, slots=True)
class SeenEffect:
    """What a plan sees of an effect."""

    effect: Effect
    sight: Sight  #: How far it is seen.
    visibility: Visibility  #: The numbers.
    logs: tuple[str, ...]  #: Columns that must be logged beside the readings for it to be tried.


def expect_design(axis: Axis, plan: AxisPlan, expected: ExpectedTest) -> Design:
    """Return a planned test with the conditions that are expected, all of them logged."""
    listed, pause = plan.visits, plan.pause
    design, second_half = (
        make_planned_design(axis, plan.targets, listed, plan.feed, plan.dwell),
        find_half_way(listed),
    )
    if pause:
        late = pause.duration * (np.arange(len(listed)) >= second_half)
        design = replace(design, time=read_only_floats(design.time + late))
    course = expect_conditions(expected.temperature_change, design.time, pause, second_half)
    return replace(design, conditions=course)


def find_determined(model: AxisModel, design: Design) -> AxisModel:
    """Return the part of a model that a planned test determines; the rest it cannot see or not tell apart."""
    kept = AxisModel(())
    for term in model.terms:
        if term.effect.untestable(design) is None:
            extended = AxisModel((*kept.terms, term))
            columns = [each.compute_some_columns(design) for each in extended.terms]
            with contextlib.suppress(ModelError):
                refuse_collisions(extended, columns)
                kept = extended
    return kept


def judge_effects_seen(
    model: AxisModel, design: Design, effects: Sequence[Effect], expected: ExpectedTest
) -> tuple[SeenEffect, ...]:
    """Return what a planned test sees of every installed effect, best seen first.

    `model`: The effects that are taken for granted, all of which the test determines.

    An effect that stands in the model is left out unless it has forms of more parameters; so is a second one
    of its kind (``scale-joint-2``), of which a plan sees what it sees of the first.
    """
    by_identifier = {effect.identifier: effect for effect in effects}
    found = []
    for seen in plan_visibility(model, design, effects, expected.sigma):
        effect = by_identifier.get(seen.effect)
        if effect is not None:
            found.append(
                SeenEffect(effect, _judge_sight(effect, seen, design), seen, list_logs_of(effect, design))
            )
    order = list(Sight)
    return tuple(sorted(found, key=lambda each: (order.index(each.sight), -each.visibility.share)))


def list_logs_of(effect: Effect, design: Design) -> tuple[str, ...]:
    """Return the columns that an effect asks for, whether a course of them can be expected or not."""
    asked = _Asked(design.conditions)
    effect.untestable(replace(design, conditions=asked))
    return tuple(asked.names)


def _judge_sight(effect: Effect, seen: Visibility, design: Design) -> Sight:
    if seen.reason is not None and effect.untestable(design) is not None:
        other = seen.reason in (needs_linear_axis(design), needs_rotary_axis(design))
        return Sight.OTHER_AXIS if other else Sight.NOT_TESTABLE
    if seen.is_hidden:
        return Sight.HIDDEN
    return Sight.TOO_SMALL if _is_beyond_all_that_is_plausible(seen) else Sight.VISIBLE


def _is_beyond_all_that_is_plausible(seen: Visibility) -> bool:
    if seen.smallest is None:
        return False
    parameter, smallest = seen.smallest
    plausible = [abs(limit) for limit in (parameter.smallest, parameter.largest) if limit is not None]
    return parameter.largest is not None and smallest > max(plausible)


@dataclass(frozen=True, slots=True)
class _Asked(Mapping[str, FloatArray]):
    """Conditions that remember which of them somebody asked for."""

    known: Mapping[str, FloatArray]
    names: dict[str, None] = field(default_factory=dict)

    def __getitem__(self, name: str) -> FloatArray:
        self.names[name] = None
        return self.known[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.known)

    def __len__(self) -> int:
        return len(self.known)


@dataclass(frozen=True, slots=True)
class Remedy:
    """What to do about an effect that a plan hides."""

    #: Why the plan hides it; None where nothing better is known than that the model imitates it.
    reason: Words | None
    advice: Words  #: What to change.
    share: float | None  #: What would then be visible of it; None where another measurement is advised.


def find_remedies(
    seen_effects: Sequence[SeenEffect], model: AxisModel, axis: Axis, proposal: Proposal
) -> dict[str, Remedy]:
    """Return what to do about each effect that a plan hides, by its identifier, where something helps."""
    plan, expected = proposal.plan, proposal.expected
    blurred = [each for each in seen_effects if each.sight in {Sight.HIDDEN, Sight.TOO_SMALL}]
    found: dict[str, Remedy] = {}
    for change in list_changes(axis, plan, proposal.seed):
        left = [each.effect for each in blurred if each.effect.identifier not in found]
        if not left:
            break
        design = expect_design(axis, change.changed(plan), expected)
        for then in judge_effects_seen(find_determined(model, design), design, left, expected):
            if then.sight is Sight.VISIBLE:
                found[then.effect.identifier] = Remedy(change.reason, change.advice, then.visibility.share)
    for each in blurred:
        remedy = _find_another_measurement(each, model)
        if remedy:
            found.setdefault(each.effect.identifier, remedy)
    return found


def _find_another_measurement(seen: SeenEffect, model: AxisModel) -> Remedy | None:
    """Return what else would show an effect: livelier conditions, or what its author knows."""
    if seen.sight is Sight.TOO_SMALL:
        return Remedy(None, _LIVELIER.given(logs=", ".join(seen.logs)), None) if seen.logs else None
    for confusion in seen.effect.confusions:
        if confusion.effect in model.identifiers:
            return Remedy(_IMITATED.given(effect=confusion.effect), confusion.told_apart_by, None)
    return None
