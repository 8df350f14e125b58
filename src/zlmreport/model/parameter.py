"""Parameters of effects: what they are, their units, and which values are plausible."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from zlmreport.language import Words
from zlmreport.measurement.axis import AxisKind
from zlmreport.quantities.units import ARCSECOND, DEGREE, MICROMETRE, MILLIMETRE, Unit


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


_LINEAR = {
    Dimension.DEVIATION: MICROMETRE,
    Dimension.SLOPE: Unit("µm/m", "um/m", 1e6),
    Dimension.POSITION: MILLIMETRE,
    Dimension.TIME: Unit("s", "s", 1.0),
    Dimension.DEVIATION_PER_KELVIN: Unit("µm/K", "um/K", 1e6),
    Dimension.EXPANSION: Unit("µm/(m·K)", "um/(m K)", 1e6),
    Dimension.LENGTH: MILLIMETRE,
    Dimension.ANGLE: DEGREE,
    Dimension.RATIO: Unit("", "1", 1.0),
}
_ROTARY = _LINEAR | {
    Dimension.DEVIATION: ARCSECOND,
    Dimension.SLOPE: Unit("″/°", "arcsec/deg", ARCSECOND.per_si / DEGREE.per_si),
    Dimension.POSITION: DEGREE,
    Dimension.DEVIATION_PER_KELVIN: Unit("″/K", "arcsec/K", ARCSECOND.per_si),
    Dimension.EXPANSION: Unit("″/(°·K)", "arcsec/(deg K)", ARCSECOND.per_si / DEGREE.per_si),
}
_READINGS = Unit("readings", "readings", 1.0)


def unit_of(dimension: Dimension, kind: AxisKind, *, time_is_counted: bool = False) -> Unit:
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
