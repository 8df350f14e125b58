"""Readings made independent: multiplied by W with WᵀW = V⁻¹, at a cost that is linear in their number."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.model.noise import Noise, NoisePart
from zlmreport.quantities.arrays import FloatArray


@dataclass(frozen=True, slots=True)
class Whitener:
    """The symmetric root of V⁻¹, with V = diag(w) + Z·diag(φ)·Zᵀ.

    Attributes
    ----------
    scale : (N,) array
        1/√w.
    modes : (N, r) array
        Orthonormal directions in which readings scatter together.
    excess : (r,) array
        1 − 1/√(1 + λ), λ the variance of each mode over that of single readings.
    """

    scale: FloatArray
    modes: FloatArray
    excess: FloatArray

    def __call__(self, columns: FloatArray) -> FloatArray:
        """Return W times columns over the readings, shape (N,) or (N, k)."""
        scaled = (columns.T * self.scale).T
        return scaled - self.modes @ ((self.modes.T @ scaled).T * self.excess).T


def whitener(parts: Sequence[NoisePart], noise: Noise) -> Whitener:
    """Return the whitener of a noise."""
    scale = 1.0 / np.sqrt(noise.weights)
    active = [
        part.factor * np.sqrt(noise.ratios[part.source])
        for part in parts
        if noise.ratios.get(part.source, 0.0) > 0
    ]
    factors = np.concatenate([np.empty((len(scale), 0)), *active], axis=1) * scale[:, np.newaxis]
    modes, singular, _ = np.linalg.svd(factors, full_matrices=False)
    return Whitener(scale, modes, 1.0 - 1.0 / np.sqrt(1.0 + singular**2))
