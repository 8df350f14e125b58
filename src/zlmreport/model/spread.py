"""Unequal scatter: whether some positions, a direction or a run scatter more, and by how much.

The spread of five readings says little about their scatter: taken as a weight, as it comes, it gives
intervals that hold in 83 % of all cases instead of 95 %. So the variances are pooled; only where a test
refutes that they are equal, each is drawn to the pooled one as far as its few degrees of freedom ask.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np

from zlmreport.language import Words
from zlmreport.model.cells import repeats
from zlmreport.model.design import Design
from zlmreport.model.distributions import f_tail
from zlmreport.quantities.arrays import FloatArray, IntArray

#: Equality is refuted at this level: weights that are not needed cost more than those that are missing.
_LEVEL = 0.01
_FEWEST_READINGS = 3


class Spread(Enum):
    """How the scatter of single readings is taken to differ."""

    POOLED = "pooled"
    SHRUNK = "shrunk to the pooled variance where a test asks for it"
    OWN = "each position and direction its own, as it comes"


class SpreadFactor(Enum):
    """By what the scatter may differ."""

    POSITION = "position"
    DIRECTION = "direction"
    RUN = "run"

    @property
    def words(self) -> Words:
        """What it is."""
        return _WORDS[self]


_WORDS = {
    SpreadFactor.POSITION: Words(en="from position to position", de="von Position zu Position"),
    SpreadFactor.DIRECTION: Words(en="up and down", de="aufwärts und abwärts"),
    SpreadFactor.RUN: Words(en="from run to run", de="von Durchlauf zu Durchlauf"),
}


@dataclass(frozen=True, slots=True)
class SpreadTest:
    """A test of equal scatter (Levene's, on absolute residuals).

    Attributes
    ----------
    factor
        By what the readings are grouped.
    p_value
        Of equal scatter.
    widest
        The label of the group that scatters most: target index, direction or run.
    """

    factor: SpreadFactor
    p_value: float
    widest: int


def spread_tests(design: Design, deviation: FloatArray) -> tuple[SpreadTest, ...]:
    """Return the tests of equal scatter that the design allows."""
    scatter = _drift_free(design, deviation)
    found = []
    for factor, labels in _groupings(design).items():
        tested = _levene(np.abs(scatter), labels)
        if tested is not None:
            found.append(SpreadTest(factor, *tested))
    return tuple(found)


def weights(design: Design, deviation: FloatArray, spread: Spread = Spread.SHRUNK) -> FloatArray:
    """Return w, the variance of each reading over the mean one, shape (N,).

    Parameters
    ----------
    design
        The test.
    deviation : (N,) array
        x, m or rad.
    spread
        How it is taken to differ; `Spread.OWN` are the weights of Halaj's equation (10), for comparison.
    """
    equal = np.ones(len(deviation))
    if spread is Spread.POOLED:
        return equal
    if spread is Spread.OWN:
        return _own(design, deviation)
    scatter = _drift_free(design, deviation)
    found = equal
    for test in spread_tests(design, deviation):
        if test.p_value < _LEVEL:
            labels = _groupings(design)[test.factor]
            found = found * _shrunk(scatter / np.sqrt(found), labels)
    return np.asarray(found / found.mean(), dtype=np.float64)


def _groupings(design: Design) -> dict[SpreadFactor, IntArray]:
    return {
        SpreadFactor.POSITION: design.target,
        SpreadFactor.DIRECTION: design.direction.astype(np.int64),
        SpreadFactor.RUN: design.run,
    }


def _drift_free(design: Design, deviation: FloatArray) -> FloatArray:
    """Return the scatter of each reading about its cell and its two neighbours in time, of its own variance.

    Without the neighbours, an effect that grows with position and time would pass for scatter, and be given
    little weight just where it shows.
    """
    within = repeats(design, deviation)
    padded = np.concatenate([within.centred[1:2], within.centred, within.centred[-2:-1]])
    local = within.centred - 0.5 * (padded[:-2] + padded[2:])
    kept = np.maximum(1.0 - 1.0 / within.count[within.cell], 1e-3)
    return np.asarray(local / np.sqrt(1.5 * kept), dtype=np.float64)


def _levene(sizes: FloatArray, labels: IntArray) -> tuple[float, int] | None:
    """Return p-value and widest group of Levene's test; None where a group is too small to be tested."""
    names, group = np.unique(labels, return_inverse=True)
    count = np.bincount(group)
    if len(names) < 2 or count.min() < _FEWEST_READINGS:
        return None
    means = np.bincount(group, weights=sizes) / count
    between = float(np.sum(count * (means - sizes.mean()) ** 2)) / (len(names) - 1)
    within = float(np.sum((sizes - means[group]) ** 2)) / (len(sizes) - len(names))
    if within == 0:
        return None
    p_value = f_tail(between / within, len(names) - 1, len(sizes) - len(names))
    return p_value, int(names[int(np.argmax(means))])


def _shrunk(scatter: FloatArray, labels: IntArray) -> FloatArray:
    """Return for each reading its group's variance, drawn to the pooled one: (ν₀s² + ν_i·s_i²)/(ν₀ + ν_i).

    ν₀ follows from how much more the logarithms of the variances differ than chance would have it.
    """
    _, group = np.unique(labels, return_inverse=True)
    degrees = np.bincount(group).astype(np.float64)
    variance = np.bincount(group, weights=scatter**2) / degrees
    pooled = float(np.mean(scatter**2))
    logarithms = np.log(np.maximum(variance, 1e-3 * pooled))
    excess = float(np.var(logarithms, ddof=1)) - float(np.mean(2.0 / degrees))
    prior = 2.0 / max(excess, 1e-2)
    drawn = (prior * pooled + degrees * variance) / (prior + degrees)
    return np.asarray(drawn[group] / pooled, dtype=np.float64)


def _own(design: Design, deviation: FloatArray) -> FloatArray:
    within = repeats(design, deviation)
    degrees = np.maximum(within.count - 1, 1)
    variance = np.bincount(within.cell, weights=within.centred**2) / degrees
    variance = np.maximum(variance, 1e-6 * float(np.mean(variance)) or 1.0)
    return np.asarray(variance[within.cell] / np.mean(variance[within.cell]), dtype=np.float64)
