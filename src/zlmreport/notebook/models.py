"""The error model of an axis for notebooks: fitted, diagnosed, and changed effect by effect."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from zlmreport.document.blocks import Notice, Section
from zlmreport.document.subjects.diagnosis import lay_out_diagnosis, lay_out_unseen
from zlmreport.document.subjects.fit import fit_sections
from zlmreport.errors import InputError, Place, Problem
from zlmreport.job.effect_choices import EffectChoice, choose_effects_of, find_next_number
from zlmreport.job.evaluation_keys import STATED_COVERAGE_FACTOR
from zlmreport.language import Language
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.model.diagnosis.asking import AskedLength, list_lengths_asked
from zlmreport.model.diagnosis.building import build
from zlmreport.model.diagnosis.contest import Told
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, diagnose
from zlmreport.model.diagnosis.error_numbers import ErrorNumbers, compute_error_numbers
from zlmreport.model.diagnosis.report import (
    build_values,
    report,
    report_error,
    report_model,
    write_verdict_statement,
)
from zlmreport.model.diagnosis.study import Fitted
from zlmreport.model.effects.axis_model import AxisModel, choose_terms
from zlmreport.model.effects.effect import find_unit_on
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.blunders import find_outliers
from zlmreport.model.fitting.estimate import InstrumentError
from zlmreport.model.fitting.fit import Assumptions, Fit, fit as fit_model
from zlmreport.model.fitting.observations import Observations, make_observations_of
from zlmreport.notebook.frames import frame_of
from zlmreport.notebook.layout import sections_html
from zlmreport.notebook.readings import Readings, readings_of, registry, tree_of
from zlmreport.notebook.results import draw_on

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_NAME = "fit"
_ASKED = "What the axis does not state"
_SIDES = {Approach.POSITIVE: "up", Approach.NEGATIVE: "down"}


@dataclass(frozen=True, slots=True)
class Estimated:
    """A parameter of the model, in its own unit.

    `given`: Whether it was given and not estimated.
    `at_bound`: ``min`` or ``max`` where it is held at a bound; else empty.
    """

    effect: str
    name: str
    value: float
    unit: str
    expanded_uncertainty: float
    coverage_factor: float
    given: bool
    at_bound: str


@dataclass(frozen=True, slots=True)
class Candidate:
    """An effect that the model may lack.

    Attributes
    ----------
    effect
        Its identifier.
    settings
        The form of it that fits best, as its own keys in a job.
    probability
        Among all effects, nameless shapes and no effect.
    p_value
        Chance of so much an improvement without it.
    rms_after
        The error after adding it, µm or ″.
    explains
        What it takes away, in words.
    indistinguishable_from
        Effects that these readings cannot tell from it.
    discriminate_by
        The measurement that would; empty where there is nothing to tell apart.
    """

    effect: str
    settings: Mapping[str, Any]
    probability: float
    p_value: float
    rms_after: float
    explains: str
    indistinguishable_from: tuple[str, ...]
    discriminate_by: str


class Diagnosis:
    """Whether a model describes the readings, and what it lacks.

    Attributes
    ----------
    statement
        The verdict in a sentence.
    asks
        What to state of the axis so that more effects can be tried, in sentences.
    """

    def __init__(self, values: Mapping[str, Any], found: AxisDiagnosis, asks: Sequence[str]) -> None:
        self._values = values
        self.statement = write_verdict_statement(found).in_language(Language.ENGLISH)
        self.asks = tuple(asks)
        titles = {each.identifier: each.title for each in registry().effects}
        self._sections = (
            *lay_out_diagnosis(found, Language.ENGLISH, titles),
            *lay_out_unseen(found, Language.ENGLISH, titles),
        )

    @property
    def verdict(self) -> str:
        """``adequate``, ``missing`` or ``unexplained``."""
        return str(self._values["verdict"])

    @property
    def candidates(self) -> tuple[Candidate, ...]:
        """Effects that the model may lack, the best first."""
        return tuple(
            Candidate(
                each["effect"],
                each["settings"],
                each["probability"],
                each["p_value"],
                each["rms_after"],
                each["explains"],
                tuple(each["indistinguishable_from"]),
                each["discriminate_by"],
            )
            for each in self._values["candidates"]
        )

    @property
    def failures(self) -> tuple[str, ...]:
        """Where model and readings disagree, in sentences."""
        return tuple(each["statement"] for each in self._values["failures"])

    def to_dict(self) -> dict[str, Any]:
        """Return the diagnosis as ``zlmreport model diagnose --json`` prints it."""
        return dict(self._values)

    def __repr__(self) -> str:
        """Return the verdict in a sentence."""
        return f"<Diagnosis: {self.statement}>"

    def _repr_html_(self) -> str:
        asked = (Section("asked", _ASKED, (Notice(_ASKED, self.asks),)),) if self.asks else ()
        return sections_html([*self._sections, *asked])


@dataclass(frozen=True, slots=True)
class BuildStep:
    """An effect that came into a model, or went out of it again.

    Attributes
    ----------
    effect
        Its identifier.
    rms_before, rms_after
        The error without this step and with it, µm or ″.
    removed
        Whether it went out again.
    equals
        Effects that the readings do not tell from it.
    """

    effect: str
    rms_before: float
    rms_after: float
    removed: bool
    equals: tuple[str, ...] = ()


class Build:
    """A model that was built step by step.

    `model`: What came of it.
    """

    def __init__(self, model: Model, values: Mapping[str, Any]) -> None:
        self.model = model
        self._values = values

    @property
    def steps(self) -> tuple[BuildStep, ...]:
        """What came in and went out, in order."""
        return tuple(
            BuildStep(
                each["effect"],
                each["rms_before"],
                each["rms_after"],
                bool(each.get("removed", False)),
                tuple(each.get("indistinguishable_from", ())),
            )
            for each in self._values["steps"]
        )

    @property
    def verdict(self) -> str:
        """Of the last model: ``adequate``, ``missing`` or ``unexplained``."""
        return str(self._values["verdict"])

    @property
    def remainder(self) -> Mapping[str, Any] | None:
        """What is left beside the model: its size, place and shape; None if nothing is."""
        found: Mapping[str, Any] | None = self._values["remainder"]
        return found

    def to_dict(self) -> dict[str, Any]:
        """Return the build as ``zlmreport model build --json`` prints it."""
        return dict(self._values)

    def __repr__(self) -> str:
        """Return the steps in a line."""
        steps = " → ".join(
            f"{'−' if each.removed else '+'} {each.effect} {each.rms_after:.2g}" for each in self.steps
        )
        return f"<Build: {steps or 'nothing to add'} {self.model.data.unit}>"


class Model:
    """An error model fitted to the readings of a test.

    Attributes
    ----------
    data
        The readings.
    effects
        Identifiers of its effects, in order.
    """

    def __init__(self, data: Readings, choices: Sequence[EffectChoice], assumptions: Assumptions) -> None:
        self.data = data
        self._choices = tuple(choices)
        self._assumptions = assumptions
        kind = data.measurements.axis.kind
        self._model = AxisModel(choose_terms(self._choices, registry().effect, kind))
        self.effects: tuple[str, ...] = tuple(self._model.identifiers)

    def __reduce__(self) -> tuple[Any, ...]:
        """Return how to fit it anew: plugins stay here, and go by their names."""
        return type(self), (self.data, self._choices, self._assumptions)

    @cached_property
    def _observed(self) -> Observations:
        return make_observations_of(self.data.measurements)

    @cached_property
    def _kept(self) -> Observations:
        """The readings without those that stand off."""
        return self._observed.without(find_outliers(self._observed.design, self._observed.deviation).readings)

    @cached_property
    def fit(self) -> Fit:
        """The same in SI, for those who go further down; no part of the stable interface."""
        return fit_model(self._model, self._kept.design, self._kept.deviation, self._assumptions)

    @cached_property
    def _error(self) -> ErrorNumbers:
        return compute_error_numbers(self.fit)

    @property
    def rms(self) -> float:
        """Root mean square of the residuals by degrees of freedom, µm or ″."""
        return float(self._convert_to_printed(self.fit.rms))

    @property
    def noise_rms(self) -> float | None:
        """What the readings scatter when they are repeated, µm or ″; None without repeats."""
        return (
            None if self._error.noise_rms is None else float(self._convert_to_printed(self._error.noise_rms))
        )

    @cached_property
    def parameters(self) -> tuple[Estimated, ...]:
        """The parameters of all effects with their uncertainties (k for 95 %)."""
        return tuple(
            Estimated(**{name: each.get(name, "") for name in Estimated.__slots__})
            for each in report_model(self.fit)["parameters"]
        )

    def __getitem__(self, name: str) -> Estimated:
        """Return a parameter: ``model["backlash.lost_motion"]``.

        Raises
        ------
        KeyError
            If the model has none of that name; with those that it has.
        """
        known = {f"{each.effect}.{each.name}": each for each in self.parameters}
        if name not in known:
            raise KeyError(f"the model has no parameter {name!r} (it has: {', '.join(known)})")
        return known[name]

    def __contains__(self, name: object) -> bool:
        """Tell whether the model has a parameter of that name."""
        return any(name in (each, f"{each.effect}.{each.name}") for each in self.parameters)

    def __iter__(self) -> Iterator[Estimated]:
        """Yield the parameters."""
        return iter(self.parameters)

    @property
    def residuals(self) -> Any:
        """A frame of what the model leaves: target (mm or °), direction, run, residual (µm or ″).

        Readings that stand off from all others are set aside, and are missing here.
        """
        return self._list_by_reading("residual", self.fit.residual)

    @property
    def fitted(self) -> Any:
        """What the model gives for each reading, as `residuals`."""
        return self._list_by_reading("deviation", self.fit.fitted)

    def _list_by_reading(self, name: str, values: FloatArray) -> Any:
        design = self.fit.design
        columns = {
            "target": design.axis.position_unit.from_si(design.position),
            "direction": np.where(design.direction > 0, "+", "-"),
            "run": design.run,
            name: self._convert_to_printed(values),
        }
        return frame_of(columns, self.data.library)

    @property
    def covariance(self) -> FloatArray:
        """Covariance of the estimated parameters, in their units, shape (p, p).

        Rows and columns are the `parameters` that are estimated and vary continuously, in their order.
        """
        known = self.fit.uncertainties
        covariance = known.sigma**2 * known.inverse + known.systematic @ known.systematic.T
        order, scale = zip(*self._list_columns(), strict=True) if len(covariance) else ((), ())
        scales = np.array(scale)
        return read_only_floats(covariance[np.ix_(order, order)] * scales[:, np.newaxis] * scales)

    def _list_columns(self) -> list[tuple[int, float]]:
        """Return for each estimated parameter its place in the fit's covariance, and its unit over SI."""
        design, columns = self.fit.design, self.fit.columns
        return [
            (
                columns.index(own),
                find_unit_on(design, own[1].dimension).per_si,
            )
            for each in self.fit.estimates
            if (own := (each.effect, each.parameter)) in columns
        ]

    def at(self, positions: ArrayLike) -> Any:
        """Return the deviation anywhere on the measured travel, with its expanded uncertainty.

        At the mean time and the mean conditions of the test.

        Parameters
        ----------
        positions
            mm or degrees.

        Returns
        -------
        frame
            A row for each position: ``position``, ``up``, ``U_up``, ``down``, ``U_down``: µm or ″, of the
            directions measured.

        Raises
        ------
        InputError
            If a position lies outside of what was measured, or is no number.
        """
        unit = self.fit.design.axis.position_unit
        places = unit.to_si(_read_positions(positions))
        columns: dict[str, FloatArray] = {"position": unit.from_si(places)}
        for approach, found in self.fit.predict_at(places, Place("at")).items():
            columns[_SIDES[approach]] = self._convert_to_printed(found.deviation)
            columns[f"U_{_SIDES[approach]}"] = self._convert_to_printed(found.expanded_uncertainty)
        return frame_of(columns, self.data.library)

    def diagnose(self) -> Diagnosis:
        """Say whether the model describes the readings, and which installed effects it may lack."""
        try:
            found = diagnose(self._model, self._observed, registry().effects, self._assumptions)
        except ModelError as error:
            raise _make_refusal(error) from error
        asked = list_lengths_asked(self._observed.design, self._model.identifiers, registry().effects)
        return Diagnosis(report(found), found, [_read_question(each) for each in asked])

    def build(self) -> Build:
        """Return the model that comes of adding, step by step, every effect with evidence of its own."""
        installed = registry().effects

        def diagnosing(model: AxisModel, may_go: frozenset[str], told: Told) -> AxisDiagnosis:
            return diagnose(model, self._observed, installed, self._assumptions, may_go=may_go, told=told)

        try:
            found = build(self._model, diagnosing)
        except ModelError as error:
            raise _make_refusal(error) from error
        added = _choose_effects(
            [{each.identifier: each.settings.model_dump(mode="json")} for each in found.added]
        )
        known = {each.identifier for each in added}
        kept = [
            each
            for each in self._choices
            if each.identifier in found.model.identifiers and each.identifier not in known
        ]
        model = _fit_model(self.data, [*kept, *added], self._assumptions)
        return Build(model, build_values(found))

    def add(self, effect: str | Mapping[str, Any] | Candidate) -> Model:
        """Return the model with an effect more, fitted anew; what the effect contains goes out.

        Parameters
        ----------
        effect
            Its name, ``{"polynomial": {"order": 5}}`` as in a job, or a candidate of a diagnosis.
        """
        if isinstance(effect, Candidate):
            effect = {effect.effect: effect.settings}
        (choice,) = _choose_effects([effect])
        if choice.identifier in self.effects and not choice.is_formula:
            installed = registry().effect(choice.installed)
            if installed.several:
                choice = choice.renumber(find_next_number(choice.installed, self._choices))
        contains = () if choice.is_formula else registry().effect(choice.identifier).contains
        replaced = {choice.identifier, *contains}
        kept = [each for each in self._choices if each.identifier not in replaced]
        return _fit_model(self.data, [*kept, choice], self._assumptions)

    def remove(self, *effects: str) -> Model:
        """Return the model without some effects, fitted anew."""
        unknown = [each for each in effects if each not in self.effects]
        if unknown:
            known = ", ".join(self.effects)
            raise KeyError(f"the model has no effect {unknown[0]!r} (it has: {known})")
        kept = [each for each in self._choices if each.identifier not in effects]
        return _fit_model(self.data, kept, self._assumptions)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the estimate with its uncertainty over the travel on axes of matplotlib, and return them."""
        from zlmreport.document.figures.model_diagram import ModelDiagram, estimate  # noqa: PLC0415 - drawn on demand

        return draw_on(estimate(ModelDiagram(self.fit, self._error)), ax)[0]

    def plots(self) -> dict[str, list[Axes]]:
        """Draw all graphs of the model, each in a figure of its own.

        Returns the axes of their panels: ``model`` (readings and model, and the residuals below),
        ``estimate``, ``residuals-run`` and ``residuals-time``.
        """
        from zlmreport.document.figures.model_diagram import ModelDiagram, estimate  # noqa: PLC0415 - drawn on demand
        from zlmreport.document.figures.model_residuals import (  # noqa: PLC0415 - drawn on demand
            draw_over_position,
            draw_over_run,
            draw_over_time,
        )

        diagram = ModelDiagram(self.fit, self._error)
        figures = [each(diagram) for each in (draw_over_position, estimate, draw_over_run, draw_over_time)]
        return {figure.key: draw_on(figure, None) for figure in figures}

    def to_dict(self) -> dict[str, Any]:
        """Return effects, parameters and error as the results file has them."""
        error = report_error(self._error, self.fit.design.axis)
        return {**report_model(self.fit), "error": error}

    def _convert_to_printed(self, value: Any) -> Any:
        return self.data.measurements.axis.deviation_unit.from_si(value)

    def __repr__(self) -> str:
        """Return the effects and the error."""
        return f"<Model of {', '.join(self.effects) or 'no effect'}: rms {self.rms:.4g} {self.data.unit}>"

    def _repr_html_(self) -> str:
        return sections_html(fit_sections(Fitted(self.fit, self._error), Language.ENGLISH))


def _read_question(asked: AskedLength) -> str:
    effects = ", ".join(asked.effects)
    return (
        f"{asked.name.in_language(Language.ENGLISH)} ({asked.unit}): stated, z.read(…, "
        f"axis={{'{asked.key}': …}}), it decides on {effects}"
    )


def fit(
    data: Readings, effects: Sequence[str | Mapping[str, Any]], *, instrument_uncertainty: float = 0.0
) -> Model:
    """Fit an error model to readings.

    Parameters
    ----------
    data
        The readings.
    effects
        Names of installed effects, or ``{name: {parameter: value}}`` as in a job.
    instrument_uncertainty
        Expanded uncertainty of the instrument (k = 2), µm or ″; it acts at each position.

    Raises
    ------
    InputError
        If there is no such effect, or the effects make no sense on these readings.

    Examples
    --------
    >>> import zlmreport as z
    >>> data = z.simulate(
    ...     axis={"name": "X", "travel": [0, 1000]}, targets={"count": 21}, noise={"reading": 0.3},
    ...     effects=[{"backlash": {"lost_motion": 4}}], seed=1,
    ... )
    >>> model = z.fit(data, ["offset", "backlash"])
    >>> round(model["backlash.lost_motion"].value)
    4
    """
    data = readings_of(data, _NAME)
    u = data.measurements.axis.deviation_unit.to_si(instrument_uncertainty) / STATED_COVERAGE_FACTOR
    return _fit_model(
        data, _choose_effects(effects), Assumptions(instrument=InstrumentError(at_each_position=u))
    )


def _fit_model(data: Readings, choices: Sequence[EffectChoice], assumptions: Assumptions) -> Model:
    model = Model(data, choices, assumptions)
    try:
        _ = model.fit  # what cannot be fitted fails here, and not when it is looked at
    except ModelError as error:
        raise _make_refusal(error) from error
    return model


def _read_positions(positions: ArrayLike) -> FloatArray:
    """Return positions in a row; raise `InputError` if they are none."""
    try:
        found = np.atleast_1d(np.asarray(positions, dtype=np.float64))
    except (TypeError, ValueError):
        found = np.empty(0)
    if found.ndim != 1 or not len(found):
        raise InputError.at(Place("at"), "positions are a number or several in a row; for example [100, 250]")
    return found


def _choose_effects(effects: Sequence[str | Mapping[str, Any]]) -> tuple[EffectChoice, ...]:
    if isinstance(effects, str | Mapping):
        raise InputError.at(Place(_NAME), f"effects are a list; for a single one write [{effects!r}]")
    listed = tree_of({"effects": list(effects)}, _NAME).entries["effects"].value
    problems: list[Problem] = []
    choices = choose_effects_of(listed, registry(), problems, within="effects")
    if problems:
        raise InputError(Problem(Place(_NAME), each.message) for each in problems)
    return choices


def _make_refusal(error: ModelError) -> InputError:
    return InputError(Problem(Place(_NAME), sentence) for sentence in error.sentences)
