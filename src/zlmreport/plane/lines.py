"""Lines of a plane: tests of one axis at several positions of a second one, put side by side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from zlmreport.measurement.approach import Approach
from zlmreport.model.design import Design
from zlmreport.model.observations import Observations, of_readings
from zlmreport.model.repeats import noise_floor, outliers
from zlmreport.quantities.arrays import FloatArray, IntArray, read_only_floats, read_only_integers

#: The condition under which a design holds the position of the second axis, m.
ACROSS = "position_of_second_axis"


@dataclass(frozen=True, slots=True)
class Line:
    """A test of the axis at one position of the second axis."""

    across: float  #: R, the position of the second axis, m.
    observed: Observations  #: The readings, none set aside.

    def aside(self) -> IntArray:
        """Return the readings that stand off, by their places among those observed."""
        return outliers(self.observed.design, self.observed.deviation).readings

    def kept(self) -> Observations:
        """Return the readings without those that stand off."""
        return self.observed.without(self.aside())


@dataclass(frozen=True, slots=True)
class Readings:
    """The readings of all lines that approach from one side."""

    second: str  #: Name of the second axis.
    #: With R as the condition `ACROSS`. A target is a point of the plane: a line that is measured again
    #: shares its targets, but no two lines share a run.
    design: Design
    deviation: FloatArray  #: (N,): x, m.
    #: σ_f of a single reading, from the repeats within each line, m; None without repeats.
    noise_floor: float | None

    @property
    def across(self) -> FloatArray:
        """R of each reading, shape (N,), m."""
        return self.design.conditions[ACROSS]


def side_by_side(lines: Sequence[Line], approach: Approach, second: str = "R") -> Readings:
    """Return the readings of lines in one direction of approach, those that stand off set aside.

    `lines`: In any order.
    """
    kept = [_one_way(line, approach) for line in lines]
    designs = [each.design for each in kept]
    counts = [len(each.deviation) for each in kept]
    number = np.repeat(np.arange(len(kept), dtype=np.float64), counts)
    across = np.repeat([line.across for line in lines], counts)
    position = np.concatenate([design.position for design in designs])
    run = np.concatenate([design.run for design in designs])
    design = Design(
        axis=designs[0].axis,
        position=read_only_floats(position),
        direction=read_only_floats(np.full(len(number), float(approach))),
        run=_labels(number, run) + 1,
        target=_labels(across, position),
        time=read_only_floats(np.arange(len(number))),
        time_is_counted=True,
        since_reversal=read_only_floats(np.concatenate([each.since_reversal for each in designs])),
        conditions={ACROSS: read_only_floats(across)},
    )
    deviation = read_only_floats(np.concatenate([each.deviation for each in kept]))
    return Readings(second, design, deviation, _pooled_floor(kept))


def points(readings: Readings, along: FloatArray, across: FloatArray) -> Design:
    """Return a design that asks for points of the plane, each (M,), m."""
    design = readings.design
    none = np.zeros(len(along))
    return Design(
        axis=design.axis,
        position=along,
        direction=np.full(len(along), design.direction[0]),
        run=none.astype(np.int64),
        target=none.astype(np.int64),
        time=none,
        time_is_counted=True,
        since_reversal=none,
        conditions={ACROSS: across},
        span=design.span,
    )


def _one_way(line: Line, approach: Approach) -> Observations:
    kept = line.kept()
    chosen = np.flatnonzero(kept.design.direction == float(approach))
    return Observations(
        of_readings(kept.design, chosen),
        read_only_floats(kept.deviation[chosen]),
        read_only_integers(kept.reading[chosen]),
        kept.remarks,
    )


def _labels(one: FloatArray, other: FloatArray | IntArray) -> IntArray:
    """Return numbers from 0 for the pairs of two values, the same for the same pair."""
    _, index = np.unique(np.stack([one, other]), axis=1, return_inverse=True)
    return read_only_integers(index.reshape(-1))


def _pooled_floor(lines: Sequence[Observations]) -> float | None:
    floors = [noise_floor(each.design, each.deviation) for each in lines]
    known = [floor for floor in floors if floor is not None]
    return float(np.sqrt(np.mean(np.square(known)))) if known else None
