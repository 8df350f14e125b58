"""Chooses target positions: random fractions, digits to type, phases of periods."""

from __future__ import annotations

import math

import numpy as np

from zlmreport.evaluation.checks import position_in_words
from zlmreport.language import Words
from zlmreport.measurement.arrays import BoolArray, FloatArray, read_only_floats
from zlmreport.measurement.axis import Axis, AxisKind

#: Number of the targets among the random parts of a test: theirs for ever, or old seeds would give others.
_STREAM = 10
#: Digits after the decimal point that controls take, of mm or °; phases of a period that they must part.
_USUAL_DIGITS, _LEAST_PHASES = 3, 20
#: Without a known pitch: share of the interval that the fractions cover.
_SHARE_OF_INTERVAL = 1 / 4
_RIGHT_ANGLE = math.pi / 2
#: More digits than any control takes, and fewer than a double rounds at.
_DIGITS = 9
_ROUNDING = 1e-9
#: Phases that agree within this share of a period are one.
_ONE_PHASE = 0.01

_PERIODS = {
    "axis.screw_pitch": Words("the pitch of {period}"),
    "axis.signal_period": Words("the signal period of {period}"),
}


def make_target_generator(seed: int) -> np.random.Generator:
    """Return where the random fractions of targets come from: the same seed gives the same targets."""
    return np.random.default_rng([seed, _STREAM])


def compute_target_positions(
    travel: tuple[float, float], count: int, period: float, generator: np.random.Generator
) -> FloatArray:
    """Return target positions P_i = (i − 1)·p + r, rising, all within the travel.

    The random fractions r let the targets see every phase of a periodic error; the interval p leaves room
    for them at the end.

    `travel`: First and last position, m or rad.
    `count`: m, the number of targets; two at least.
    `period`: The greatest period that is expected, m or rad: r is drawn anew for each target, evenly from 0
        up to it. 0 gives even targets.

    Raises `ValueError` if targets so many do not fit: p must not be smaller than the period.
    """
    first, last = travel
    interval = (last - first - period) / (count - 1)
    if interval < period:
        most = int((last - first) / period)
        raise ValueError(
            f"{count} targets with fractions of a period do not fit into the travel; up to {most} do"
        )
    return first + interval * np.arange(count) + generator.uniform(0.0, period, count)


def makes_whole_turns(axis: Axis) -> bool:
    """Tell whether an axis has no end at which it must turn round."""
    if axis.kind is not AxisKind.ROTARY or axis.travel is None:
        return False
    return axis.travel[1] - axis.travel[0] >= 2 * math.pi * (1 - _ROUNDING)


def sample_targets(axis: Axis, count: int, overrun: float, period: float | None, seed: int) -> FloatArray:
    """Return targets P_i = (i − 1)·p + r over the travel of an axis, rising, m or rad.

    They keep the overrun's distance from the ends of the travel, for there the axis must turn round; not on
    an axis that makes whole turns. On rotary axes the targets next to whole quarter turns are moved there.

    `axis`: An axis with a travel.
    `count`: m, two at least.
    `overrun`: m or rad.
    `period`: Whose random fractions r are, m or rad; 0 for even targets; None for the pitch that the axis
        states, or else a quarter of the interval, as far as they fit.

    Raises `ValueError` if so many targets do not fit.
    """
    assert axis.travel is not None  # noqa: S101 - the caller has seen to it
    first, last = axis.travel
    if not makes_whole_turns(axis):
        first, last = first + overrun, last - overrun
    if last <= first:
        raise ValueError("the travel is shorter than the overrun at both ends")
    if period is None:
        period = _find_usual_period(axis, count, last - first)
    targets = compute_target_positions((first, last), count, period, make_target_generator(seed))
    typed = np.clip(_round_as_typed(axis, targets), first, last)
    if axis.kind is AxisKind.ROTARY and period:
        typed = _add_quarter_turns(typed, first, last)
    return read_only_floats(typed)


def convert_to_users_unit(axis: Axis, positions: FloatArray) -> list[float]:
    """Return positions in mm or °, as decimal numbers that were meant."""
    return [round(value, _DIGITS) for value in axis.position_unit.from_si(positions).tolist()]


def list_periods(axis: Axis) -> tuple[tuple[str, float], ...]:
    """Return the periods that an axis states, by their keys, m or rad."""
    stated = (("axis.screw_pitch", axis.screw_pitch), ("axis.signal_period", axis.signal_period))
    return tuple((key, period) for key, period in stated if period is not None)


def _find_usual_period(axis: Axis, count: int, length: float) -> float:
    wanted = axis.screw_pitch or _SHARE_OF_INTERVAL * length / (count - 1)
    return min(wanted, (1 - _ROUNDING) * length / count)


def _round_as_typed(axis: Axis, targets: FloatArray) -> FloatArray:
    """Return targets with as many digits as a control takes, and as their periods and intervals need."""
    unit = axis.position_unit
    interval = float(targets[-1] - targets[0]) / (len(targets) - 1)
    shortest = unit.from_si(min([interval, *(period for _, period in list_periods(axis))]))
    digits = max(_USUAL_DIGITS, math.ceil(-math.log10(shortest / _LEAST_PHASES) - _ROUNDING))
    return unit.to_si(np.round(unit.from_si(targets), digits))


def _add_quarter_turns(targets: FloatArray, first: float, last: float) -> FloatArray:
    """Return targets among which every quarter turn from the first to the last is, as ISO 230-2 asks."""
    moved = targets.copy()
    turns = range(
        math.ceil(first / _RIGHT_ANGLE - _ROUNDING), math.floor(last / _RIGHT_ANGLE + _ROUNDING) + 1
    )
    for turn in turns:
        angle = turn * _RIGHT_ANGLE
        moved[np.argmin(np.abs(targets - angle))] = angle
    return moved


def find_periods_at_phases(axis: Axis, targets: FloatArray, number: int) -> list[Words]:
    """Return the known periods of an axis at exactly so many phases of which targets lie.

    `axis`: Which states its periods, or none.
    `targets`, (m,): m or rad.
    `number`: 1 or 2.
    """
    return [
        _PERIODS[key].given(period=position_in_words(axis, period))
        for key, period in list_periods(axis)
        if count_phases(targets, period) == number
    ]


def count_phases(targets: FloatArray, period: float) -> int:
    """Return at how many phases of a period targets lie: 1, 2, or 3 for more."""
    elsewhere = targets[~_find_phase_of_first(targets, period)]
    if not elsewhere.size:
        return 1
    return 2 if _find_phase_of_first(elsewhere, period).all() else 3


def _find_phase_of_first(targets: FloatArray, period: float) -> BoolArray:
    turns = (targets - targets[0]) / period
    return np.asarray(np.abs(turns - np.rint(turns)) < _ONE_PHASE)
