"""The machine axis under test."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from enum import StrEnum
from typing import Any

import numpy as np

from zlmreport.measurement.provenance import SourceFile
from zlmreport.quantities.arrays import FloatArray
from zlmreport.quantities.units import (
    ANGLE_UNITS,
    ARCSECOND,
    DEGREE,
    LENGTH_UNITS,
    MICROMETRE,
    MILLIMETRE,
    Unit,
)
from zlmreport.values import dataclass


class AxisKind(StrEnum):
    """Whether positions along the axis are lengths or angles."""

    LINEAR = "linear"
    ROTARY = "rotary"


@dataclass(frozen=True, slots=True)
class PositionTable:
    """A quantity over the position of the axis, known at some positions."""

    positions: tuple[float, ...]  #: Rising, m or rad; two at least.
    values: tuple[float, ...]  #: At these positions, SI.
    source: SourceFile | None = None  #: The file that it was read from; None for one made in memory.
    #: The values moving back, where they are others; None where one column stands for both directions.
    reverse: tuple[float, ...] | None = None

    @property
    def interval(self) -> float:
        """The median distance of neighbouring positions, m or rad."""
        return float(np.median(np.diff(self.positions)))

    def at(self, position: FloatArray, direction: FloatArray | float = 1.0) -> FloatArray:
        """Return the quantity anywhere: linear between the positions, its end values held beyond them.

        The direction is +1 forward and −1 back; it counts where the two have values of their own.
        """
        forward = np.interp(position, self.positions, self.values)
        if self.reverse is None:
            return forward
        return np.where(np.less(direction, 0), np.interp(position, self.positions, self.reverse), forward)


@dataclass(frozen=True, slots=True)
class Axis:
    """A machine axis.

    Attributes
    ----------
    name
        As on the machine: ``X``, ``C``.
    kind
        Linear or rotary.
    travel
        First and last position, m or rad; None where the job does not state it.
    screw_pitch, signal_period
        Known periods, m (rad): of the screw or gear, and of the scale's signal. None where unknown.
    scale_element
        Length of one element of a scale that is made of several, m (rad); None for one piece.
    compensation_table
        The table that the control is meant to apply, in the sign of the deviation (actual − target),
        m or rad; None where the job names none.
    angular_errors
        The rotation that makes the Abbe offset count (pitch or yaw), rad; None where it was not measured.
    abbe_offset
        Of the measuring line from the scale, m; None where the job does not state it.
    """

    name: str
    kind: AxisKind = AxisKind.LINEAR
    travel: tuple[float, float] | None = None
    screw_pitch: float | None = None
    signal_period: float | None = None
    scale_element: float | None = None
    compensation_table: PositionTable | None = None
    angular_errors: PositionTable | None = None
    abbe_offset: float | None = None

    @property
    def files(self) -> tuple[SourceFile, ...]:
        """The files that the axis's tables were read from."""
        tables = (self.compensation_table, self.angular_errors)
        return tuple(table.source for table in tables if table and table.source)

    @property
    def position_unit(self) -> Unit:
        """The unit in which positions are read and printed."""
        return MILLIMETRE if self.kind is AxisKind.LINEAR else DEGREE

    @property
    def deviation_unit(self) -> Unit:
        """The unit in which deviations are read and printed."""
        return MICROMETRE if self.kind is AxisKind.LINEAR else ARCSECOND

    def with_length(self, key: str, length: float) -> Axis:
        """Return the axis with one of its lengths stated, by the name of the attribute; m or rad."""
        lengths: dict[str, Any] = {key: length}
        return replace(self, **lengths)

    def typed(self, position: float) -> float:
        """Return a position (m or rad) in mm or degrees as it was typed.

        15 digits undo the rounding of the way to SI and back.
        """
        return float(f"{self.position_unit.from_si(position):.15g}")


def position_units(kind: AxisKind) -> Mapping[str, Unit]:
    """Return the units in which positions and deviations of an axis may be given."""
    return LENGTH_UNITS if kind is AxisKind.LINEAR else ANGLE_UNITS
