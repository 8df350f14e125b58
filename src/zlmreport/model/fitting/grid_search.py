"""The best grid values of searched parameters, two terms at a time.

A step at a wrong place bends the wave beside it, and the bent wave holds the step there: where one term is
searched after another, the end hangs on the order in which a job names its effects. So terms get their values
one by one, always that next which leaves least; then those of two are tried together, each with each.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations, product

import numpy as np

from zlmreport.measurement.arrays import FloatArray, make_orthonormal_basis
from zlmreport.model.fitting.search import FitProblem, Solution, Thetas, refine

_SWEEPS = 4
#: Between two targets every place of a kink fits alike: what differs by less than this part chooses nothing,
#: as other processors round otherwise.
_ROUNDING = 1e-9
#: Square of the share of a column's length below which others imitate it.
_IMITATED = 1e-14


def search(problem: FitProblem) -> Solution:
    """Return the best fit on the grids of all terms, refined."""
    first = tuple(term.make_grid(problem.design)[0] for term in problem.model.terms)
    deviation = problem.make_equations(first, ())[1]
    grids = [_Grid.of(problem, first, deviation, terms) for terms in problem.model.linked_terms]
    chosen = _choose_one_by_one(deviation, grids)
    searched = [place for place, grid in enumerate(grids) if len(grid.columns) > 1]
    for _ in range(_SWEEPS):
        before = list(chosen)
        for one, other in combinations(searched, 2):
            _choose_together(deviation, grids, chosen, one, other)
        if chosen == before:
            break
    values = {
        term: theta
        for grid, row in zip(grids, chosen, strict=True)
        for term, theta in zip(grid.terms, grid.thetas[row], strict=True)
    }
    return refine(problem, problem.solve_at(tuple(values[term] for term in range(len(first)))))


@dataclass(frozen=True, slots=True)
class _Grid:
    """Values that are tried of terms whose parameters are linked, mostly of a single term."""

    terms: tuple[int, ...]  #: Their places in the model.
    thetas: Sequence[Thetas]  #: θ of each of these terms, row by row.
    columns: FloatArray  #: (g, N, k): Whitened columns whose coefficients are solved.
    given: FloatArray  #: (g, N): Whitened deviation that given coefficients make.

    @classmethod
    def of(cls, problem: FitProblem, first: Thetas, deviation: FloatArray, terms: tuple[int, ...]) -> _Grid:
        """Return the grid of some terms, all others at their first values."""
        rows: dict[bytes, Thetas] = {}
        for own in product(*(problem.model.terms[term].make_grid(problem.design) for term in terms)):
            values = dict(zip(terms, own, strict=True))
            thetas = problem.model.link([values.get(term, theta) for term, theta in enumerate(first)])
            rows[b"".join(thetas[term].tobytes() for term in terms)] = thetas
        equations = [problem.make_equations(thetas, terms) for thetas in rows.values()]
        return cls(
            terms,
            [tuple(thetas[term] for term in terms) for thetas in rows.values()],
            np.stack([columns for columns, _ in equations]),
            np.stack([deviation - left for _, left in equations]),
        )


def _choose_one_by_one(deviation: FloatArray, grids: Sequence[_Grid]) -> list[int]:
    """Return a row of each grid, found beside those alone that have theirs already."""
    chosen = [0 for _ in grids]
    known = [place for place, grid in enumerate(grids) if len(grid.columns) == 1]
    while open_ := [place for place in range(len(grids)) if place not in known]:
        beside = [(grids[place], chosen[place]) for place in known]
        left = {place: _list_left(deviation, beside, grids[place]) for place in open_}
        best = min(open_, key=lambda place: float(left[place].min()))
        chosen[best] = _find_first_best(left[best])
        known.append(best)
    return chosen


def _choose_together(
    deviation: FloatArray, grids: Sequence[_Grid], chosen: list[int], one: int, other: int
) -> None:
    """Move two grids to the rows that leave least together, all else as it is."""
    few, many = sorted((one, other), key=lambda place: len(grids[place].columns))
    rest = [
        (grid, row)
        for place, (grid, row) in enumerate(zip(grids, chosen, strict=True))
        if place not in (one, other)
    ]
    left = np.array(
        [
            _list_left(deviation, [*rest, (grids[few], row)], grids[many])
            for row in range(len(grids[few].columns))
        ]
    )
    if left.min() < left[chosen[few], chosen[many]] * (1 - _ROUNDING):
        chosen[few], chosen[many] = divmod(_find_first_best(left.ravel()), left.shape[1])


def _list_left(deviation: FloatArray, beside: Sequence[tuple[_Grid, int]], grid: _Grid) -> FloatArray:
    """Return the residual sum of squares with each row of a grid beside rows of others, shape (g,).

    `deviation`, (N,): Whitened.
    """
    empty = np.empty((len(deviation), 0))
    others = np.concatenate([empty, *(each.columns[row] for each, row in beside)], axis=1)
    basis = make_orthonormal_basis(others, _IMITATED**0.5)
    left = deviation - sum(each.given[row] for each, row in beside) - grid.given
    left = left - (left @ basis) @ basis.T
    with np.errstate(over="ignore", invalid="ignore"):  # a row without a finite value is never the best
        own = grid.columns - basis @ (basis.T @ grid.columns)
        lengths = np.linalg.norm(grid.columns, axis=1)
    scaled = own / np.where(lengths > 0, lengths, 1.0)[:, np.newaxis]
    values, vectors = np.linalg.eigh(scaled.transpose(0, 2, 1) @ scaled)
    seen = values > _IMITATED
    products = (left[:, np.newaxis] @ scaled @ vectors)[:, 0]
    explained = np.sum(np.where(seen, products**2 / np.where(seen, values, 1.0), 0.0), axis=1)
    found = np.sum(left**2, axis=1) - explained
    return np.asarray(np.where(np.isfinite(found), found, np.inf))


def _find_first_best(left: FloatArray) -> int:
    """Return the first of those that leave least, as far as rounding tells them apart."""
    least = float(left.min())
    return int(np.flatnonzero(left <= least + _ROUNDING * abs(least))[0])
