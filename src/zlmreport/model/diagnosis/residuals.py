"""Residuals made independent, the names of their tests, p-values, and what a failed test says."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray, IntArray, make_orthonormal_basis, read_only_integers
from zlmreport.model.effects.design import Design
from zlmreport.model.fitting.contrasts import Whitener, make_whitener
from zlmreport.model.fitting.distributions import f_tail
from zlmreport.model.fitting.fit import Fit
from zlmreport.model.fitting.noise import Noise, list_noise_parts

_DEPENDENT = 1e-11
#: Sum of squares of a residual that is no residual at all, m² or rad².
_NOTHING = 1e-60
_TRIALS = 400
_SEED = 20_261_118


class ResidualTest(Enum):
    """The tests of residuals, with the names that results files use."""

    LACK_OF_FIT = "lack-of-fit"
    TIME_ORDER = "time-order"
    SIGNS = "signs"
    PERIOD_IN_POSITION = "period-in-position"
    PERIOD_IN_TIME = "period-in-time"
    DIRECTION = "direction"
    RUNS = "runs"
    CONDITION = "condition"
    SPREAD = "spread"
    OUTLIERS = "outliers"

    @property
    def title(self) -> Words:
        """What it tests."""
        return _TITLES[self]


@dataclass(frozen=True, slots=True)
class Failure:
    """A test that the residuals did not pass."""

    test: ResidualTest  #: Which.
    p_value: float  #: Chance of such residuals if the model held.
    #: The place, the time, the run or the condition: what stands in brackets after the statement.
    where: Words
    statement: Words  #: What the residuals do, in a sentence without a full stop.
    #: (k,) integer: The readings that `where` names, by their places in the design; none where all show it,
    #: or where they were set aside before.
    readings: IntArray = field(default_factory=lambda: read_only_integers([]), compare=False)
    condition: str = ""  #: Of the test against a logged condition, the name of that; else empty.


_TITLES = {
    ResidualTest.LACK_OF_FIT: Words("Means of the positions against the repeats"),
    ResidualTest.TIME_ORDER: Words("Order of time within the repeats"),
    ResidualTest.SIGNS: Words("Signs along the axis"),
    ResidualTest.PERIOD_IN_POSITION: Words("Period along the axis"),
    ResidualTest.PERIOD_IN_TIME: Words("Period in time"),
    ResidualTest.DIRECTION: Words("Up against down"),
    ResidualTest.RUNS: Words("Run against run"),
    ResidualTest.CONDITION: Words("Logged conditions"),
    ResidualTest.SPREAD: Words("Equal scatter"),
    ResidualTest.OUTLIERS: Words("Single readings"),
}


@dataclass(frozen=True, slots=True)
class Residuals:
    """The residuals of a fitted model."""

    fit: Fit  #: The model.
    whiten: Whitener  #: Makes readings independent under the noise of the test.
    base: FloatArray  #: (N, q): Orthonormal columns that span the whitened model.
    independent: FloatArray  #: (N,): The whitened residuals.

    @property
    def design(self) -> Design:
        """The test."""
        return self.fit.design

    @property
    def degrees(self) -> int:
        """Readings less columns of the model."""
        return int(self.base.shape[0] - self.base.shape[1])

    def make_blocks(self, columns: FloatArray) -> FloatArray:
        """Return blocks of columns, shape (g, N, k), as orthonormal contrasts of independent readings."""
        size, readings, width = columns.shape
        flat = self.whiten(columns.transpose(1, 0, 2).reshape(readings, -1))
        left = flat - self.base @ (self.base.T @ flat)
        whitened, left = (each.reshape(readings, size, width).transpose(1, 0, 2) for each in (flat, left))
        lengths = np.linalg.norm(whitened, axis=1, keepdims=True)
        vectors, singular, _ = np.linalg.svd(left / np.where(lengths > 0, lengths, 1.0), full_matrices=False)
        return np.asarray(vectors * (singular > _DEPENDENT)[:, np.newaxis, :], dtype=np.float64)

    def compute_p_value(self, columns: FloatArray) -> float:
        """Return the chance that columns, shape (N, k), explain so much of the residuals (F-test)."""
        block = self.make_blocks(columns[np.newaxis])[0]
        rank = int(np.count_nonzero(np.any(block != 0, axis=0)))
        if rank == 0 or self.degrees <= rank:
            return 1.0
        explained = float(np.sum((block.T @ self.independent) ** 2))
        left = float(np.sum(self.independent**2)) - explained
        if left <= 0:
            return 0.0
        return f_tail((explained / rank) / (left / (self.degrees - rank)), rank, self.degrees - rank)

    def find_best_block(self, columns: FloatArray) -> tuple[int, float]:
        """Return which of many blocks explains most, and the chance that the best explains so much.

        The chance is that of the whole search, counted on simulated independent residuals.

        `columns`, (g, N, k): The blocks.
        """
        blocks = self.make_blocks(columns)
        size, readings, width = blocks.shape
        flat = blocks.transpose(1, 0, 2).reshape(readings, -1)
        random = np.random.default_rng(_SEED).standard_normal((readings, _TRIALS))
        together = np.column_stack([self.independent, random - self.base @ (self.base.T @ random)])
        shares = ((flat.T @ together) ** 2).reshape(size, width, -1).sum(axis=1)
        shares /= np.maximum(np.sum(together**2, axis=0), _NOTHING)
        most = shares.max(axis=0)
        reached = int(np.count_nonzero(most[1:] >= most[0]))
        return int(np.argmax(shares[:, 0])), (1 + reached) / (_TRIALS + 1)


def find_residuals_of(fit: Fit, noise: Noise) -> Residuals:
    """Return the residuals of a fit under a noise: one that holds no more than noise may."""
    whiten = make_whitener(list_noise_parts(fit.design), noise)
    base = make_orthonormal_basis(whiten(fit.compute_base()), _DEPENDENT)
    whitened = whiten(fit.residual)
    return Residuals(fit, whiten, base, whitened - base @ (base.T @ whitened))
