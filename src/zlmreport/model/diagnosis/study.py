"""The study of a job's model that commands, workbench and annex begin with: fit, diagnosis, build."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from zlmreport.errors import InputError, Place, Problem
from zlmreport.job.edit import CANDIDATES, WrittenEffect, list_items_written, read_named_effect
from zlmreport.job.effect_choices import EffectChoice, find_next_number, number_effect
from zlmreport.job.formula import find_names_in, parse_formula
from zlmreport.job.formula_keys import FormulaKeys
from zlmreport.job.job import Job
from zlmreport.language import Language, Words
from zlmreport.language.numbers import write_significant
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.measurand import is_for
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.units import with_unit
from zlmreport.model.diagnosis.building import Built, build
from zlmreport.model.diagnosis.contest import Told, tell_nobody
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, diagnose
from zlmreport.model.diagnosis.error_numbers import ErrorNumbers, compute_error_numbers
from zlmreport.model.effects.axis_model import AxisModel, Term, choose_effect, choose_terms
from zlmreport.model.effects.design import Design, transform_to_position
from zlmreport.model.effects.effect import Effect, Shape
from zlmreport.model.effects.harmonic import Harmonic, find_harmonics
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.blunders import find_outliers
from zlmreport.model.fitting.estimate import InstrumentError, ParameterEstimate
from zlmreport.model.fitting.fit import Assumptions, Fit, fit
from zlmreport.model.fitting.observations import (
    Observations,
    make_observations_of,
    select_of_the_job,
    select_readings,
    thin,
)
from zlmreport.model.fitting.priors import PriorExpectation
from zlmreport.model.fitting.sessions import add_zeros, join_sessions

if TYPE_CHECKING:
    from zlmreport.plugin.registry import Registry

#: The effect that is a full polynomial over the position.
_POLYNOMIAL = "polynomial"
#: Coverage factor of the instrument's uncertainty as a job states it.
_COVERAGE_FACTOR = 2.0
_AT_POSITIONS = frozenset({"at-each-position", "at-each-approach"})
_KEY = "model.effects"
_SESSIONS = "model.sessions"
#: What a table of positions, one for each direction, can take away; the rest changes with time or run.
BY_TABLE = frozenset({Shape.POSITION, Shape.DIRECTION})
_EXPECTED = Words(
    "Scatter and sizes of effects are expected to be as {number} earlier test says (model.priors).",
    plural="Scatter and sizes of effects are expected to be as {number} earlier tests say (model.priors).",
)
_CORRECTED = Words("Predicted: less what the error model explains by {effects}")


@dataclass(frozen=True, slots=True)
class Fitted:
    """A fitted model, and how far it is from the readings."""

    fit: Fit
    error: ErrorNumbers


def demand_effects_for(job: Job, effects: Sequence[Effect]) -> None:
    """Refuse a job of several measured lines, and one on what no effect describes: nothing could be found."""
    job.demand_one_line("an error model")
    measurand = job.axis.measurand
    own = any(each.is_formula for each in (*job.effects, *job.candidates))
    if not own and not any(is_for(each, measurand) for each in effects):
        way = (
            "the effects of a circle are found by 'zlmreport machine diagnose', from a machine file that "
            "names this job among its tests"
            if measurand.is_closed
            else "a formula of your own does: model.candidates"
        )
        raise InputError.at(
            job.place_of("measurement.error"),
            f"this job is on {measurand.identifier}, and no installed effect acts on that; {way}",
        )


@dataclass(frozen=True, slots=True)
class Study:
    """The error model that a job names, and the readings that it is held against.

    Its methods raise `InputError` at the place in the job where an effect stands that makes no sense on these
    readings.
    """

    job: Job
    measurements: MeasurementSet  #: Its readings.
    model: AxisModel  #: Its effects, after the zeros of further sessions.
    observed: Observations  #: Its readings as the model sees them, none set aside.
    #: What fits take for granted: the error of the instrument, as the job states it.
    assumptions: Assumptions
    sessions: tuple[MeasurementSet, ...]  #: The readings of the job's further sessions.
    #: The readings of all sessions below one another; without others, those of the job.
    together: Observations

    @classmethod
    def of(
        cls,
        job: Job,
        measurements: MeasurementSet,
        effects: Sequence[Effect],
        sessions: Sequence[MeasurementSet] = (),
    ) -> Study:
        """Begin the study of a job.

        `sessions`: The readings of the further sessions that the job names.
        """
        demand_effects_for(job, effects)
        find = {effect.identifier: effect for effect in effects}.__getitem__
        own = _observe(measurements, job)
        names = [each.files[0].name for each in job.sessions]
        others = [_observe(each, other) for each, other in zip(sessions, job.sessions, strict=True)]
        try:
            together = join_sessions(own, list(zip(names, others, strict=True)))
        except ModelError as error:
            raise InputError(Problem(job.place_of(_SESSIONS), each) for each in error.sentences) from error
        return cls(
            job,
            measurements,
            add_zeros(AxisModel(choose_terms(job.effects, find, job.axis.kind)), together.design),
            select_of_the_job(together),
            Assumptions(instrument=find_instrument_error(job, float(np.ptp(measurements.target_positions)))),
            tuple(sessions),
            together,
        )

    def fit_whole(self) -> Fitted:
        """Return the model fitted to the readings, those that stand off set aside."""
        every = thin(self.together)
        kept = every.without(find_outliers(every.design, every.deviation).readings)
        return self._fit(self.model, kept.design, kept.deviation, self.assumptions)

    def diagnose(self, effects: Sequence[Effect], told: Told = tell_nobody) -> AxisDiagnosis:
        """Return the diagnosis: every installed effect is tried, and every formula that the job lists."""
        try:
            return self._diagnose(self.model, self.list_tried(effects), told)
        except ModelError as error:
            raise InputError(self._list_problems(error)) from error

    def build(self, effects: Sequence[Effect], told: Told = tell_nobody) -> Built:
        """Return the model that comes of adding, step by step, what has evidence of its own."""
        tried = self.list_tried(effects)

        def diagnosing(model: AxisModel, may_go: frozenset[str], told: Told) -> AxisDiagnosis:
            return self._diagnose(model, tried, told, may_go)

        try:
            return build(self.model, diagnosing, told)
        except ModelError as error:
            raise InputError(self._list_problems(error)) from error

    def _diagnose(
        self, model: AxisModel, tried: Sequence[Effect], told: Told, may_go: frozenset[str] = frozenset()
    ) -> AxisDiagnosis:
        """Return the diagnosis of a model of this job, with what earlier tests say where it names them."""
        stated = self.job.priors
        expected = PriorExpectation.of(stated, self.job.axis) if stated else None
        found = diagnose(model, self.together, tried, self.assumptions, expected, may_go=may_go, told=told)
        if stated is None:
            return found
        return replace(found, remarks=(*found.remarks, _EXPECTED.given(number=stated.tests)))

    def list_titles(self, effects: Sequence[Effect]) -> dict[str, Words]:
        """Return what installed effects and the formulas of the job are called, by identifier."""
        of_model = (term.effect for term in self.model.terms)
        return {each.identifier: each.title for each in (*self.list_tried(effects), *of_model)}

    def list_tried(self, effects: Sequence[Effect]) -> list[Effect]:
        """Return the effects that are tried: those for what was measured, and the formulas of the job."""
        by_identifier: dict[str, Effect] = {}
        kind = self.job.axis.kind
        formulas = (choose_effect(each, by_identifier.__getitem__, kind) for each in self.job.candidates)
        return [*(each for each in effects if is_for(each, self.job.axis.measurand)), *formulas]

    def fit_history(self, whole: Fitted | None = None) -> tuple[Fitted, ...]:
        """Return the fits of no effect, of the first, of the first two …, up to the whole model.

        All are fits to the readings of the last: a diagnosis may have set others aside than a fit does.

        So a history needs no record beside the job, and says of every model what is true of it today.

        `whole`: The fit of the whole model, where it is there already.
        """
        terms = self.model.terms
        last = whole or self.fit_whole()
        # How unequally readings scatter is seen from repeats, whatever the model.
        assumptions = replace(self.assumptions, weights=last.fit.noise.weights)
        models = (AxisModel(terms[:count]) for count in range(len(terms)))
        parts = [self._fit(each, last.fit.design, last.fit.deviation, assumptions) for each in models]
        return (*parts, last)

    def _fit(
        self, model: AxisModel, design: Design, deviation: FloatArray, assumptions: Assumptions
    ) -> Fitted:
        try:
            found = fit(model, design, deviation, assumptions)
        except ModelError as error:
            raise InputError(self._list_problems(error)) from error
        return Fitted(found, compute_error_numbers(found))

    def _list_problems(self, error: ModelError) -> Iterator[Problem]:
        for sentence in error.sentences:
            yield Problem(self._place_of(sentence.partition(" ")[0]), sentence)

    def _place_of(self, identifier: str) -> Place:
        """Return where the job names an effect, or the list of effects if it does not."""
        for choice in self.job.effects:
            if choice.identifier == identifier:
                return choice.place
        return self.job.place_of(_KEY)


def _observe(measurements: MeasurementSet, job: Job) -> Observations:
    """Return what the model of a job is held against: its readings, and what it says of their course."""
    stated = job.keys.plan.overrun
    overrun = None if stated is None else job.axis.position_unit.to_si(stated)
    return _add_feed(make_observations_of(measurements, overrun=overrun), job)


def _add_feed(observed: Observations, job: Job) -> Observations:
    """Return observations with the feed of the job beside them, where a formula has it and no log does."""
    feed = job.keys.measurement.feed
    used = any(
        isinstance(each.settings, FormulaKeys) and "v" in find_names_in(parse_formula(each.settings.formula))
        for each in (*job.effects, *job.candidates)
    )
    if not used or feed is None or "v" in observed.design.conditions:
        return observed
    log = read_only_floats(np.full(len(observed.deviation), feed))
    conditions = {**observed.design.conditions, "v": log}
    return replace(observed, design=replace(observed.design, conditions=conditions))


def find_instrument_error(job: Job, length: float) -> InstrumentError:
    """Return the error of the instrument as the budget takes it; none if it is not stated as a number.

    What acts in time or at each reading differs within the test: the noise that the readings show has it
    already. `length` is the measured one, m or rad.
    """
    stated = job.keys.instrument.stated_uncertainty if job.keys.instrument else None
    constant, per_metre = stated or (0.0, 0.0)
    u = job.axis.deviation_unit.to_si(constant) / _COVERAGE_FACTOR
    acts = job.keys.uncertainty.instrument_acts or "at-each-position"
    along = u / length if acts == "along-the-length" and length else 0.0
    return InstrumentError(
        common=u if acts == "at-the-datum" else 0.0,
        proportional=math.hypot(job.axis.deviation_unit.to_si(per_metre) / _COVERAGE_FACTOR, along),
        at_each_position=u if acts in _AT_POSITIONS else 0.0,
        between_directions=u if acts == "between-directions" else 0.0,
    )


def read_addition(
    text: str, job: Job, registry: Registry, effects: Sequence[Effect], place: Place
) -> tuple[WrittenEffect, tuple[str, ...]]:
    """Return an effect that a person names, and the effects of the model that it takes the place of.

    `text`: ``backlash``, or ``polynomial: {order: 5}`` as in a job, or the name of a formula of its
        candidates.

    Raises `InputError` if there is no such effect, or it stands in the model already; of those that may be
    several, the next is meant.
    """
    named = _find_listed(text.strip(), job) or read_named_effect(text, registry, place)
    identifier = named.choice.identifier
    if any(each.identifier == identifier for each in job.effects) and not named.choice.is_formula:
        again = find_next_number(named.choice.installed, job.effects)
        if registry.effect(named.choice.installed).several and text.strip().startswith(identifier):
            text = text.replace(identifier, number_effect(named.choice.installed, again), 1)
            named = read_named_effect(text, registry, place)
            identifier = named.choice.identifier
    for choice in job.effects:
        if _state_meaning(choice) == _state_meaning(named.choice):
            raise InputError.at(choice.place, f"{identifier} stands in the model already")
    contains = next((each.contains for each in effects if each.identifier == identifier), ())
    replaced = {identifier, *contains}
    return named, tuple(each.identifier for each in job.effects if each.identifier in replaced)


def _find_listed(name: str, job: Job) -> WrittenEffect | None:
    """Return a formula of a job's candidates by its name."""
    nodes = list_items_written(job, CANDIDATES)
    pairs = zip(nodes, job.candidates, strict=True)
    return next((WrittenEffect(node, choice) for node, choice in pairs if choice.identifier == name), None)


def refuse_useless(added: str, before: Fitted, after: Fitted, job: Job) -> None:
    """Refuse an effect that does not lower the error.

    Raises `InputError` with both errors.
    """
    if after.error.rms >= before.error.rms:
        raise InputError.at(
            job.place_of(_KEY),
            f"{added} explains nothing here: the error would be {_write_rms(after)} with it and is "
            f"{_write_rms(before)} without; the job was left as it is",
        )


def _write_rms(fitted: Fitted) -> str:
    """Write an error with so many digits that a slight change shows."""
    unit = fitted.fit.design.axis.deviation_unit
    digits = write_significant(unit.from_si(fitted.error.rms), 4)
    return with_unit(digits.in_language(Language.ENGLISH), unit.symbol)


def _state_meaning(choice: EffectChoice) -> tuple[object, ...]:
    return choice.identifier, choice.settings, dict(choice.values)


def correct_by_model(measurements: MeasurementSet, observed: Observations, fitted: Fit) -> MeasurementSet:
    """Return the readings less what a model explains of them; none is left out, flagged ones neither.

    `observed`: The same as the model sees them, none set aside.
    """
    left = measurements.deviation.copy()
    taken = []
    solution = fitted.solution
    for term, theta, gamma in zip(fitted.model.terms, solution.thetas, solution.coefficients, strict=True):
        left[observed.reading] -= term.effect.columns(observed.design, theta) @ gamma
        taken.append(term.effect.identifier)
    if not taken:
        return measurements
    provenance = measurements.provenance
    remark = _CORRECTED.given(effects=", ".join(taken))
    return replace(
        measurements,
        deviation=read_only_floats(left),
        provenance=replace(provenance, remarks=(*provenance.remarks, remark)),
    )


def list_what_moves_with_time(fitted: Fit) -> tuple[str, ...]:
    """Return the effects of a model that no table of positions takes away."""
    return tuple(term.effect.identifier for term in fitted.model.terms if term.effect.shape not in BY_TABLE)


def list_one_way(fitted: Fit) -> Iterator[tuple[Approach, FloatArray, FloatArray]]:
    """Yield the polynomial of each direction in powers of the position itself, with its covariance.

    M. Halaj, E. Kureková, R. Palenčár and T. Loebl, The positional deviation in two axes, equation (2): a, b,
    c, d, deviation and position both in mm or in degrees. It is fitted to the readings of that direction
    alone, whatever else stands in the model; nothing where the model has no polynomial.
    """
    own = fitted.of_the_job
    for term in fitted.model.terms:
        for approach in Approach if term.effect.identifier == _POLYNOMIAL else ():
            chosen = np.flatnonzero(own.design.direction == approach)
            design = select_readings(own.design, chosen)
            if not len(chosen) or term.effect.untestable(design):
                continue
            alone = fit(
                AxisModel((Term(term.effect),)),
                design,
                own.deviation[chosen],
                Assumptions(fitted.assumptions.instrument),
            )
            powers = np.arange(len(term.effect.linear))
            scale = design.axis.position_unit.per_si ** (1.0 - powers)
            turn = scale[:, np.newaxis] * transform_to_position(len(powers) - 1, design.span)
            yield (
                approach,
                turn @ alone.solution.coefficients[0],
                turn @ alone.uncertainties.covariance @ turn.T,
            )


@dataclass(frozen=True, slots=True)
class Wave:
    """A harmonic of a periodic effect."""

    effect: str  #: Identifier of the effect.
    harmonic: Harmonic  #: Its amplitude and phase with standard uncertainties, SI.
    coverage_factor: float  #: k for 95 %, of both.


def list_waves(fitted: Fit) -> tuple[Wave, ...]:
    """Return the harmonics of all periodic effects of a model; one with a given parameter is left out."""
    return tuple(_find_waves(fitted))


def _find_waves(fitted: Fit) -> Iterator[Wave]:
    covariance = fitted.uncertainties.covariance
    first = 0
    for term in fitted.model.terms:
        solved = int(np.count_nonzero(term.is_solved))
        columns = slice(first, first + solved)
        first += solved
        if solved < len(term.effect.linear):
            continue
        own: list[ParameterEstimate] = [
            each
            for each in fitted.estimates
            if each.effect == term.effect.identifier and each.parameter in term.effect.linear
        ]
        values = np.array([each.value for each in own])
        for harmonic in find_harmonics(term.effect.linear, values, covariance[columns, columns]):
            yield Wave(term.effect.identifier, harmonic, own[0].coverage_factor)
