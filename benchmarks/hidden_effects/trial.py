"""From a case to a test: axis, plan, weather, what is hidden, noise; and the same axis measured again."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from hidden_effects.cases import Case, Kind, Scatter
from hidden_effects.drawn_axes import drawn_linear_test, drawn_rotary_test
from hidden_effects.hidden import Imitation, drawn_effect, imitations, scale_to
from hidden_effects.sizes import base_columns
from hidden_effects.strangers import STRANGERS, Stranger
from hidden_effects.weather import wandering
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Effect
from zlmreport.model.planning.methods import Method
from zlmreport.model.planning.targets import compute_target_positions
from zlmreport.model.simulation.description import Description, SimulatedNoise
from zlmreport.model.simulation.simulate import compute_deviation_by, make_design_of, observe
from zlmreport_plugins.effects import zlmreport_effects

#: σ, the repeatability of a single reading, µm or ″.
_SIGMA = 0.8
#: Size of each column of the job's own model in the readings, µm or ″.
_KNOWN = 3.0
#: A shape of which an installed effect imitates more is not outside the catalogue.
_IS_INSIDE = 0.95
_TRIES = 10
#: Share of a deviation beyond which only rounding is left.
_IS_THE_SAME = 1 - 1e-6

EFFECTS: Mapping[str, Effect] = {effect.identifier: effect for effect in zlmreport_effects()}
ROTARY = frozenset({"eccentricity", "ellipticity", "gear-mesh"})
OF_A_GAUGE = frozenset({"probe-radius", "gauge-misalignment"})

#: The job's model: a cubic and backlash, but for hidden effects that these contain or imitate.
_USUAL = ("polynomial", "backlash")
_STRAIGHT = ("offset", "backlash")
_MODELS: Mapping[str, Sequence[str]] = {
    "offset": ("scale-error", "backlash"),
    "scale-error": _STRAIGHT,
    "cosine-error": _STRAIGHT,
    "gauge-misalignment": _STRAIGHT,
    "polynomial": ("offset", "scale-error", "backlash"),
    "backlash": ("polynomial",),
    "probe-radius": ("polynomial",),
    **dict.fromkeys(ROTARY, _STRAIGHT),
}


@dataclass(frozen=True, slots=True)
class Measured:
    """A test as its user has it, and the truth beside it.

    Attributes
    ----------
    measurements
        The readings.
    design
        The test with its true conditions, missing readings included.
    known, hidden : (N,) arrays
        Deviations that the job's model describes, and those that it lacks, m or rad.
    """

    measurements: MeasurementSet
    design: Design
    known: FloatArray
    hidden: FloatArray


@dataclass(frozen=True, slots=True)
class Trial:
    """A test that hides something.

    Attributes
    ----------
    case
        What was asked for.
    description
        The axis, its plan and its noise.
    model
        The job's model.
    coefficients : (q,) array
        Of the columns of the job's model, as they are in truth.
    effects
        The hidden effects, with their values.
    first
        The test.
    imitated
        How well each installed effect describes what is hidden; empty unless that is a single thing.
    """

    case: Case
    description: Description
    model: AxisModel
    coefficients: FloatArray
    effects: tuple[Term, ...]
    first: Measured
    imitated: tuple[Imitation, ...]

    @property
    def sigma(self) -> float:
        """σ of a single reading, m or rad."""
        return self.description.noise.reading

    @property
    def twins(self) -> frozenset[str]:
        """The hidden effect, and those that this test cannot tell from it: their columns are the same."""
        own = self._own_parameters
        alike = {
            each.effect.identifier
            for each in self.imitated
            if each.share > _IS_THE_SAME and each.parameters == own
        }
        return frozenset(alike) | frozenset(self.case.hidden)

    def nearest(self) -> tuple[Imitation, float] | None:
        """Return the effect that is the hardest to tell from the hidden one, and how far away it is.

        The distance is N·ρ²·(1 − R²) and ln N for each parameter that it takes more: the expected difference
        of two criteria, in noise without shared parts. None if one does not ask.
        """
        readings = len(self.first.hidden)
        distances = [
            (
                readings * self.case.size**2 * (1 - each.share)
                + math.log(readings) * (each.parameters - self._own_parameters),
                place,
            )
            for place, each in enumerate(self.imitated)
            if each.effect.identifier not in self.twins
        ]
        if not self.effects or not distances:
            return None
        distance, place = min(distances)
        return self.imitated[place], distance

    @property
    def _own_parameters(self) -> int:
        """How many parameters the hidden effect takes, in its form."""
        own = [
            each.parameters
            for term in self.effects
            for each in self.imitated
            if (each.effect.identifier, each.effect.settings)
            == (term.effect.identifier, term.effect.settings)
        ]
        return own[0] if own else 0

    def again(self) -> Measured:
        """Return a second test of the same axis: other targets on the travel, other weather and noise."""
        random = np.random.default_rng([self.description.seed, 2])
        first, last = self.first.design.span
        plan, axis = self.description.plan, self.description.axis
        assert axis.travel is not None  # every drawn axis has one
        targets = compute_target_positions(axis.travel, len(plan.targets), axis.screw_pitch or 0.0, random)
        plan = replace(plan, targets=read_only_floats(np.clip(targets, first, last)))
        another = _drawn_test(self.case, random)
        description = replace(self.description, plan=plan, seed=another.seed, conditions=another.conditions)
        design = replace(_design(self.case, description, random), span=self.first.design.span)
        known = base_columns([term.effect for term in self.model.terms], design) @ self.coefficients
        return measured(description, design, known, sum_of(self.effects, design))


def drawn_trial(case: Case, sizes: tuple[int, int] | None = None) -> Trial | None:
    """Return the test of a case; None if this test cannot show what should be hidden.

    Parameters
    ----------
    case
        The case.
    sizes
        Targets and runs; None for the usual ones.
    """
    random = case.random()
    test = _drawn_test(case, random, sizes)
    description = replace(test, noise=_noise(case.scatter, test.axis.kind, random))
    design = _design(case, description, random)
    model = _model(case)
    base = base_columns([term.effect for term in model.terms], design)
    lengths = np.sqrt(np.mean(base**2, axis=0))
    coefficients = _KNOWN * _unit(test.axis.kind) * random.standard_normal(base.shape[1]) / lengths
    rms = case.size * description.noise.reading
    if case.kind is Kind.STRANGER:
        drawn = drawn_stranger(STRANGERS[case.hidden[0]], design, base, rms, random)
    else:
        drawn = _inside(case.hidden, design, base, rms, random)
    if drawn is None:
        return None
    effects, hidden, imitated = drawn
    first = measured(description, design, base @ coefficients, hidden)
    return Trial(case, description, model, coefficients, effects, first, imitated)


#: Effects that are hidden, the deviation that they make, and how well each installed effect describes it.
_Drawn: TypeAlias = tuple[tuple[Term, ...], FloatArray, tuple[Imitation, ...]]


def _inside(
    names: Sequence[str], design: Design, base: FloatArray, rms: float, random: np.random.Generator
) -> _Drawn | None:
    """Return effects of the catalogue, each of the same size; None if the test cannot show one of them."""
    effects = []
    for name in names:
        effect = drawn_effect(EFFECTS[name], design, base, rms, random)
        if effect is None:
            return None
        effects.append(effect)
    hidden = sum_of(effects, design)
    imitated = imitations(hidden, EFFECTS.values(), design, base) if len(effects) == 1 else ()
    return tuple(effects), hidden, imitated


def drawn_stranger(
    stranger: Stranger, design: Design, base: FloatArray, rms: float, random: np.random.Generator
) -> _Drawn | None:
    """Return a shape that no effect imitates; None if in this test each that was drawn looks like one."""
    for _ in range(_TRIES):
        shape = stranger(design, random)
        scale = scale_to(shape, base, rms)
        if scale is None:
            continue
        imitated = imitations(scale * shape, EFFECTS.values(), design, base)
        if max(each.share for each in imitated) <= _IS_INSIDE:
            return (), scale * shape, imitated
    return None


def _drawn_test(case: Case, random: np.random.Generator, sizes: tuple[int, int] | None = None) -> Description:
    draw = drawn_rotary_test if ROTARY.intersection(case.hidden) else drawn_linear_test
    return draw(random, case.method, *(sizes or ()))


def _model(case: Case) -> AxisModel:
    name = case.hidden[0] if len(case.hidden) == 1 else ""
    one_way = case.method is Method.UNIDIRECTIONAL
    names = [each for each in _MODELS.get(name, _USUAL) if not (one_way and each == "backlash")]
    return AxisModel(tuple(Term(EFFECTS[each]) for each in names))


def _design(case: Case, description: Description, random: np.random.Generator) -> Design:
    design = wandering(make_design_of(description), random)
    if not OF_A_GAUGE.intersection(case.hidden):
        return design
    # In both directions the probe touches the face that it meets; in one it reaches over every second block.
    one_way = np.where(design.target % 2, 1.0, -1.0)
    face = one_way if case.method is Method.UNIDIRECTIONAL else design.direction
    return replace(design, conditions={**design.conditions, "face": read_only_floats(face)})


def measured(description: Description, design: Design, known: FloatArray, hidden: FloatArray) -> Measured:
    """Return what an instrument gives of two deviations, with the face that a probe touched."""
    measurements = observe(description, design, known + hidden)
    if "face" in design.conditions:
        logged = {**measurements.conditions, "face": design.conditions["face"]}
        measurements = replace(measurements, conditions=logged)
    return Measured(measurements, design, known, hidden)


def sum_of(effects: Sequence[Term], design: Design) -> FloatArray:
    """Return the deviation that effects with their values make, shape (N,), m or rad."""
    deviations = [compute_deviation_by(each.effect, design, each.fixed) for each in effects]
    return np.sum(deviations, axis=0) if deviations else np.zeros(len(design.position))


def _noise(scatter: Scatter, kind: AxisKind, random: np.random.Generator) -> SimulatedNoise:
    unit = _unit(kind)
    if scatter is Scatter.CLEAN:
        return SimulatedNoise(reading=_SIGMA * unit)
    return SimulatedNoise(
        reading=_SIGMA * unit,
        unequal=0.4,
        position=0.3 * unit,
        position_and_direction=0.12 * unit,
        run=0.1 * unit,
        drift=0.2 * unit,
        drift_time=float(random.uniform(300.0, 1200.0)),
        outlier_share=0.005,
        outlier_size=10.0 * unit,
        missing_share=0.02,
        resolution=0.1 * unit,
    )


def _unit(kind: AxisKind) -> float:
    """Return 1 µm or 1″ in SI."""
    return 1e-6 if kind is AxisKind.LINEAR else math.radians(1 / 3600)
