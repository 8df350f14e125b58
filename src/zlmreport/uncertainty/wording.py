"""The budget in words: names of contributions, how they were stated, where they come from."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from zlmreport.language import Words
from zlmreport.quantities.units import METRE, Unit
from zlmreport.uncertainty.contribution import Acts, Distribution

NO_INSTRUMENT = Words(
    en="the uncertainty of the measuring instrument is not stated",
    de="die Messunsicherheit des Messgeräts ist nicht angegeben",
)
INSTRUMENT_IN_WORDS = Words(
    en="the uncertainty of the measuring instrument is stated in words and not as a number",
    de="die Messunsicherheit des Messgeräts ist in Worten und nicht als Zahl angegeben",
)

DEVICE = Words(en="Measuring instrument", de="Messgerät")
_ENVIRONMENTAL_VARIATION = Words(
    en="Variation of the environment during the test", de="Schwankung der Umgebung während der Messung"
)
_RESOLUTION = Words(en="Resolution of the readings", de="Auflösung der Messwerte")
#: The usual contributors beside the instrument, by the keys of a job.
USUAL: Mapping[str, Words] = MappingProxyType(
    {
        "misalignment": Words(
            en="Misalignment of the measuring line", de="Fluchtungsabweichung der Messlinie"
        ),
        "machine_temperature": Words(
            en="Temperature measurement, machine", de="Temperaturmessung an der Maschine"
        ),
        "device_temperature": Words(
            en="Temperature measurement, measuring device", de="Temperaturmessung am Messmittel"
        ),
        "expansion_coefficient": Words(
            en="Expansion coefficient, machine", de="Ausdehnungskoeffizient der Maschine"
        ),
        "device_expansion_coefficient": Words(
            en="Expansion coefficient, measuring device", de="Ausdehnungskoeffizient des Messmittels"
        ),
        "environmental_variation": _ENVIRONMENTAL_VARIATION,
        "resolution": _RESOLUTION,
    }
)
#: Those of a rotary axis.
USUAL_OF_ROTARY: Mapping[str, Words] = MappingProxyType(
    {"environmental_variation": _ENVIRONMENTAL_VARIATION, "resolution": _RESOLUTION}
)

STATED = Words(en="stated by the laboratory", de="Angabe des Laboratoriums")
_CALIBRATION = Words(en="calibration certificate {certificate}", de="Kalibrierschein {certificate}")
MISALIGNED = Words(
    en="cosine error up to R²/(2L), L = {length}", de="Kosinusfehler bis R²/(2L), L = {length}"
)
TEMPERATURE = Words(
    en="α·L·R(θ), α = {expansion} µm/(m·K), L = {length}",
    de="α·L·R(θ), α = {expansion} µm/(m·K), L = {length}",
)
EXPANSION = Words(
    en="L·ΔT·R(α), ΔT = {difference} K, L = {length}", de="L·ΔT·R(α), ΔT = {difference} K, L = {length}"
)
DRIFT_AT_REST = Words(
    en="readings of the axis at rest over the time of the test",
    de="Messwerte der ruhenden Achse über die Zeit der Messung",
)
LAST_DIGIT = Words(en="last digit of the readings", de="letzte Stelle der Messwerte")

ACTS: Mapping[Acts, Words] = MappingProxyType(
    {
        Acts.ALONG_THE_LENGTH: Words(
            en="all readings, in proportion to the distance from the first target",
            de="alle Messwerte, im Verhältnis zum Abstand von der ersten Sollposition",
        ),
        Acts.BETWEEN_DIRECTIONS: Words(
            en="all readings of the negative direction, against those of the positive one",
            de="alle Messwerte der negativen Richtung, gegenüber denen der positiven",
        ),
        Acts.AT_THE_DATUM: Words(en="all readings alike", de="alle Messwerte gleich"),
        Acts.AT_EACH_POSITION: Words(
            en="all readings of a target alike", de="alle Messwerte einer Sollposition gleich"
        ),
        Acts.AT_EACH_APPROACH: Words(
            en="all readings of a target in one direction alike",
            de="alle Messwerte einer Sollposition in einer Richtung gleich",
        ),
        Acts.AT_EACH_READING: Words(en="each reading by itself", de="jeder Messwert für sich"),
    }
)
DISTRIBUTIONS: Mapping[Distribution, Words] = MappingProxyType(
    {
        Distribution.NORMAL: Words(en="normal", de="normal"),
        Distribution.RECTANGULAR: Words(en="rectangular", de="Rechteck"),
        Distribution.TRIANGULAR: Words(en="triangular", de="Dreieck"),
        Distribution.ONE_SIDED: Words(en="rectangular, from zero", de="Rechteck, ab null"),
    }
)

_VALUE = Words(en="{symbol} = {value} {unit}", de="{symbol} = {value} {unit}")
_EXPANDED = Words(en="U = {value} {unit} (k = {factor})", de="U = {value} {unit} (k = {factor})")
_EXPANDED_PER_METRE = Words(
    en="U = {value} {unit} + {per_metre} µm/m · L (k = {factor})",
    de="U = {value} {unit} + {per_metre} µm/m · L (k = {factor})",
)


def calibration(certificate: str | None) -> Words:
    """Return where an instrument's uncertainty is known from."""
    return _CALIBRATION.given(certificate=certificate) if certificate else STATED


def length(value: float) -> Words:
    """Return a length, m, with its unit."""
    return Words("{value} m", "{value} m").given(value=METRE.from_si(value))


def full_range(symbol: str, value: float, unit: str) -> Words:
    """Return a full range as it is stated."""
    return _VALUE.given(symbol=symbol, value=value, unit=unit)


def standard(value: float, unit: Unit) -> Words:
    """Return a standard uncertainty as it is stated."""
    return _VALUE.given(symbol="u", value=value, unit=unit.symbol)


def expanded(value: float, per_metre: float, unit: Unit, factor: float) -> Words:
    """Return an expanded uncertainty as it is stated."""
    words = _EXPANDED_PER_METRE if per_metre else _EXPANDED
    return words.given(value=value, unit=unit.symbol, per_metre=per_metre, factor=factor)
