"""The scatter of repeats (one target, one direction): noise floor, resolution, tests of equal spread.

The spread of five readings says little about their scatter: taken as a weight, as it comes, it gives
intervals that hold in 83 % of all cases instead of 95 %. So the variances are pooled; only where a test
refutes that they are equal they part: those that grow along the axis by that growth, others each drawn to
the pooled one as far as its few degrees of freedom ask.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.model.effects.design import Design
from zlmreport.model.fitting.observations import select_readings

#: Growth along the axis is seen at this level, which the other tests share among them: weights that are not
#: needed cost more than those that are missing.
_LEVEL = 0.01
_FEWEST_READINGS = 3
#: Scatter below this share of the largest deviation is the rounding of doubles: it is none.
_NOTHING = 1e-9
#: Share of a reading's variance that a line through its pass leaves at the least.
_LEAST_KEPT = 0.1
#: Steps by which the growth of the scatter is found, and the largest change of ln σ² in one.
_STEPS, _LARGEST_STEP = 4, 1.0
#: Decimal exponent of the finest step that is looked for, µm or ″, and what is a multiple of one.
_FINEST, _MULTIPLE = -7, 1e-3
_TRIALS = 1000
#: Times the variance of single readings that a jump within one target's explains where it is beyond doubt: of
#: some ten places in each of some twenty targets none is chance.
_SURE_JUMP = 25.0
#: Readings over which noise may last.
_LASTS = 4
#: Times the scatter of neighbours up to which it is noise.
_MOST_LASTING = 1.5
_SEED = 20_261_118


@dataclass(frozen=True, slots=True)
class Repeats:
    """The deviations within their cells."""

    cell: IntArray  #: (N,) integer: Index of the cell of each reading.
    count: IntArray  #: (cells,) integer: Readings in each cell.
    centred: FloatArray  #: (N,): Each deviation less the mean of its cell, m or rad.

    @property
    def degrees(self) -> int:
        """Degrees of freedom of the pure error: readings less cells."""
        return len(self.cell) - len(self.count)

    @property
    def squares(self) -> float:
        """Sum of squares of the pure error."""
        return float(np.sum(self.centred**2))


def number_cells(design: Design) -> IntArray:
    """Return for each reading the index of its cell, shape (N,); each session has its own."""
    target = design.target + design.session * (design.target.max() + 1)
    _, index = np.unique(2 * target + (design.direction > 0), return_inverse=True)
    return np.asarray(index, dtype=np.int64)


def find_repeats(design: Design, deviation: FloatArray) -> Repeats:
    """Return the deviations of a test within their cells."""
    cell = number_cells(design)
    count = np.bincount(cell)
    means = np.bincount(cell, weights=deviation) / count
    return Repeats(cell, count.astype(np.int64), deviation - means[cell])


def is_apart_in_time(design: Design) -> bool:
    """Whether the readings of a cell lie apart in time, as in the linear method.

    Then slow drift is within the cells, and neighbours in time are in different ones. In pendulum and
    quasi-pilgrim tests a cell is measured within a short time, and drift is between the cells.
    """
    cell = number_cells(design)
    order = np.lexsort((np.arange(len(cell)), cell))
    gaps = np.diff(order)[np.diff(cell[order]) == 0]
    return bool(gaps.size and np.median(gaps) > 0.5 * len(np.unique(cell)))


def find_resolution(values: FloatArray) -> float:
    """Return the step of which readings are multiples, in their unit; 0 where they are not of any.

    >>> find_resolution(np.array([0.4, 1.2, -0.6])), find_resolution(np.array([5.0, 10.0, 20.0]))
    (0.2, 5.0)
    """
    largest = float(np.abs(values).max(initial=0.0))
    if largest == 0:
        return 0.0
    for exponent in range(int(np.floor(np.log10(largest))), _FINEST, -1):
        for digit in (5, 2, 1):
            step = float(f"{digit}e{exponent}")
            multiples = values / step
            if np.all(np.abs(multiples - np.rint(multiples)) < _MULTIPLE):
                return step
    return 0.0


def estimate_noise_floor(design: Design, deviation: FloatArray) -> float | None:
    """Return the standard deviation σ_f of a single reading, drift left out; None without repeats.

    Where the readings of a cell lie apart in time, neighbours within a run are compared: what drifts more
    slowly than a reading drops out. Otherwise the pure error is drift-free as it is, but for a jump of the
    zero while one target is measured: where it is beyond doubt, it is left out. The standard deviations of
    ISO 230-2 contain the drift and are no floor.

    `deviation`, (N,): x, m or rad.
    """
    within = find_repeats(design, deviation)
    if within.degrees < 1:
        return None
    if is_apart_in_time(design):
        neighbours = (np.diff(within.cell) != 0) & (np.diff(design.cycle) == 0)
        steps = np.diff(within.centred)[neighbours]
        # A mean of n̄ readings is subtracted from each, and takes a share of 1/n̄ of its variance along.
        shares = 1.0 - 1.0 / within.count[within.cell]
        expected = (shares[1:] + shares[:-1])[neighbours].sum()
        if steps.size and expected > 0:
            return float(np.sqrt(np.sum(steps**2) / expected))
    sure = _list_sure_jumps(design, deviation, within)
    return float(np.sqrt((within.squares - sum(sure)) / (within.degrees - len(sure))))


def _list_sure_jumps(design: Design, deviation: FloatArray, within: Repeats) -> list[float]:
    """Return what jumps of the zero explain of the squares of repeats, one at most within each target's."""
    left = within.centred[:, np.newaxis].copy()
    explained = _remove_jumps(design, within.cell, left)
    unit = design.axis.deviation_unit
    resolution = float(unit.to_si(find_resolution(unit.from_si(deviation))))
    # Of readings that are rounded, one step of the last digit is no jump.
    variance = max(float(np.sum(left**2)) / within.degrees, (resolution / 2.0) ** 2)
    return [float(each) for each in explained[:, 0] if each > _SURE_JUMP * variance]


def estimate_lasting_floor(design: Design, deviation: FloatArray) -> float | None:
    """Return the noise floor, that counted in which lasts from one reading to the next few; None without one.

    Neighbours that scatter together differ by less than they scatter: a floor that is taken from them calls
    such noise a misfit. Readings a few steps apart show it whole; where they differ by far more
    than neighbours, it is a course in time.

    `deviation`, (N,): x, m or rad.
    """
    floor = estimate_noise_floor(design, deviation)
    if floor is None or not is_apart_in_time(design):
        return floor
    within, lasting = find_repeats(design, deviation), floor
    shares = 1.0 - 1.0 / within.count[within.cell]
    for lag in range(2, _LASTS + 1):
        pairs = (design.cycle[lag:] == design.cycle[:-lag]) & (within.cell[lag:] != within.cell[:-lag])
        steps = (within.centred[lag:] - within.centred[:-lag])[pairs]
        expected = float((shares[lag:] + shares[:-lag])[pairs].sum())
        if expected > 0:
            lasting = max(lasting, float(np.sqrt(np.sum(steps**2) / expected)))
    return lasting if lasting <= _MOST_LASTING * floor else floor


class SpreadFactor(Enum):
    """By what the scatter may differ."""

    GROWTH = "growth"
    POSITION = "position"
    DIRECTION = "direction"
    RUN = "run"

    @property
    def words(self) -> Words:
        """What it is."""
        return _WORDS[self]


_WORDS = {
    SpreadFactor.GROWTH: Words("along the axis"),
    SpreadFactor.POSITION: Words("from position to position"),
    SpreadFactor.DIRECTION: Words("up and down"),
    SpreadFactor.RUN: Words("from run to run"),
}


@dataclass(frozen=True, slots=True)
class SpreadTest:
    """A test of equal scatter, on absolute residuals: Levene's by groups, or their slope along the axis."""

    factor: SpreadFactor  #: By what the readings are grouped.
    p_value: float  #: Of equal scatter.
    widest: int  #: The label of the group that scatters most: target index, direction or run.

    @property
    def is_refuted(self) -> bool:
        """Whether the scatter is so unequal that readings are weighted by it."""
        others = len(SpreadFactor) - 1
        return self.p_value < (_LEVEL if self.factor is SpreadFactor.GROWTH else _LEVEL / others)


def list_spread_tests(design: Design, deviation: FloatArray) -> tuple[SpreadTest, ...]:
    """Return the tests of equal scatter that the design allows; of growth first, the others beside it.

    Few repeats in many cells make any such statistic larger than tables have it; so it is held against
    simulated readings of equal scatter.
    """
    return _examine_spreads(design, deviation)[0]


def _examine_spreads(design: Design, deviation: FloatArray) -> tuple[tuple[SpreadTest, ...], FloatArray]:
    """Return the tests, and the variance of each reading by its growth along the axis; 1 where it is none."""
    random = np.random.default_rng(_SEED).standard_normal((len(deviation), _TRIALS))
    pairs = np.column_stack([deviation, random])
    sizes = np.abs(_remove_drift(design, pairs))
    whole = sizes if is_apart_in_time(design) else np.abs(_remove_drift(design, pairs, with_jumps=True))
    grown = np.ones(len(deviation))
    found: list[SpreadTest] = []
    if sizes[:, 0].max() <= _NOTHING * np.abs(deviation).max():
        return (), grown
    if design.length and len(deviation) > len(np.unique(number_cells(design))):
        away = design.position - design.middle
        slope, p_value = _fit_slope(away, sizes)
        for run in np.unique(design.cycle) if p_value < _LEVEL else ():
            # What one run alone shows is a disturbance of this run, and no growth.
            others = np.flatnonzero(design.cycle != run)
            part = select_readings(design, others)
            if len(others) > len(np.unique(number_cells(part))):
                without = np.abs(_remove_drift(part, pairs[others]))
                p_value = max(p_value, _fit_slope(away[others], without)[1])
        widest = int(design.target[np.argmax(away * slope)])
        found.append(SpreadTest(SpreadFactor.GROWTH, p_value, widest))
        if found[0].is_refuted:
            grown = _fit_growth(design, deviation)
            for each, with_jumps in ((sizes, False), (whole, True)):
                scatter = _estimate_scatter(design, deviation, grown, with_jumps=with_jumps)
                each[:, 0] = np.abs(scatter) / np.sqrt(grown)
    for factor, labels in _make_groupings(design).items():
        names, group = np.unique(labels, return_inverse=True)
        fewest = 3 if factor is SpreadFactor.RUN else 2  # two runs lie as far from their means as each other
        if len(names) < fewest or np.bincount(group).min() < _FEWEST_READINGS:
            continue
        ratios, widest = _compute_levene(sizes if factor is SpreadFactor.POSITION else whole, group)
        reached = int(np.count_nonzero(ratios[1:] >= ratios[0]))
        found.append(SpreadTest(factor, (1 + reached) / (_TRIALS + 1), int(names[widest])))
    return tuple(found), grown


def _fit_slope(away: FloatArray, sizes: FloatArray) -> tuple[float, float]:
    """Return the slope of the first set's absolute residuals along the axis, and the chance of such a one."""
    slopes = away @ (sizes - sizes.mean(axis=0)) / np.linalg.norm(sizes - sizes.mean(axis=0), axis=0)
    by_chance = math.sqrt(float(np.mean(slopes[1:] ** 2)))  # a sum of many: normal, to its far tail
    return float(slopes[0]), math.erfc(abs(float(slopes[0])) / (by_chance * math.sqrt(2.0)))


def _fit_growth(design: Design, deviation: FloatArray) -> FloatArray:
    """Return the variance of each reading, ln σ² being a straight line over the position: likeliest, mean 1.

    Fisher scoring of normal scatter; what is left of the passes is taken anew with each step's weights, or
    the loud end of a pass would shake its quiet one.
    """
    line = np.column_stack([np.ones(len(deviation)), design.position - design.middle])
    line[:, 1] /= np.abs(line[:, 1]).max()
    logarithm = np.zeros(2)
    grown = np.ones(len(deviation))
    for _ in range(_STEPS):
        squares = _estimate_scatter(design, deviation, grown) ** 2
        squares /= squares.mean()
        for _ in range(_STEPS):
            step = np.linalg.lstsq(line, squares / np.exp(line @ logarithm) - 1, rcond=None)[0]
            logarithm += np.clip(step, -_LARGEST_STEP, _LARGEST_STEP)
        grown = np.exp(line @ logarithm)
        grown /= grown.mean()
    return np.asarray(grown, dtype=np.float64)


def compute_weights(design: Design, deviation: FloatArray) -> FloatArray:
    """Return w, the variance of each reading over the mean one, shape (N,)."""
    tests, grown = _examine_spreads(design, deviation)
    found = grown
    for test in tests:
        if test.is_refuted and test.factor in (groupings := _make_groupings(design)):
            is_whole = test.factor is not SpreadFactor.POSITION
            scatter = _estimate_scatter(design, deviation, grown, with_jumps=is_whole)
            found = found * _shrink_variances(scatter / np.sqrt(found), groupings[test.factor])
    return np.asarray(found / found.mean(), dtype=np.float64)


def _make_groupings(design: Design) -> dict[SpreadFactor, IntArray]:
    return {
        SpreadFactor.POSITION: design.target,
        SpreadFactor.DIRECTION: design.direction.astype(np.int64),
        SpreadFactor.RUN: design.cycle,
    }


def _estimate_scatter(
    design: Design, deviation: FloatArray, variance: FloatArray, *, with_jumps: bool = False
) -> FloatArray:
    """Return the scatter of readings of known relative variance as `_remove_drift` does, shape (N,)."""
    return _remove_drift(design, deviation[:, np.newaxis], variance, with_jumps=with_jumps)[:, 0]


def _remove_drift(
    design: Design, values: FloatArray, variance: FloatArray | None = None, *, with_jumps: bool = False
) -> FloatArray:
    """Return the scatter of readings about their cells, and about offset and slope of their passes.

    A pass is what one run takes in one direction. Without it, an effect that grows with position and time
    would pass for scatter, and be given little weight just where it shows. So would a jump of the zero while
    one target is measured again and again: where a target's readings follow one another, of each the best
    jump goes, too, unless they are compared from run to run, or up and down: all targets show that alike.

    `values`, (N, B): Deviations of B sets.
    `variance`, (N,) array or None: Of each reading over the mean one; the readings of a cell share it.
    `with_jumps`: Whether jumps stay in it.
    """
    cell = number_cells(design)
    count = np.bincount(cell)
    root = np.ones(len(cell)) if variance is None else np.sqrt(variance)
    membership = (cell == np.arange(len(count))[:, np.newaxis]) / count[:, np.newaxis]
    left = (values - (membership @ values)[cell]) / root[:, np.newaxis]
    if not with_jumps and not is_apart_in_time(design):
        _remove_jumps(design, cell, left)
    kept = 1.0 - 1.0 / count[cell]
    _, passes = np.unique(2 * design.cycle + (design.direction > 0), return_inverse=True)
    for index in range(passes.max() + 1):
        taken = np.flatnonzero(passes == index)
        line = np.column_stack([np.ones(len(taken)), design.position[taken] - design.middle])
        base, _ = np.linalg.qr(line / root[taken, np.newaxis])
        left[taken] -= base @ (base.T @ left[taken])
        kept[taken] *= np.maximum(1.0 - np.sum(base**2, axis=1), _LEAST_KEPT)
    return np.asarray(left * (root / np.sqrt(np.maximum(kept, 1e-3)))[:, np.newaxis], dtype=np.float64)


def _remove_jumps(design: Design, cell: IntArray, left: FloatArray) -> FloatArray:
    """Take from each target's readings, in place, the jump in time that explains most of their scatter.

    Returns what it explains of their squares, shape (targets, B).

    `left`, (N, B): Deviations of B sets less the means of their cells.
    """
    targets = np.unique(design.target)
    explained = np.zeros((len(targets), left.shape[1]))
    for place, target in enumerate(targets):
        taken = np.flatnonzero(design.target == target)
        # One reading that stands off is no jump, and lies within what the scatter may be.
        jumps = (taken[:, np.newaxis] > taken[1:-2]).astype(np.float64)
        for each in np.unique(cell[taken]):
            own = cell[taken] == each
            jumps[own] -= jumps[own].mean(axis=0)
        lengths = np.linalg.norm(jumps, axis=0)
        jumps = jumps[:, lengths > 0] / lengths[lengths > 0]
        sizes = jumps.T @ left[taken]
        if len(sizes):
            best = np.argmax(np.abs(sizes), axis=0)
            largest = np.take_along_axis(sizes, best[np.newaxis], axis=0)
            left[taken] -= jumps[:, best] * largest
            explained[place] = largest[0] ** 2
    return explained


def _compute_levene(sizes: FloatArray, group: IntArray) -> tuple[FloatArray, int]:
    """Return the ratio of variances between and within groups for each set, and the first's widest group."""
    count = np.bincount(group)
    membership = (group == np.arange(len(count))[:, np.newaxis]) / count[:, np.newaxis]
    means = membership @ sizes
    between = count @ (means - sizes.mean(axis=0)) ** 2 / (len(count) - 1)
    within = np.sum((sizes - means[group]) ** 2, axis=0) / (len(sizes) - len(count))
    # Readings that are all alike have no scatter, and none of them stands off.
    ratio = np.divide(between, within, out=np.zeros_like(between), where=within > 0)
    return ratio, int(np.argmax(means[:, 0]))


def _shrink_variances(scatter: FloatArray, labels: IntArray) -> FloatArray:
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
