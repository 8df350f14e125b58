"""Units of the quantities that enter and leave; between the two everything is SI."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import overload

from zlmreport.quantities.arrays import FloatArray


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of length or angle.

    Attributes
    ----------
    symbol
        As printed, with the micro sign U+00B5.
    ascii
        As written in the results file.
    per_si
        How many of the unit make one metre or one radian. Stored this way round because a decimal
        number of micrometres divided by 1e6 is the double nearest to the true value in metres.
    """

    symbol: str
    ascii: str
    per_si: float

    @overload
    def to_si(self, value: float) -> float: ...
    @overload
    def to_si(self, value: FloatArray) -> FloatArray: ...
    def to_si(self, value: float | FloatArray) -> float | FloatArray:
        """Convert from this unit to metres or radians."""
        return value / self.per_si

    @overload
    def from_si(self, value: float) -> float: ...
    @overload
    def from_si(self, value: FloatArray) -> FloatArray: ...
    def from_si(self, value: float | FloatArray) -> float | FloatArray:
        """Convert from metres or radians to this unit."""
        return value * self.per_si


METRE = Unit("m", "m", 1.0)
MILLIMETRE = Unit("mm", "mm", 1e3)
MICROMETRE = Unit("µm", "um", 1e6)
NANOMETRE = Unit("nm", "nm", 1e9)
INCH = Unit("in", "in", 1 / 0.0254)
MICROINCH = Unit("µin", "uin", 1e6 / 0.0254)
DEGREE = Unit("°", "deg", 180 / math.pi)
ARCSECOND = Unit("″", "arcsec", 3600 * 180 / math.pi)
MILLIRADIAN = Unit("mrad", "mrad", 1e3)
MICRORADIAN = Unit("µrad", "urad", 1e6)
RADIAN = Unit("rad", "rad", 1.0)

LENGTHS = (METRE, MILLIMETRE, MICROMETRE, NANOMETRE, INCH, MICROINCH)
ANGLES = (DEGREE, ARCSECOND, MILLIRADIAN, MICRORADIAN, RADIAN)
