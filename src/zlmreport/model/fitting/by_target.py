"""Algebra of a covariance that falls apart into one block for each target.

Readings of other targets share nothing of it, so its covariance falls apart into small blocks, and what is
done with it costs no more for each of a hundred targets than for each of ten (M. A. Woodbury).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from zlmreport.measurement.arrays import FloatArray, IntArray


class FactorsByTarget:
    """The factors Z of parts that readings of other targets do not share, m targets and p parts."""

    def __init__(self, factors: Sequence[FloatArray], readings: int) -> None:
        """Take factors of shape (N, m): a column is zero at all readings of other targets."""
        target = np.argmax(factors[0] != 0, axis=1) if factors else np.zeros(readings, dtype=np.int64)
        values = np.array([each.sum(axis=1) for each in factors]).reshape(-1, readings)
        counts = np.bincount(target)
        order, ends = np.argsort(target, kind="stable"), np.cumsum(counts)
        self._shape = len(counts), len(values)
        # Targets with as many readings, the readings of each, and Zᵀ: (t,), (t, n) and (t, p, n).
        self._alike = []
        for count in np.unique(counts):
            targets = np.flatnonzero(counts == count)
            own = order[(ends[targets] - count)[:, np.newaxis] + np.arange(count)]
            self._alike.append((targets, own, np.ascontiguousarray(values[:, own].transpose(1, 0, 2))))

    def sum_by_target(self, columns: FloatArray) -> FloatArray:
        """Return Zᵀ times columns over the readings, (N, k), shape (m, p, k)."""
        found = np.empty((*self._shape, columns.shape[1]))
        for targets, readings, factors in self._alike:
            found[targets] = factors @ columns[readings]
        return found

    def compute_gram(self) -> FloatArray:
        """Return ZᵀZ, shape (m, p, p)."""
        found = np.empty((*self._shape, self._shape[1]))
        for targets, _, factors in self._alike:
            found[targets] = factors @ factors.transpose(0, 2, 1)
        return found

    def spread(self, sizes: FloatArray) -> FloatArray:
        """Return Z times sizes, (m, p, k), shape (N, k)."""
        found = np.empty((sum(readings.size for _, readings, _ in self._alike), sizes.shape[2]))
        for targets, readings, factors in self._alike:
            found[readings] = factors.transpose(0, 2, 1) @ sizes[targets]
        return found


def find_roots_of_blocks(among: FloatArray, active: IntArray, ratios: FloatArray) -> tuple[FloatArray, float]:
    """Return R of each block of V = 1 + Z·diag(φ)·Zᵀ, shape (m, a, a), and ln|V|.

    A product under V is a·b − (R·Zᵀa)·(R·Zᵀb).

    `among`, (m, p, p): ZᵀZ of each block, between which nothing is shared.
    `active`, (a,): The columns of Z that have a share in V.
    `ratios`, (a,): φ of these.
    """
    roots = np.sqrt(ratios)
    inner = roots[:, np.newaxis] * among[:, active[:, np.newaxis], active] * roots
    factors = np.linalg.cholesky(np.eye(len(active)) + inner)
    logarithms = np.log(np.diagonal(factors, axis1=1, axis2=2))
    return np.linalg.inv(factors) * roots, 2.0 * float(logarithms.sum())


class ProductsByTarget:
    """Products of columns over the readings under any sizes of what targets have of their own."""

    def __init__(self, factors: FactorsByTarget, columns: FloatArray) -> None:
        """Take columns in, shape (N, w)."""
        self._gram, self._among = columns.T @ columns, factors.compute_gram()
        self._sums = factors.sum_by_target(columns)

    def compute_under(self, ratios: FloatArray) -> tuple[FloatArray, float]:
        """Return the products under V = 1 + Σ φ·Z·Zᵀ, shape (w, w), and ln|V|.

        `ratios`, (p,): φ.
        """
        active = np.flatnonzero(ratios)
        roots, logarithm = find_roots_of_blocks(self._among, active, ratios[active])
        turned = (roots @ self._sums[:, active]).reshape(-1, len(self._gram))
        return self._gram - turned.T @ turned, logarithm


class RootByTarget:
    """The symmetric root R of (1 + Σ φ·Z·Zᵀ)⁻¹."""

    def __init__(self, factors: FactorsByTarget, ratios: FloatArray) -> None:
        """Take φ of each part, shape (p,)."""
        roots = np.sqrt(ratios)[:, np.newaxis]
        values, vectors = np.linalg.eigh(roots * factors.compute_gram() * roots.T)
        lengths = np.sqrt(1.0 + np.maximum(values, 0.0))
        turned = roots * vectors
        self._factors = factors
        self._kernel = (turned / (lengths * (1.0 + lengths))[:, np.newaxis]) @ turned.transpose(0, 2, 1)

    def __call__(self, columns: FloatArray) -> FloatArray:
        """Return R times columns over the readings, shape (N, k)."""
        return columns - self._factors.spread(self._kernel @ self._factors.sum_by_target(columns))
