"""A test without its deviations: everything that an effect may depend on.

The design is known before anything is measured, so the same value serves the fit of a test, the simulation
of one, and the question what a planned test would be able to see.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from zlmreport.measurement.axis import Axis
from zlmreport.quantities.arrays import FloatArray, IntArray

_OF_THE_READINGS = (math.nan, math.nan)


@dataclass(frozen=True, slots=True)
class Design:
    """The readings of a test in the order in which they are taken, but for their deviations.

    Attributes
    ----------
    axis
        The axis under test, with its known periods and tables.
    position : (N,) array
        Target position P of each reading, m or rad.
    direction : (N,) array
        +1.0 for the positive approach, −1.0 for the negative.
    run : (N,) integer array
        Number of the run, from 1.
    target : (N,) integer array
        Index of the target position.
    time : (N,) array
        From the first reading, s; where the source tells no times, the number of the reading.
    time_is_counted
        True where `time` counts readings instead of seconds: time constants then come in readings.
    since_reversal : (N,) array
        Distance travelled since the last reversal of direction, m or rad.
    conditions : mapping of name to (N,) array
        Logged conditions, SI; complete (no NaN) and smoothed where they are noisy.
    span
        First and last position of the measured travel, m or rad; those of the readings if it is not given.
        ``dataclasses.replace`` keeps it, so that a design which asks for other positions (a prediction, a
        second test) still means the travel on which the parameters were estimated.
    """

    axis: Axis
    position: FloatArray
    direction: FloatArray
    run: IntArray
    target: IntArray
    time: FloatArray
    time_is_counted: bool
    since_reversal: FloatArray
    conditions: Mapping[str, FloatArray] = field(default_factory=dict)
    span: tuple[float, float] = _OF_THE_READINGS

    def __post_init__(self) -> None:
        """Take the span from the readings where none is given."""
        if self.span is _OF_THE_READINGS:
            object.__setattr__(self, "span", (float(self.position.min()), float(self.position.max())))

    @property
    def length(self) -> float:
        """The measured travel, m or rad."""
        first, last = self.span
        return last - first

    @property
    def middle(self) -> float:
        """The middle of the measured travel, m or rad."""
        first, last = self.span
        return (first + last) / 2

    @property
    def duration(self) -> float:
        """The time from the first to the last reading, s (or readings)."""
        return float(self.time.max() - self.time.min())

    @property
    def target_positions(self) -> FloatArray:
        """The distinct target positions, rising, m or rad."""
        return np.unique(self.position)

    @property
    def is_bidirectional(self) -> bool:
        """Whether targets are approached from both directions."""
        return bool(self.direction.min() < 0 < self.direction.max())
