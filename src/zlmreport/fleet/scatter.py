"""How much the tests of an axis scatter, learned from these and from the other axes of a fleet.

Four tests know little of their scatter, but hundreds of axes with four tests each know which scatters there
are, and how often: perhaps many axes that hardly scatter and a few that scatter four times as much. So no
form is supposed for that. How frequent each scatter of a lattice is, is learned from the sums of squares of
all axes; each axis asks the others only, for its own tests are asked already. That is the collapsed
variational step of a mixture with a Dirichlet prior (A. Asuncion et al., Uncertainty in Artificial
Intelligence 25 (2009) 27), repeated from a start in which all scatters are as likely. A little of that
ignorance stays: it alone speaks where an axis has no others, and then gives Student's t.

Scatter is in the unit of the values.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.fitting.distributions import chi_square_tail, normal_tail

#: No scatter is taken for smaller, in parts of the limit.
_LEAST = 1e-3
#: From one scatter of the lattice to the next.
_RATIO = 1.15
#: The lattice ends at so many times the largest that was met, or that is usual.
_BEYOND, _USUAL = 20.0, 0.1
#: So many axes' worth of not knowing, and how often the axes are asked what the others say.
_IGNORANCE, _ROUNDS = 0.1, 200
#: What is less likely than this part of the likeliest is left out of sums.
_NEGLIGIBLE = 1e-7
#: Of a quantile, as a part of it.
_PRECISION = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class ScatterLikelihood:
    """How likely each scatter is."""

    deviations: FloatArray  #: Rising.
    weights: FloatArray  #: How likely each is: above 0, and 1 together.
    degrees: int = 0  #: By how many degrees of freedom, of whatever axes, that is known.

    @property
    def deviation(self) -> float:
        """The root of the mean variance."""
        return math.sqrt(float(self.weights @ self.deviations**2))

    def update(self, squares: float, degrees: int) -> ScatterLikelihood:
        """Return what is known after tests with a sum of squares of so many degrees of freedom."""
        logarithms = self._compute_logarithms(squares, degrees)
        likely = np.exp(logarithms - logarithms.max())
        kept = likely > _NEGLIGIBLE
        weights = likely[kept]
        return ScatterLikelihood(self.deviations[kept], weights / weights.sum(), self.degrees + degrees)

    def compute_chance_of_change(self, change: float) -> float:
        """Return the chance that a normal value of this scatter exceeds a change."""
        return float(self.weights @ [normal_tail(each) for each in (change / self.deviations).tolist()])

    def compute_chance_of_squares(self, squares: float, degrees: int) -> float:
        """Return the chance that a sum of squares of so many degrees of freedom exceeds one."""
        ratios = squares / self.deviations**2
        return float(self.weights @ [chi_square_tail(each, degrees) for each in ratios.tolist()])

    def compute_quantile(self, chance: float) -> float:
        """Return the change that a normal value of this scatter exceeds with a chance below one half."""
        normal = NormalDist().inv_cdf(1 - chance)
        low, high = normal * float(self.deviations[0]), normal * float(self.deviations[-1])
        while high > low * (1 + _PRECISION):
            middle = math.sqrt(low * high)
            low, high = (middle, high) if self.compute_chance_of_change(middle) > chance else (low, middle)
        return high

    def compute_evidence(self, squares: float, degrees: int) -> float:
        """Return the logarithm of how likely a sum of squares is, but for what only the degrees decide."""
        logarithms = self._compute_logarithms(squares, degrees)
        largest = float(logarithms.max())
        return largest + math.log(float(np.exp(logarithms - largest).sum()))

    def _compute_logarithms(self, squares: float, degrees: int) -> FloatArray:
        logarithms: FloatArray = (
            np.log(self.weights) - degrees * np.log(self.deviations) - squares / (2 * self.deviations**2)
        )
        return logarithms


def learn_scatter(samples: Iterable[tuple[float, int]]) -> tuple[ScatterLikelihood, ...]:
    """Return, for each axis of a fleet, what the others let expect.

    `samples`: Of each axis a sum of squares about a mean, and its degrees of freedom, which may be none.
    """
    squares, degrees = np.array([*samples], dtype=float).reshape(-1, 2).T
    told = degrees > 0
    largest = float(np.sqrt(squares[told] / degrees[told]).max(initial=_USUAL))
    steps = math.ceil(math.log(_BEYOND * largest / _LEAST) / math.log(_RATIO))
    lattice: FloatArray = _LEAST * np.power(_RATIO, np.arange(steps + 1.0))
    logarithms = -np.outer(degrees, np.log(lattice)) - np.outer(squares, 0.5 / lattice**2)
    likelihood = np.exp(logarithms - logarithms.max(axis=1, keepdims=True))
    others = np.ones_like(likelihood)
    for _ in range(_ROUNDS):
        own = others * likelihood
        own *= (told / own.sum(axis=1))[:, np.newaxis]
        others = own.sum(axis=0) + _IGNORANCE / len(lattice) - own
    others /= others.sum(axis=1, keepdims=True)
    known = degrees.sum() - degrees
    return tuple(
        ScatterLikelihood(lattice, weights, int(each)) for weights, each in zip(others, known, strict=True)
    )
