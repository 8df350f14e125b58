"""Fits the parameters of a model with their covariance; predicts the deviation; cross-validation.

Generalized least squares on single readings, never on means: x = Σ C(θ)·γ + ε, Var ε = σ²·V(φ). The noise φ
is that of restricted maximum likelihood for the model at hand, θ is searched by variable projection, and the
covariance is that of all parameters, the searched ones included.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from zlmreport.errors import InputError, Place, Problem
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.axis_model import AxisModel, refuse_collisions
from zlmreport.model.effects.design import Design, list_outside_of_measured, place_at_positions
from zlmreport.model.effects.effect import Parameter
from zlmreport.model.fitting.contrasts import Contrasts, estimate_restricted, make_contrasts_of, make_root
from zlmreport.model.fitting.estimate import (
    InstrumentError,
    ParameterEstimate,
    Uncertainties,
    compute_coverage_factors,
    compute_variance_of_variance,
    list_estimates_of,
)
from zlmreport.model.fitting.grid_search import search
from zlmreport.model.fitting.noise import Noise, NoisePart, list_noise_parts, make_coarse_grid
from zlmreport.model.fitting.observations import select_readings
from zlmreport.model.fitting.repeats import compute_weights
from zlmreport.model.fitting.search import (
    ContinuousParameter,
    FitProblem,
    Solution,
    Thetas,
    compute_tangents,
    refine,
)

#: Variance of a source of shared scatter over that of single readings: none is larger in a fit.
_LARGEST_RATIO = 1e4
#: Share of the sum of squares by which a last step changes it where runs are predicted from the others.
_SETTLED = 1e-13


@dataclass(frozen=True, slots=True)
class Assumptions:
    """What a fit takes for granted."""

    #: The error of the instrument, for the uncertainty of all that is estimated.
    instrument: InstrumentError = field(default_factory=InstrumentError)
    #: Sources of shared scatter; None for those that the design can show.
    parts: tuple[NoisePart, ...] | None = None
    #: (N,) array or None: Variance of each reading over the mean one; None to see whether the readings
    #: scatter unequally.
    weights: FloatArray | None = None


@dataclass(frozen=True, slots=True)
class Prediction:
    """The deviation that the model gives where nobody measured."""

    deviation: FloatArray  #: (M,): m or rad.
    #: (M,): Of the model's value, not of a single reading to come; m or rad.
    standard_uncertainty: FloatArray
    coverage_factor: FloatArray  #: (M,): k for 95 %.

    @property
    def expanded_uncertainty(self) -> FloatArray:
        """U = k·u, shape (M,), m or rad."""
        return self.coverage_factor * self.standard_uncertainty


@dataclass(frozen=True, slots=True)
class Fit:
    """A fitted model."""

    #: model and design: What was fitted to which readings.
    model: AxisModel
    design: Design
    #: deviation and fitted: (N,): x and the model's value, m or rad.
    deviation: FloatArray
    fitted: FloatArray
    assumptions: Assumptions  #: What was taken for granted.
    estimates: tuple[ParameterEstimate, ...]  #: All parameters, in the order of the model.
    noise: Noise  #: What scatters.
    solution: Solution  #: The parameters as arrays.
    places: tuple[ContinuousParameter, ...]  #: The searched parameters that vary continuously.
    uncertainties: Uncertainties  #: What the uncertainty of any value follows from.

    @property
    def residual(self) -> FloatArray:
        """Deviations less model, shape (N,), m or rad."""
        return self.deviation - self.fitted

    @property
    def open_deviation(self) -> FloatArray:
        """Deviations less what given parameters make of them, shape (N,), m or rad."""
        return _open(self.model, self.design, self.deviation, self.solution)

    @property
    def of_the_job(self) -> Fit:
        """The same model beside the readings of the job's own session alone."""
        own = np.flatnonzero(self.design.session == 0)
        if len(own) == len(self.deviation):
            return self
        design = select_readings(self.design, own)
        return replace(self, design=design, deviation=self.deviation[own], fitted=self.fitted[own])

    @property
    def columns(self) -> tuple[tuple[str, Parameter], ...]:
        """The parameters in the order of their covariance, each with the identifier of its effect."""
        terms = self.model.terms
        solved = (
            (term.effect.identifier, parameter)
            for term in terms
            for parameter, is_solved in zip(term.effect.linear, term.is_solved, strict=True)
            if is_solved
        )
        effects = ((terms[place.term].effect, place.column) for place in self.places)
        return (*solved, *((effect.identifier, effect.searched[column]) for effect, column in effects))

    @property
    def degrees(self) -> int:
        """Readings less estimated parameters."""
        return len(self.deviation) - sum(estimate.is_free for estimate in self.estimates)

    @property
    def rms(self) -> float:
        """√(RSS/(N − q)), unweighted, m or rad."""
        return float(np.sqrt(np.sum(self.residual**2) / self.degrees))

    def compute_base(
        self, design: Design | None = None, *, without: frozenset[str] = frozenset()
    ) -> FloatArray:
        """Return what the model can imitate near its estimate: its columns and tangents, shape (N, p).

        On the readings that it was fitted to, or on those of another design.

        `without`: Effects that are left out.
        """
        names, design = self.model.identifiers, design or self.design
        columns = zip(names, _list_columns(self.model, design, self.solution), strict=True)
        places = [each for each in self.places if names[each.term] not in without]
        slopes = compute_tangents(self.model, design, self.solution, places)
        empty = np.empty((len(design.position), 0))
        return np.concatenate([empty, *(own for name, own in columns if name not in without), slopes], axis=1)

    def compute_value_at(self, design: Design) -> FloatArray:
        """Return the deviation that the model gives for other readings, m or rad, shape (M,)."""
        return _compute_value(self.model, design, self.solution)

    def predict(self, design: Design) -> Prediction:
        """Return the deviation that the model gives for other readings; valid on the measured span only.

        No deviation is known better than the instrument that it was measured with.
        """
        rows = _compute_jacobian(self.model, design, self.solution, self.places)
        standard, degrees = self.uncertainties.of(rows, self.assumptions.instrument.at_each_position)
        return Prediction(self.compute_value_at(design), standard, compute_coverage_factors(degrees))

    def predict_at(self, positions: FloatArray, place: Place) -> dict[Approach, Prediction]:
        """Return what the model gives at positions, m or rad, in each direction that was measured.

        Raises `InputError` at the place with each position that lies outside of what was measured.
        """
        design, axis = self.design, self.design.axis
        outside = list_outside_of_measured(axis.name, axis.position_unit, positions, design.span)
        if outside:
            raise InputError(Problem(place, each) for each in outside)
        return {
            approach: self.predict(place_at_positions(design, positions, approach))
            for approach in Approach
            if np.any(design.direction == approach)
        }


def fit(
    model: AxisModel,
    design: Design,
    deviation: FloatArray,
    assumptions: Assumptions | None = None,
    start: Thetas | None = None,
) -> Fit:
    """Fit a model to the readings of a test.

    A linear parameter that would lie beyond its bounds is held at the bound, one after another.

    `deviation`, (N,): x, m or rad.
    `start`: Searched parameters near their best values; the whole grid is searched if they are not given.

    Raises `ModelError` if the model makes no sense on the design, or its columns depend on each other.
    """
    found = _fit(model, design, deviation, assumptions or Assumptions(), start)
    while (held := _hold_beyond_bound(found)) is not None:
        found = _fit(held, design, deviation, assumptions or Assumptions(), found.solution.thetas)
    return found


def _hold_beyond_bound(found: Fit) -> AxisModel | None:
    """Return the model with the linear parameter farthest beyond its bound held there; None if none is."""
    farthest, held = 0.0, None
    terms = {term.effect.identifier: (index, term) for index, term in enumerate(found.model.terms)}
    for each in found.estimates:
        index, term = terms[each.effect]
        low, high = term.bounds.get(each.parameter.name, (-np.inf, np.inf))
        value = min(max(each.value, low), high)
        beyond = abs(each.value - value) / (each.standard_uncertainty or 1.0)
        if each.is_free and each.parameter in term.effect.linear and beyond > farthest:
            own = replace(term, fixed={**term.fixed, each.parameter.name: value})
            farthest, held = beyond, (index, own)
    if held is None:
        return None
    listed = list(found.model.terms)
    listed[held[0]] = held[1]
    return AxisModel(tuple(listed))


def _fit(
    model: AxisModel, design: Design, deviation: FloatArray, taken: Assumptions, start: Thetas | None
) -> Fit:
    model.check(design)
    parts = list_noise_parts(design) if taken.parts is None else taken.parts
    known = compute_weights(design, deviation) if taken.weights is None else taken.weights
    noise = Noise(0.0, {}, known)
    problem = FitProblem(model, design, deviation, make_root(parts, noise))
    solution = search(problem) if start is None else refine(problem, problem.solve_at(start))
    refuse_collisions(model, _list_columns(model, design, solution))
    for _ in range(2 if any(len(theta) for theta in solution.thetas) else 1):
        base = _compute_jacobian(model, design, solution, problem.list_continuous_parameters(solution.thetas))
        space = make_contrasts_of(base, parts, noise.weights)
        noise = _estimate_noise(space, _open(model, design, deviation, solution), noise.weights)
        problem = FitProblem(model, design, deviation, make_root(parts, noise))
        solution = refine(problem, problem.solve_at(solution.thetas))
    return _finish(problem, solution, space, noise, taken)


def _estimate_noise(space: Contrasts, deviation: FloatArray, weights: FloatArray) -> Noise:
    """Return the noise by restricted maximum likelihood."""
    ratios, variance = estimate_restricted(
        space, space.of(deviation), make_coarse_grid(space.parts), np.full(len(space.parts), _LARGEST_RATIO)
    )
    by_source = {part.source: float(ratio) for part, ratio in zip(space.parts, ratios, strict=True)}
    return Noise(float(np.sqrt(variance)), by_source, weights)


def _open(model: AxisModel, design: Design, deviation: FloatArray, solution: Solution) -> FloatArray:
    """Return deviations less what given parameters make of them, shape (N,)."""
    left = deviation
    for _, given in model.compute_columns(design, solution.thetas):
        left = left - given
    return left


def _list_columns(model: AxisModel, design: Design, solution: Solution) -> list[FloatArray]:
    """Return term by term the columns whose coefficients are solved."""
    return [solved for solved, _ in model.compute_columns(design, solution.thetas)]


def _compute_value(model: AxisModel, design: Design, solution: Solution) -> FloatArray:
    """Return the model's deviation on a design, shape (N,)."""
    found = np.zeros(len(design.position))
    for term, theta, gamma in zip(model.terms, solution.thetas, solution.coefficients, strict=True):
        found += term.effect.columns(design, theta) @ gamma
    return found


def _compute_jacobian(
    model: AxisModel, design: Design, solution: Solution, places: Sequence[ContinuousParameter]
) -> FloatArray:
    """Return J on a design: the columns that were solved, then the tangents, shape (N, p)."""
    empty = np.empty((len(design.position), 0))
    slopes = compute_tangents(model, design, solution, places)
    return np.concatenate([empty, *_list_columns(model, design, solution), slopes], axis=1)


def _finish(
    problem: FitProblem, solution: Solution, space: Contrasts, noise: Noise, assumptions: Assumptions
) -> Fit:
    model, design = problem.model, problem.design
    places = problem.list_continuous_parameters(solution.thetas)
    jacobian = _compute_jacobian(model, design, solution, places)
    whitened = problem.whiten(jacobian)
    lengths = np.linalg.norm(whitened, axis=0)
    lengths = np.where(lengths > 0, lengths, 1.0)
    root = np.linalg.pinv(whitened / lengths) / lengths[:, np.newaxis]
    inverse = root @ root.T
    systematic = root @ problem.whiten(assumptions.instrument.compute_factor(design))
    weighted = problem.whiten.apply_transposed(whitened) @ inverse
    variances = compute_variance_of_variance(space, noise, weighted)
    uncertainties = Uncertainties(noise.sigma, inverse, systematic, variances)
    return Fit(
        model=model,
        design=design,
        deviation=problem.deviation,
        assumptions=assumptions,
        fitted=_compute_value(model, design, solution),
        estimates=list_estimates_of(problem, solution, places, uncertainties),
        noise=noise,
        solution=solution,
        places=places,
        uncertainties=uncertainties,
    )


def cross_validate(model: AxisModel, design: Design, deviation: FloatArray, thetas: Thetas) -> float | None:
    """Return the root mean square error of runs that were left out; None if there is a single run.

    What depends on position alone is repeated in every run, so this number is too kind to it. It is one to
    watch, not one to rank by.

    `thetas`: Searched parameters of the whole test; refined anew without each run, as far as
        the others tell them.
    """
    cycle = design.cycle
    runs = np.unique(cycle)
    if len(runs) < 2:
        return None
    squares = 0.0
    for run in runs:
        left_out = np.flatnonzero(cycle == run)
        kept = np.flatnonzero(cycle != run)
        independent = make_root((), Noise(1.0, {}, np.ones(len(kept))))
        problem = FitProblem(model, select_readings(design, kept), deviation[kept], independent)
        found = problem.solve_at(thetas)
        # Without the run after a pause there is no pause, and nothing is known of what happens in it.
        if all(each.effect.untestable(problem.design) is None for each in model.terms):
            found = refine(problem, found, _SETTLED * found.squares)
        predicted = _compute_value(model, select_readings(design, left_out), found)
        squares += float(np.sum((deviation[left_out] - predicted) ** 2))
    return float(np.sqrt(squares / len(deviation)))
