"""What a plan will be able to see of each installed effect, and what it hides."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum

from zlmreport.foresight.conditions import Expected, expected_courses
from zlmreport.measurement.axis import Axis
from zlmreport.model import needs
from zlmreport.model.axis_model import AxisModel, ModelError, refuse_collisions
from zlmreport.model.design import Design
from zlmreport.model.effect import Effect
from zlmreport.model.visibility import Visibility, plan_visibility
from zlmreport.planning.methods import path
from zlmreport.planning.visits import Visit, planned_design, visits
from zlmreport.quantities.arrays import FloatArray, read_only_floats
from zlmreport.simulation.courses import true_course
from zlmreport.simulation.description import Plan

#: Share of an effect that a plan sees, below which it hides it.
HIDDEN_SHARE = 0.1


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
class Prospect:
    """What a plan sees of an effect.

    Attributes
    ----------
    effect
        The effect.
    sight
        How far it is seen.
    visibility
        The numbers.
    logs
        Columns that must be logged beside the readings for it to be tried.
    """

    effect: Effect
    sight: Sight
    visibility: Visibility
    logs: tuple[str, ...]


def planned_visits(plan: Plan) -> tuple[Visit, ...]:
    """Return the readings of a plan in their order."""
    return visits(path(plan.method, plan.targets.tolist(), plan.runs, plan.overrun))


def expected_design(axis: Axis, plan: Plan, expected: Expected) -> Design:
    """Return a planned test with the conditions that are expected, all of them logged."""
    design = planned_design(axis, plan.targets, planned_visits(plan), plan.feed, plan.dwell)
    courses = expected_courses(expected.temperature_change, design.duration)
    conditions = {name: read_only_floats(true_course(each, design.time)) for name, each in courses.items()}
    return replace(design, conditions=conditions)


def determined(model: AxisModel, design: Design) -> AxisModel:
    """Return the part of a model that a planned test determines; the rest it cannot see or not tell apart."""
    kept = AxisModel(())
    for term in model.terms:
        if term.effect.untestable(design) is None:
            extended = AxisModel((*kept.terms, term))
            columns = [each.columns(design, each.grid(design)[0])[0] for each in extended.terms]
            with contextlib.suppress(ModelError):
                refuse_collisions(extended, columns)
                kept = extended
    return kept


def outlook(
    model: AxisModel, design: Design, effects: Sequence[Effect], expected: Expected
) -> tuple[Prospect, ...]:
    """Return what a planned test sees of every installed effect, best seen first.

    Parameters
    ----------
    model
        The effects that are taken for granted, all of which the test determines.
    design
        The plan with the conditions that are expected.
    effects
        All that are installed.
    expected
        Above all the repeatability.

    Notes
    -----
    An effect that stands in the model is left out unless it has forms of more parameters.
    """
    by_identifier = {effect.identifier: effect for effect in effects}
    found = []
    for seen in plan_visibility(model, design, effects, expected.sigma):
        effect = by_identifier[seen.effect]
        found.append(Prospect(effect, _sight(effect, seen, design), seen, logs_of(effect, design)))
    order = list(Sight)
    return tuple(sorted(found, key=lambda each: (order.index(each.sight), -each.visibility.share)))


def logs_of(effect: Effect, design: Design) -> tuple[str, ...]:
    """Return the columns that an effect asks for, whether a course of them can be expected or not."""
    asked = _Asked(design.conditions)
    effect.untestable(replace(design, conditions=asked))
    return tuple(asked.names)


def _sight(effect: Effect, seen: Visibility, design: Design) -> Sight:
    if seen.reason is not None and effect.untestable(design) is not None:
        other = seen.reason in (needs.linear_axis(design), needs.rotary_axis(design))
        return Sight.OTHER_AXIS if other else Sight.NOT_TESTABLE
    if seen.share < HIDDEN_SHARE:
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
