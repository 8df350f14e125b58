"""Where and how fast each reading of circles was taken: what effects of circles are functions of."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.measurement.circle import PLANES, NominalCircle

#: The linear axes; effects speak of them by their numbers here.
AXES = ("X", "Y", "Z")


@dataclass(frozen=True, slots=True)
class CircleTest:
    """What the turns of one circular test share."""

    name: str  #: As its file is called.
    nominal: NominalCircle

    @property
    def axes(self) -> tuple[int, int]:
        """The numbers of the plane's first and second axis."""
        return find_axes_of(self.nominal.plane)


def find_axes_of(plane: str) -> tuple[int, int]:
    """Return the numbers of a plane's first and second axis."""
    first, second = PLANES[plane]
    return AXES.index(first), AXES.index(second)


@dataclass(frozen=True, slots=True)
class CircleDesign:
    """The circles of a machine side by side; (N,) unless it says otherwise.

    Attributes
    ----------
    tests
        The tests, in the order of the machine file.
    test, turn
        Of which of them a reading is, and of which turn of all of them, from 0.
    angle
        θ from the plane's first axis towards its second, rad; it goes on over a full turn.
    sense
        s: +1 counter-clockwise, −1 clockwise.
    travelled
        Angle since the beginning of the turn, rad.
    time
        Since the beginning of the test, s: the turns in the order of the file, one after the other.
    radius, feed
        R, m; F along the path, m/s.
    first, second
        Numbers of the plane's axes.
    """

    tests: tuple[CircleTest, ...]
    test: IntArray
    turn: IntArray
    angle: FloatArray
    sense: FloatArray
    travelled: FloatArray
    time: FloatArray
    radius: FloatArray
    feed: FloatArray
    first: IntArray
    second: IntArray

    @property
    def count(self) -> int:
        """Number of readings."""
        return len(self.angle)

    @property
    def turns(self) -> IntArray:
        """The turns, from 0."""
        return np.unique(self.turn)

    @property
    def axes(self) -> tuple[int, ...]:
        """Numbers of the axes that moved."""
        return tuple(int(each) for each in np.unique(np.concatenate([self.first, self.second])))

    @property
    def planes(self) -> tuple[str, ...]:
        """The planes of the tests."""
        return tuple(plane for plane in PLANES if any(each.nominal.plane == plane for each in self.tests))

    @property
    def has_both_senses(self) -> bool:
        """Whether circles were run in both senses."""
        return bool(np.any(self.sense > 0) and np.any(self.sense < 0))

    @property
    def centripetal(self) -> FloatArray:
        """F²/R, the acceleration towards the centre, m/s²."""
        return np.asarray(self.feed**2 / self.radius)

    @property
    def fewest_of_a_turn(self) -> int:
        """Number of readings of the turn that has fewest."""
        return min(int(np.count_nonzero(self.turn == turn)) for turn in self.turns)

    def is_plane(self, plane: str) -> FloatArray:
        """Return 1 for readings in a plane, 0 for others."""
        first, second = find_axes_of(plane)
        return np.asarray((self.first == first) & (self.second == second), dtype=np.float64)

    def wave(self, axis: int) -> FloatArray:
        """Return an axis' coordinate over the radius: cos θ as first axis, sin θ as second, 0 at rest."""
        return np.asarray(
            np.where(self.first == axis, np.cos(self.angle), 0.0)
            + np.where(self.second == axis, np.sin(self.angle), 0.0)
        )

    def other_wave(self, axis: int) -> FloatArray:
        """Return the coordinate of the plane's other axis over the radius; 0 where the axis is at rest."""
        return np.asarray(
            np.where(self.first == axis, np.sin(self.angle), 0.0)
            + np.where(self.second == axis, np.cos(self.angle), 0.0)
        )

    def travel(self, axis: int) -> FloatArray:
        """Return d, the direction in which an axis moves: +1, −1; 0 at rest and where it turns."""
        moved = np.where(self.first == axis, -np.sin(self.angle), 0.0) + np.where(
            self.second == axis, np.cos(self.angle), 0.0
        )
        return np.asarray(self.sense * np.sign(np.round(moved, 12)))

    def since_reversal(self, axis: int) -> FloatArray:
        """Return φ, the angle travelled since an axis turned, rad, in [0, π); NaN where it is at rest.

        A turn comes out of its feed-in: where it begins behind a reversal, the axis has turned before.
        """
        turned_at = np.where(self.second == axis, np.pi / 2, 0.0)
        since = (self.sense * (self.angle - turned_at) + 1e-9) % np.pi - 1e-9
        return np.where((self.first == axis) | (self.second == axis), since, np.nan)
