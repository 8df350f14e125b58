"""Residuals of a test of a machine: RMS, scatter, and arcs where it leaves the band of the prediction."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from zlmreport.machines.course import CircularTest, StraightTest
from zlmreport.measurement.arrays import BoolArray, FloatArray, IntArray, estimate_robust_deviation
from zlmreport.model.effects.circle_design import AXES

#: Correlation length of what is irregular on a circle, rad: what is shorter is no stretch.
_LENGTH = float(np.radians(10.0))
#: Points of an arc at which its coordinates are looked at.
_POINTS = 50


def centre(circle: CircularTest, values: FloatArray) -> FloatArray:
    """Return radial deviations without the centre of each turn, and without the mean radius of the test.

    The mean radius stays where the bar is calibrated.
    """
    columns = []
    for turn in circle.list_turns():
        for wave in (np.cos, np.sin):
            column = np.zeros(len(values))
            column[turn] = wave(circle.angle[turn])
            columns.append(column)
    if not circle.nominal.is_calibrated:
        columns.append(np.ones(len(values)))
    base = np.column_stack(columns)
    return np.asarray(values - base @ np.linalg.lstsq(base, values, rcond=None)[0], dtype=np.float64)


def compute_root_mean_square(values: FloatArray) -> float:
    """Return the root of the mean square."""
    return float(np.sqrt(np.mean(values**2))) if len(values) else 0.0


def estimate_scatter_within(circle: CircularTest, residual: FloatArray) -> float:
    """Return by how much means over half a correlation length scatter, m: by how they bend at random.

    The second difference of three neighbours has six times their variance; its median does not see a step.
    """
    bends = []
    for turn in circle.list_turns():
        _, mean, count = _split_into_arcs(circle.angle[turn], residual[turn])
        there = mean[count > 0]
        bends.append(there[:-2] - 2.0 * there[1:-1] + there[2:])
    together = np.concatenate(bends)
    return estimate_robust_deviation(together) / float(np.sqrt(6.0)) if len(together) else 0.0


@dataclass(frozen=True, slots=True)
class Stretch:
    """Where a residual leaves its band."""

    sense: float  #: Of a circle +1 counter-clockwise, −1 clockwise; of a line the direction of travel.
    begin: float  #: Of a circle rad, of a line m.
    end: float
    coordinates: Mapping[str, tuple[float, float]]  #: From and to on each axis that moves there, m.
    largest: float  #: The residual there, m.


def find_stretches(circle: CircularTest, residual: FloatArray, standard: FloatArray) -> tuple[Stretch, ...]:
    """Return where a residual is beyond twice its standard deviation for longer than a correlation length.

    `residual`, `standard`, (N,): m. The residual is averaged over a correlation length first; `standard` is
    that of such an average.
    """
    found: list[Stretch] = []
    for way in (1.0, -1.0):
        own = np.flatnonzero(circle.sense == way)
        if not len(own):
            continue
        edges, mean, count = _split_into_arcs(circle.angle[own], residual[own])
        u = np.sqrt(_split_into_arcs(circle.angle[own], standard[own] ** 2)[1])
        beyond = (count > 0) & (np.abs(mean) > 2.0 * u)
        found += [_make_arc(circle, way, (edges[first], edges[last + 1]), mean[first : last + 1])
                  for first, last in _find_runs(beyond, mean)]  # fmt: skip
    return tuple(sorted(found, key=lambda each: -abs(each.largest)))


def _split_into_arcs(angle: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray, IntArray]:
    """Return the edges of arcs of half a correlation length, and mean and number of values in each."""
    bins = round(2.0 * np.pi / _LENGTH) * 2
    where = np.floor((angle % (2.0 * np.pi)) / (2.0 * np.pi) * bins).astype(int) % bins
    count = np.bincount(where, minlength=bins)
    mean = np.bincount(where, values, bins) / np.maximum(count, 1)
    return np.linspace(0.0, 2.0 * np.pi, bins + 1), mean, count


def _find_runs(beyond: BoolArray, mean: FloatArray) -> Iterator[tuple[int, int]]:
    """Yield first and last place of stretches of two places or more, of one sign."""
    start = None
    for index in range(len(beyond) + 1):
        goes_on = index < len(beyond) and beyond[index] and (start is None or mean[index] * mean[start] > 0)
        if goes_on and start is None:
            start = index
        elif not goes_on and start is not None:
            if index - start >= 2:
                yield start, index - 1
            start = index if index < len(beyond) and beyond[index] else None


def _make_arc(circle: CircularTest, way: float, ends: tuple[float, float], mean: FloatArray) -> Stretch:
    angles = np.linspace(*ends, _POINTS)
    coordinates = {}
    for axis, wave in zip(circle.axes, (np.cos(angles), np.sin(angles)), strict=True):
        places = circle.nominal.centre[axis] + circle.nominal.radius * wave
        coordinates[AXES[axis]] = (float(places.min()), float(places.max()))
    return Stretch(way, float(ends[0]), float(ends[1]), coordinates, _find_largest(mean))


def _find_largest(values: FloatArray) -> float:
    return float(values[np.argmax(np.abs(values))])


def find_stretches_of_line(
    line: StraightTest, residual: FloatArray, standard: FloatArray
) -> tuple[Stretch, ...]:
    """Return where a residual along a line is beyond twice its standard deviation at two places or more."""
    found: list[Stretch] = []
    direction = line.direction
    for way in np.unique(direction).tolist():
        own = np.flatnonzero(direction == way)
        own = own[np.argsort(line.at[own])]
        left, place = residual[own], line.course.position[own]
        for first, last in _find_runs(np.abs(left) > 2.0 * standard[own], left):
            part = place[first : last + 1]
            coordinates = {
                axis: (float(part[:, index].min()), float(part[:, index].max()))
                for index, axis in enumerate(AXES)
                if np.ptp(place[:, index]) > 0
            }
            ends = line.at[own][first], line.at[own][last]
            found.append(
                Stretch(
                    way, float(ends[0]), float(ends[1]), coordinates, _find_largest(left[first : last + 1])
                )
            )
    return tuple(sorted(found, key=lambda each: -abs(each.largest)))
