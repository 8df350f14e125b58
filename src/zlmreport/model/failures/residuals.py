"""The residuals of a fit, made independent: what all tests of them share."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.model.design import Design
from zlmreport.model.distributions import f_tail
from zlmreport.model.fit import Fit
from zlmreport.model.noise import Noise, noise_parts
from zlmreport.model.whitening import Whitener, whitener
from zlmreport.quantities.arrays import FloatArray

_DEPENDENT = 1e-11
#: Sum of squares of a residual that is no residual at all, m² or rad².
_NOTHING = 1e-60
_TRIALS = 400
_SEED = 20_261_118


@dataclass(frozen=True, slots=True)
class Residuals:
    """The residuals of a fitted model.

    Attributes
    ----------
    fit
        The model.
    whiten
        Makes readings independent under the noise of the test.
    base : (N, q) array
        Orthonormal columns that span the whitened model.
    independent : (N,) array
        The whitened residuals.
    """

    fit: Fit
    whiten: Whitener
    base: FloatArray
    independent: FloatArray

    @property
    def design(self) -> Design:
        """The test."""
        return self.fit.design

    @property
    def degrees(self) -> int:
        """Readings less columns of the model."""
        return int(self.base.shape[0] - self.base.shape[1])

    def blocks(self, columns: FloatArray) -> FloatArray:
        """Return blocks of columns, shape (g, N, k), as orthonormal contrasts of independent readings."""
        whitened = np.stack([self.whiten(block) for block in columns])
        left = whitened - self.base @ (self.base.T @ whitened)
        lengths = np.linalg.norm(whitened, axis=1, keepdims=True)
        vectors, singular, _ = np.linalg.svd(left / np.where(lengths > 0, lengths, 1.0), full_matrices=False)
        return np.asarray(vectors * (singular > _DEPENDENT)[:, np.newaxis, :], dtype=np.float64)

    def p_value(self, columns: FloatArray) -> float:
        """Return the chance that columns, shape (N, k), explain so much of the residuals (F-test)."""
        block = self.blocks(columns[np.newaxis])[0]
        rank = int(np.count_nonzero(np.any(block != 0, axis=0)))
        if rank == 0 or self.degrees <= rank:
            return 1.0
        explained = float(np.sum((block.T @ self.independent) ** 2))
        left = float(np.sum(self.independent**2)) - explained
        if left <= 0:
            return 0.0
        return f_tail((explained / rank) / (left / (self.degrees - rank)), rank, self.degrees - rank)

    def best_block(self, columns: FloatArray) -> tuple[int, float]:
        """Return which of many blocks explains most, and the chance that the best explains so much.

        The chance is that of the whole search, counted on simulated independent residuals.

        Parameters
        ----------
        columns : (g, N, k) array
            The blocks.
        """
        blocks = self.blocks(columns)
        size, readings, width = blocks.shape
        flat = blocks.transpose(1, 0, 2).reshape(readings, -1)
        random = np.random.default_rng(_SEED).standard_normal((readings, _TRIALS))
        together = np.column_stack([self.independent, random - self.base @ (self.base.T @ random)])
        shares = ((flat.T @ together) ** 2).reshape(size, width, -1).sum(axis=1)
        shares /= np.maximum(np.sum(together**2, axis=0), _NOTHING)
        most = shares.max(axis=0)
        reached = int(np.count_nonzero(most[1:] >= most[0]))
        return int(np.argmax(shares[:, 0])), (1 + reached) / (_TRIALS + 1)


def residuals_of(fit: Fit, noise: Noise) -> Residuals:
    """Return the residuals of a fit under a noise: one that holds no more than noise may."""
    whiten = whitener(noise_parts(fit.design), noise)
    columns = whiten(fit.base())
    lengths = np.linalg.norm(columns, axis=0)
    vectors, singular, _ = np.linalg.svd(columns / np.where(lengths > 0, lengths, 1.0), full_matrices=False)
    base = vectors[:, singular > _DEPENDENT * singular.max(initial=0.0)]
    whitened = whiten(fit.residual)
    return Residuals(fit, whiten, base, whitened - base @ (base.T @ whitened))
