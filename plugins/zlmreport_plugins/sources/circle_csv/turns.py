"""The readings of one turn in one sense: its angles, its overlap, which readings are evaluated."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from zlmreport.plugin import Approach, BoolArray, FloatArray, Place

TURN = 2 * math.pi
#: Of the way from reading to reading: what lies nearer to the end of a turn closes it.
_CLOSES = 0.5


@dataclass(frozen=True, slots=True)
class CircleTurn:
    """Readings of one turn in one sense, in the order of time."""

    sense: Approach  #: + counter-clockwise.
    run: int
    angle: FloatArray  #: (N,): θ, rad, unwrapped: it rises counter-clockwise and falls clockwise.
    deviation: FloatArray  #: (N,): actual − nominal radius, m; NaN where missing.
    time: FloatArray  #: (N,): s; NaN where not logged.
    conditions: Mapping[str, FloatArray]  #: What was logged beside each, (N,).
    places: Sequence[Place]  #: Where each stands.

    @property
    def travelled(self) -> FloatArray:
        """How far round each reading lies from the first, rad; negative against the sense."""
        return np.asarray(float(self.sense) * (self.angle - self.angle[0]))

    @property
    def extent(self) -> float:
        """How far round the turn went, rad."""
        return float(self.travelled[-1])

    @property
    def step(self) -> float:
        """The usual way from reading to reading, rad."""
        return float(np.median(np.abs(np.diff(self.angle))))

    def keep(self, chosen: BoolArray) -> CircleTurn:
        """Return some of its readings."""
        return replace(
            self,
            angle=self.angle[chosen],
            deviation=self.deviation[chosen],
            time=self.time[chosen],
            conditions={name: values[chosen] for name, values in self.conditions.items()},
            places=[place for place, is_one in zip(self.places, chosen, strict=True) if is_one],
        )


def choose_evaluated_part(
    turn: CircleTurn, feed_in: float | None, feed_out: float | None
) -> tuple[CircleTurn, float, float]:
    """Return the part of a turn that is evaluated, at most one round, and the arcs before and behind it, rad.

    `feed_in`, `feed_out`: As the job states them, rad; None where it does not: then one of them follows from
    the other, and without both what goes beyond a full turn is left out by halves.
    """
    excess = max(0.0, turn.extent - TURN)
    if excess <= _CLOSES * turn.step:
        excess = 0.0
    if feed_in is None and feed_out is None:
        before = behind = excess / 2
    else:
        before = feed_in if feed_in is not None else max(0.0, excess - (feed_out or 0.0))
        behind = feed_out if feed_out is not None else max(0.0, excess - before)
    slack = 1e-9
    way = turn.travelled
    last = min(turn.extent - behind, before + TURN - _CLOSES * turn.step)
    return turn.keep((way >= before - slack) & (way <= last + slack)), before, behind


def put_one_after_another(turns: Sequence[CircleTurn]) -> tuple[list[CircleTurn], bool]:
    """Return turns whose times go on where those of each begin anew, and whether any did."""
    found: list[CircleTurn] = []
    shift, is_shifted, last = 0.0, False, -math.inf
    for turn in turns:
        times = turn.time[np.isfinite(turn.time)]
        if times.size and times[0] + shift < last:
            shift, is_shifted = last - float(times[0]), True
        found.append(replace(turn, time=turn.time + shift))
        last = float(times[-1]) + shift if times.size else last
    return found, is_shifted


def find_common_angles(turns: Sequence[CircleTurn], most: int) -> FloatArray | None:
    """Return the angles that all turns share, rad in [0, 2π), rising; None where they have their own.

    They share them if each has half of all at least; a reading that one of them lacks is then missing.
    """
    noise = 1e-9
    own = [np.mod(turn.angle + noise, TURN) - noise for turn in turns]
    found = np.sort(np.concatenate(own))
    distinct = found[np.concatenate([[True], np.diff(found) > 100 * noise])]
    if len(distinct) > most or any(2 * len(each) < len(distinct) for each in own):
        return None
    return np.asarray(distinct)


def find_strays(turn: CircleTurn) -> Iterator[str]:
    """Yield what is wrong with the angles of a turn: most of them go the other way."""
    steps = float(turn.sense) * np.diff(turn.angle)
    if not np.count_nonzero(steps):
        return
    if np.count_nonzero(steps < 0) > np.count_nonzero(steps > 0):
        way, other = ("rise", "ccw") if turn.sense is Approach.NEGATIVE else ("fall", "cw")
        yield (
            f"the angles of this turn {way}, so that it went {other}; are sense or angle exchanged? Angles "
            "are reckoned from the plane's first axis towards its second"
        )
