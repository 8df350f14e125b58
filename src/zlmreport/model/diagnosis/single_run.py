"""One run against the others: its mean, its slope along the axis, its reversal value.

Noise may displace every run a little; then all of them differ. Where all but one agree, that one is no noise.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects import wording
from zlmreport.model.effects.design import Design
from zlmreport.model.fitting.distributions import t_quantile

_FEWEST_RUNS = 3
#: What runs differ by as a rule, in units of σ, and as how many runs that counts beside those of the test.
_USUAL, _IMAGINED = 0.12, 4.0
#: Chance of such a run, all runs and all their ways to differ counted, below which it is no noise.
LEVEL = 5e-3


class RunDifference(Enum):
    """In what a run differs from the others."""

    MEAN = Words("run {run} displaced as a whole")
    SLOPE = Words("a slope along the axis in run {run} alone")
    REVERSAL = Words("another reversal value in run {run} than in the others")


@dataclass(frozen=True, slots=True)
class SingleRun:
    """A run that differs from all others."""

    run: int
    way: RunDifference
    values: FloatArray  #: (N,): What it adds to the readings, m or rad; zero in the others.

    @property
    def shape(self) -> Words:
        """What it does, in words."""
        return self.way.value.given(run=self.run)

    def say_where(self, design: Design) -> Words:
        """Return which run it is, with the largest of its values."""
        return _BY.given(run=self.run, size=wording.deviation(design.axis, float(np.abs(self.values).max())))


_BY = Words("run {run}, by up to {size}")


def find_single_run(design: Design, residual: FloatArray, sigma: float) -> SingleRun | None:
    """Return the run that plainly differs from all others; None if none does.

    `residual`, (N,): What a model leaves, m or rad.
    `sigma`: Standard deviation of a single reading, m or rad.
    """
    runs = np.unique(design.cycle)
    if len(runs) < _FEWEST_RUNS or sigma <= 0:
        return None
    lever = 2.0 * (design.position - design.middle) / (design.length or 1.0)
    ways = {
        RunDifference.MEAN: np.ones(len(residual)),
        RunDifference.SLOPE: lever,
        RunDifference.REVERSAL: design.direction,
    }
    farthest, found = 0.0, None
    limit = t_quantile(1.0 - LEVEL / (len(ways) * len(runs)), len(runs) - 2 + _IMAGINED)
    for way, column in ways.items():
        if way is RunDifference.REVERSAL and not design.is_bidirectional:
            continue
        if way is RunDifference.SLOPE and design.length == 0:
            continue
        of_run = [design.cycle == run for run in runs]
        squares = np.array([float(column[own] @ column[own]) for own in of_run])
        sizes = np.array([float(column[own] @ residual[own]) for own in of_run]) / squares
        spread = sigma**2 * (1.0 / squares + _USUAL**2)
        for number, run in enumerate(runs.tolist()):
            others = np.delete(sizes, number)
            variance = float(np.sum((others - others.mean()) ** 2)) + _IMAGINED * float(spread[number])
            variance /= len(others) - 1 + _IMAGINED
            off = (sizes[number] - others.mean()) / np.sqrt(variance * (1.0 + 1.0 / len(others)))
            if abs(off) > max(limit, farthest):
                farthest = abs(float(off))
                values = np.where(of_run[number], (sizes[number] - others.mean()) * column, 0.0)
                found = SingleRun(run, way, values)
    return found
