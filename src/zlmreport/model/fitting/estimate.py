"""Uncertainty of fitted parameters: coverage factor, plausibility, the instrument's common error.

M. Halaj, E. Kureková, R. Palenčár and T. Loebl, The positional deviation in two axes, equations (7) to (9):
U(x) = diag(u²(P_i)) + u²(δ)·i·iᵀ. The second term changes no estimate and no residual of a model with a
constant, so it can hide no misfit; it is an uncertainty of every prediction.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from math import inf, sqrt

import numpy as np

from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.axis import Axis
from zlmreport.model.effects.axis_model import Term
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.effect import Dimension, Parameter
from zlmreport.model.fitting.contrasts import Contrasts
from zlmreport.model.fitting.distributions import t_quantile
from zlmreport.model.fitting.noise import Noise
from zlmreport.model.fitting.search import ContinuousParameter, FitProblem, Solution

_ACTIVE = 1e-3
_FEWEST, _MOST = 1.0, 1e6
#: Probability of expanded uncertainties: that of two standard deviations of a normal variable.
COVERAGE = 0.9545
_WELL_KNOWN = 1e5
#: Coverage factors that are computed where there are many.
_FACTORS = 25


@dataclass(frozen=True, slots=True)
class InstrumentError:
    """Standard uncertainty of the instrument; what readings share does not average out."""

    common: float = 0.0  #: u(δ), the same at all positions, m or rad.
    #: Per distance from the first position, m/m or rad/rad: the paper has none, a laser's wavelength does.
    proportional: float = 0.0
    at_each_position: float = 0.0  #: Shared by all readings at one position, and by no others, m or rad.
    #: Shared by all readings of the negative direction, against those of the positive one, m or rad.
    between_directions: float = 0.0

    def compute_factor(self, design: Design) -> FloatArray:
        """Return F with F·Fᵀ the covariance of the readings of a test, shape (N, 3 and more)."""
        position = design.position
        shared = [
            np.full(len(position), self.common),
            self.proportional * (position - position.min()),
            self.between_directions * (design.direction < 0),
        ]
        if self.at_each_position:
            shared += [self.at_each_position * (position == each) for each in np.unique(position)]
        return np.column_stack(shared)


@dataclass(frozen=True, slots=True)
class VarianceOfVariance:
    """What is needed to judge the variance of any linear combination of parameters."""

    covariance: FloatArray  #: (c, c): Of the estimated variance components, in units of σ̂⁴.
    #: sequence of (r, p): For each component a matrix S with ∂(jᵀ·Cov·j)/∂(component) = |S·j|².
    slopes: tuple[FloatArray, ...]

    def compute_degrees(self, combination: FloatArray, variance: float) -> float:
        """Return the effective degrees of freedom of jᵀ·Cov·j, given in units of σ̂².

        `combination`, (p,): j.
        `variance`: jᵀ·Cov·j / σ̂².
        """
        gradient = np.array([float(np.sum((slope @ combination) ** 2)) for slope in self.slopes])
        spread = float(gradient @ self.covariance @ gradient)
        if spread <= 0:
            return _MOST
        return float(np.clip(2 * variance**2 / spread, _FEWEST, _MOST))


def compute_variance_of_variance(space: Contrasts, noise: Noise, weighted: FloatArray) -> VarianceOfVariance:
    """Return how well the variance of the parameters is known.

    `weighted`, (N, p): V⁻¹J(JᵀV⁻¹J)⁻¹: the weight of each reading in each parameter.
    """
    active = [index for index, part in enumerate(space.parts) if noise.ratios.get(part.source, 0.0) > _ACTIVE]
    ratios = np.array([noise.ratios.get(part.source, 0.0) for part in space.parts])
    information = _compute_information(space, ratios, active)
    factors = [space.parts[index].factor.T @ weighted for index in active]
    slopes = (weighted / space.scale[:, np.newaxis], *factors)
    return VarianceOfVariance(np.asarray(np.linalg.pinv(information), dtype=np.float64), slopes)


def _compute_information(space: Contrasts, ratios: FloatArray, active: Sequence[int]) -> FloatArray:
    """Return ½·tr(P·V_i·P·V_j) for single readings and the active sources, in units of σ̂⁻⁴."""
    root = space.make_metric(ratios).compute_coordinates(np.eye(len(space.gram)))
    together = root.T @ root
    ends = np.cumsum([part.factor.shape[1] for part in space.parts])
    spans = [slice(int(ends[i]) - space.parts[i].factor.shape[1], int(ends[i])) for i in active]
    gram = space.gram
    inner = gram - gram @ together @ gram  # ZᵀPZ
    outer = inner - inner @ together @ gram  # ZᵀPPZ
    own = gram @ together
    traces = np.empty((len(active) + 1, len(active) + 1))
    traces[0, 0] = space.degrees - 2 * np.trace(own) + np.sum(own * own.T)
    for row, span in enumerate(spans, 1):
        traces[0, row] = traces[row, 0] = np.trace(outer[span, span])
        for column, other in enumerate(spans, 1):
            traces[row, column] = np.sum(inner[span, other] ** 2)
    return 0.5 * traces


class Plausibility(Enum):
    """How a value lies to the range that is physically plausible."""

    PLAUSIBLE = "plausible"
    DOUBTFUL = "within its uncertainty of the plausible range"
    IMPLAUSIBLE = "outside the plausible range"
    UNKNOWN = "nothing is known of what is plausible"


@dataclass(frozen=True, slots=True)
class ParameterEstimate:
    """A parameter of the model as estimated."""

    effect: str  #: Identifier of its effect.
    parameter: Parameter  #: What it is.
    value: float  #: SI.
    #: SI; 0 for a value that is given or held. Of a scanned value, that of a rectangular distribution.
    standard_uncertainty: float
    degrees: float  #: Effective degrees of freedom of the uncertainty; infinite for a value given or held.
    is_given: bool = False  #: Whether it was given and not estimated.
    expected: float | None = None  #: The value that follows from the job, SI; None where none does.
    #: Whether it was found among the values of a grid, and nothing is known of what lies between them: its
    #: expanded uncertainty is then the whole half-width of the interval that holds it.
    is_scanned: bool = False
    #: The parameter of another effect that it is and that is estimated once, ``effect.parameter``.
    equals: str = ""
    #: The bound at which it is held, ``min`` or ``max``: the readings would have it beyond.
    at_bound: str = ""

    @property
    def is_free(self) -> bool:
        """Whether it is estimated for itself."""
        return not (self.is_given or self.at_bound or self.equals)

    @property
    def coverage_factor(self) -> float:
        """The factor k to the expanded uncertainty of 95 %; √3, the whole interval, for a scanned value."""
        return sqrt(3) if self.is_scanned else compute_coverage_factor(self.degrees)

    @property
    def expanded_uncertainty(self) -> float:
        """U = k·u, SI."""
        return self.coverage_factor * self.standard_uncertainty

    def plausibility(self, *, time_is_counted: bool) -> Plausibility:
        """Return how the value lies to its plausible range; nothing is known of counted times."""
        smallest, largest = self.parameter.smallest, self.parameter.largest
        counted = time_is_counted and self.parameter.dimension is Dimension.TIME
        if counted or (smallest is None and largest is None):
            return Plausibility.UNKNOWN
        low, high = -inf if smallest is None else smallest, inf if largest is None else largest
        if low <= self.value <= high:
            return Plausibility.PLAUSIBLE
        reach = self.expanded_uncertainty
        if low <= self.value + reach and self.value - reach <= high:
            return Plausibility.DOUBTFUL
        return Plausibility.IMPLAUSIBLE


def compute_coverage_factor(degrees: float) -> float:
    """Return k for an expanded uncertainty of 95.45 %: 2 where the standard uncertainty is well known."""
    return 2.0 if degrees > _WELL_KNOWN else t_quantile(COVERAGE, degrees)


def compute_coverage_factors(degrees: FloatArray) -> FloatArray:
    """Return k for many degrees of freedom, shape (M,).

    k is smooth in 1/ν: between a few values it is interpolated, to 1e-3 where ν is at least 3.
    """
    inverse = 1.0 / degrees
    known = np.unique(inverse)
    if len(known) > _FACTORS:
        known = np.linspace(known[0], known[-1], _FACTORS)
    return np.interp(inverse, known, [compute_coverage_factor(1.0 / each) for each in known.tolist()])


@dataclass(frozen=True, slots=True)
class Uncertainties:
    """What the uncertainty of every estimate follows from."""

    sigma: float  #: Standard deviation of a single reading, m or rad.
    inverse: FloatArray  #: (p, p): (JᵀV⁻¹J)⁻¹.
    systematic: FloatArray  #: (p, …): What the instrument's error does to the parameters.
    variances: VarianceOfVariance  #: How well the variance is known.

    @property
    def covariance(self) -> FloatArray:
        """Of the parameters, the instrument's share in it, shape (p, p)."""
        return np.asarray(self.sigma**2 * self.inverse + self.systematic @ self.systematic.T)

    def of(self, rows: FloatArray, least: float = 0.0) -> tuple[FloatArray, FloatArray]:
        """Return standard uncertainty and degrees of freedom of linear combinations, rows of shape (M, p).

        What the instrument does to them counts with `least` at least.
        """
        scaled = np.einsum("np,pq,nq->n", rows, self.inverse, rows)
        random = self.sigma**2 * scaled
        total = random + np.maximum(np.sum((rows @ self.systematic) ** 2, axis=1), least**2)
        degrees = np.array(
            [self.variances.compute_degrees(row, part) for row, part in zip(rows, scaled, strict=True)]
        )
        # The instrument's share is known from its certificate: Welch and Satterthwaite with one term.
        shares = np.divide(total, random, out=np.ones_like(total), where=random > 0)
        return np.sqrt(total), degrees * shares**2


def list_estimates_of(
    problem: FitProblem,
    solution: Solution,
    places: Sequence[ContinuousParameter],
    uncertainties: Uncertainties,
) -> tuple[ParameterEstimate, ...]:
    """Return every parameter of a fitted model, in its order, the linear ones of each effect first."""
    count = len(uncertainties.inverse)
    standard, degrees = uncertainties.of(np.eye(count))
    solved = iter(zip(standard.tolist(), degrees.tolist(), strict=True))
    terms = zip(problem.model.terms, solution.coefficients, strict=True)
    linear = [list(_estimate_linear(term, gamma, solved)) for term, gamma in terms]
    by_place = {
        (place.term, place.column): (
            float(standard[count - len(places) + number]),
            float(degrees[count - len(places) + number]),
        )
        for number, place in enumerate(places)
    }
    found: list[ParameterEstimate] = []
    for index, term in enumerate(problem.model.terms):
        found.extend(_add_expected(each, term, problem.design.axis) for each in linear[index])
        searched = term.is_searched(problem.design)
        for column, parameter in enumerate(term.effect.searched):
            value = float(solution.thetas[index][column])
            if not searched[column]:
                estimate = ParameterEstimate(
                    term.effect.identifier, parameter, value, 0.0, inf, is_given=True
                )
            else:
                u, nu = by_place.get((index, column), (0.0, inf))
                is_scanned = u == 0 or not np.isfinite(u)
                if is_scanned:
                    low, high = find_scanned_ends(problem, solution, index, column, uncertainties.sigma)
                    u, nu = max(value - low, high - value) / sqrt(3), inf
                estimate = ParameterEstimate(
                    term.effect.identifier, parameter, value, u, nu, is_scanned=is_scanned
                )
            found.append(_add_expected(estimate, term, problem.design.axis))
    return tuple(_link_estimate(each, found, problem) for each in found)


def _link_estimate(
    estimate: ParameterEstimate, found: Sequence[ParameterEstimate], problem: FitProblem
) -> ParameterEstimate:
    """Return the estimate of a parameter that equals another: the value and uncertainty of that."""
    links = {term.effect.identifier: term.links for term in problem.model.terms}[estimate.effect]
    if estimate.parameter.name not in links:
        return estimate
    other = links[estimate.parameter.name]
    target = next(each for each in found if (each.effect, each.parameter.name) == other)
    return replace(
        target,
        effect=estimate.effect,
        parameter=estimate.parameter,
        expected=estimate.expected,
        equals=".".join(other),
    )


def _estimate_linear(
    term: Term, gamma: FloatArray, solved: Iterator[tuple[float, float]]
) -> Iterator[ParameterEstimate]:
    for parameter, value, is_solved in zip(term.effect.linear, gamma.tolist(), term.is_solved, strict=True):
        u, degrees = next(solved) if is_solved else (0.0, inf)
        held = term.find_bound(parameter)
        is_given = not (is_solved or held)
        yield ParameterEstimate(
            term.effect.identifier, parameter, value, u, degrees, is_given=is_given, at_bound=held
        )


def _add_expected(estimate: ParameterEstimate, term: Term, axis: Axis) -> ParameterEstimate:
    expected = term.effect.expected(axis).get(estimate.parameter.name)
    if expected is None:
        return estimate
    return replace(estimate, expected=expected)


def find_scanned_ends(
    problem: FitProblem, solution: Solution, index: int, column: int, sigma: float
) -> tuple[float, float]:
    """Return the ends of the interval of a θ that jumps from value to value and has no derivative.

    Its likelihood is flat between two readings, and falls in steps: the interval is that of the values of
    the grid which four variances of a reading do not exclude, and half the distance to the next on each side.
    """
    theta = solution.thetas[index]
    values = np.unique(problem.model.terms[index].make_grid(problem.design)[:, column])
    limit = solution.squares + 4.0 * sigma**2
    possible = [int(np.argmin(np.abs(values - theta[column])))]
    for number, other in enumerate(values.tolist()):
        moved = theta.copy()
        moved[column] = other
        thetas = (*solution.thetas[:index], moved, *solution.thetas[index + 1 :])
        if problem.solve_at(thetas).squares <= limit:
            possible.append(number)
    ends = np.concatenate([values[:1], (values[1:] + values[:-1]) / 2, values[-1:]])
    return float(ends[min(possible)]), float(ends[max(possible) + 1])
