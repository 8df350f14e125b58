"""Positioning methods: the path on which each leads the axis over its targets, and the readings on it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, read_only_floats, read_only_integers
from zlmreport.measurement.axis import Axis
from zlmreport.model.effects.design import Design


class Method(StrEnum):
    """A positioning method, as jobs name it."""

    LINEAR = "linear"
    UNIDIRECTIONAL = "unidirectional"
    PENDULUM = "pendulum"
    QUASI_PILGRIM = "quasi-pilgrim"


#: Methods that have taken all readings of a run before the next begins.
RUN_BY_RUN = frozenset({Method.LINEAR, Method.UNIDIRECTIONAL})


@dataclass(frozen=True, slots=True)
class Stop:
    """A point at which the axis stops: at a target for a reading, or beyond one to turn round."""

    position: float  #: m or rad.
    target: int | None = None  #: Index of the target position that is read there; None where nothing is read.
    run: int = 0  #: Number of the run of that reading, from 1.


Path: TypeAlias = Iterator[Stop]


def plan_path(method: Method, targets: Sequence[float], runs: int, overrun: float) -> tuple[Stop, ...]:
    """Return the stops of a test, in their order.

    `targets`: Target positions, rising, m or rad.
    `runs`: How often each is read in each direction.
    `overrun`: How far beyond a target the axis turns round, so that the next approach has its direction: the
        approach length at the start, the loop at the end, m or rad.

    Raises `ValueError` if the targets do not rise, or the overrun is lost in the rounding of one: then a
    reading would not be approached from its stated side.
    """
    if any(later <= earlier for earlier, later in pairwise(targets)):
        raise ValueError("target positions must rise")
    if any(not target - overrun < target < target + overrun for target in targets):
        raise ValueError(f"an overrun of {overrun:g} leaves no approach to the targets")
    return tuple(_PATHS[method](targets, runs, overrun))


def _lead_linear(targets: Sequence[float], runs: int, overrun: float) -> Path:
    """Lead over all targets upwards, then over all of them downwards; and so on for each run."""
    yield Stop(targets[0] - overrun)
    for run in range(1, runs + 1):
        yield from (Stop(position, index, run) for index, position in enumerate(targets))
        yield Stop(targets[-1] + overrun)
        yield from (Stop(targets[index], index, run) for index in reversed(range(len(targets))))
        yield Stop(targets[0] - overrun)


def _lead_unidirectional(targets: Sequence[float], runs: int, overrun: float) -> Path:
    """Lead over all targets upwards, and back without a reading; and so on for each run."""
    for run in range(1, runs + 1):
        yield Stop(targets[0] - overrun)
        yield from (Stop(position, index, run) for index, position in enumerate(targets))


def _lead_pendulum(targets: Sequence[float], runs: int, overrun: float) -> Path:
    """Approach each target from below and from above in turn, all runs of it before the next target."""
    for index, position in enumerate(targets):
        for run in range(1, runs + 1):
            yield Stop(position - overrun)
            yield Stop(position, index, run)
            yield Stop(position + overrun)
            yield Stop(position, index, run)


def _lead_quasi_pilgrim(targets: Sequence[float], runs: int, overrun: float) -> Path:
    """Go to and fro between each pair of neighbours: the next target upwards, this one downwards.

    The first target has all its upward readings before that, the last one its downward readings after it.
    """
    for run in range(1, runs + 1):
        yield Stop(targets[0] - overrun)
        yield Stop(targets[0], 0, run)
    for index in range(len(targets) - 1):
        for run in range(1, runs + 1):
            yield Stop(targets[index + 1], index + 1, run)
            yield Stop(targets[index], index, run)
    for run in range(1, runs + 1):
        yield Stop(targets[-1] + overrun)
        yield Stop(targets[-1], len(targets) - 1, run)


_PATHS: Mapping[Method, Callable[[Sequence[float], int, float], Path]] = {
    Method.LINEAR: _lead_linear,
    Method.UNIDIRECTIONAL: _lead_unidirectional,
    Method.PENDULUM: _lead_pendulum,
    Method.QUASI_PILGRIM: _lead_quasi_pilgrim,
}


@dataclass(frozen=True, slots=True)
class Visit:
    """A reading that is to be taken."""

    target: int  #: Index of the target position.
    approach: Approach  #: The direction in which the axis comes there.
    run: int  #: Number of the run, from 1.
    since_reversal: float  #: Distance from the place where the axis last changed its direction, m or rad.
    #: The whole way since the visit before, loops included, m or rad; of the first, since the start.
    travelled: float


def list_visits(path: Iterable[Stop]) -> tuple[Visit, ...]:
    """Return the readings on a path; direction and distances are those of the motion that leads to them.

    Raises `ValueError` if a reading stands at the start of the path, where no motion leads to it.
    """
    found = []
    position = turning_point = direction = None
    travelled = 0.0
    for stop in path:
        if position is None:
            position = turning_point = stop.position
        step = stop.position - position
        if step:
            if direction is not None and (step > 0) != (direction is Approach.POSITIVE):
                turning_point = position
            direction = Approach.POSITIVE if step > 0 else Approach.NEGATIVE
        travelled += abs(step)
        position = stop.position
        if stop.target is None:
            continue
        if direction is None or turning_point is None:
            raise ValueError("a reading at the start of the path has no direction of approach")
        found.append(Visit(stop.target, direction, stop.run, abs(position - turning_point), travelled))
        travelled = 0.0
    return tuple(found)


def find_half_way(listed: Sequence[Visit]) -> int:
    """Return the reading with which the second half of the runs begins, where these follow one another."""
    middle = max(visit.run for visit in listed) // 2 + 1
    return next(index for index, visit in enumerate(listed) if visit.run >= middle)


def compute_times(listed: Sequence[Visit], feed: float, dwell: float) -> FloatArray:
    """Return when each reading is taken, s from the first, shape (N,).

    `feed`: m/s or rad/s; the way to a target is travelled at this speed.
    `dwell`: Time at rest at a target until the reading is taken, s.
    """
    elapsed = np.cumsum([visit.travelled / feed + dwell for visit in listed])
    return np.asarray(elapsed - elapsed[0])


def make_planned_design(
    axis: Axis, targets: FloatArray, listed: Sequence[Visit], feed: float, dwell: float
) -> Design:
    """Return a planned test as effects see it; nobody knows its conditions yet.

    `targets`, (m,): Target positions, rising, m or rad.
    `feed`, `dwell`: As `compute_times` takes them.
    """
    index = np.array([visit.target for visit in listed])
    return Design(
        axis=axis,
        position=read_only_floats(targets[index]),
        direction=read_only_floats([visit.approach for visit in listed]),
        run=read_only_integers([visit.run for visit in listed]),
        target=read_only_integers(index),
        time=read_only_floats(compute_times(listed, feed, dwell)),
        time_is_counted=False,
        since_reversal=read_only_floats([visit.since_reversal for visit in listed]),
    )
