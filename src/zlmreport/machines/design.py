"""The readings of all circles of a machine side by side, thinned, without those near reversals.

Readings are averaged in their order, so that a turn keeps at most some 180 of them: more would not tell even,
low orders any better, for irregular geometry is alike in all of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from zlmreport.machines.course import CircularTest
from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.model.effects.circle_design import CircleDesign, CircleTest

#: Readings that a turn keeps, and all turns together.
_OF_A_TURN, _TOGETHER = 180, 1800
_FEWEST_OF_A_TURN = 90
#: A reading nearer to a reversal is left out, rad.
_BESIDE_REVERSAL = float(np.radians(0.7))
_COLUMNS = (
    "test", "turn", "angle", "sense", "travelled", "time", "radius", "feed", "first", "second",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class ThinnedDesign(CircleDesign):
    """A design of which each reading is the mean of some, neighbours in time."""

    circles: tuple[CircularTest, ...]  #: The tests with their readings.
    fine: CircleDesign  #: All readings.
    order: IntArray  #: The sorted indices of all readings,
    starts: IntArray  #: where each group begins among them,
    sizes: IntArray  #: and how many it has.

    def thin(self, values: FloatArray) -> FloatArray:
        """Return values at all readings, (M,) or (M, k), as means at those of this design."""
        sums = np.add.reduceat(values[self.order], self.starts, axis=0)
        return np.asarray((sums.T / self.sizes).T)


def clear_of_reversals(circle: CircularTest) -> CircularTest:
    """Return a circle without the readings beside the points where an axis turns.

    An axis runs through its lost motion within √(2B/R), some 0.7°: there nobody knows which side it is on.
    """
    beside = np.abs((circle.angle + np.pi / 4) % (np.pi / 2) - np.pi / 4)
    kept = beside > _BESIDE_REVERSAL
    return circle.keep(kept) if np.count_nonzero(kept) >= 0.8 * len(kept) else circle


def make_thinned_design(circles: Sequence[CircularTest]) -> ThinnedDesign:
    """Return the design of circles with fewer readings: means of neighbours in time."""
    fine = join_side_by_side(circles)
    turns = len(fine.turns)
    most = max(min(_OF_A_TURN, _TOGETHER // max(turns, 1)), _FEWEST_OF_A_TURN)
    groups: list[IntArray] = []
    for turn in fine.turns.tolist():
        own = np.flatnonzero(fine.turn == turn)
        groups += np.array_split(own, min(most, len(own)))
    order = np.concatenate(groups)
    sizes = np.array([len(each) for each in groups])
    starts = np.cumsum(sizes) - sizes
    values: dict[str, Any] = {name: getattr(fine, name)[order][starts] for name in _COLUMNS}
    for name in ("angle", "travelled", "time"):
        values[name] = np.add.reduceat(getattr(fine, name)[order], starts) / sizes
    return ThinnedDesign(
        fine.tests, **values, circles=tuple(circles), fine=fine, order=order, starts=starts, sizes=sizes
    )


def join_side_by_side(circles: Sequence[CircularTest]) -> CircleDesign:
    """Return all readings of circles side by side; angles go on over a full turn."""
    columns: dict[str, list[Any]] = {name: [] for name in _COLUMNS}
    number = 0
    for index, circle in enumerate(circles):
        count = len(circle.angle)
        turn, travelled, angle = np.zeros(count), np.zeros(count), np.zeros(count)
        for own in sorted(circle.list_turns(), key=lambda each: int(each[0])):
            unwrapped = np.unwrap(circle.angle[own])
            turn[own], travelled[own] = number, np.abs(unwrapped - unwrapped[0])
            angle[own] = unwrapped
            number += 1
        found = {
            "test": np.full(count, index),
            "turn": turn.astype(np.int64),
            "angle": angle,
            "sense": circle.sense,
            "travelled": travelled,
            "time": circle.time,
            "radius": np.full(count, circle.nominal.radius),
            "feed": np.full(count, circle.nominal.feed),
            "first": np.full(count, circle.axes[0]),
            "second": np.full(count, circle.axes[1]),
        }
        for name, values in found.items():
            columns[name].append(values)
    joined: dict[str, Any] = {name: np.concatenate(each) for name, each in columns.items()}
    tests = tuple(CircleTest(each.name, each.nominal) for each in circles)
    return CircleDesign(tests, **joined)
