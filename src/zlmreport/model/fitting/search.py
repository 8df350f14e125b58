"""Solves and refines searched (nonlinear) parameters by variable projection.

G. H. Golub and V. Pereyra, SIAM Journal on Numerical Analysis 10 (1973) 413. For any value of θ the linear
parameters are solved, so only the residual sum of squares as a function of θ is searched: over the grids of
all effects first (`grid_search`), then between their values, then by Gauss-Newton steps.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np

from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.model.effects.design import Design
from zlmreport.model.fitting.contrasts import Root

#: Of all terms, in the order of the model; empty arrays for terms without θ.
Thetas: TypeAlias = tuple[FloatArray, ...]

_HALVINGS = 12
_STEPS = 60
_CONVERGED = 1e-14
#: Step of a derivative over the distance of neighbours in the grid: where rounding and curvature err alike.
_DERIVATIVE = 3e-3
_SMALLEST_DAMPING, _LARGEST_DAMPING = 1e-12, 1e6
#: Between two targets every place of a kink fits alike. What differs by less than this part, sums of squares
#: and slopes beside what is imitated, chooses nothing: other processors round otherwise.
_ROUNDING = 1e-9
_IMITATED = 1e-7


@dataclass(frozen=True, slots=True)
class ContinuousParameter:
    """A searched parameter that varies continuously."""

    #: term and column: Index of its term, and of it among the θ of that term.
    term: int
    column: int
    spacing: float  #: Distance of neighbours in the grid about it.
    #: least and most: The ends of the grid: beyond, a relaxation becomes a constant, and a wave a straight
    #: line.
    least: float
    most: float

    def move(self, thetas: Thetas, shift: float) -> Thetas:
        """Return θ with this one shifted, but not beyond the grid."""
        value = min(max(float(thetas[self.term][self.column]) + shift, self.least), self.most)
        return self.at(thetas, value)

    def at(self, thetas: Thetas, value: float) -> Thetas:
        """Return θ with another value of this one."""
        changed = thetas[self.term].copy()
        changed[self.column] = value
        return (*thetas[: self.term], changed, *thetas[self.term + 1 :])


@dataclass(frozen=True, slots=True)
class Solution:
    """The linear parameters for one θ."""

    thetas: Thetas  #: θ of every term.
    coefficients: tuple[FloatArray, ...]  #: γ of every term, the given ones included.
    columns: FloatArray  #: (N, k): Whitened columns of those that were solved.
    residual: FloatArray  #: (N,): Whitened.

    @property
    def squares(self) -> float:
        """Residual sum of squares."""
        return float(self.residual @ self.residual)


@dataclass(frozen=True, slots=True)
class FitProblem:
    """A model to be fitted to deviations."""

    #: model, design and deviation: What is fitted to what.
    model: AxisModel
    design: Design
    deviation: FloatArray
    whiten: Root  #: Makes readings independent.
    # Of each term its last θ and what it comes to: from one solution to the next one term changes. Not
    # handed on by `replace`: another model has other columns.
    _last: dict[int, tuple[bytes, tuple[FloatArray, FloatArray]]] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def solve_at(self, thetas: Thetas) -> Solution:
        """Return the linear parameters for one θ."""
        thetas = self.model.link(thetas)
        columns, left = self.make_equations(thetas, range(len(thetas)))
        solved = solve(columns, left)
        return Solution(thetas, self.model.collect_coefficients(solved), columns, left - columns @ solved)

    def make_equations(self, thetas: Thetas, terms: Collection[int]) -> tuple[FloatArray, FloatArray]:
        """Return the whitened columns of some terms, and what their given coefficients leave, both whitened.

        `terms`: By their places in the model; what is linked to one of them comes along.
        """
        own = [self._compute_columns(index, theta) for index, theta in enumerate(thetas)]
        pairs = self.model.add_linked(self.design, thetas, own)
        chosen = [pairs[index] for index in terms]
        left = self.deviation - np.sum([given for _, given in chosen], axis=0)
        whitened = self.whiten(np.column_stack([*(each for each, _ in chosen), left]))
        return whitened[:, :-1], whitened[:, -1]

    def _compute_columns(self, index: int, theta: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the columns of a term whose coefficients are solved, and what the given ones make."""
        key, known = theta.tobytes(), self._last.get(index)
        if known is None or known[0] != key:
            known = key, self.model.terms[index].compute_columns(self.design, theta)
            self._last[index] = known
        return known[1]

    def list_continuous_parameters(self, thetas: Thetas) -> tuple[ContinuousParameter, ...]:
        """Return the searched parameters that vary continuously."""
        return tuple(
            _place(index, column, term.make_grid(self.design)[:, column], float(thetas[index][column]))
            for index, term in enumerate(self.model.terms)
            for column, is_searched in enumerate(term.is_searched(self.design))
            if is_searched and term.effect.searched[column].is_refined
        )


def solve(columns: FloatArray, values: FloatArray) -> FloatArray:
    """Return the coefficients of least squares; the columns are brought to one length first."""
    lengths = np.linalg.norm(columns, axis=0)
    scaled = columns / np.where(lengths > 0, lengths, 1.0)
    found = np.linalg.lstsq(scaled, values, rcond=None)[0]
    # Once more on what is left: polynomials of high order lose digits otherwise.
    found = found + np.linalg.lstsq(scaled, values - scaled @ found, rcond=None)[0]
    return found / np.where(lengths > 0, lengths, 1.0)


def refine(problem: FitProblem, start: Solution, settled: float = 0.0) -> Solution:
    """Return the best fit near another one: halving steps first, then Gauss-Newton.

    `settled`: As for `descend`.
    """
    best, places = start, problem.list_continuous_parameters(start.thetas)
    steps = [place.spacing / 2 for place in places]
    for _ in range(_HALVINGS if places else 0):
        for place, step in zip(places, steps, strict=True):
            either = [problem.solve_at(place.move(best.thetas, shift)) for shift in (step, -step)]
            best = _choose_better(best, min(either, key=_sum_squares))
        steps = [step / 2 for step in steps]
    return descend(problem, best, settled)


def compute_tangents(
    model: AxisModel, design: Design, solution: Solution, places: Sequence[ContinuousParameter]
) -> FloatArray:
    """Return ∂(Cγ)/∂θ on a design, shape (N, places)."""
    found = np.empty((len(design.position), len(places)))
    for number, place in enumerate(places):
        moving = (place.term, *model.find_followers(place.term, place.column))
        step = _DERIVATIVE * place.spacing
        value = float(solution.thetas[place.term][place.column])
        shifted = [model.link(place.at(solution.thetas, value + shift * step)) for shift in (-2, -1, 1, 2)]
        values = [
            sum(
                model.terms[index].effect.columns(design, thetas[index]) @ solution.coefficients[index]
                for index in moving
            )
            for thetas in shifted
        ]
        slope = (values[0] - 8 * values[1] + 8 * values[2] - values[3]) / (12 * step)
        # What rounding leaves of no slope at all would look like another column.
        is_flat = all(np.array_equal(each, values[0]) for each in values)
        found[:, number] = 0.0 if is_flat else slope
    return found


def descend(problem: FitProblem, start: Solution, settled: float) -> Solution:
    """Return the best fit by damped steps in θ, the linear parameters following (L. Kaufman's Jacobian).

    A step that changes the sum of squares by less than `settled` is the last.
    """
    best, places = start, problem.list_continuous_parameters(start.thetas)
    damping = _SMALLEST_DAMPING
    spacings = np.array([place.spacing for place in places])
    for _ in range(_STEPS if places else 0):
        slopes = problem.whiten(compute_tangents(problem.model, problem.design, best, places)) * spacings
        basis = np.linalg.qr(best.columns)[0]
        whole = np.linalg.norm(slopes, axis=0)
        slopes = slopes - basis @ (basis.T @ slopes)
        # What the linear parameters imitate to the last digits has no slope, and stays where it is.
        slopes[:, np.linalg.norm(slopes, axis=0) <= _IMITATED * whole] = 0.0
        lengths = np.linalg.norm(slopes, axis=0)
        if not np.any(lengths > 0):
            break
        lengths = np.where(lengths > 0, lengths, np.inf)
        damped = np.vstack([slopes / lengths, np.sqrt(damping) * np.eye(len(places))])
        aim = np.concatenate([best.residual, np.zeros(len(places))])
        step = np.linalg.lstsq(damped, aim, rcond=None)[0] / lengths
        thetas = best.thetas
        for place, shift in zip(places, step * spacings, strict=True):
            thetas = place.move(thetas, float(shift))
        tried = problem.solve_at(thetas)
        change = abs(tried.squares - best.squares)
        if tried.squares < best.squares:
            best, damping = tried, max(damping / 10, _SMALLEST_DAMPING)
        else:
            damping = max(damping * 100, 1e-6)
        if np.abs(step).max() < _CONVERGED or damping > _LARGEST_DAMPING or change < settled:
            break
    return best


def _choose_better(best: Solution, tried: Solution) -> Solution:
    """Return the better fit; the one there is where rounding alone tells them apart."""
    return tried if _sum_squares(tried) < _sum_squares(best) * (1 - _ROUNDING) else best


def _sum_squares(solution: Solution) -> float:
    squares = solution.squares
    return squares if np.isfinite(squares) else np.inf


def _place(term: int, column: int, values: FloatArray, theta: float) -> ContinuousParameter:
    """Return the place of a θ in its grid, with the distance of neighbours about it."""
    distinct = np.unique(values)
    near = int(np.clip(np.searchsorted(distinct, theta), 1, len(distinct) - 1))
    spacing = float(distinct[near] - distinct[near - 1])
    return ContinuousParameter(term, column, spacing, float(distinct[0]), float(distinct[-1]))
