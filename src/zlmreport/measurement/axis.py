"""The machine axis under test."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from zlmreport.quantities.units import ARCSECOND, DEGREE, MICROMETRE, MILLIMETRE, Unit


class AxisKind(StrEnum):
    """Whether positions along the axis are lengths or angles."""

    LINEAR = "linear"
    ROTARY = "rotary"


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
    """

    name: str
    kind: AxisKind = AxisKind.LINEAR
    travel: tuple[float, float] | None = None
    screw_pitch: float | None = None
    signal_period: float | None = None
    scale_element: float | None = None

    @property
    def position_unit(self) -> Unit:
        """The unit in which positions are read and printed."""
        return MILLIMETRE if self.kind is AxisKind.LINEAR else DEGREE

    @property
    def deviation_unit(self) -> Unit:
        """The unit in which deviations are read and printed."""
        return MICROMETRE if self.kind is AxisKind.LINEAR else ARCSECOND
