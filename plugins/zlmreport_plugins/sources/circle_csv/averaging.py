"""Averages many readings of a turn over equal arcs, and looks for vibration that this would hide.

A ballbar reads a thousand times a second. Averages over arcs keep the path and lose what is faster: so the
readings are searched for a vibration at their full rate, and how much the averages leave out is told.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.plugin import FloatArray, IntArray
from zlmreport.plugin.source import Averaging
from zlmreport_plugins.sources.circle_csv.turns import TURN, CircleTurn

#: Numbers of arcs of a turn, of which the largest is taken that leaves none without a reading.
_ARCS = (3600, 1800, 1440, 1200, 900, 720, 600, 480, 360, 240, 180, 120, 90, 72, 60, 36, 24, 12, 8)
#: Harmonics of the turn that are taken off before averaging, and put back at the middle of each arc.
_HARMONICS = 4
#: Of a line in a spectrum of white noise: so seldom is it that strong by chance.
_CHANCE = 1e-3
#: Readings among which a line is looked for, and the amplitude that is one at the least, m.
_FEWEST, _SMALLEST = 64, 1e-8
#: Points of the spectrum to each of its lines.
_FINER = 8


@dataclass(frozen=True, slots=True)
class Averaged:
    """A turn of averages over arcs."""

    turn: CircleTurn  #: What it was made of.
    angle: FloatArray  #: (m,): middles of the arcs, rad in [0, 2π), in the order in which they were passed.
    deviation: FloatArray  #: (m,): m.
    time: FloatArray  #: (m,): s; NaN where not logged.
    conditions: Mapping[str, FloatArray]
    central: IntArray  #: (m,): Index of the reading in the middle of each arc.


def count_arcs_of(turns: Sequence[CircleTurn]) -> int:
    """Return into how many arcs a turn may be cut so that each has a reading of every turn."""
    for number in _ARCS:
        covered = _find_covered(turns, number)
        if covered.size and all(np.isin(covered, _find_arc(turn, number)).all() for turn in turns):
            return number
    return _ARCS[-1]


def average_turns(turns: Sequence[CircleTurn], number: int) -> tuple[Averaged, ...]:
    """Return the averages of turns over arcs that all of them cover whole, at so many arcs a turn."""
    covered = _find_covered(turns, number)
    return tuple(_average_turn(turn, number, covered) for turn in turns)


def look_at_averages(turns: Sequence[Averaged], angular_speed: float) -> Averaging:
    """Return what the averages leave out: how much, and the strongest vibration in it.

    `angular_speed`: Of the turns, rad/s: it makes a frequency of a number of cycles to the turn.
    """
    left = [_compute_left_out(each) for each in turns]
    amplitude, frequency = max(
        (_find_strongest(each.turn, rest, angular_speed) for each, rest in zip(turns, left, strict=True)),
        default=(0.0, 0.0),
    )
    everything = np.concatenate(left)
    return Averaging(
        sum(len(each.turn.angle) for each in turns),
        float(np.sqrt(np.mean(everything**2))) if everything.size else 0.0,
        amplitude,
        frequency,
    )


def _find_arc(turn: CircleTurn, number: int) -> IntArray:
    """Return in which arc each reading lies, counted from angle 0; arcs begin where the axes turn round."""
    return np.floor(np.mod(turn.angle, TURN) / TURN * number + 1e-9).astype(np.int64) % number


def _find_covered(turns: Sequence[CircleTurn], number: int) -> IntArray:
    """Return the arcs that every turn covers whole: all of a full turn, of others those between its ends."""
    found = np.arange(number)
    width = TURN / number
    for turn in turns:
        low, high = sorted((float(turn.angle[0]), float(turn.angle[-1])))
        slack = turn.step
        if high - low + slack >= TURN - 1e-6:
            continue
        first = math.ceil((low - slack / 2) / width - 1e-6)
        last = math.floor((high + slack / 2) / width + 1e-6)
        found = np.intersect1d(found, np.arange(first, last) % number)
    return found


def _make_harmonics(angle: FloatArray) -> FloatArray:
    orders = np.arange(1, _HARMONICS + 1)
    phases = np.multiply.outer(angle, orders)
    return np.concatenate([np.ones((len(angle), 1)), np.cos(phases), np.sin(phases)], axis=1)


def _average_turn(turn: CircleTurn, number: int, covered: IntArray) -> Averaged:
    """Average one turn.

    The readings of an arc do not lie about its middle evenly: what changes slowly along the path is taken off
    before, and put back there, so that it is not moved.
    """
    present = np.isfinite(turn.deviation)
    design = _make_harmonics(turn.angle)
    smooth, *_ = np.linalg.lstsq(design[present], turn.deviation[present], rcond=1e-9)
    rest = np.where(present, turn.deviation - design @ smooth, np.nan)
    arc = _find_arc(turn, number)
    place = np.full(number, -1)
    place[covered] = np.arange(len(covered))
    slot = place[arc]
    middle = (covered + 0.5) * TURN / number
    mean = _compute_means(rest, slot, len(covered)) + _make_harmonics(middle) @ smooth
    central = _find_central(slot, len(covered))
    there = central >= 0
    order = np.flatnonzero(there)[np.argsort(central[there], kind="stable")]
    return Averaged(
        turn,
        middle[order],
        mean[order],
        turn.time[central[order]],
        {name: _compute_means(values, slot, len(covered))[order] for name, values in turn.conditions.items()},
        central[order],
    )


def _find_central(slot: IntArray, count: int) -> IntArray:
    """Return the index of the reading in the middle of each slot's, in the order of time; −1 without any.

    In the arc in which a turn begins and ends that is one of the greater part.
    """
    by_slot = np.argsort(slot, kind="stable")
    starts = np.searchsorted(slot[by_slot], np.arange(count))
    ends = np.searchsorted(slot[by_slot], np.arange(count), side="right")
    middle = np.minimum((starts + ends - 1) // 2, len(slot) - 1)
    return np.where(ends > starts, by_slot[middle], -1)


def _compute_means(values: FloatArray, slot: IntArray, count: int) -> FloatArray:
    """Return the mean of the values that there are in each slot; NaN where there is none."""
    chosen = (slot >= 0) & np.isfinite(values)
    total = np.bincount(slot[chosen], weights=values[chosen], minlength=count)
    number = np.bincount(slot[chosen], minlength=count)
    with np.errstate(invalid="ignore"):
        return np.asarray(total / number, dtype=np.float64)


def _compute_left_out(found: Averaged) -> FloatArray:
    """Return what is left of each reading beside the averages, linear between these."""
    turn = found.turn
    angle = np.mod(turn.angle, TURN)
    inside = np.isfinite(turn.deviation) & np.isfinite(found.deviation).any()
    known = np.isfinite(found.deviation)
    order = np.argsort(found.angle[known])
    path = np.interp(angle, found.angle[known][order], found.deviation[known][order], period=TURN)
    return (turn.deviation - path)[inside]


def _find_strongest(turn: CircleTurn, left: FloatArray, angular_speed: float) -> tuple[float, float]:
    """Return amplitude and frequency of the strongest line, m and Hz; zeros where it may be chance."""
    count = len(left)
    if count < _FEWEST:
        return 0.0, 0.0
    rest = left - left.mean()
    power = np.abs(np.fft.rfft(rest)[1:-1]) ** 2
    total = float(power.sum())
    if not total:
        return 0.0, 0.0
    share = float(power.max()) / total
    if share <= 1 - (_CHANCE / len(power)) ** (1 / (len(power) - 1)):  # Fisher's test
        return 0.0, 0.0
    finer = np.abs(np.fft.rfft(rest, _FINER * count))  # its peak lies between two lines of the spectrum
    strongest = int(finer.argmax())
    amplitude = 2 * float(finer[strongest]) / count
    if amplitude < _SMALLEST:
        return 0.0, 0.0
    cycles = strongest / _FINER / (turn.extent + turn.step)  # per rad
    return amplitude, cycles * angular_speed
