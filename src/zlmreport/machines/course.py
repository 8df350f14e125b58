"""A circle or a line of a test of a machine: where the tool went, the direction sensed, the readings.

A circle, a line and a diagonal are one thing: positions of the machine, the directions in which its
axes moved, the direction in which the deviation was sensed. What only a circle has (angle, sense, radius)
stands in `CircularTest`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from zlmreport.machines.kinematics import Point
from zlmreport.measurement.arrays import BoolArray, FloatArray, IntArray
from zlmreport.measurement.circle import NominalCircle
from zlmreport.model.effects.circle_design import AXES


@dataclass(frozen=True, slots=True)
class ToolCourse:
    """Where the tool went."""

    position: FloatArray  #: (N, 3): x, y, z of the machine, m.
    sensing: FloatArray  #: (N, 3): The unit vector along which the deviation was sensed.
    #: (N, 3): +1 or −1, the direction in which each axis moved; 0 for one at rest or read in both.
    motion: FloatArray
    #: The tool's offset, m, (3,) or (N, 3); None for that of the machine.
    tool: Point | FloatArray | None = None


@dataclass(frozen=True, slots=True)
class CircularTest:
    """A circular test: some turns about one centre, at one radius and feed."""

    name: str  #: The stem of its job.
    nominal: NominalCircle  #: The path that the control was told to run.
    #: angle, sense, run, deviation: Of each reading, in the order of time within its run, shape (N,): θ from
    #: the plane's first axis towards its second, rad; +1 counter-clockwise, −1 clockwise; number of the turn
    #: from 1, counted over both senses together or each by itself; actual − nominal radius, m.
    angle: FloatArray
    sense: FloatArray
    run: IntArray
    deviation: FloatArray
    time: FloatArray  #: Seconds from the beginning of the test.
    tool: Point | None = None  #: The tool's offset, m; None for that of the machine.

    @property
    def axes(self) -> tuple[int, int]:
        """Numbers of the plane's axes."""
        first, second = self.nominal.axes
        return AXES.index(first), AXES.index(second)

    def make_course(self) -> ToolCourse:
        """Return where the tool went."""
        first, second = self.axes
        cosine, sine = np.cos(self.angle), np.sin(self.angle)
        sensing = np.zeros((len(self.angle), 3))
        sensing[:, first], sensing[:, second] = cosine, sine
        motion = np.zeros_like(sensing)
        motion[:, first], motion[:, second] = -self.sense * np.sign(sine), self.sense * np.sign(cosine)
        position = np.asarray(self.nominal.centre) + self.nominal.radius * sensing
        return ToolCourse(position, sensing, motion, self.tool)

    def list_turns(self) -> Sequence[IntArray]:
        """Return the indices of the readings of each turn, counter-clockwise ones first, in their order."""
        return [
            np.flatnonzero((self.sense == sense) & (self.run == number))
            for sense in (1.0, -1.0)
            for number in np.unique(self.run[self.sense == sense])
        ]

    def keep(self, kept: BoolArray | IntArray) -> CircularTest:
        """Return the circle with some of its readings."""
        own = {name: getattr(self, name)[kept] for name in ("angle", "sense", "run", "deviation", "time")}
        return replace(self, **own)


@dataclass(frozen=True, slots=True)
class StraightTest:
    """A test along a line or a diagonal: what a scale, a laser or a step gauge read there."""

    name: str
    course: ToolCourse
    at: FloatArray  #: (N,): Place along the line, m.
    deviation: FloatArray  #: (N,): Mean of the repeats, m.
    standard_uncertainty: FloatArray  #: (N,): Of these means, from their scatter, m.
    direction: FloatArray  #: (N,): +1 or −1, the direction of travel along the line.
