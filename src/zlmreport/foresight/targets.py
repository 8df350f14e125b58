"""Target positions that a person can type and an axis can reach."""

from __future__ import annotations

import math

import numpy as np

from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.planning.targets import target_positions
from zlmreport.quantities.arrays import FloatArray, read_only_floats
from zlmreport.simulation.randomness import Stream

#: In mm or °, and as a share of a short travel.
_USUAL_OVERRUN, _LARGEST_SHARE = 5.0, 1 / 50
#: Digits after the decimal point that controls take, of mm or °; phases of a period that they must part.
_USUAL_DIGITS, _LEAST_PHASES = 3, 20
#: Without a known pitch: share of the interval that the fractions cover.
_SHARE_OF_INTERVAL = 1 / 4
_RIGHT_ANGLE = math.pi / 2
#: More digits than any control takes, and fewer than a double rounds at.
_DIGITS = 9
_ROUNDING = 1e-9


def makes_whole_turns(axis: Axis) -> bool:
    """Tell whether an axis has no end at which it must turn round."""
    if axis.kind is not AxisKind.ROTARY or axis.travel is None:
        return False
    return axis.travel[1] - axis.travel[0] >= 2 * math.pi * (1 - _ROUNDING)


def usual_overrun(axis: Axis) -> float:
    """Return how far beyond a target an axis turns round where the job does not say it, m or rad."""
    usual = axis.position_unit.to_si(_USUAL_OVERRUN)
    if axis.travel is None:
        return usual
    return min(usual, _LARGEST_SHARE * (axis.travel[1] - axis.travel[0]))


def drawn_targets(axis: Axis, count: int, overrun: float, period: float | None, seed: int) -> FloatArray:
    """Return targets P_i = (i − 1)·p + r over the travel of an axis, rising, m or rad.

    They keep the overrun's distance from the ends of the travel, for there the axis must turn round; not on
    an axis that makes whole turns. On rotary axes the targets next to whole quarter turns are moved there.

    Parameters
    ----------
    axis
        An axis with a travel.
    count
        m, two at least.
    overrun
        m or rad.
    period
        Whose random fractions r are, m or rad; 0 for even targets; None for the pitch that the axis states,
        or else a quarter of the interval, as far as they fit.
    seed
        Of the fractions.

    Raises
    ------
    ValueError
        If so many targets do not fit.
    """
    assert axis.travel is not None  # noqa: S101 - the caller has seen to it
    first, last = axis.travel
    if not makes_whole_turns(axis):
        first, last = first + overrun, last - overrun
    if last <= first:
        raise ValueError("the travel is shorter than the overrun at both ends")
    if period is None:
        period = _usual_period(axis, count, last - first)
    targets = target_positions((first, last), count, period, Stream.TARGETS.generator(seed))
    typed = np.clip(_typed(axis, targets), first, last)
    if axis.kind is AxisKind.ROTARY and period:
        typed = _at_quarter_turns(typed, first, last)
    return read_only_floats(typed)


def in_users_unit(axis: Axis, positions: FloatArray) -> list[float]:
    """Return positions in mm or °, as decimal numbers that were meant."""
    return [round(value, _DIGITS) for value in axis.position_unit.from_si(positions).tolist()]


def periods(axis: Axis) -> tuple[tuple[str, float], ...]:
    """Return the periods that an axis states, by their keys, m or rad."""
    stated = (("axis.screw_pitch", axis.screw_pitch), ("axis.signal_period", axis.signal_period))
    return tuple((key, period) for key, period in stated if period is not None)


def _usual_period(axis: Axis, count: int, length: float) -> float:
    wanted = axis.screw_pitch or _SHARE_OF_INTERVAL * length / (count - 1)
    return min(wanted, (1 - _ROUNDING) * length / count)


def _typed(axis: Axis, targets: FloatArray) -> FloatArray:
    """Return targets with as many digits as a control takes, and as their periods and intervals need."""
    unit = axis.position_unit
    interval = float(targets[-1] - targets[0]) / (len(targets) - 1)
    shortest = unit.from_si(min([interval, *(period for _, period in periods(axis))]))
    digits = max(_USUAL_DIGITS, math.ceil(-math.log10(shortest / _LEAST_PHASES) - _ROUNDING))
    return unit.to_si(np.round(unit.from_si(targets), digits))


def _at_quarter_turns(targets: FloatArray, first: float, last: float) -> FloatArray:
    """Return targets among which every quarter turn from the first to the last is, as ISO 230-2 asks."""
    moved = targets.copy()
    turns = range(
        math.ceil(first / _RIGHT_ANGLE - _ROUNDING), math.floor(last / _RIGHT_ANGLE + _ROUNDING) + 1
    )
    for turn in turns:
        angle = turn * _RIGHT_ANGLE
        moved[np.argmin(np.abs(targets - angle))] = angle
    return moved
