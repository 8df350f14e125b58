"""What is irregular from target to target, eliminated: each target by itself.

Readings of other targets share nothing of it, so its covariance falls apart into small blocks, and products
under it cost no more for a hundred targets than for ten (M. A. Woodbury).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from zlmreport.measurement.arrays import FloatArray


class ByTarget:
    """Columns over the readings, ready for products under any sizes of what targets have of their own."""

    def __init__(self, factors: Sequence[FloatArray], columns: FloatArray) -> None:
        """Take columns in, shape (N, w).

        `factors`: Z of each of p parts, (N, targets): a column is zero at all readings of other targets.
        """
        self._gram = columns.T @ columns
        among = [[np.sum(one * other, axis=0) for other in factors] for one in factors]
        self._among = np.array(among).transpose(2, 0, 1) if factors else np.empty((0, 0, 0))
        sums = [each.T @ columns for each in factors]
        self._sums = np.stack(sums, axis=1) if factors else np.empty((0, 0, columns.shape[1]))

    def products(self, ratios: FloatArray) -> tuple[FloatArray, float]:
        """Return products of the columns under V = 1 + Σ φ·Z·Zᵀ, shape (w, w), and ln|V|.

        `ratios`, (p,): φ.
        """
        active = np.flatnonzero(ratios)
        if not len(active):
            return self._gram, 0.0
        roots = np.sqrt(ratios[active])[:, np.newaxis]
        inner = np.eye(len(active)) + roots * self._among[:, active[:, np.newaxis], active] * roots.T
        factors = np.linalg.cholesky(inner)
        turned = np.linalg.solve(factors, roots * self._sums[:, active]).reshape(-1, len(self._gram))
        logarithms = np.log(np.diagonal(factors, axis1=1, axis2=2))
        return self._gram - turned.T @ turned, 2.0 * float(logarithms.sum())
