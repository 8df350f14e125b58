"""From a path to the readings on it: the visit list."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import Axis
from zlmreport.model.design import Design
from zlmreport.planning.methods import Stop
from zlmreport.quantities.arrays import FloatArray, read_only_floats, read_only_integers


@dataclass(frozen=True, slots=True)
class Visit:
    """A reading that is to be taken.

    Attributes
    ----------
    target
        Index of the target position.
    approach
        The direction in which the axis comes there.
    run
        Number of the run, from 1.
    since_reversal
        Distance from the place where the axis last changed its direction, m or rad.
    travelled
        The whole way since the visit before, loops included, m or rad; of the first, since the start.
    """

    target: int
    approach: Approach
    run: int
    since_reversal: float
    travelled: float


def visits(path: Iterable[Stop]) -> tuple[Visit, ...]:
    """Return the readings on a path; direction and distances are those of the motion that leads to them.

    Raises
    ------
    ValueError
        If a reading stands at the start of the path, where no motion leads to it.
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


def times(listed: Sequence[Visit], feed: float, dwell: float) -> FloatArray:
    """Return when each reading is taken, s from the first, shape (N,).

    Parameters
    ----------
    listed
        The visits.
    feed
        m/s or rad/s; the way to a target is travelled at this speed.
    dwell
        Time at rest at a target until the reading is taken, s.
    """
    elapsed = np.cumsum([visit.travelled / feed + dwell for visit in listed])
    return np.asarray(elapsed - elapsed[0])


def planned_design(
    axis: Axis, targets: FloatArray, listed: Sequence[Visit], feed: float, dwell: float
) -> Design:
    """Return a planned test as effects see it; nobody knows its conditions yet.

    Parameters
    ----------
    axis
        The axis under test.
    targets : (m,) array
        Target positions, rising, m or rad.
    listed
        The visits.
    feed, dwell
        As `times` takes them.
    """
    index = np.array([visit.target for visit in listed])
    return Design(
        axis=axis,
        position=read_only_floats(targets[index]),
        direction=read_only_floats([visit.approach for visit in listed]),
        run=read_only_integers([visit.run for visit in listed]),
        target=read_only_integers(index),
        time=read_only_floats(times(listed, feed, dwell)),
        time_is_counted=False,
        since_reversal=read_only_floats([visit.since_reversal for visit in listed]),
    )
