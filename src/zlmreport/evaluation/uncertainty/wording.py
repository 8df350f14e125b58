"""The budget in words: names of contributions, how they were stated, where they come from."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from zlmreport.evaluation.evaluation import Least
from zlmreport.evaluation.uncertainty.budget import Acts, Distribution
from zlmreport.language import Words
from zlmreport.measurement.measurement_set import CONDITION_NAMES
from zlmreport.measurement.units import METRE, Unit, with_unit

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
DEVICE_ALONG = Words(
    en="Measuring instrument, part that grows with the length",
    de="Messgerät, mit der Länge wachsender Teil",
)
UNCORRECTED = Words(en="Thermal expansion, not corrected", de="Wärmeausdehnung, nicht korrigiert")
UNCORRECTED_SOURCE = Words(
    en="of known size: α = {expansion} µm/(m·K), ΔT = {difference} K, L = {length}",
    de="der Größe nach bekannt: α = {expansion} µm/(m·K), ΔT = {difference} K, L = {length}",
)
#: The usual contributors, by the keys of a job.
USUAL: Mapping[str, Words] = MappingProxyType(
    {
        "instrument": DEVICE,
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
        "calibrated_length": Words(
            en="Calibrated length of the instrument", de="Kalibrierte Länge des Messgeräts"
        ),
        "centring": Words(
            en="Centring of the instrument on the circle", de="Zentrierung des Messgeräts auf den Kreis"
        ),
        "environmental_variation": _ENVIRONMENTAL_VARIATION,
        "resolution": _RESOLUTION,
    }
)


def contributor(name: str) -> Words:
    """Return the name of a usual contributor, by its key."""
    return CONDITION_NAMES[name] if name in CONDITION_NAMES else USUAL[name]


#: What an uncertainty was raised to.
RAISED_TO: Mapping[Least, Words] = MappingProxyType(
    {
        Least.INSTRUMENT: Words(
            en="raised to the U of the measuring instrument",
            de="auf U des Messgeräts angehoben",
        ),
        Least.LABORATORY: Words(
            en="raised to the laboratory's measurement capability (CMC)",
            de="auf die Messmöglichkeit des Laboratoriums (CMC) angehoben",
        ),
    }
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
EXPANSION_THAT_MOVES = Words(
    en="L·ΔT·R(α), ΔT from {low} to {high} K reading by reading, L = {length}",
    de="L·ΔT·R(α), ΔT von {low} bis {high} K, Messwert für Messwert, L = {length}",
)
DRIFT_AT_REST = Words(
    en="readings of the axis at rest over the time of the test",
    de="Messwerte der ruhenden Achse über die Zeit der Messung",
)
SECOND_ORDER = Words(
    en="e²/(2R), the centre found lies {offset} µm off",
    de="e²/(2R), der gefundene Mittelpunkt liegt {offset} µm ab",
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
        Acts.ROUND_THE_CIRCLE: Words(
            en="all readings of an angle alike, and smooth round the circle (second to fourth harmonic)",
            de="alle Messwerte eines Winkels gleich, und glatt um den Kreis (zweite bis vierte Harmonische)",
        ),
        Acts.OFF_CENTRE: Words(
            en="all readings as by a centre that lies off",
            de="alle Messwerte wie durch einen versetzten Mittelpunkt",
        ),
        Acts.AT_EACH_APPROACH: Words(
            en="all readings of a target in one direction alike",
            de="alle Messwerte einer Sollposition in einer Richtung gleich",
        ),
        Acts.IN_TIME: Words(
            en="readings that are near in time; of the kind of drift that disturbs a parameter most",
            de="zeitlich benachbarte Messwerte; nach der Art der Drift, die eine Kenngröße am meisten stört",
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

_VALUE = Words(en="{symbol} = {value}", de="{symbol} = {value}")
_EXPANDED = Words(en="U = {value} (k = {factor})", de="U = {value} (k = {factor})")


def calibration(certificate: str | None) -> Words:
    """Return where an instrument's uncertainty is known from."""
    return _CALIBRATION.given(certificate=certificate) if certificate else STATED


def length(value: float) -> Words:
    """Return a length, m, with its unit."""
    return Words("{value} m", "{value} m").given(value=METRE.from_si(value))


def full_range(symbol: str, value: float, unit: str) -> Words:
    """Return a full range as it is stated."""
    return _VALUE.given(symbol=symbol, value=_quantity(value, unit))


def standard(value: float, unit: Unit) -> Words:
    """Return a standard uncertainty as it is stated."""
    return _VALUE.given(symbol="u", value=_quantity(value, unit.symbol))


def expanded(value: float, unit: str, factor: float) -> Words:
    """Return an expanded uncertainty as it is stated."""
    return _EXPANDED.given(value=_quantity(value, unit), factor=factor)


def _quantity(value: float, unit: str) -> Words:
    phrase = with_unit("{value}", unit)
    return Words(phrase, phrase).given(value=value)
