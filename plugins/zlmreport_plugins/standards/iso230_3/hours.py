"""The interval of time over which a drift is taken (ISO 230-3), and the ranges in it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from zlmreport.plugin import HOUR, BoolArray, FloatArray
from zlmreport.plugin.standard import PositionStatistics, span_over_positions

#: Of stated hours, what readings need not go over.
_MAY_LACK = 1 / 50


@dataclass(frozen=True, slots=True)
class Hours:
    """From when on, and how long, s; a length that is not stated is that of the whole record."""

    start: float = 0.0
    length: float = math.inf

    @classmethod
    def of(cls, start: float, hours: float | None) -> Hours:
        """Return what a job states in hours."""
        return cls(HOUR.to_si(start), math.inf if hours is None else HOUR.to_si(hours))

    @property
    def are_stated(self) -> bool:
        """Whether the length is."""
        return math.isfinite(self.length)

    def select(self, times: FloatArray) -> BoolArray:
        """Return which times, s, lie in them; a millisecond beyond their ends is rounding."""
        slack = 1e-3
        return np.asarray((times >= self.start - slack) & (times <= self.start + self.length + slack))

    def measure_covered(self, times: FloatArray) -> float:
        """Return for how long there are readings in them, s.

        `times`: Of the readings, s, rising. Of stated hours one interval of readings may be lacking, as
        averages stand in the middles of theirs, but no more than a fiftieth.
        """
        is_whole = self.are_stated and self.are_covered(times)
        return self.length if is_whole else self.measure_extent(times)

    def measure_extent(self, times: FloatArray) -> float:
        """Return the time from the first to the last reading in them, s."""
        inside = times[self.select(times)]
        return float(inside[-1] - inside[0]) if inside.size > 1 else 0.0

    def are_covered(self, times: FloatArray) -> bool:
        """Return whether readings go over all of them; of the whole record they do."""
        if not self.are_stated:
            return True
        spare = min(find_usual_interval(times), _MAY_LACK * self.length)
        return self.measure_extent(times) + spare >= self.length * (1 - 1e-9)


def find_usual_interval(times: FloatArray) -> float:
    """Return the median time from reading to reading, s; 0 for a single one."""
    return float(np.median(np.diff(times))) if times.size > 1 else 0.0


def find_longest_gap(times: FloatArray) -> float:
    """Return the longest time from reading to reading, s; 0 for a single one."""
    return float(np.diff(times).max()) if times.size > 1 else 0.0


def compute_span_in(line: PositionStatistics, hours: Hours) -> FloatArray:
    """Return the range of one sensor's readings in the hours, m, shape (...).

    NaN where they do not go over all of them: the range in a shorter time is another quantity.
    """
    return _compute_span(line.mean_positive, (line,), hours)


def compute_tilt_over_time(
    first: PositionStatistics, second: PositionStatistics, distance: float
) -> FloatArray:
    """Return the tilt at the times of the first sensor, rad, shape (..., position).

    The second is taken linear between its own times, where they are others; NaN beyond them.
    """
    return np.asarray((first.mean_positive - _interpolate_at(second, first.positions)) / distance)


def compute_tilt_in(
    first: PositionStatistics, second: PositionStatistics, distance: float, hours: Hours
) -> FloatArray:
    """Return the range of the tilt in the hours, rad, shape (...); NaN as `compute_span_in`."""
    return _compute_span(compute_tilt_over_time(first, second, distance), (first, second), hours)


def _compute_span(values: FloatArray, lines: tuple[PositionStatistics, ...], hours: Hours) -> FloatArray:
    """Return the range of values at the times of the first of some sensors, in hours that all go over."""
    inside = hours.select(lines[0].positions)
    if not all(hours.are_covered(each.positions) for each in lines) or np.count_nonzero(inside) < 2:
        return np.full(values.shape[:-1], np.nan)
    return span_over_positions(values[..., inside])


def _interpolate_at(line: PositionStatistics, times: FloatArray) -> FloatArray:
    """Return a sensor's readings at some times, linear between its own, shape (..., position)."""
    own, values = line.positions, line.mean_positive
    if np.array_equal(own, times):
        return values
    if own.size < 2:
        return np.full((*values.shape[:-1], times.size), np.nan)
    after = np.clip(np.searchsorted(own, times), 1, own.size - 1)
    share = (times - own[after - 1]) / (own[after] - own[after - 1])
    between = values[..., after - 1] * (1 - share) + values[..., after] * share
    # At a reading of its own that reading alone counts, whatever is missing beside it.
    between = np.where(share == 0, values[..., after - 1], np.where(share == 1, values[..., after], between))
    return np.asarray(np.where((times < own[0]) | (times > own[-1]), np.nan, between))
