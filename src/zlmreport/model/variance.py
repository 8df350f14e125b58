"""How well the variances themselves are known: degrees of freedom for intervals that hold.

Where readings share the irregular geometry of their targets, the uncertainty of what depends on position
rests on as many values as there are targets, not readings. After F. E. Satterthwaite (Biometrics Bulletin 2
(1946) 110), with the expected information of restricted likelihood on each variance component.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.model.contrasts import Contrasts
from zlmreport.model.noise import Noise
from zlmreport.quantities.arrays import FloatArray

_ACTIVE = 1e-3
_FEWEST, _MOST = 1.0, 1e6


@dataclass(frozen=True, slots=True)
class VarianceOfVariance:
    """What is needed to judge the variance of any linear combination of parameters.

    Attributes
    ----------
    covariance : (c, c) array
        Of the estimated variance components, in units of σ̂⁴.
    slopes : sequence of (r, p) arrays
        For each component a matrix S with ∂(jᵀ·Cov·j)/∂(component) = |S·j|².
    """

    covariance: FloatArray
    slopes: tuple[FloatArray, ...]

    def degrees(self, combination: FloatArray, variance: float) -> float:
        """Return the effective degrees of freedom of jᵀ·Cov·j, given in units of σ̂².

        Parameters
        ----------
        combination : (p,) array
            j.
        variance
            jᵀ·Cov·j / σ̂².
        """
        gradient = np.array([float(np.sum((slope @ combination) ** 2)) for slope in self.slopes])
        spread = float(gradient @ self.covariance @ gradient)
        if spread <= 0:
            return _MOST
        return float(np.clip(2 * variance**2 / spread, _FEWEST, _MOST))


def variance_of_variance(space: Contrasts, noise: Noise, weighted: FloatArray) -> VarianceOfVariance:
    """Return how well the variance of the parameters is known.

    Parameters
    ----------
    space
        The contrasts of the model.
    noise
        As estimated.
    weighted : (N, p) array
        V⁻¹J(JᵀV⁻¹J)⁻¹: the weight of each reading in each parameter.
    """
    active = [index for index, part in enumerate(space.parts) if noise.ratios.get(part.source, 0.0) > _ACTIVE]
    ratios = np.array([noise.ratios.get(part.source, 0.0) for part in space.parts])
    information = _information(space, ratios, active)
    factors = [space.parts[index].factor.T @ weighted for index in active]
    slopes = (weighted / space.scale[:, np.newaxis], *factors)
    return VarianceOfVariance(np.asarray(np.linalg.pinv(information), dtype=np.float64), slopes)


def _information(space: Contrasts, ratios: FloatArray, active: Sequence[int]) -> FloatArray:
    """Return ½·tr(P·V_i·P·V_j) for single readings and the active sources, in units of σ̂⁻⁴."""
    root = space.metric(ratios).coordinates(np.eye(len(space.gram)))
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
