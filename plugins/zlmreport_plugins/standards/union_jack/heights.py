"""From the slopes along eight lines to the heights of a plate (J. C. Moody, 1955).

The heights along a line are the slopes, added up over the distance of the feet. Both diagonals are laid so
that their ends are alike and their middles are 0: that is the base plane. The edges are laid between the
corners, the centre lines between the middles of the edges; that their own middles are not 0 is what the
measurement does not close by.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from zlmreport.plugin import FloatArray
from zlmreport.plugin.standard import PositionStatistics
from zlmreport_plugins.union_jack_lines import (
    ACROSS,
    ALONG,
    CENTRE_LINES,
    DIAGONALS,
    EDGES,
    LINES,
    PLACES,
    list_lacking,
    put_in_one_order,
)

_HALF = 0.5
_STATIONS = 2


@dataclass(frozen=True, slots=True)
class Profile:
    """The surface along one line, from the first point of its name to the second."""

    shares: FloatArray  #: (n + 1,): Where the feet stood, of its length: from 0 to 1.
    heights: FloatArray  #: (..., n + 1), m.
    length: float  #: m.

    def interpolate_half(self) -> FloatArray:
        """Return the height at half its length, m, (...): between two stations where none is there."""
        after = min(max(int(np.searchsorted(self.shares, _HALF - 1e-9)), 1), len(self.shares) - 1)
        low, high = self.shares[after - 1], self.shares[after]
        part = (_HALF - low) / (high - low)
        return np.asarray((1 - part) * self.heights[..., after - 1] + part * self.heights[..., after])

    def lay_between(self, first: FloatArray, last: FloatArray) -> Profile:
        """Return the profile laid so that its ends have two heights, m, (...)."""
        begins, ends = self.heights[..., :1], self.heights[..., -1:]
        rise = self.shares * ((last[..., np.newaxis] - first[..., np.newaxis]) - (ends - begins))
        return Profile(self.shares, self.heights - begins + first[..., np.newaxis] + rise, self.length)

    def lift(self, by: FloatArray) -> Profile:
        """Return the profile, every height larger by as much, m, (...)."""
        return Profile(self.shares, self.heights + by[..., np.newaxis], self.length)


@dataclass(frozen=True, slots=True)
class Plate:
    """The heights of a plate above Moody's base plane."""

    profiles: Mapping[str, Profile]  #: By the eight names of lines.
    closures: Mapping[str, FloatArray]  #: Of each centre line, m, (...): its height where it should be 0.

    @property
    def sides(self) -> tuple[float, float]:
        """From west to east and from north to south, m: means of the lines that run so."""
        along, across = (
            float(np.mean([self.profiles[name].length for name in (*edges, centre)]))
            for edges, centre in zip((ALONG, ACROSS), CENTRE_LINES, strict=True)
        )
        return along, across

    def lay_stations(self, name: str) -> FloatArray:
        """Return where the stations of a line lie, m, (n + 1, 2): towards the east, towards the north."""
        first, last = (np.array(PLACES[point]) for point in name.split("-"))
        shares = self.profiles[name].shares[:, np.newaxis]
        return np.asarray((first + shares * (last - first)) * self.sides)

    @property
    def points(self) -> FloatArray:
        """The places of all stations, m, (N, 2)."""
        return np.concatenate([self.lay_stations(name) for name in LINES])

    @property
    def heights(self) -> FloatArray:
        """The heights of all stations, m, (..., N), in the order of `points`."""
        return np.concatenate([self.profiles[name].heights for name in LINES], axis=-1)


def find_plate_of(lines: Mapping[str, PositionStatistics]) -> Plate | None:
    """Return the heights of a plate, NaN where a reading is missing; None where a line is, or has only one.

    A line of one reading has its ends and nothing between: no height follows from it.
    """
    if list_lacking(lines) or any(
        line.positions.size < _STATIONS or line.positions[-1] <= 0 for line in lines.values()
    ):
        return None
    measured = {
        name: _sum_profile(statistics, backwards=called != name)
        for name, (called, statistics) in put_in_one_order(lines).items()
    }
    laid: dict[str, Profile] = {}
    corners: dict[str, FloatArray] = {}
    for name in DIAGONALS:
        nothing = np.zeros(measured[name].heights.shape[:-1])
        level = measured[name].lay_between(nothing, nothing)
        laid[name] = level.lift(-level.interpolate_half())
        for corner, at in zip(name.split("-"), (0, -1), strict=True):
            corners[corner] = laid[name].heights[..., at]
    for name in EDGES:
        first, last = name.split("-")
        laid[name] = measured[name].lay_between(corners[first], corners[last])
    closures = {}
    for name, edges in zip(CENTRE_LINES, (ACROSS, ALONG), strict=True):
        ends = [laid[edge].interpolate_half() for edge in edges]
        line = measured[name].lay_between(*ends)
        closures[name] = line.interpolate_half()
        laid[name] = line.lift(-closures[name])
    return Plate(laid, closures)


def _sum_profile(statistics: PositionStatistics, *, backwards: bool) -> Profile:
    """Return the heights along a line as its slopes add up; backwards: of one measured the other way."""
    slopes = statistics.mean_of_all_runs
    feet = statistics.positions
    risen = np.cumsum(slopes * np.diff(feet, prepend=0.0), axis=-1)
    heights = np.concatenate([np.zeros((*risen.shape[:-1], 1)), risen], axis=-1)
    shares = np.concatenate([[0.0], feet]) / feet[-1]
    if backwards:
        heights, shares = heights[..., ::-1], 1.0 - shares[::-1]
    return Profile(shares, heights, float(feet[-1]))
