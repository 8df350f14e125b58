"""Parameters of effects: what they are, their units, and which values are plausible."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from zlmreport.language import Words
from zlmreport.measurement.axis import AxisKind


class Dimension(Enum):
    """What kind of quantity a parameter is; its printed unit follows from it and the kind of axis."""

    DEVIATION = "deviation"
    SLOPE = "deviation per position"
    POSITION = "position along the axis"
    TIME = "time"
    DEVIATION_PER_KELVIN = "deviation per kelvin"
    EXPANSION = "deviation per position and kelvin"
    LENGTH = "length across the axis"
    ANGLE = "phase"
    RATIO = "ratio"


@dataclass(frozen=True, slots=True)
class ParameterUnit:
    """A printed unit: its symbols, and how many of it make one in SI."""

    symbol: str
    ascii: str
    per_si: float


_DEGREES = 57.29577951308232
_ARCSECONDS = 206264.80624709636

_LINEAR = {
    Dimension.DEVIATION: ParameterUnit("µm", "um", 1e6),
    Dimension.SLOPE: ParameterUnit("µm/m", "um/m", 1e6),
    Dimension.POSITION: ParameterUnit("mm", "mm", 1e3),
    Dimension.TIME: ParameterUnit("s", "s", 1.0),
    Dimension.DEVIATION_PER_KELVIN: ParameterUnit("µm/K", "um/K", 1e6),
    Dimension.EXPANSION: ParameterUnit("µm/(m·K)", "um/(m K)", 1e6),
    Dimension.LENGTH: ParameterUnit("mm", "mm", 1e3),
    Dimension.ANGLE: ParameterUnit("°", "deg", _DEGREES),
    Dimension.RATIO: ParameterUnit("", "1", 1.0),
}
_ROTARY = _LINEAR | {
    Dimension.DEVIATION: ParameterUnit("″", "arcsec", _ARCSECONDS),
    Dimension.SLOPE: ParameterUnit("″/°", "arcsec/deg", _ARCSECONDS / _DEGREES),
    Dimension.POSITION: ParameterUnit("°", "deg", _DEGREES),
    Dimension.DEVIATION_PER_KELVIN: ParameterUnit("″/K", "arcsec/K", _ARCSECONDS),
    Dimension.EXPANSION: ParameterUnit("″/(°·K)", "arcsec/(deg K)", _ARCSECONDS / _DEGREES),
}
_READINGS = ParameterUnit("readings", "readings", 1.0)


def unit_of(dimension: Dimension, kind: AxisKind, *, time_is_counted: bool = False) -> ParameterUnit:
    """Return the unit in which a parameter is read and printed.

    Parameters
    ----------
    dimension
        What kind of quantity it is.
    kind
        Of the axis.
    time_is_counted
        Whether the design counts readings instead of seconds.
    """
    if dimension is Dimension.TIME and time_is_counted:
        return _READINGS
    return (_LINEAR if kind is AxisKind.LINEAR else _ROTARY)[dimension]


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter of an effect.

    Attributes
    ----------
    name
        ASCII, as jobs and results files name it: ``lost_motion``.
    notation
        As printed: ``B``.
    dimension
        What kind of quantity it is.
    description
        In words.
    smallest, largest
        The plausible range, SI; a value outside it is reported as implausible and never clipped. None
        where nothing is known. The range of a time is in seconds and says nothing where time is counted.
    is_refined
        Of a searched parameter, whether the search goes on between the values of the grid: not where only
        these make sense (a number of teeth), or where nothing changes between them (the gap of a joint).
    """

    name: str
    notation: str
    dimension: Dimension
    description: Words
    smallest: float | None = None
    largest: float | None = None
    is_refined: bool = True
