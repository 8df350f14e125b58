"""Units, how they are printed and spelled, and their conversion to SI."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TypeVar, overload
from unicodedata import normalize

from zlmreport.errors import did_you_mean
from zlmreport.language import Words
from zlmreport.language.formatting import write_stated_number
from zlmreport.language.numbers import RoundedNumber
from zlmreport.measurement.arrays import FloatArray

#: 0 °C in kelvin.
ZERO_CELSIUS = 273.15
#: 20 °C in kelvin, the standard reference temperature of ISO 1.
REFERENCE_TEMPERATURE = 293.15
SECONDS_PER_MINUTE = 60.0

_Value = TypeVar("_Value", float, FloatArray)


#: Signs of angles, which follow a number without a space (SI brochure, 5.4.3).
_TOUCHING = ("°", "″")


def with_unit(number: str, symbol: str) -> str:
    """Return a number with its unit as printed: ``20 µm``, ``20″``, ``4.2 ± 0.3 µm``, ``(4.2 ± 0.3)″``."""
    is_sum = symbol in _TOUCHING and "±" in number
    return f"({number}){write_behind(symbol)}" if is_sum else f"{number}{write_behind(symbol)}"


def say_with_unit(value: float, symbol: str) -> Words:
    """Return a value with its unit, for sentences: each language writes the number its own way."""
    return Words(with_unit("{value}", symbol)).given(value=value)


def say_stated(value: float, symbol: str) -> Words:
    """Return a value that somebody states, such as a position or a limit, to its last digit with its unit."""
    return Words(with_unit("{value}", symbol)).given(value=RoundedNumber(write_stated_number(value)))


def write_behind(symbol: str) -> str:
    """Return a unit as it stands behind a number: ``″`` and ``″/m`` touch it, and a blank parts others."""
    return symbol if not symbol or symbol in _TOUCHING or symbol.startswith("″") else f" {symbol}"


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of length or angle, or of what is made of them.

    Attributes
    ----------
    symbol
        As printed, with the micro sign U+00B5.
    ascii
        As written in the results file.
    per_si
        How many of the unit make one in SI. Stored this way round because a decimal
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
        """Convert from this unit to SI."""
        return value / self.per_si

    @overload
    def from_si(self, value: float) -> float: ...
    @overload
    def from_si(self, value: FloatArray) -> FloatArray: ...
    def from_si(self, value: float | FloatArray) -> float | FloatArray:
        """Convert from SI to this unit."""
        return value * self.per_si


@dataclass(frozen=True, slots=True)
class Scale:
    """A unit of time or of a condition, which may have a zero of its own.

    Attributes
    ----------
    symbol
        As printed.
    si
        How many SI units (s, K, Pa, 1) one of the unit is.
    zero
        What the zero of the scale is in SI.
    """

    symbol: str
    si: float = 1.0
    zero: float = 0.0

    def to_si(self, value: float) -> float:
        """Convert from this unit to SI."""
        return value * self.si + self.zero

    @overload
    def from_si(self, value: float) -> float: ...
    @overload
    def from_si(self, value: FloatArray) -> FloatArray: ...
    def from_si(self, value: float | FloatArray) -> float | FloatArray:
        """Convert from SI to this unit."""
        return (value - self.zero) / self.si


METRE = Unit("m", "m", 1.0)
MILLIMETRE = Unit("mm", "mm", 1e3)
MICROMETRE = Unit("µm", "um", 1e6)
NANOMETRE = Unit("nm", "nm", 1e9)
INCH = Unit("in", "in", 1 / 0.0254)
MICROINCH = Unit("µin", "uin", 1e6 / 0.0254)
THOUSANDTH_OF_AN_INCH = Unit("thou", "thou", 1e3 / 0.0254)
DEGREE = Unit("°", "deg", 180 / math.pi)
GON = Unit("gon", "gon", 200 / math.pi)
MILLIGON = Unit("mgon", "mgon", 200e3 / math.pi)
ARCSECOND = Unit("″", "arcsec", 3600 * 180 / math.pi)
MILLIRADIAN = Unit("mrad", "mrad", 1e3)
MICRORADIAN = Unit("µrad", "urad", 1e6)
RADIAN = Unit("rad", "rad", 1.0)
#: Of a slope, which is an angle by another name.
MICROMETRE_PER_METRE = Unit("µm/m", "um/m", 1e6)
#: Of positions in time, as of a drift.
HOUR = Unit("h", "h", 1 / 3600)
MINUTE = Unit("min", "min", 1 / 60)
SECONDS = Unit("s", "s", 1.0)

LENGTHS = (METRE, MILLIMETRE, MICROMETRE, NANOMETRE, INCH, MICROINCH, THOUSANDTH_OF_AN_INCH)
ANGLES = (DEGREE, GON, MILLIGON, ARCSECOND, MILLIRADIAN, MICRORADIAN, RADIAN, MICROMETRE_PER_METRE)
#: An expansion coefficient of 1 µm/(m·K), 1/K.
MICROMETRE_PER_METRE_KELVIN = 1e-6

CELSIUS = Scale("°C", zero=ZERO_CELSIUS)
KELVIN = Scale("K")
FAHRENHEIT = Scale("°F", si=5 / 9, zero=459.67 * 5 / 9)
HECTOPASCAL = Scale("hPa", si=100.0)
KILOPASCAL = Scale("kPa", si=1000.0)
PERCENT = Scale("%", si=0.01)
SECOND = Scale("s")

_U = TypeVar("_U", bound=Unit | Scale)


def _list_spellings(units: Mapping[str, _U]) -> Mapping[str, _U]:
    """Return units by each spelling that a key lists; folding makes the two micro signs one."""
    return MappingProxyType(
        {spelling.casefold(): unit for spellings, unit in units.items() for spelling in spellings.split()}
    )


#: Units of length by the spellings that files and jobs use.
LENGTH_UNITS = _list_spellings(
    {
        "m": METRE,
        "mm 毫米": MILLIMETRE,
        "µm um micron microns 微米": MICROMETRE,
        "nm": NANOMETRE,
        "in inch inches": INCH,
        "µin uin microinch microinches": MICROINCH,
        "thou mil mils": THOUSANDTH_OF_AN_INCH,
    }
)
#: Units of angles by their spellings.
ANGLE_UNITS = _list_spellings(
    {
        "° deg degree degrees 度": DEGREE,
        "gon": GON,
        "mgon": MILLIGON,
        "″ arcsec arcseconds 角秒": ARCSECOND,
        "mrad": MILLIRADIAN,
        "µrad urad": MICRORADIAN,
        "rad": RADIAN,
        "µm/m um/m": MICROMETRE_PER_METRE,
    }
)
#: Units of positions in time by their spellings.
TIMES = _list_spellings({"h hours": HOUR, "min": MINUTE, "s sec seconds": SECONDS})
#: Of positions and deviations of any axis.
POSITION_UNITS: Mapping[str, Unit] = MappingProxyType({**LENGTH_UNITS, **ANGLE_UNITS})
TEMPERATURE_UNITS = _list_spellings({"°C degC C": CELSIUS, "K": KELVIN, "°F degF F": FAHRENHEIT})
PRESSURE_UNITS = _list_spellings(
    {
        "Pa": Scale("Pa"),
        "hPa": HECTOPASCAL,
        "mbar": Scale("mbar", si=100.0),
        "kPa": KILOPASCAL,
        "bar": Scale("bar", si=1e5),
        "mmHg": Scale("mmHg", si=133.322),
        "inHg": Scale("inHg", si=3386.39),
    }
)
RATIO_UNITS = _list_spellings({"% %RH percent": PERCENT, "1": Scale("1")})
#: Units of time by their spellings.
TIME_UNITS = _list_spellings(
    {
        "s sec seconds": SECOND,
        "ms": Scale("ms", si=1e-3),
        "min": Scale("min", si=60.0),
        "h": Scale("h", si=3600.0),
    }
)


def find_unit_named(spelling: str, units: Mapping[str, _U]) -> _U:
    """Return the unit of a spelling, with either micro sign; raise ValueError if it is none of the units.

    >>> find_unit_named("µm", LENGTH_UNITS).ascii
    'um'
    """
    written = spelling.strip()
    found = units.get(written.casefold()) or units.get(normalize("NFKC", written).casefold())  # ㎛, ℃
    if found is None:
        symbols = sorted({unit.symbol for unit in units.values()})
        raise ValueError(
            f"{spelling.strip()[:40]!r} is no unit of this quantity; {did_you_mean(spelling[:40], symbols)}"
        )
    return found


def find_printed_symbol(ascii_name: str) -> str:
    """Return the printed symbol of a unit that a results file names: ``um`` as ``µm``; others as they are."""
    return next((unit.symbol for unit in (*LENGTHS, *ANGLES) if unit.ascii == ascii_name), ascii_name)


def compute_above_reference(temperature: _Value) -> _Value:
    """Return ΔT = T − 20 °C, K, of a temperature in kelvin."""
    return temperature - REFERENCE_TEMPERATURE
