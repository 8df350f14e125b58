"""All tests of the residuals of a model; those of order, of time and of periods, stand here."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from zlmreport.language import Words
from zlmreport.model import wording
from zlmreport.model.null_distribution import LEVEL
from zlmreport.model.repeats import repeats
from zlmreport.model.residual_means import conditions, direction, lack_of_fit, runs, signs, spread
from zlmreport.model.residuals import Failure, Residuals, ResidualTest
from zlmreport.quantities.arrays import FloatArray, IntArray

_TIME_ORDER = Words(
    en="repeats that follow one another deviate alike: something moves with time, by {size} from the first "
    "third of the test to the last",
    de="aufeinander folgende Wiederholungen weichen gleich ab: Etwas bewegt sich mit der Zeit, um {size} vom "
    "ersten Drittel der Prüfung zum letzten",
)
_REPEATS = Words(en="the residual repeats every {period}", de="das Residuum wiederholt sich alle {period}")
_ALONG_THE_AXIS = Words(
    en="along the whole axis, amplitude {size}", de="längs der ganzen Achse, Amplitude {size}"
)
_DURING_THE_TEST = Words(
    en="during the whole test, amplitude {size}", de="während der ganzen Prüfung, Amplitude {size}"
)
_WHOLE_TEST = Words(en="during the whole test", de="während der ganzen Prüfung")

_PERMUTATIONS = 400
_SEED = 20_261_118
_FEWEST_PERIODS = 1.3
_STEPS_PER_PERIOD = 4
_MOST_PERIODS = 200
_READINGS_PER_PERIOD = 4
_HARMONICS = (1, 2)
_FEWEST_TARGETS = 6
_FINER = 41


def time_order(residuals: Residuals) -> Failure | None:
    """Return von Neumann's ratio of the repeats in time order, against repeats exchanged in their cells."""
    fit = residuals.fit
    within = repeats(residuals.design, fit.residual)
    if within.degrees < 1 or within.squares == 0:
        return None
    found = _ratio(within.centred[np.newaxis])[0]
    chance = _ratio(_exchanged(within.centred, within.cell))
    p_value = (1 + int(np.count_nonzero(chance <= found))) / (_PERMUTATIONS + 1)
    third = max(1, len(within.centred) // 3)
    moved = float(within.centred[-third:].mean() - within.centred[:third].mean())
    statement = _TIME_ORDER.given(size=wording.deviation(residuals.design.axis, moved))
    return Failure(ResidualTest.TIME_ORDER, p_value, _WHOLE_TEST, statement)


def period_in_position(residuals: Residuals) -> Failure | None:
    """Return the strongest wave along the axis; periods that the job states are tried beside all others."""
    design = residuals.design
    targets = len(design.target_positions)
    if targets < _FEWEST_TARGETS or design.length == 0:
        return None
    stated = [each for each in (design.axis.screw_pitch, design.axis.signal_period) if each is not None]
    known = [each / harmonic for each in stated for harmonic in _HARMONICS if each <= design.length]
    period, p_value, size = _strongest_wave(residuals, design.position, targets / 2, known)
    statement = _REPEATS.given(period=wording.length(design.axis, period))
    return Failure(ResidualTest.PERIOD_IN_POSITION, p_value, _ALONG_THE_AXIS.given(size=size), statement)


def period_in_time(residuals: Residuals) -> Failure | None:
    """Return the strongest wave in time."""
    design = residuals.design
    most = len(design.time) / _READINGS_PER_PERIOD
    if design.duration == 0 or most <= _FEWEST_PERIODS:
        return None
    period, p_value, size = _strongest_wave(residuals, design.time, most, [])
    statement = _REPEATS.given(period=wording.span_of_time(design, period))
    return Failure(ResidualTest.PERIOD_IN_TIME, p_value, _DURING_THE_TEST.given(size=size), statement)


def _strongest_wave(
    residuals: Residuals, where: FloatArray, most: float, known: Sequence[float]
) -> tuple[float, float, Words]:
    """Return the period that explains most, the chance of it, and the amplitude in words.

    Parameters
    ----------
    residuals
        The residuals.
    where : (N,) array
        Position or time.
    most
        Periods within the test that the readings can tell.
    known
        Periods that are exact, and not looked for.
    """
    extent = float(np.ptp(where))
    counts = np.arange(_FEWEST_PERIODS, min(most, _MOST_PERIODS), 1 / _STEPS_PER_PERIOD)
    periods = np.concatenate([known, extent / counts])
    best, p_value = residuals.best_block(_waves(where, periods))
    period = float(periods[best])
    if best >= len(known):
        finer = extent / (extent / period + np.linspace(-1.0, 1.0, _FINER) / _STEPS_PER_PERIOD)
        best, _ = residuals.best_block(_waves(where, finer))
        period = float(finer[best])
    amplitude = np.hypot(*_coefficients(residuals, _waves(where, np.array([period]))[0]))
    return period, p_value, wording.deviation(residuals.design.axis, float(amplitude))


def _waves(where: FloatArray, periods: FloatArray) -> FloatArray:
    """Return sine and cosine of each period, shape (periods, N, 2)."""
    angles = 2 * np.pi * where / periods[:, np.newaxis]
    return np.stack([np.sin(angles), np.cos(angles)], axis=2)


def _coefficients(residuals: Residuals, wave: FloatArray) -> FloatArray:
    return np.asarray(np.linalg.lstsq(wave, residuals.fit.residual, rcond=None)[0], dtype=np.float64)


def _ratio(centred: FloatArray) -> FloatArray:
    """Return von Neumann's ratio of each row."""
    squares = np.sum(np.diff(centred, axis=1) ** 2, axis=1) / np.sum(centred**2, axis=1)
    return np.asarray(squares, dtype=np.float64)


def _exchanged(centred: FloatArray, cell: IntArray) -> FloatArray:
    """Return repeats exchanged at random within their cells, shape (permutations, N)."""
    keys = np.random.default_rng(_SEED).random((_PERMUTATIONS, len(cell)))
    places = np.argsort(cell, kind="stable")
    found = np.empty((_PERMUTATIONS, len(cell)))
    found[:, places] = centred[np.argsort(keys + cell, axis=1)]
    return found


def residual_tests(residuals: Residuals) -> tuple[Failure, ...]:
    """Return every test that the design allows, passed or not."""
    return tuple(_tests(residuals))


def failures(tests: tuple[Failure, ...]) -> tuple[Failure, ...]:
    """Return the tests that were not passed, the clearest first; each pays for the number of them."""
    limit = LEVEL / max(1, len(tests))
    return tuple(sorted((test for test in tests if test.p_value < limit), key=lambda test: test.p_value))


def _tests(residuals: Residuals) -> Iterator[Failure]:
    for single in _SINGLE:
        found = single(residuals)
        if found is not None:
            yield found
    yield from spread(residuals)


_SINGLE = (
    lack_of_fit,
    signs,
    direction,
    runs,
    time_order,
    period_in_position,
    period_in_time,
    conditions,
)
