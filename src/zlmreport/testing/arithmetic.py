"""What the formulas of every standard must do."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np

from zlmreport.evaluation.evaluate import is_negative, measure_reach
from zlmreport.evaluation.evaluation import Arithmetic
from zlmreport.evaluation.statistics import PositionStatistics, join_statistics, position_statistics
from zlmreport.job.types import Options
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.plugin.kinds import STANDARD
from zlmreport.plugin.protocols import Standard
from zlmreport.testing.expectations import (
    check,
    expect,
    guard_subject,
    is_same_value,
    list_checks_of,
)
from zlmreport.testing.measurements import is_of_circles, names_of_lines

_POSITIONS, _RUNS = 7, 5
_MANY = 200  # tests in a stack
#: Where they stand, m: at no equal intervals.
_PLACES = read_only_floats([0.0, 0.13, 0.29, 0.44, 0.62, 0.87, 1.0])
#: Of a circle, from the first of them to the last, rad.
_ROUND = 5.4
_SPREAD = 5e-6  # m: readings of a machine tool
#: How many times as large as the largest of readings with scatter a parameter is at most, and at least.
_LARGEST, _SMALLEST = 30.0, 2e-3
#: Between two ways of adding some hundred doubles there are a few units in the last place.
_RELATIVE, _ABSOLUTE = 1e-9, 1e-9 * _SPREAD


@check
def gives_every_quantity(standard: Standard, options: Options, *_: Any) -> None:
    """Check that there is one value for each parameter, and one at each position for each own column."""
    statistics = _make_statistics(standard, _sample_readings(3))
    guard_subject(standard, STANDARD).arithmetic(statistics, options)


@check
def stack_equals_loop(standard: Standard, options: Options, *_: Any) -> None:
    """Check that a stack of tests, complete or not, gives what each test gives alone: batch first."""
    stack = _sample_readings(2, 4)
    stack[0, 1, Approach.NEGATIVE.index, 3, 2] = np.nan
    stack[0, 2, Approach.NEGATIVE.index] = np.nan
    stack[1, 0, Approach.POSITIVE.index] = np.nan
    stack[1, 1, ..., 1:] = np.nan
    stack[1, 2] = np.nan
    together = _collect_values(_find_arithmetic(standard, options, stack))
    for place in np.ndindex(2, 4):
        alone = _collect_values(_find_arithmetic(standard, options, stack[place]))
        for symbol, value in alone.items():
            _expect_close(
                together[symbol][place],
                value,
                f"{standard.identifier}: {symbol} of test {place} in a stack differs from the test alone",
            )


@check
def order_of_runs_is_irrelevant(standard: Standard, options: Options, *_: Any) -> None:
    """Check that numbering the runs another way changes nothing."""
    readings = _sample_readings()
    before = _collect_values(_find_arithmetic(standard, options, readings))
    after = _collect_values(_find_arithmetic(standard, options, readings[..., [3, 0, 4, 1, 2]]))
    for symbol, value in before.items():
        _expect_close(
            after[symbol], value, f"{standard.identifier}: {symbol} depends on the order of the runs"
        )


@check
def scales_with_the_readings(standard: Standard, options: Options, *_: Any) -> None:
    """Check that deviations twice as large give parameters twice as large: they are lengths or angles."""
    readings = _sample_readings()
    before = _collect_values(_find_arithmetic(standard, options, readings))
    after = _collect_values(_find_arithmetic(standard, options, 2 * readings))
    for symbol, value in before.items():
        _expect_close(
            after[symbol], 2 * value, f"{standard.identifier}: {symbol} does not double with the readings"
        )


@check
def moves_no_more_than_an_offset(standard: Standard, options: Options, *_: Any) -> None:
    """Check that an offset of all readings moves no parameter by more than itself."""
    readings, offset = _sample_readings(), 2 * _SPREAD
    before = _collect_values(_find_arithmetic(standard, options, readings))
    after = _collect_values(_find_arithmetic(standard, options, readings + offset))
    for symbol, value in before.items():
        moved = np.max(np.abs(after[symbol] - value), initial=0.0, where=~np.isnan(value))
        expect(
            moved <= offset * (1 + _RELATIVE),
            f"{standard.identifier}: {symbol} moves by {moved:.3g} m when all readings move {offset:.3g} m",
        )


@check
def no_part_exceeds_its_whole(standard: Standard, options: Options, *_: Any) -> None:
    """Check that no parameter is smaller than those of which its quantity says that it never is."""
    values = _collect_values(_find_arithmetic(standard, options, _sample_readings(_MANY)))
    for whole in standard.quantities:
        for symbol in whole.never_below:
            said = f"{standard.identifier}: {whole.symbol} is said to be never below {symbol}"
            expect(symbol in values, f"{said}, which is no parameter")
            short = np.abs(values[symbol]) - np.abs(values[whole.symbol])
            most = np.max(short, initial=0.0, where=~np.isnan(short))
            expect(most <= _ABSOLUTE, f"{said}, and was by {most:.3g} m")


@check
def one_missing_reading_takes_nothing_away(standard: Standard, options: Options, *_: Any) -> None:
    """Check that one missing reading leaves every parameter defined that the complete test defines."""
    readings = _sample_readings()
    complete = _find_arithmetic(standard, options, readings)
    readings[Approach.NEGATIVE.index, 2, 3] = np.nan
    for symbol, value in _find_arithmetic(standard, options, readings).parameters.items():
        expect(
            np.isfinite(value) or np.isnan(complete.parameters[symbol]),
            f"{standard.identifier}: {symbol} is {value} when one of {_RUNS} readings at a target is missing",
        )


@check
def undefined_is_nan(standard: Standard, options: Options, *_: Any) -> None:
    """Check that what a test does not define is NaN: not zero, not infinite, no warning, no exception.

    What is zero of the complete test too is so by definition, as both ends of a line that goes through them.
    """
    by_definition = {
        symbol: value == 0.0
        for symbol, value in _collect_values(_find_arithmetic(standard, options, _sample_readings())).items()
    }
    for kind, readings in _make_incomplete().items():
        where = f"{standard.identifier}: arithmetic of {kind}"
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            arithmetic = _find_arithmetic(standard, options, readings)
        for symbol, value in _collect_values(arithmetic).items():
            expect(not np.any(np.isinf(value)), f"{where}: {symbol} is infinite; expected NaN")
            expect(
                not np.any((value == 0.0) & ~by_definition[symbol]),
                f"{where}: {symbol} is exactly zero, which no readings with scatter give; expected NaN",
            )


@check
def nothing_gives_nothing(standard: Standard, options: Options, *_: Any) -> None:
    """Check that a test without a reading defines no parameter."""
    readings = np.full_like(_sample_readings(), np.nan)
    for symbol, value in _collect_values(_find_arithmetic(standard, options, readings)).items():
        expect(
            np.all(np.isnan(value)),
            f"{standard.identifier}: {symbol} of a test without readings is {value}; expected NaN",
        )


@check
def defines_what_it_declares(standard: Standard, options: Options, *_: Any) -> None:
    """Check that each parameter is defined by a complete test, or at least by some test."""
    tests = [_sample_readings(), *_make_incomplete().values(), _sample_readings()[..., :1]]
    found = [_collect_values(_find_arithmetic(standard, options, readings)) for readings in tests]
    for symbol in found[0]:
        expect(
            any(not np.all(np.isnan(values[symbol])) for values in found),
            f"{standard.identifier}: {symbol} is NaN in every test, complete ones too",
        )


@check
def values_are_lengths_that_readings_have(standard: Standard, options: Options, *_: Any) -> None:
    """Check that values are of the size of the readings, in metres, and that no spread is negative."""
    readings = _sample_readings()
    arithmetic = _find_arithmetic(standard, options, readings)
    largest, farthest = float(np.abs(readings).max()), measure_reach(position_statistics(readings))
    for symbol, value in _collect_values(arithmetic).items():
        size = float(np.max(np.abs(value), initial=0.0, where=~np.isnan(value)))
        where = f"{standard.identifier}: {symbol} of readings up to {largest:.3g} m is {size:.3g}"
        expect(size <= _LARGEST * largest, f"{where}; values are metres (radians), not micrometres")
        expect(
            size >= _SMALLEST * largest or np.all(np.isnan(value)), f"{where}; values are metres (radians)"
        )
    for quantity in standard.quantities:
        single = float(arithmetic.parameters[quantity.symbol])
        expect(
            np.isnan(single) or not is_negative(quantity, single, farthest),
            f"{standard.identifier}: {quantity.symbol} is {single:.3g} m; what is random or composite is no "
            "negative length",
        )


@check
def directions_are_not_swapped(standard: Standard, options: Options, *_: Any) -> None:
    """Check that symbols with ``_fwd`` follow readings taken upwards, and those with ``_bwd`` the others."""
    readings = _sample_readings()
    before = _collect_values(_find_arithmetic(standard, options, readings))
    for ending, other in (("_fwd", Approach.NEGATIVE), ("_bwd", Approach.POSITIVE)):
        moved = readings.copy()
        moved[other.index] *= 3.0
        after = _collect_values(_find_arithmetic(standard, options, moved))
        for symbol, value in before.items():
            if symbol.partition(" ")[0].endswith(ending):
                _expect_close(
                    after[symbol],
                    value,
                    f"{standard.identifier}: {symbol} follows the readings of the other direction",
                )


@check
def alters_no_input(standard: Standard, options: Options, *_: Any) -> None:
    """Check that the statistics are as they were after the arithmetic has used them."""
    statistics, kept = (_make_statistics(standard, _sample_readings(3)) for _ in range(2))
    _evaluate_statistics(standard, options, statistics)
    expect(
        is_same_value(statistics, kept),
        f"{standard.identifier}: arithmetic alters the statistics it is given",
    )


@check
def gives_the_same_again(standard: Standard, options: Options, *_: Any) -> None:
    """Check that the same readings give the same bits."""
    first, second = (_find_arithmetic(standard, options, _sample_readings()) for _ in range(2))
    expect(
        is_same_value(_collect_values(first), _collect_values(second)),
        f"{standard.identifier}: arithmetic gives other values the second time",
    )


def _make_statistics(standard: Standard, readings: FloatArray) -> PositionStatistics:
    """Return the statistics of readings, or of lines on which these stand in another order of positions."""
    places = read_only_floats(_ROUND * _PLACES) if is_of_circles(standard) else _PLACES
    lines = {
        name: position_statistics(np.roll(readings, shift, axis=-2), places)
        for shift, name in enumerate(names_of_lines(standard))
    }
    return join_statistics(lines) if lines else position_statistics(readings, places)


def _sample_readings(*batch: int) -> FloatArray:
    """Return deviations of shape (*batch, approach, position, run), m."""
    random = np.random.default_rng(20)
    means = random.normal(0.0, 2 * _SPREAD, (*batch, 2, _POSITIONS, 1))
    return means + random.normal(0.0, _SPREAD, (*batch, 2, _POSITIONS, _RUNS))


def _make_incomplete() -> Mapping[str, FloatArray]:
    tests = {
        kind: _sample_readings()
        for kind in (
            "the positive direction only",
            "the negative direction only",
            "a test with a single run",
            "a test with a single run in one direction",
            "a test with a target approached from one side only",
            "a test with a target never reached",
        )
    }
    positive, negative, run, run_positive, one_sided, unreached = tests.values()
    positive[Approach.NEGATIVE.index] = np.nan
    negative[Approach.POSITIVE.index] = np.nan
    run[..., 1:] = np.nan
    run_positive[..., 1:] = np.nan
    run_positive[Approach.NEGATIVE.index] = np.nan
    one_sided[Approach.POSITIVE.index, 1] = np.nan
    unreached[:, 4] = np.nan
    return tests


def _find_arithmetic(standard: Standard, options: Options, readings: FloatArray) -> Arithmetic:
    return _evaluate_statistics(standard, options, _make_statistics(standard, readings))


def _evaluate_statistics(standard: Standard, options: Options, statistics: PositionStatistics) -> Arithmetic:
    try:
        return standard.arithmetic(statistics, options)
    except Exception as error:
        message = (
            f"{standard.identifier}: arithmetic raised {error!r} on readings of {statistics.deviations.shape}"
        )
        raise AssertionError(message) from error


def _collect_values(arithmetic: Arithmetic) -> dict[str, FloatArray]:
    """Return all values by symbol; own columns under ``symbol by position``."""
    columns = {f"{symbol} by position": values for symbol, values in arithmetic.positions.items()}
    return {
        symbol: np.asarray(value, dtype=float)
        for symbol, value in {**arithmetic.parameters, **columns}.items()
    }


def _expect_close(found: FloatArray, expected: FloatArray, sentence: str) -> None:
    expect(
        np.allclose(found, expected, rtol=_RELATIVE, atol=_ABSOLUTE, equal_nan=True),
        f"{sentence}: {found} instead of {expected}",
    )


#: Every check of a standard's formulas.
ARITHMETIC_CHECKS = list_checks_of(__name__)
