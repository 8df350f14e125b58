"""Columns over the readings and their products under a covariance, kept for the contest's speed.

Every column stands as error contrasts: whatever the job's model can imitate is taken out of it. Products of
columns are computed once and kept; a set of effects beside any amplitudes of what has no name is then a
matter of small matrices, however many readings there are. The largest part of the covariance, what is
irregular from position to position, has one column for each target and is eliminated first (M. A. Woodbury):
target by target, and then the model among what is left.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from zlmreport.measurement.arrays import FloatArray, IntArray, read_only_integers
from zlmreport.model.fitting.by_target import FactorsByTarget, find_roots_of_blocks
from zlmreport.model.fitting.contrasts import Contrasts, SingleReadings

_FIRST_ROOM = 256


class _Table:
    """Products of columns with the first ones, a column a row; filled as they are asked for."""

    def __init__(self, core: FloatArray) -> None:
        """Begin a table with the products of the core, or with none."""
        self.values, self._filled = core, len(core)
        self._row = np.arange(len(core))  # of each column by its place; −1 of those that nobody asked for

    def find_rows(self, places: IntArray, fill: Callable[[IntArray], FloatArray]) -> IntArray:
        """Return the rows of some columns; `fill` makes those that are missing."""
        if len(places) and places.max() >= len(self._row):
            more = np.full(int(places.max()) + 1 + len(self._row), -1)
            more[: len(self._row)] = self._row
            self._row = more
        found = self._row[places]
        if found.min(initial=0) < 0:
            missing = np.unique(places[found < 0])
            first, self._filled = self._filled, self._filled + len(missing)
            if self._filled > len(self.values):
                room = np.empty((self._filled, self.values.shape[1]))
                self.values = np.concatenate([self.values, room])
            self.values[first : self._filled] = fill(missing)
            self._row[missing] = np.arange(first, self._filled)
            found = self._row[places]
        return found


@dataclass(frozen=True, slots=True)
class HeldContrasts:
    """Contrasts that are not in a table, held against it under many covariances."""

    contrasts: FloatArray  #: (N, k)
    sums: FloatArray  #: (k, r): Products with the irregular factors, target by target.


@dataclass(slots=True)
class _Eliminated:
    """Irregular shares of given amplitudes, eliminated: products a·b become a·b − ã·b̃."""

    log_determinant: float
    roots: FloatArray  #: (m, a, p): R of each target, a of its p factors having a share.
    base: FloatArray  #: (q, m·a): The model, what the shares take of it made orthonormal.
    turned: _Table  #: ã of columns.
    near: _Table  #: Products with the columns of the core.
    kept: _Table  #: Products with all kept columns.
    squares: dict[bytes, FloatArray] = field(default_factory=dict)  #: Of blocks among themselves.
    among: dict[bytes, FloatArray] = field(default_factory=dict)  #: Of sets of columns among themselves.

    def turn(self, sums: FloatArray) -> FloatArray:
        """Return ã of columns from their products with the irregular factors, shape (k, m·a + q)."""
        own = _turn_by_target(sums, self.roots)
        return np.concatenate([own, own @ self.base.T], axis=1)

    def multiply_with_many(self, turned: FloatArray, sums: FloatArray) -> FloatArray:
        """Return ã·b̃ of few columns a, turned, and of many b, of which the sums do: ã is turned back."""
        if not self.roots.size:
            return np.zeros((len(turned), len(sums)))
        count = turned.shape[1] - len(self.base)
        own = turned[:, :count] + turned[:, count:] @ self.base
        return np.asarray(_turn_by_target(own, self.roots.transpose(0, 2, 1)) @ sums.T)


class Columns:
    """A table of columns that grows; `space` has the contrasts of the job's model."""

    def __init__(self, space: Contrasts, irregular: Sequence[FloatArray]) -> None:
        """Begin a table.

        `irregular`: Factors (N, m) of what is irregular from position to position.
        """
        self.space = space
        readings = len(space.scale)
        self._factors = FactorsByTarget(irregular, readings)
        self._width = sum(each.shape[1] for each in irregular)
        self._among = _multiply_factors(space.single, irregular)
        self._base = self._sum(space.base)
        # A row each: to gather some of them then copies whole stretches.
        self._values = np.empty((_FIRST_ROOM, readings))
        self._sums = np.empty((_FIRST_ROOM, self._width))
        self._count = self._core = self._kept = 0
        # Of products with the columns of the core and with all kept ones, nothing eliminated.
        self._near, self._plain = _Table(np.empty((0, 0))), _Table(np.empty((0, 0)))
        self._eliminated: dict[tuple[float, ...], _Eliminated] = {}

    def add(self, contrasts: FloatArray) -> IntArray:
        """Take columns in, contrasts of shape (N, k); return their places."""
        first, self._count = self._count, self._count + contrasts.shape[1]
        while self._count > len(self._values):
            self._values = np.concatenate([self._values, np.empty_like(self._values)])
            self._sums = np.concatenate([self._sums, np.empty_like(self._sums)])
        self._values[first : self._count] = contrasts.T
        self._sums[first : self._count] = self._sum(contrasts)
        return read_only_integers(np.arange(first, self._count))

    def hold(self, contrasts: FloatArray) -> HeldContrasts:
        """Return contrasts, shape (N, k), ready for products with the columns of the table."""
        return HeldContrasts(contrasts, self._sum(contrasts))

    def keep(self, core: int) -> None:
        """Say that products of the columns so far will be asked for again and again, most of all of a core.

        `core`: How many of the first columns are the core.
        """
        self._core, self._kept = core, self._count
        self._plain = _Table(self._values[:core] @ self._values[: self._count].T)
        self._near = _Table(self._plain.values[:, :core])

    def select_columns(self, places: IntArray) -> FloatArray:
        """Return columns, shape (N, k)."""
        return self._values[places].T

    def log_determinant(self, ratios: tuple[float, ...]) -> float:
        """Return ln|V| of the irregular shares alone, within the space of contrasts."""
        return self._of(ratios).log_determinant

    def multiply(self, ratios: tuple[float, ...], one: IntArray, other: IntArray) -> FloatArray:
        """Return products of columns under irregular shares, shape (k, l)."""
        known = self._of(ratios)
        if not (len(one) and len(other)):
            return np.empty((len(one), len(other)))
        if other.max() < self._core:
            rows = known.near.find_rows(one, lambda missing: self._multiply_with_core(known, missing))
            return known.near.values[rows[:, np.newaxis], other]
        if one.max() < self._core:
            return self.multiply(ratios, other, one).T
        return self._multiply_between(known, one, other)

    def multiply_among(
        self, ratios: tuple[float, ...], first: IntArray, members: IntArray, last: IntArray
    ) -> FloatArray:
        """Return products of columns of the core, of a set and of the core again, among themselves."""
        known, begin, end = self._of(ratios), len(first), len(first) + len(members)
        together = np.concatenate([first, members, last])
        found = np.empty((len(together), len(together)))
        rows = known.near.find_rows(together, lambda missing: self._multiply_with_core(known, missing))
        rows = rows[:, np.newaxis]
        found[:, :begin] = known.near.values[rows, first]
        found[:, end:] = known.near.values[rows, last]
        found[:begin, begin:end] = found[begin:end, :begin].T
        found[end:, begin:end] = found[begin:end, end:].T
        if len(members):
            # The same set is asked about again and again, each time beside other curves without a name.
            key = members.tobytes()
            if key not in known.among:
                known.among[key] = self._multiply_between(known, members, members)
            found[begin:end, begin:end] = known.among[key]
        return found

    def multiply_core_blocks(self, ratios: tuple[float, ...], blocks: IntArray) -> FloatArray:
        """Return products of the columns of blocks of the core among themselves, shape (g, k, k)."""
        # The first rows of the table are those of the core.
        return self._of(ratios).near.values[blocks[:, :, np.newaxis], blocks[:, np.newaxis, :]]

    def multiply_with_kept(self, ratios: tuple[float, ...], one: IntArray, kept: IntArray) -> FloatArray:
        """Return the same products with many of the kept columns."""
        if not len(one):
            return np.empty((0, len(kept)))
        known = self._of(ratios)
        rows = known.kept.find_rows(one, lambda missing: self._multiply_with_all_kept(known, missing))
        return known.kept.values[rows[:, np.newaxis], kept]

    def multiply_with(self, ratios: tuple[float, ...], one: IntArray, held: HeldContrasts) -> FloatArray:
        """Return products of columns with contrasts that are not in the table, shape (k, l)."""
        known = self._of(ratios)
        less = known.multiply_with_many(known.turn(held.sums), self._sums[one])
        return np.asarray(self._values[one] @ held.contrasts - less.T)

    def multiply_kept_blocks(self, ratios: tuple[float, ...], blocks: IntArray) -> FloatArray:
        """Return products of the columns of each of some kept blocks among themselves, shape (g, k, k)."""
        known, key = self._of(ratios), blocks.tobytes()
        if key not in known.squares:
            flat = blocks.ravel()
            known.squares[key] = self._multiply_within(
                known, HeldContrasts(self.select_columns(flat), self._sums[flat]), blocks.shape[1]
            )
        return known.squares[key]

    def multiply_held_blocks(self, ratios: tuple[float, ...], held: HeldContrasts, width: int) -> FloatArray:
        """Return the same of contrasts that are not in the table, so many in a block."""
        return self._multiply_within(self._of(ratios), held, width)

    def _sum(self, contrasts: FloatArray) -> FloatArray:
        """Return products of contrasts, (N, k), with the irregular factors, shape (k, r)."""
        # Contrasts are at right angles to the model: the factors themselves do for their contrasts.
        sums = self._factors.sum_by_target(self.space.single.apply_transposed(contrasts))
        return sums.transpose(2, 0, 1).reshape(contrasts.shape[1], self._width)

    def _multiply_within(self, known: _Eliminated, held: HeldContrasts, width: int) -> FloatArray:
        rows = np.ascontiguousarray(held.contrasts.T).reshape(-1, width, len(held.contrasts))
        turned = known.turn(held.sums).reshape(len(rows), width, -1)
        return np.asarray(rows @ rows.transpose(0, 2, 1) - turned @ turned.transpose(0, 2, 1))

    def _multiply_with_core(self, known: _Eliminated, places: IntArray) -> FloatArray:
        core = slice(0, self._core)
        rows = self._near.find_rows(places, lambda missing: self._values[missing] @ self._values[core].T)
        # The first rows of the table are those of the core.
        less = self._turn(known, places) @ known.turned.values[core].T
        return np.asarray(self._near.values[rows] - less)

    def _multiply_with_all_kept(self, known: _Eliminated, places: IntArray) -> FloatArray:
        kept = slice(0, self._kept)
        rows = self._plain.find_rows(places, lambda missing: self._values[missing] @ self._values[kept].T)
        less = known.multiply_with_many(self._turn(known, places), self._sums[kept])
        return np.asarray(self._plain.values[rows] - less)

    def _multiply_between(self, known: _Eliminated, one: IntArray, other: IntArray) -> FloatArray:
        less = self._turn(known, one) @ self._turn(known, other).T
        return np.asarray(self._values[one] @ self._values[other].T - less)

    def _turn(self, known: _Eliminated, places: IntArray) -> FloatArray:
        """Return ã of columns, shape (k, m·a + q)."""
        rows = known.turned.find_rows(places, lambda missing: known.turn(self._sums[missing]))
        return known.turned.values[rows]

    def _of(self, ratios: tuple[float, ...]) -> _Eliminated:
        if ratios not in self._eliminated:
            self._eliminated[ratios] = self._eliminate(ratios)
        return self._eliminated[ratios]

    def _eliminate(self, ratios: tuple[float, ...]) -> _Eliminated:
        spread = np.tile(ratios, self._among.shape[1] // (len(ratios) or 1))
        active = np.flatnonzero(spread)
        own, logarithm = find_roots_of_blocks(self._among, active, spread[active])
        roots = np.zeros((len(own), len(active), len(spread)))
        roots[:, :, active] = own
        base = _turn_by_target(self._base, roots)
        factor = np.linalg.cholesky(np.eye(len(base)) - base @ base.T)
        known = _Eliminated(
            logarithm + 2.0 * float(np.log(np.diagonal(factor)).sum()),
            roots,
            np.linalg.inv(factor) @ base,
            _Table(np.empty((0, base.shape[1] + len(base)))),
            _Table(np.empty((0, self._core))),
            _Table(np.empty((0, self._kept))),
        )
        known.near.find_rows(np.arange(self._core), lambda missing: self._multiply_with_core(known, missing))
        return known


def _multiply_factors(single: SingleReadings, irregular: Sequence[FloatArray]) -> FloatArray:
    """Return ZᵀZ of the irregular factors, single readings made independent, shape (m, p, p).

    A block for each target; where readings are like those before them, one for all: m = 1.
    """
    readings = len(single.scale)
    if single.kept is None or not irregular:
        return FactorsByTarget([single.whiten(each) for each in irregular], readings).compute_gram()
    whitened = single.whiten(np.stack(irregular, axis=2).reshape(readings, -1))
    return (whitened.T @ whitened)[np.newaxis]


def _turn_by_target(sums: FloatArray, roots: FloatArray) -> FloatArray:
    """Return R of each target, (m, a, p), times the products of columns with its factors.

    `sums`: (k, m·p); what is returned is of shape (k, m·a).
    """
    targets, active, factors = roots.shape
    apart = sums.reshape(len(sums), targets, factors)
    turned = apart.transpose(1, 0, 2) @ roots.transpose(0, 2, 1)
    return turned.transpose(1, 0, 2).reshape(len(sums), targets * active)
