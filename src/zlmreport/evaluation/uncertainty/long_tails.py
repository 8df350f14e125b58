"""Readings that scatter with longer tails than a normal distribution, and how U then reaches farther.

Two things make some readings of a test lie farther out than the others: places that scatter more, and tails.
They are told apart by their marginal likelihoods (Bayes' theorem): variances of places that are drawn from
one scaled inverse χ² distribution, of normal readings, against one scale for all and readings like Student's
t. Either has the same probability before the test, and of each all its shapes; means are flat, and scales
flat in ln σ.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from zlmreport.measurement.arrays import FloatArray

#: Degrees of freedom of the t distributions that are tried, and of how alike places may scatter.
_TAILS = (2.5, 3.0, 4.0, 6.0)
_ALIKE = (3.0, 6.0, 12.0, 24.0, 1e4)
#: Scales that are tried, about the usual size of a residual, and means of a place.
_SCALES = np.geomspace(0.25, 2.0, 16)
_MEANS = np.linspace(-5.0, 5.0, 31)
#: Tails count unless it is two to one that there are none: the intervals of most axes without them stay as
#: they are, and few axes with them look so normal. Chosen by other axes than the benchmark of worlds has.
_LEAST = 1 / 3
_FEWEST = 3


@dataclass(frozen=True, slots=True)
class Tails:
    """What one test tells of the tails of its axis."""

    probability: float  #: That they are longer than those of a normal distribution.
    freedom: FloatArray  #: (hypothesis,): Degrees of freedom of t.
    scale: FloatArray  #: (hypothesis,): Its scale, m or rad.
    weight: FloatArray  #: (hypothesis,): The probability of each, if tails are long; their sum is 1.

    def draw(self, count: int, generator: np.random.Generator) -> tuple[FloatArray, FloatArray]:
        """Return the degrees of freedom and the scales of axes that may be this one, each (count,)."""
        chosen = generator.choice(len(self.weight), count, p=self.weight)
        return self.freedom[chosen], self.scale[chosen]


def find_long_tails(residuals: FloatArray) -> Tails | None:
    """Return what residuals tell of their tails; None where they are hardly long.

    `residuals`: (place, run), m or rad, about the mean of each place; NaN where there is none.
    """
    there = np.isfinite(residuals)
    count = there.sum(axis=1)
    cells = residuals[count >= _FEWEST]
    size = float(np.sqrt(np.nanmean(cells**2))) if len(cells) else 0.0
    if not size:
        return None
    cells = cells / size
    normal = np.concatenate([_weigh_places(cells, alike) for alike in _ALIKE])
    tailed = np.stack([_weigh_tails(cells, freedom) for freedom in _TAILS])
    most = max(float(normal.max()), float(tailed.max()))
    of_normal = float(np.exp(normal - most).sum()) / len(_ALIKE)
    weights = np.exp(tailed - most).ravel()
    of_tails = float(weights.sum()) / len(_TAILS)
    probability = of_tails / (of_tails + of_normal)
    if probability < _LEAST:
        return None
    freedom, scale = np.meshgrid(_TAILS, size * _SCALES, indexing="ij")
    return Tails(probability, freedom.ravel(), scale.ravel(), weights / weights.sum())


def _weigh_places(cells: FloatArray, alike: float) -> FloatArray:
    """Return ln of the density of normal cells whose variances differ, for each scale that is tried."""
    count = np.isfinite(cells).sum(axis=1)
    freedom, squares = count - 1, np.nansum(cells**2, axis=1)
    prior = alike * _SCALES[:, np.newaxis] ** 2
    constant = [
        math.lgamma((alike + each) / 2) - math.lgamma(alike / 2) - each / 2 * math.log(math.pi)
        for each in freedom.tolist()
    ]
    # Of many degrees of freedom the powers of large numbers cancel; their logarithms do without a loss.
    powers = -(alike / 2) * np.log1p(squares / prior) - freedom / 2 * np.log(prior + squares)
    return np.asarray((powers + constant - 0.5 * np.log(count)).sum(axis=1))


def _weigh_tails(cells: FloatArray, freedom: float) -> FloatArray:
    """Return ln of the density of cells like t of one scale, for each scale that is tried."""
    constant = math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2) - math.log(freedom * math.pi) / 2
    there = np.isfinite(cells)
    found = np.empty(len(_SCALES))
    for number, scale in enumerate(_SCALES.tolist()):
        away = (cells[:, np.newaxis, :] - _MEANS[:, np.newaxis] * scale) / scale
        logarithms = constant - math.log(scale) - (freedom + 1) / 2 * np.log1p(away**2 / freedom)
        of_mean = np.where(there[:, np.newaxis, :], logarithms, 0.0).sum(axis=-1)
        most = of_mean.max(axis=1, keepdims=True)
        integral = np.exp(of_mean - most).sum(axis=1) * scale * (_MEANS[1] - _MEANS[0])
        found[number] = float((most[:, 0] + np.log(integral)).sum())
    return found
