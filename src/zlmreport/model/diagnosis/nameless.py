"""Nameless random curves along the axis, in time, from run to run: their amplitudes and their price.

Beside every set of named effects something may act that nobody knows. It is no polynomial that swallows what
has a name, but a random curve: its many coefficients are not fitted but averaged over, and only its amplitude
is chosen, with a few correlation lengths (C. E. Rasmussen and C. K. I. Williams, Gaussian Processes for
Machine Learning, 2006, chapter 2). Small amplitudes of irregular shares are noise, which costs little; what
is larger has to earn its place like an effect.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import Enum

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.model.diagnosis.columns import Columns
from zlmreport.model.effects.design import Design
from zlmreport.model.fitting.noise import BY_TARGET, NoisePart, NoiseSource, split_by_session
from zlmreport.model.fitting.pauses import compute_working_time
from zlmreport.model.fitting.priors import PriorExpectation

#: 2·ln of the odds against a nameless part, its amplitude chosen among some: rarer than a known cause.
PRICE = 9.0
#: Variances that are tried of a random curve, in units of σ²: from hidden in the scatter to far above it.
_VARIANCES = (0.02, 0.1, 0.5, 2.5, 12.0, 60.0, 300.0, 1500.0, 1e4, 1e5, 1e6)
#: The same of irregular shares, beyond those that are noise; what drifts without being smooth stays noise.
_IRREGULAR = (0.25, 1.0, 5.0, 25.0, 125.0, 1e3, 1e4, 1e5)
#: Variances beyond which a curve is large, and the odds against that: those of an effect that is as large.
_LARGE = ((30.0, 18.0), (3000.0, 30.0))
#: By how much each level of a shared noise is rarer than the one below it, 2·ln of the odds.
_RARER = 1.0
#: Correlation lengths of smooth curves, as shares of the travel or the duration.
_LENGTHS = (0.3, 0.1)
_TERMS = 12
#: The same along the axis and in time of a curve that changes in both, and its terms.
_ALONG, _IN_COURSE, _TERMS_IN_BOTH = 0.3, 0.3, 16
#: Crests of waves within the travel that are tried, targets that at least must tell each, and over what share
#: of the travel size and period of one change: it then takes in every wave between two of them.
_FEWEST_CRESTS, _MOST_CRESTS, _TARGETS_PER_CREST = 2, 10, 2
_STEADY, _TERMS_OF_SIZE = 0.5, 4
#: What a curve that changes in both costs beyond one that changes in one: it does nearly all that they do.
_IN_BOTH = 4.0
_LEAST_VARIANCE = 1e-7
_GRID = 120
_LEAST_VISIBLE = 1e-3


class Along(Enum):
    """Over what a nameless part changes."""

    PLACE = "place"
    TIME = "time"
    RUN = "run"


class Course(Enum):
    """With what it changes, and in which carrier: what decides where one looks for it."""

    PLACE = "smooth along the axis"
    IRREGULAR = "from position to position"
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


_IN_TIME = frozenset({Course.TIME, Course.SLOPE, Course.REVERSAL_IN_TIME})


@dataclass(frozen=True, slots=True)
class CovariancePart:
    """A part of the covariance, with the amplitudes that are tried of it."""

    shape: Words  #: In words.
    course: Course
    #: (k,) integer: The places of its columns, whose random combination it is, of mean variance one; empty
    #: for a part that is irregular from position to position, which stands apart.
    columns: IntArray
    #: Which of the irregular factors it is; None of other parts.
    irregular: int | None
    levels: tuple[float, ...]  #: Its variances over σ² that are tried, rising from zero.
    costs: tuple[float, ...]  #: −2 ln of the prior odds of each level.
    noise_levels: int  #: How many of the levels are noise.
    source: NoiseSource | None = None  #: The source of noise that it is at these.

    @property
    def width(self) -> int:
        """The number of its columns beside the irregular ones."""
        return len(self.columns)


def list_parts_of(
    design: Design,
    columns: Columns,
    noise: tuple[NoisePart, ...],
    expected: PriorExpectation,
    *,
    with_nameless: bool = True,
) -> tuple[CovariancePart, ...]:
    """Return the parts of the covariance that the plan can see beside the model; their columns are added.

    `noise`: The sources of noise; those by position are the irregular factors of the table, in their order.
    `expected`: What earlier tests say of their amplitudes.
    `with_nameless`: Whether anything else than noise is thought of.
    """
    found = []
    nowhere = columns.add(np.empty((len(design.position), 0)))
    irregular = 0
    for each in noise:
        is_irregular = each.source in BY_TARGET
        contrasts = columns.space.of(each.factor)
        places = nowhere if is_irregular else columns.add(contrasts)
        may_be_more = with_nameless and each.source is not NoiseSource.TIME
        further = tuple(level for level in _IRREGULAR if may_be_more and level > each.ratios[-1])
        free = _compute_noise_costs(each, expected)
        found.append(
            CovariancePart(
                _WORDS[each.source],
                _COURSES[each.source],
                places,
                irregular if is_irregular else None,
                (*each.ratios, *further),
                (*free, *(PRICE + free[-1] for _ in further)),
                len(each.ratios),
                each.source,
            )
        )
        irregular += is_irregular
    listed = list(_list_features(design)) if with_nameless else []
    waves = sum(shape is _UNSTEADY_WAVE for shape, _, _ in listed)
    for shape, course, features in listed:
        contrasts = columns.space.of(features)
        size = float(np.sqrt(np.mean(np.sum(contrasts**2, axis=1))))
        if size > _LEAST_VISIBLE * np.sqrt(np.mean(np.sum(features**2, axis=1))):
            price = _compute_price(shape, waves)
            costs = (0.0, *(price + _compute_cost_of_size(each) for each in _VARIANCES))
            places = columns.add(contrasts / size)
            found.append(CovariancePart(shape, course, places, None, (0.0, *_VARIANCES), costs, 1))
    return tuple(found)


def _compute_price(shape: Words, waves: int) -> float:
    """Return 2·ln of the odds against a curve.

    `waves`: Of unsteady waves, how many there are to choose from.
    """
    if shape is _UNSTEADY_WAVE:
        return PRICE + 2.0 * float(np.log(waves))
    return PRICE + _IN_BOTH if shape is _SMOOTH_IN_BOTH else PRICE


def _compute_cost_of_size(variance: float) -> float:
    """Return what it costs a curve that it is large, 2·ln of the odds."""
    return 2.0 * float(np.log(max((odds for least, odds in _LARGE if variance > least), default=1.0)))


def _compute_noise_costs(noise: NoisePart, expected: PriorExpectation) -> tuple[float, ...]:
    """Return what each ratio of a source of noise costs.

    No axis is the same at two positions, and that is free. That readings which are taken together share
    something besides is the rarer the larger it is: else it would follow whatever a curve without a name
    leaves of a cause.
    """
    costs = expected.compute_costs(noise.source, noise.ratios)
    if noise.source is NoiseSource.POSITION or noise.source in expected.ratios:
        return costs
    return tuple(cost + _RARER * level for level, cost in enumerate(costs))


def make_irregular_factors(noise: tuple[NoisePart, ...]) -> list[FloatArray]:
    """Return the factors of what is irregular from position to position."""
    return [each.factor for each in noise if each.source in BY_TARGET]


def _list_features(design: Design) -> Iterator[tuple[Words, Course, FloatArray]]:
    along, moment = _normalise(design.position), _normalise(compute_working_time(design))
    lever, direction = _find_lever(design)[:, np.newaxis], design.direction[:, np.newaxis]
    runs = np.asarray(design.cycle[:, np.newaxis] == np.unique(design.cycle), dtype=np.float64)
    if runs.shape[1] > 1:
        yield _SLOPE_RUNS, Course.RUNS, lever * runs
        if design.is_bidirectional:
            yield _DIRECTION_RUNS, Course.RUNS, direction * runs
    for length in _LENGTHS:
        place = _smooth(along, length)
        yield _SMOOTH_PLACE, Course.PLACE, place
        if design.is_bidirectional:
            yield _DIRECTION_PLACE, Course.REVERSAL, direction * place
        if design.duration > 0:
            time = split_by_session(design, _smooth(moment, length))
            yield _SMOOTH_TIME, Course.TIME, time
            yield _SLOPE_TIME, Course.SLOPE, lever * time
            if design.is_bidirectional:
                yield _DIRECTION_TIME, Course.REVERSAL_IN_TIME, direction * time
    most = min(_MOST_CRESTS, (len(design.target_positions) - 1) // _TARGETS_PER_CREST)
    for crests in range(_FEWEST_CRESTS, most + 1):
        yield _UNSTEADY_WAVE, Course.PLACE, _make_unsteady_wave(along, crests)
    if design.duration > 0:
        yield _SMOOTH_IN_BOTH, Course.PLACE_IN_TIME, _smooth_in_both(along, moment)


def _find_lever(design: Design) -> FloatArray:
    """Return the position as a share of the travel, from the zero of the axis or the end that is next to it.

    What changes in proportion to the position is nothing there, as with every effect that has a name: a slope
    about the middle would need a displacement beside it, and would be dearer than a name that is wrong.
    """
    low, high = design.span
    return np.asarray((design.position - min(max(0.0, low), high)) / design.length, dtype=np.float64)


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


_COURSES: Mapping[NoiseSource, Course] = {
    NoiseSource.POSITION: Course.IRREGULAR,
    NoiseSource.DIRECTION: Course.IRREGULAR,
    NoiseSource.RUN: Course.RUNS,
    NoiseSource.TIME: Course.TIME,
}
_SMOOTH_PLACE = Words("smooth along the axis")
_DIRECTION_PLACE = Words("a reversal value that changes smoothly along the axis")
_SMOOTH_TIME = Words("smooth in time, alike at all positions")
_SLOPE_TIME = Words("a slope along the axis that changes smoothly in time")
_DIRECTION_TIME = Words("a reversal value that changes smoothly in time")
_UNSTEADY_WAVE = Words("a wave along the axis that is not steady")
_SMOOTH_IN_BOTH = Words("a curve along the axis that changes in time")
_SLOPE_RUNS = Words("a slope along the axis that differs from run to run")
_DIRECTION_RUNS = Words("a reversal value that differs from run to run")
_WORDS: Mapping[NoiseSource, Words] = {
    NoiseSource.POSITION: Words("irregular from position to position, alike in all runs"),
    NoiseSource.DIRECTION: Words("irregular from position to position, opposite up and down"),
    NoiseSource.RUN: Words("every run displaced as a whole"),
    NoiseSource.TIME: Words("slow irregular drift"),
}
