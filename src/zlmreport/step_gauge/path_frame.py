"""The gauge's own coordinates: along it, across it and out of its top, from the centre of its first block."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from zlmreport.quantities.arrays import FloatArray, read_only_floats
from zlmreport.step_gauge.gauge import Location
from zlmreport.step_gauge.path import Point


@dataclass(frozen=True, slots=True)
class GaugeFrame:
    """Where a gauge lies, as a change of coordinates.

    Attributes
    ----------
    origin : (3,) array
        Centre of the first block of the section, m.
    axes : (3, 3) array
        Rows: unit vectors along the gauge, across it to the right of who looks along it, and out of its top.
    """

    origin: FloatArray
    axes: FloatArray

    @classmethod
    def of(cls, location: Location) -> GaugeFrame:
        """Return the frame of a location."""
        along = np.array(location.direction)
        upward = np.array(location.upward) - np.dot(location.upward, along) * along
        upward /= np.linalg.norm(upward)
        axes = [along, np.cross(along, upward), upward]
        return cls(read_only_floats(location.begin), read_only_floats(axes))

    def to_machine(self, along: float, across: float, upward: float) -> Point:
        """Return a point of the gauge, m, in the coordinates of the machine."""
        x, y, z = (self.origin + np.array([along, across, upward]) @ self.axes).tolist()
        return x, y, z

    def to_gauge(self, points: ArrayLike) -> FloatArray:
        """Return points of the machine, shape (..., 3), m, in the gauge's own coordinates."""
        own: FloatArray = (np.asarray(points) - self.origin) @ self.axes.T
        return own

    def turned(self, along: float) -> Point:
        """Return the direction along the gauge (1) or against it (−1)."""
        x, y, z = (along * self.axes[0] + 0.0).tolist()
        return x, y, z
