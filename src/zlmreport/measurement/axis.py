"""The machine axis under test: its kind, letter, travel, units of positions and deviations, heading."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any

import numpy as np

from zlmreport.errors import InputError, Place
from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.circle import NominalCircle
from zlmreport.measurement.error_symbol import find_symbol_of_positioning
from zlmreport.measurement.measurand import POSITIONING, ROTARY_POSITIONING, Coordinate, Measurand
from zlmreport.measurement.provenance import SourceFile
from zlmreport.measurement.units import ANGLE_UNITS, LENGTH_UNITS, Unit

#: In mm or °, and as a share of a short travel.
_USUAL_OVERRUN, _LARGEST_SHARE = 5.0, 1 / 50


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
    pole_pitch
        Distance of like poles of a linear motor, m (rad); None where it has none, or nobody stated it.
    compensation_table
        The table that the control is meant to apply, in the sign of the deviation (actual − target),
        m or rad; None where the job names none.
    angular_errors
        The rotation that makes the Abbe offset count (pitch or yaw), rad; None where it was not measured.
    abbe_offset
        Of the measuring line from the scale, m; None where the job does not state it.
    quantity
        What was measured of it; None for its positioning.
    error
        The symbol of that error, ``EYX``; empty where it has none, or nobody stated it.
    at
        Where the other axes stood, by their names, m or rad; empty where the job does not state it.
    circle
        The circle that two axes ran together: its plane is the name then. None for a single axis.
    """

    name: str
    kind: AxisKind = AxisKind.LINEAR
    travel: tuple[float, float] | None = None
    screw_pitch: float | None = None
    signal_period: float | None = None
    scale_element: float | None = None
    pole_pitch: float | None = None
    compensation_table: PositionTable | None = None
    angular_errors: PositionTable | None = None
    abbe_offset: float | None = None
    quantity: Measurand | None = None
    error: str = ""
    at: tuple[tuple[str, float], ...] = ()
    circle: NominalCircle | None = None

    @property
    def measurand(self) -> Measurand:
        """What was measured of it."""
        usual = POSITIONING if self.kind is AxisKind.LINEAR else ROTARY_POSITIONING
        if self.quantity is None or self.quantity.identifier == usual.identifier:
            return usual
        return self.quantity

    @property
    def has_length(self) -> bool:
        """Whether what was measured is a length along it: with a temperature, an expansion, a wavelength."""
        return self.measurand.is_position and self.measurand.coordinate is Coordinate.LENGTH

    @property
    def letter(self) -> str:
        """The direction that the symbol of the error names, ``Y`` of ``EYX``; its own where there is none."""
        return self.error[1:2] if self.error and self.error[:1] == "E" else self.name

    @property
    def symbol(self) -> str:
        """The symbol of what was measured: ``EXX`` of a position without one; empty where it has none."""
        return self.error or (find_symbol_of_positioning(self.name) if self.measurand.is_position else "")

    @property
    def subject(self) -> Words:
        """What a document on the test is about: ``Straightness error EYX of axis X``."""
        return self.measurand.named(self.name, self.error)

    @property
    def heading(self) -> Words:
        """What was measured of, as headings begin: ``Axis X``, ``Plane XY``."""
        return self.measurand.bearer.given(axis=self.name)

    @property
    def files(self) -> tuple[SourceFile, ...]:
        """The files that the axis's tables were read from."""
        tables = (self.compensation_table, self.angular_errors)
        return tuple(table.source for table in tables if table and table.source)

    @property
    def position_unit(self) -> Unit:
        """The unit in which positions are read and printed."""
        return self.measurand.coordinate.unit

    @property
    def deviation_unit(self) -> Unit:
        """The unit in which deviations are read and printed."""
        return self.measurand.unit

    @property
    def position_units(self) -> Mapping[str, Unit]:
        """The units in which positions may be given, by their spellings."""
        return self.measurand.coordinate.units

    @property
    def deviation_units(self) -> Mapping[str, Unit]:
        """The units in which deviations may be given, by their spellings."""
        return self.measurand.units

    def with_length(self, key: str, length: float) -> Axis:
        """Return the axis with one of its lengths stated, by the name of the attribute; m or rad."""
        lengths: dict[str, Any] = {key: length}
        return replace(self, **lengths)

    def typed(self, position: float) -> float:
        """Return a position (m or rad) in mm or degrees as it was typed.

        15 digits undo the rounding of the way to SI and back.
        """
        return float(f"{self.position_unit.from_si(position):.15g}")


def find_usual_overrun(axis: Axis) -> float:
    """Return how far beyond a target an axis turns round where the job does not say it, m or rad."""
    usual = axis.position_unit.to_si(_USUAL_OVERRUN)
    if axis.travel is None:
        return usual
    return min(usual, _LARGEST_SHARE * (axis.travel[1] - axis.travel[0]))


def refuse_other_than_positions(axis: Axis, place: Place, reason: str) -> None:
    """Raise `InputError` for what holds for positions only, where something else was measured.

    `reason`: Why it does, as the end of a sentence.
    """
    if not axis.measurand.is_position:
        named = f"{axis.measurand.identifier} ({axis.error})" if axis.error else axis.measurand.identifier
        raise InputError.at(place, f"this job is on {named}, not on positioning: {reason}")


def list_position_units(kind: AxisKind) -> Mapping[str, Unit]:
    """Return the units in which positions and deviations of an axis may be given."""
    return LENGTH_UNITS if kind is AxisKind.LINEAR else ANGLE_UNITS
