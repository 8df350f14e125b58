"""Random curves without a name: over what each changes, its terms at the readings, what it costs.

Of each only the kind is known: smooth along the axis or in time, in both at once, a wave that is not steady,
from run to run. A curve is a random combination of its terms.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects import wording
from zlmreport.model.effects.design import Design
from zlmreport.model.fitting.noise import split_by_session
from zlmreport.model.fitting.pauses import compute_working_time

#: 2·ln of the odds against a nameless part, its amplitude chosen among some: rarer than a known cause.
PRICE = 9.0
#: Correlation lengths of smooth curves, as shares of the travel or the duration.
_LENGTHS = (0.3, 0.1)
_TERMS = 12
#: The same along the axis and in time of a curve that changes in both, and its terms.
_ALONG, _IN_COURSE, _TERMS_IN_BOTH = 0.3, 0.3, 16
#: Crests of waves within the travel that are tried, targets that at least must tell each, and over what share
#: of the travel size and period of one change: it then takes in every wave between two of them.
_FEWEST_CRESTS, _MOST_CRESTS, _TARGETS_PER_CREST = 2, 10, 2
_STEADY, _TERMS_OF_SIZE, _DIGITS_OF_PERIOD = 0.5, 4, 2
_LEAST_VARIANCE = 1e-7
_GRID = 120


class Along(Enum):
    """Over what a nameless part changes."""

    PLACE = "place"
    TIME = "time"
    RUN = "run"


class Course(Enum):
    """With what it changes, and in which carrier: what decides where one looks for it."""

    PLACE = "smooth along the axis"
    IRREGULAR = "from position to position"
    IRREGULAR_REVERSAL = "from position to position, in the reversal"
    REVERSAL = "in the reversal, along the axis"
    TIME = "in time, at all positions alike"
    SLOPE = "in time, in proportion to the position"
    REVERSAL_IN_TIME = "in the reversal, in time"
    PLACE_IN_TIME = "along the axis, at each place otherwise in time"
    RUNS = "from run to run"
    TARGET = "at some targets"

    @property
    def along(self) -> Along:
        """Over what it changes."""
        if self is Course.RUNS:
            return Along.RUN
        return Along.TIME if self in _IN_TIME else Along.PLACE

    @property
    def is_irregular(self) -> bool:
        """Whether it is another at each position."""
        return self in {Course.IRREGULAR, Course.IRREGULAR_REVERSAL}


_IN_TIME = frozenset({Course.TIME, Course.SLOPE, Course.REVERSAL_IN_TIME})


@dataclass(frozen=True, slots=True)
class RandomCurve:
    """A kind of random curve on a design."""

    shape: Words  #: In words.
    course: Course
    features: FloatArray  #: (N, k): Its terms at the readings.
    price: float = PRICE  #: 2·ln of the odds against it.


def list_random_curves(design: Design) -> Iterator[RandomCurve]:
    """Yield every kind of curve that a plan may show: at one target none that lies along the axis."""
    for each in _list_curves(design):
        if design.length > 0 or each.shape not in _WITH_POSITION:
            yield each


def _list_curves(design: Design) -> Iterator[RandomCurve]:
    along, moment = _normalise(design.position), _normalise(compute_working_time(design))
    lever, direction = _find_lever(design)[:, np.newaxis], design.direction[:, np.newaxis]
    runs = np.asarray(design.cycle[:, np.newaxis] == np.unique(design.cycle), dtype=np.float64)
    if runs.shape[1] > 1:
        yield RandomCurve(_SLOPE_RUNS, Course.RUNS, lever * runs)
        if design.is_bidirectional:
            yield RandomCurve(_DIRECTION_RUNS, Course.RUNS, direction * runs)
    for length in _LENGTHS:
        place = _smooth(along, length)
        yield RandomCurve(_SMOOTH_PLACE, Course.PLACE, place)
        if design.is_bidirectional:
            yield RandomCurve(_DIRECTION_PLACE, Course.REVERSAL, direction * place)
        if design.duration > 0:
            time = split_by_session(design, _smooth(moment, length))
            yield RandomCurve(_SMOOTH_TIME, Course.TIME, time)
            yield RandomCurve(_SLOPE_TIME, Course.SLOPE, lever * time)
            if design.is_bidirectional:
                yield RandomCurve(_DIRECTION_TIME, Course.REVERSAL_IN_TIME, direction * time)
    yield from _list_unsteady_waves(design, along)
    if design.duration > 0:
        both = _smooth_in_both(along, moment)
        # It does what a curve along the axis and one in time do together, and is as rare as two.
        yield RandomCurve(_SMOOTH_IN_BOTH, Course.PLACE_IN_TIME, both, 2.0 * PRICE)


def _list_unsteady_waves(design: Design, along: FloatArray) -> Iterator[RandomCurve]:
    """Yield waves of every number of crests that the targets tell; each pays for the choice among them.

    Where there are no more targets than terms, none of them is a wave: it is any shape.
    """
    targets, unit = len(design.target_positions), design.axis.position_unit
    most = min(_MOST_CRESTS, (targets - 1) // _TARGETS_PER_CREST) if targets > 2 * _TERMS_OF_SIZE else 0
    numbers = range(_FEWEST_CRESTS, most + 1)
    for crests in numbers:
        period = unit.to_si(float(f"{unit.from_si(design.length / crests):.{_DIGITS_OF_PERIOD}g}"))
        shape = _UNSTEADY_WAVE.given(period=wording.length(design.axis, period))
        price = PRICE + 2.0 * float(np.log(len(numbers)))
        yield RandomCurve(shape, Course.PLACE, _make_unsteady_wave(along, crests), price)


def _find_lever(design: Design) -> FloatArray:
    """Return the position as a share of the travel, from the zero of the axis or the end that is next to it.

    What changes in proportion to the position is nothing there, as with every effect that has a name: a slope
    about the middle would need a displacement beside it, and would be dearer than a name that is wrong.
    """
    low, high = design.span
    return np.asarray((design.position - min(max(0.0, low), high)) / (design.length or 1.0), dtype=np.float64)


def _normalise(values: FloatArray) -> FloatArray:
    extent = float(np.ptp(values))
    return np.asarray((values - values.min()) / (extent or 1.0), dtype=np.float64)


def _smooth(where: FloatArray, length: float) -> FloatArray:
    """Return the leading terms of a smooth random curve on 0 to 1 at the readings, about their mean.

    What a curve has everywhere has a name: a gap that changes along the axis is lost motion and a curve about
    it, not a curve that hides the lost motion.
    """
    return _centre(_make_curves(where, length, _TERMS))


def _make_unsteady_wave(where: FloatArray, crests: int) -> FloatArray:
    """Return a wave on 0 to 1 at the readings whose size and phase are smooth random curves.

    A wave that grows, or whose period changes, has no name; without this one, two or three names that have a
    steady period would stand for it.
    """
    size = _make_curves(where, _STEADY, _TERMS_OF_SIZE)
    phase = 2.0 * np.pi * crests * where[:, np.newaxis]
    return _centre(np.column_stack([size * np.sin(phase), size * np.cos(phase)]))


def _smooth_in_both(where: FloatArray, moment: FloatArray) -> FloatArray:
    """Return the leading terms of a random curve at the readings, smooth along the axis and in time.

    A bow that comes with the warmth is no curve in time alone, nor one along the axis: without this one, a
    growth, a drift and a curve along the axis would share it.
    """
    place, place_sizes = _find_leading_terms(where, _ALONG, _TERMS)
    time, time_sizes = _find_leading_terms(moment, _IN_COURSE, _TERMS)
    sizes = place_sizes[:, np.newaxis] * time_sizes
    largest = np.argsort(-sizes, axis=None, kind="stable")[:_TERMS_IN_BOTH]
    at_place, at_time = np.unravel_index(largest, sizes.shape)
    return _centre(place[:, at_place] * time[:, at_time] * sizes[at_place, at_time])


def _make_curves(where: FloatArray, length: float, count: int) -> FloatArray:
    """Return the leading terms of a smooth random curve on 0 to 1 at the readings, each of its size."""
    terms, sizes = _find_leading_terms(where, length, count)
    return terms * sizes


def _find_leading_terms(where: FloatArray, length: float, count: int) -> tuple[FloatArray, FloatArray]:
    """Return the leading eigenfunctions of a smooth random curve at the readings, and their sizes."""
    grid = np.linspace(0.0, 1.0, _GRID)
    values, functions = np.linalg.eigh(np.exp(-0.5 * ((grid[:, np.newaxis] - grid) / length) ** 2))
    kept = np.flatnonzero(values > _LEAST_VARIANCE * values[-1])[-count:]
    terms = np.column_stack([np.interp(where, grid, each) for each in functions[:, kept].T])
    return terms, np.sqrt(values[kept])


def _centre(curves: FloatArray) -> FloatArray:
    return np.asarray(curves - curves.mean(axis=0), dtype=np.float64)


_SMOOTH_PLACE = Words("smooth along the axis")
_DIRECTION_PLACE = Words("a reversal value that changes smoothly along the axis")
_SMOOTH_TIME = Words("smooth in time, alike at all positions")
_SLOPE_TIME = Words("a slope along the axis that changes smoothly in time")
_DIRECTION_TIME = Words("a reversal value that changes smoothly in time")
_UNSTEADY_WAVE = Words("a wave along the axis with a period of some {period}, not steady")
_SMOOTH_IN_BOTH = Words("a curve along the axis that changes in time")
_SLOPE_RUNS = Words("a slope along the axis that differs from run to run")
_DIRECTION_RUNS = Words("a reversal value that differs from run to run")
#: Those that are no curves where there is but one position.
_WITH_POSITION = (_SMOOTH_PLACE, _DIRECTION_PLACE, _SLOPE_TIME, _SMOOTH_IN_BOTH, _SLOPE_RUNS)
