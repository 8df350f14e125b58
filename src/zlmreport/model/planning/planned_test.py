"""From a job to all that can be said of its test before it is done."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from zlmreport.errors import InputError, count_in_words
from zlmreport.evaluation.evaluation import Finding
from zlmreport.job.job import Job
from zlmreport.language import Words
from zlmreport.model.effects.axis_model import AxisModel, Term, choose_terms
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect
from zlmreport.model.planning.methods import Visit
from zlmreport.model.planning.plan import (
    PlannedStandard,
    Proposal,
    find_beyond_stated_travel,
    make_as_measured,
    propose,
)
from zlmreport.model.planning.targets import find_periods_at_phases
from zlmreport.model.planning.visibility import (
    Remedy,
    SeenEffect,
    expect_design,
    find_determined,
    find_remedies,
    judge_effects_seen,
)

#: Readings beyond the number of parameters that a diagnosis needs.
_FEWEST_DEGREES = 6
#: What is taken for granted of an axis where the job names no model.
USUAL_MODEL = ("offset", "scale-error", "backlash")


@dataclass(frozen=True, slots=True)
class PlannedTest:
    """A test before it is done."""

    proposal: Proposal  #: The plan, and what it takes for granted.
    visits: tuple[Visit, ...]  #: Its readings in their order.
    design: Design  #: The same with times and the conditions that are expected.
    travelled: float  #: The whole way of the axis, loops included, m or rad.
    duration: float  #: Of motion and rest together, s.
    #: Known periods of which the targets see two phases only, and so what repeats with them in part only.
    half_seen: tuple[Words, ...]
    #: The lowest and the highest position that the axis reaches, m or rad, where one of them lies beyond an
    #: end of its travel.
    beyond_travel: tuple[float, float] | None
    #: The effects beside which others are looked for: those of the job that the test determines.
    model: AxisModel
    seen_effects: tuple[SeenEffect, ...]  #: What is seen of every other installed effect.
    remedies: Mapping[str, Remedy]  #: What to do about those that the plan hides, by their identifiers.
    findings: Mapping[str, tuple[Finding, ...]]  #: What each standard asks of the test, by its designation.

    @property
    def logs(self) -> dict[str, list[str]]:
        """Conditions to log beside the readings, each with the effects that cannot be tried without it."""
        found: dict[str, list[str]] = {}
        for seen in self.seen_effects:
            for column in seen.logs:
                if column in self.design.conditions:
                    found.setdefault(column, []).append(seen.effect.identifier)
        return found


def describe_planned_test(
    job: Job, standards: Sequence[PlannedStandard], effects: Sequence[Effect]
) -> PlannedTest:
    """Return what can be said of a job's test before it is done.

    Raises `InputError` if the targets cannot be planned, or are too few for anything to be seen.
    """
    proposal = propose(job, standards)
    plan = proposal.plan
    design = expect_design(job.axis, plan, proposal.expected)
    model = choose_model_of(job, effects)
    base = find_determined(model, design)
    _demand_readings(job, base, design)
    seen_effects = judge_effects_seen(base, design, effects, proposal.expected)
    test = make_as_measured(job.axis, plan.method, plan.targets, plan.runs)
    return PlannedTest(
        proposal=proposal,
        visits=plan.visits,
        design=design,
        travelled=plan.travelled,
        duration=plan.duration,
        half_seen=tuple(find_periods_at_phases(job.axis, plan.targets, 2)),
        beyond_travel=find_beyond_stated_travel(job.axis, plan),
        model=base,
        seen_effects=seen_effects,
        remedies=find_remedies(seen_effects, model, job.axis, proposal),
        findings={
            standard.designation: tuple(standard.requirements(test, options))
            for standard, options in standards
        },
    )


def _demand_readings(job: Job, base: AxisModel, design: Design) -> None:
    """Refuse a test of which a diagnosis could say nothing."""
    readings = len(design.position)
    parameters = sum(term.compute_some_columns(design).shape[1] for term in base.terms)
    if readings < parameters + _FEWEST_DEGREES:
        raise InputError.at(
            job.place_of("plan"),
            f"plan: too few readings ({readings}): the model has "
            f"{count_in_words(parameters, 'parameter')}, and an effect is seen from "
            f"{_FEWEST_DEGREES} readings more on; take more targets or runs",
        )


def choose_model_of(job: Job, effects: Sequence[Effect]) -> AxisModel:
    """Return the effects beside which others are looked for: those of the job, or the usual ones."""
    by_identifier = {effect.identifier: effect for effect in effects}
    if job.effects:
        return AxisModel(choose_terms(job.effects, by_identifier.__getitem__, job.axis.kind))
    usual = [by_identifier[identifier] for identifier in USUAL_MODEL if identifier in by_identifier]
    return AxisModel(tuple(Term(effect) for effect in usual))
