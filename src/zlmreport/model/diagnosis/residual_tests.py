"""The tests of residuals: lack of fit, direction, run, conditions, order, time, periods; their sentences."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from zlmreport.language import Words, same
from zlmreport.language.numbers import number_words
from zlmreport.measurement.arrays import FloatArray, IntArray, read_only_integers
from zlmreport.model.diagnosis.null_distribution import LEVEL
from zlmreport.model.diagnosis.residuals import Failure, Residuals, ResidualTest
from zlmreport.model.effects import wording
from zlmreport.model.effects.design import Design
from zlmreport.model.effects.searching import count_waves_told
from zlmreport.model.fitting.blunders import Outliers
from zlmreport.model.fitting.distributions import f_tail
from zlmreport.model.fitting.repeats import SpreadFactor, SpreadTest, find_repeats, list_spread_tests

_LACK_OF_FIT = Words(
    "the means of the positions deviate from the model by up to {size}, more than their repeats allow"
)
_LARGEST_AT = Words("largest at {place}")
_SIGNS = Words(
    "the residuals keep their sign longer than by chance; changes of sign: {changes} instead of {expected}"
)
_HIGHER_UPWARDS = Words("upwards the residuals lie {size} higher than downwards")
_HIGHER_DOWNWARDS = Words("downwards the residuals lie {size} higher than upwards")
_DIRECTION_ALONG = Words("the difference between up and down changes with the position")
_RUNS = Words("runs are displaced as a whole, by up to {size}")
_WHOLE_AXIS = Words("along the whole axis")
_RUN = Words("run {run}")

_PERMUTATIONS = 400
_SEED = 20_261_118
_ORDERS = 4
_FOLLOW = Words("the residuals follow a logged condition, in their zero or in their slope")
_UNEQUAL = Words("the readings scatter unequally {factor}")
_UPWARDS = Words("more upwards")
_DOWNWARDS = Words("more downwards")
_MOST_AT = Words("most at {place}")
_FLAGGED = Words(
    "readings that stand off from their repeats and from their neighbours in time: {count}; they are set "
    "aside, not altered"
)
_AT = Words("at {place}")
_AND_MORE = Words("{first}; others: {more}")


def examine_lack_of_fit(residuals: Residuals) -> Failure | None:
    """Return the F-test of what the model leaves of the means against the pure error of the repeats."""
    fit, design = residuals.fit, residuals.design
    within = find_repeats(design, fit.residual)
    means = len(within.count) - (len(fit.deviation) - fit.degrees)
    if within.degrees < 1 or means < 1 or within.squares == 0:
        return None
    left = float(np.sum(fit.residual**2)) - within.squares
    p_value = f_tail((left / means) / (within.squares / within.degrees), means, within.degrees)
    of_cells = fit.residual - within.centred
    worst = int(np.argmax(np.abs(of_cells)))
    size = wording.deviation(design.axis, abs(float(of_cells[worst])))
    where = _LARGEST_AT.given(place=wording.cell(design, worst))
    readings = read_only_integers(np.flatnonzero(within.cell == within.cell[worst]))
    return Failure(ResidualTest.LACK_OF_FIT, p_value, where, _LACK_OF_FIT.given(size=size), readings)


def examine_signs(residuals: Residuals) -> Failure | None:
    """Return the test of the changes of sign of the positions' mean residuals along the axis."""
    design = residuals.design
    means = [
        _compute_means(residuals.fit.residual[side], design.target[side])
        for side in (design.direction > 0, design.direction < 0)
        if np.count_nonzero(side)
    ]
    signs_ = [np.sign(each - np.median(each)) for each in means if len(each) > 2]
    if not signs_:
        return None
    found = sum(_count_changes(each[np.newaxis])[0] for each in signs_)
    random = np.random.default_rng(_SEED)
    chance = np.sum(
        [_count_changes(random.permuted(np.tile(each, (_PERMUTATIONS, 1)), axis=1)) for each in signs_],
        axis=0,
    )
    p_value = (1 + int(np.count_nonzero(chance <= found))) / (_PERMUTATIONS + 1)
    statement = _SIGNS.given(changes=int(found), expected=number_words(float(np.mean(chance)), 0))
    return Failure(ResidualTest.SIGNS, p_value, _WHOLE_AXIS, statement)


def examine_direction(residuals: Residuals) -> Failure | None:
    """Return the test of a difference between the directions, constant or changing along the axis."""
    design = residuals.design
    if not design.is_bidirectional:
        return None
    sign = design.direction
    along = 2 * (design.position - design.middle) / (design.length or 1.0)
    gap = residuals.compute_p_value(sign[:, np.newaxis])
    shape = residuals.compute_p_value(sign[:, np.newaxis] * np.vander(along, _ORDERS))
    statement = _DIRECTION_ALONG if shape < gap else _say_constant_gap(residuals)
    return Failure(ResidualTest.DIRECTION, min(1.0, 2 * min(gap, shape)), _WHOLE_AXIS, statement)


def examine_runs(residuals: Residuals) -> Failure | None:
    """Return the test of runs that are displaced as a whole."""
    design = residuals.design
    numbers = np.unique(design.cycle)
    if len(numbers) < 2:
        return None
    membership = (design.cycle[:, np.newaxis] == numbers).astype(np.float64)
    means = _compute_means(residuals.fit.residual, design.cycle)
    worst = int(np.argmax(np.abs(means)))
    run = int(numbers[worst])
    statement = _RUNS.given(size=wording.deviation(design.axis, abs(float(means[worst]))))
    where, readings = _RUN.given(run=run), read_only_integers(np.flatnonzero(design.cycle == run))
    return Failure(ResidualTest.RUNS, residuals.compute_p_value(membership), where, statement, readings)


def _say_constant_gap(residuals: Residuals) -> Words:
    design, residual = residuals.design, residuals.fit.residual
    gap = float(np.mean(residual[design.direction > 0]) - np.mean(residual[design.direction < 0]))
    statement = _HIGHER_UPWARDS if gap > 0 else _HIGHER_DOWNWARDS
    return statement.given(size=wording.deviation(design.axis, abs(gap)))


def _compute_means(values: FloatArray, labels: IntArray) -> FloatArray:
    _, group = np.unique(labels, return_inverse=True)
    return np.asarray(np.bincount(group, weights=values) / np.bincount(group), dtype=np.float64)


def _count_changes(signs_: FloatArray) -> IntArray:
    """Return how often the sign changes along each row."""
    return np.asarray(np.count_nonzero(np.diff(signs_, axis=1) != 0, axis=1), dtype=np.int64)


def examine_conditions(residuals: Residuals) -> Failure | None:
    """Return the test of the logged condition that the residuals follow most closely."""
    design = residuals.design
    p_values = {}
    for name, log in design.conditions.items():
        if np.ptp(log) == 0:
            continue
        change = log - log.mean()
        columns = np.column_stack([change, change * (design.position - design.middle)])
        p_values[name] = residuals.compute_p_value(columns)
    if not p_values:
        return None
    closest = min(p_values, key=p_values.__getitem__)
    p_value = min(1.0, len(p_values) * p_values[closest])
    return Failure(ResidualTest.CONDITION, p_value, same(closest), _FOLLOW, condition=closest)


def spread(residuals: Residuals) -> Iterator[Failure]:
    """Yield the tests of equal scatter by position, direction and run."""
    design = residuals.design
    for test in list_spread_tests(design, residuals.fit.deviation):
        statement = _UNEQUAL.given(factor=test.factor.words)
        where, readings = _find_widest(design, test)
        yield Failure(ResidualTest.SPREAD, test.p_value, where, statement, readings)


def report_flagged(design: Design, aside: Outliers) -> Failure | None:
    """Return what is to be said of readings that were set aside, on the design that still has them."""
    readings = aside.readings
    if not len(readings):
        return None
    where = _AT.given(place=wording.reading_at(design, int(readings[0])))
    if len(readings) > 1:
        where = _AND_MORE.given(first=where, more=len(readings) - 1)
    return Failure(ResidualTest.OUTLIERS, aside.p_value, where, _FLAGGED.given(count=len(readings)))


def _find_widest(design: Design, test: SpreadTest) -> tuple[Words, IntArray]:
    """Return where readings scatter most, and which these are."""
    if test.factor is SpreadFactor.DIRECTION:
        chosen = np.sign(design.direction) == np.sign(test.widest)
        return (_UPWARDS if test.widest > 0 else _DOWNWARDS), read_only_integers(np.flatnonzero(chosen))
    if test.factor is SpreadFactor.RUN:
        chosen = design.cycle == test.widest
        place = _RUN.given(run=test.widest)
    else:
        chosen = design.target == test.widest
        place = wording.position(design.axis, float(design.position[int(np.argmax(chosen))]))
    return _MOST_AT.given(place=place), read_only_integers(np.flatnonzero(chosen))


_TIME_ORDER = Words(
    "repeats that follow one another deviate alike: something moves with time, by {size} from the first "
    "third of the test to the last"
)
_COMES_BACK = Words(
    "repeats that follow one another deviate alike: something comes and goes with time, by {size} from one "
    "third of the test to another"
)
_WHILE_VISITED = Words(
    "repeats that follow one another deviate alike: something moves while a target is visited again and again"
)
_REPEATS = Words("the residual repeats every {period}")
_ALONG_THE_AXIS = Words("along the whole axis, amplitude {size}")
_DURING_THE_TEST = Words("during the whole test, amplitude {size}")
_WHOLE_TEST = Words("during the whole test")

#: Times by which the thirds of a test differ more than the last from the first, that something came back.
_BACK = 2.0
#: Share of the scatter below which what moves is rounding: where each third has all repeats of its targets.
_ROUNDING = 1e-6
_FEWEST_PERIODS = 1.3
_STEPS_PER_PERIOD = 4
_MOST_PERIODS = 200
_READINGS_PER_PERIOD = 4
_HARMONICS = (1, 2)
_FEWEST_TARGETS = 6
_FINER = 41


def examine_time_order(residuals: Residuals) -> Failure | None:
    """Return von Neumann's ratio of the repeats in time order, against repeats exchanged in their cells."""
    fit = residuals.fit
    within = find_repeats(residuals.design, fit.residual)
    if within.degrees < 1 or within.squares == 0:
        return None
    found = _compute_ratio(within.centred[np.newaxis])[0]
    chance = _compute_ratio(_exchange_repeats(within.centred, within.cell))
    p_value = (1 + int(np.count_nonzero(chance <= found))) / (_PERMUTATIONS + 1)
    third = max(1, len(within.centred) // 3)
    parts = np.split(within.centred, [third, len(within.centred) - third])
    thirds = [float(each.mean()) for each in parts if each.size]
    moved, widest = thirds[-1] - thirds[0], max(thirds) - min(thirds)
    if widest < _ROUNDING * float(np.std(within.centred)):
        statement = _WHILE_VISITED
    else:
        words, size = (_COMES_BACK, widest) if widest > _BACK * abs(moved) else (_TIME_ORDER, moved)
        statement = words.given(size=wording.deviation(residuals.design.axis, size))
    return Failure(ResidualTest.TIME_ORDER, p_value, _WHOLE_TEST, statement)


def examine_period_in_position(residuals: Residuals) -> Failure | None:
    """Return the strongest wave along the axis; periods that the job states are tried beside all others."""
    design = residuals.design
    if len(design.target_positions) < _FEWEST_TARGETS or design.length == 0:
        return None
    stated = [each for each in (design.axis.screw_pitch, design.axis.signal_period) if each is not None]
    known = [each / harmonic for each in stated for harmonic in _HARMONICS if each <= design.length]
    most = count_waves_told(design)
    period, p_value, size = _find_strongest_wave(residuals, design.position, most, known)
    statement = _REPEATS.given(period=wording.length(design.axis, period))
    return Failure(ResidualTest.PERIOD_IN_POSITION, p_value, _ALONG_THE_AXIS.given(size=size), statement)


def examine_period_in_time(residuals: Residuals) -> Failure | None:
    """Return the strongest wave in time."""
    design = residuals.design
    most = len(design.time) / _READINGS_PER_PERIOD
    if design.duration == 0 or most <= _FEWEST_PERIODS:
        return None
    period, p_value, size = _find_strongest_wave(residuals, design.time, most, [])
    statement = _REPEATS.given(period=wording.span_of_time(design, period))
    return Failure(ResidualTest.PERIOD_IN_TIME, p_value, _DURING_THE_TEST.given(size=size), statement)


def _find_strongest_wave(
    residuals: Residuals, where: FloatArray, most: float, known: Sequence[float]
) -> tuple[float, float, Words]:
    """Return the period that explains most, the chance of it, and the amplitude in words.

    `where`, (N,): Position or time.
    `most`: Periods within the test that the readings can tell.
    """
    extent = float(np.ptp(where))
    counts = np.arange(_FEWEST_PERIODS, min(most, _MOST_PERIODS), 1 / _STEPS_PER_PERIOD)
    periods = np.concatenate([known, extent / counts])
    best, p_value = residuals.find_best_block(_make_waves(where, periods))
    period = float(periods[best])
    if best >= len(known):
        finer = extent / (extent / period + np.linspace(-1.0, 1.0, _FINER) / _STEPS_PER_PERIOD)
        best, _ = residuals.find_best_block(_make_waves(where, finer))
        period = float(finer[best])
    wave = _make_waves(where, np.array([period]))[0]
    amplitude = np.hypot(*np.linalg.lstsq(wave, residuals.fit.residual, rcond=None)[0])
    # What a wave does between targets half a period apart, nobody saw.
    seen = min(float(amplitude), float(np.abs(residuals.fit.residual).max()))
    return period, p_value, wording.deviation(residuals.design.axis, seen)


def _make_waves(where: FloatArray, periods: FloatArray) -> FloatArray:
    """Return sine and cosine of each period, shape (periods, N, 2)."""
    angles = 2 * np.pi * where / periods[:, np.newaxis]
    return np.stack([np.sin(angles), np.cos(angles)], axis=2)


def _compute_ratio(centred: FloatArray) -> FloatArray:
    """Return von Neumann's ratio of each row."""
    squares = np.sum(np.diff(centred, axis=1) ** 2, axis=1) / np.sum(centred**2, axis=1)
    return np.asarray(squares, dtype=np.float64)


def _exchange_repeats(centred: FloatArray, cell: IntArray) -> FloatArray:
    """Return repeats exchanged at random within their cells, shape (permutations, N)."""
    keys = np.random.default_rng(_SEED).random((_PERMUTATIONS, len(cell)))
    places = np.argsort(cell, kind="stable")
    found = np.empty((_PERMUTATIONS, len(cell)))
    found[:, places] = centred[np.argsort(keys + cell, axis=1)]
    return found


def run_residual_tests(residuals: Residuals) -> tuple[Failure, ...]:
    """Return every test that the design allows, passed or not."""
    return tuple(_run_tests(residuals))


def find_failures(tests: tuple[Failure, ...]) -> tuple[Failure, ...]:
    """Return the tests that were not passed, the clearest first; each pays for the number of them."""
    limit = LEVEL / max(1, len(tests))
    return tuple(sorted((test for test in tests if test.p_value < limit), key=lambda test: test.p_value))


def _run_tests(residuals: Residuals) -> Iterator[Failure]:
    for single in _SINGLE:
        found = single(residuals)
        if found is not None:
            yield found
    yield from spread(residuals)


_SINGLE = (
    examine_lack_of_fit,
    examine_signs,
    examine_direction,
    examine_runs,
    examine_time_order,
    examine_period_in_position,
    examine_period_in_time,
    examine_conditions,
)
