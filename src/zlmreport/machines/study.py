"""The fit of a machine's model: all its circles against axes and effects, together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from zlmreport.language import Words
from zlmreport.machines.course import CircularTest, ToolCourse
from zlmreport.machines.design import ThinnedDesign, clear_of_reversals, make_thinned_design
from zlmreport.machines.forms import CircleForm
from zlmreport.machines.machine import MachineModel, predict
from zlmreport.machines.noise import CircleNoise, NoiseFound, NoiseModel, Whitened, find_noise
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.units import Unit
from zlmreport.model.effects.circle_effect import (
    CircleEffect,
    CircleTerm,
    Estimate,
    SearchedParameter,
    title_parameter,
)

#: Standard uncertainty of the angle at which a turn begins, rad: a ballbar reckons its angle from time.
_START = float(np.radians(1.0))
#: Waves of which the slope over the angle is taken.
_SLOPE_ORDERS = 6
_COVERAGE = 2.0


@dataclass(frozen=True, slots=True)
class Chosen:
    """An effect of a model in the form that it has there."""

    effect: CircleEffect
    form: CircleForm
    #: Refined searched parameters, each with the column by which Δr changes with it: they are uncertain, too.
    tangents: tuple[tuple[SearchedParameter, FloatArray], ...] = ()

    @property
    def columns(self) -> FloatArray:
        """All its columns, (N, k): those of its terms, then the tangents."""
        return np.column_stack([self.form.columns, *(column for _, column in self.tangents)])


@dataclass(frozen=True, slots=True)
class EstimatedTerm:
    """A parameter of the model with its uncertainty, SI."""

    effect: str
    name: str
    title: Words  #: What pages call it.
    unit: Unit
    value: float
    expanded_uncertainty: float | None  #: k = 2; None where only values of a grid were tried.
    term: CircleTerm | None = None  #: None of a searched parameter.

    @property
    def is_possible(self) -> bool:
        """Whether its value lies within what physics allows, its uncertainty granted."""
        if self.term is None or self.expanded_uncertainty is None:
            return True
        u = self.expanded_uncertainty
        return self.term.low - u <= self.value <= self.term.high + u


@dataclass(frozen=True)
class CircleStudy:
    """Circles, thinned, with what the axes predict of them and the effects of a model."""

    design: ThinnedDesign  #: Where each reading was taken.
    deviation: FloatArray  #: Measured minus predicted by the axes, (N,), m.
    predicted: FloatArray  #: What the axes predict, (N,), m.
    factor: FloatArray  #: Its covariance as a factor, (N, r), m.
    #: What the noise of the design has in common, whatever the model.
    shared: CircleNoise = field(repr=False)
    effects: tuple[Chosen, ...] = ()  #: The effects of the model, each in its form.
    #: What is left that no effect explains: a curve whose random combination it is, (N, r), m. The
    #: uncertainties of the parameters hold it.
    unnamed: FloatArray | None = field(default=None, repr=False)

    @property
    def names(self) -> tuple[str, ...]:
        """The effects of the model, by name."""
        return tuple(each.effect.identifier for each in self.effects)

    @cached_property
    def base(self) -> FloatArray:
        """The columns of the model, (N, p)."""
        return np.concatenate(
            [np.zeros((self.design.count, 0)), *(each.columns for each in self.effects)], axis=1
        )

    @cached_property
    def _sigma(self) -> float:
        """A first standard deviation of a reading, with nothing else uncertain, m."""
        nothing = np.zeros((self.design.count, 0))
        return find_noise(NoiseModel(self.shared, self.base, nothing), self.deviation).sigma

    @property
    def _unit(self) -> float:
        return max(self._sigma, 1e-12)

    @cached_property
    def known(self) -> FloatArray:
        """What is uncertain by itself, as a factor in units of σ: axes, where turns begin, the unnamed."""
        turns = [_START * self._slope * (self.design.turn == turn) for turn in self.design.turns.tolist()]
        left = () if self.unnamed is None else (self.unnamed,)
        return np.column_stack([self.factor, *turns, *left]) / self._unit

    @cached_property
    def _slope(self) -> FloatArray:
        """Slope over θ of all that is known but the centre, by its first waves, m/rad."""
        curve = self.predicted + self._fit_shape()
        found = np.zeros(self.design.count)
        orders = np.arange(2, _SLOPE_ORDERS + 1)
        for turn in self.design.turns.tolist():
            own = self.design.turn == turn
            waves = np.outer(self.design.angle[own], np.arange(1, _SLOPE_ORDERS + 1))
            base = np.column_stack([np.ones(len(waves)), np.cos(waves), np.sin(waves)])
            # Part of a circle does not tell all waves apart: the plainest combination is taken.
            weights = np.linalg.lstsq(base, curve[own], rcond=1e-3)[0]
            a, b = weights[2 : _SLOPE_ORDERS + 1], weights[_SLOPE_ORDERS + 2 :]
            turned = waves[:, 1:]
            found[own] = -np.sin(turned) @ (orders * a) + np.cos(turned) @ (orders * b)
        return found

    def _fit_shape(self) -> FloatArray:
        """Return what the effects make of the deviation by plain least squares, without centre and radius."""
        if not self.base.shape[1]:
            return np.zeros(self.design.count)
        weights = np.linalg.lstsq(self.base, self.deviation, rcond=None)[0]
        is_shape = np.concatenate(
            [np.full(each.columns.shape[1], not each.effect.is_base) for each in self.effects]
        )
        return np.asarray(self.base[:, is_shape] @ weights[is_shape])

    @cached_property
    def model(self) -> NoiseModel:
        """The noise under this model."""
        return NoiseModel(self.shared, self.base, self.known)

    @cached_property
    def noise(self) -> NoiseFound:
        """The noise that the readings show under this model."""
        return find_noise(self.model, self.deviation)

    @property
    def noise_of_readings(self) -> float:
        """Root mean square of what scatters from reading to reading before they are thinned, m."""
        return self.noise.estimate_of_readings(float(self.design.sizes.mean()))

    @cached_property
    def whitened(self) -> Whitened:
        """The readings under the likeliest noise."""
        return self.model.whiten(self.noise.likeliest)

    @cached_property
    def solution(self) -> tuple[FloatArray, FloatArray]:
        """The parameters' values and covariance, averaged over the likely noises."""
        if not self.base.shape[1]:
            return np.zeros(0), np.zeros((0, 0))
        solved = [self.model.solve(shape, self.deviation) for shape in self.noise.shapes]
        values = np.array([each for each, _ in solved])
        covariances = self.noise.sigma**2 * np.array([each for _, each in solved])
        weights = self.noise.weights
        between = values - weights @ values
        covariance = np.einsum("f,fpq->pq", weights, covariances)
        return weights @ values, covariance + np.einsum("f,fp,fq->pq", weights, between, between)

    @property
    def estimates(self) -> tuple[EstimatedTerm, ...]:
        """The parameters with their uncertainties."""
        values, covariance = self.solution
        u = (_COVERAGE * np.sqrt(np.maximum(np.diag(covariance), 0.0))).tolist()
        found: list[EstimatedTerm] = []
        place = 0
        for each in self.effects:
            name, terms = each.effect.identifier, each.form.terms
            for term in terms:
                found.append(
                    EstimatedTerm(
                        name,
                        term.name,
                        title_parameter(term),
                        term.unit,
                        float(values[place]),
                        u[place],
                        term,
                    )
                )
                place += 1
            refined = {parameter.name: u[place + step] for step, (parameter, _) in enumerate(each.tangents)}
            place += len(each.tangents)
            found += [
                EstimatedTerm(
                    name,
                    parameter.name,
                    title_parameter(parameter),
                    parameter.unit,
                    value,
                    refined.get(parameter.name),
                )
                for parameter, value in zip(each.effect.searched, each.form.searched, strict=True)
            ]
        return tuple(found)

    def list_estimates_of(self, identifier: str) -> tuple[EstimatedTerm, ...]:
        """Return those of one effect."""
        return tuple(each for each in self.estimates if each.effect == identifier)

    @property
    def fitted(self) -> FloatArray:
        """What the effects of the model add to the prediction, (N,), m."""
        return np.asarray(self.base @ self.solution[0])

    @property
    def residual(self) -> FloatArray:
        """What is left, (N,), m."""
        return np.asarray(self.deviation - self.fitted)

    @property
    def rms(self) -> float:
        """The root mean square of that, m."""
        return float(np.sqrt(np.mean(self.residual**2)))

    def with_effect(self, added: Chosen) -> CircleStudy:
        """Return the study with one effect more."""
        return replace(self, effects=(*self.effects, added))

    def with_curve(self, curve: FloatArray) -> CircleStudy:
        """Return the study beside a curve without a name, a random combination of columns, (N, r), in σ."""
        return replace(self, unnamed=curve * self._unit)

    def without(self, identifier: str) -> CircleStudy:
        """Return the study without one of its effects."""
        return replace(
            self, effects=tuple(each for each in self.effects if each.effect.identifier != identifier)
        )


def find_noise_of_both(one: CircleStudy, other: CircleStudy) -> tuple[float, float]:
    """Return the noise beside two models of the same circles, and that of single readings, m.

    It is that of the one that describes them better: what the other leaves is no noise.
    """
    better = min(one, other, key=lambda each: each.noise.rms)
    return better.noise.rms, better.noise_of_readings


def list_said_estimates(estimates: Sequence[EstimatedTerm]) -> list[Estimate]:
    """Return the estimates of terms, as an effect is asked to say what they mean."""
    return [
        Estimate(each.name, each.unit, each.value, each.expanded_uncertainty)
        for each in estimates
        if each.term is not None and each.expanded_uncertainty is not None
    ]


def study_bare(machine: MachineModel, circles: Sequence[CircularTest]) -> CircleStudy:
    """Return the study of circles with an empty model."""
    circles = [clear_of_reversals(each) for each in circles]
    design = make_thinned_design(circles)
    courses = [each.make_course() for each in circles]
    tools = [
        np.tile(machine.tool if each.tool is None else each.tool, (len(each.position), 1)) for each in courses
    ]
    together = ToolCourse(
        np.concatenate([each.position for each in courses]),
        np.concatenate([each.sensing for each in courses]),
        np.concatenate([each.motion for each in courses]),
        np.concatenate(tools),
    )
    prediction = predict(machine, together)
    predicted = design.thin(prediction.values)
    measured = design.thin(np.concatenate([each.deviation for each in circles]))
    return CircleStudy(
        design, measured - predicted, predicted, design.thin(prediction.factor), CircleNoise(design)
    )
