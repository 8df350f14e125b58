"""The budget in words: names of contributions, how they were stated, where they come from."""

from __future__ import annotations

from collections.abc import Mapping

from zlmreport.evaluation.evaluation import Least
from zlmreport.evaluation.uncertainty.budget import Acts, Distribution
from zlmreport.language import Words
from zlmreport.measurement.measurement_set import CONDITION_NAMES
from zlmreport.measurement.units import Unit, say_with_unit

NO_INSTRUMENT = Words("the uncertainty of the measuring instrument is not stated")
INSTRUMENT_IN_WORDS = Words(
    "the uncertainty of the measuring instrument is stated in words and not as a number"
)

DEVICE = Words("Measuring instrument")
DEVICE_ALONG = Words("Measuring instrument, part that grows with the length")
UNCORRECTED = Words("Thermal expansion, not corrected")
UNCORRECTED_SOURCE = Words("of known size: α = {expansion} µm/(m·K), ΔT = {difference} K, L = {length}")
#: The usual contributors, by the keys of a job.
USUAL: Mapping[str, Words] = {
    "instrument": DEVICE,
    "misalignment": Words("Misalignment of the measuring line"),
    "machine_temperature": Words("Temperature measurement, machine"),
    "device_temperature": Words("Temperature measurement, measuring device"),
    "expansion_coefficient": Words("Expansion coefficient, machine"),
    "device_expansion_coefficient": Words("Expansion coefficient, measuring device"),
    "calibrated_length": Words("Calibrated length of the instrument"),
    "centring": Words("Centring of the instrument on the circle"),
    "square": Words("Square"),
    "foot_spacing": Words("Distance of the carriage's feet"),
    "environmental_variation": Words("Variation of the environment during the test"),
    "resolution": Words("Resolution of the readings"),
}


def name_contributor(name: str) -> Words:
    """Return the name of a usual contributor, by its key."""
    return CONDITION_NAMES[name] if name in CONDITION_NAMES else USUAL[name]


#: What an uncertainty was raised to.
RAISED_TO: Mapping[Least, Words] = {
    Least.FLATTER_AXIS: Words(
        "raised to reach the flattest axis that the readings leave possible, for errors that differ from "
        "position to position widen what is read"
    ),
    Least.INSTRUMENT: Words("raised to the U of the measuring instrument"),
    Least.LABORATORY: Words("raised to the laboratory's measurement capability (CMC)"),
}

STATED = Words("stated by the laboratory")
_CALIBRATION = Words("calibration certificate {certificate}")
MISALIGNED = Words("cosine error up to R²/(2L), L = {length}")
TEMPERATURE = Words("α·L·R(θ), α = {expansion} µm/(m·K), L = {length}")
EXPANSION = Words("L·ΔT·R(α), ΔT = {difference} K, L = {length}")
EXPANSION_THAT_MOVES = Words("L·ΔT·R(α), ΔT from {low} to {high} K reading by reading, L = {length}")
DRIFT_AT_REST = Words("readings of the axis at rest over the time of the test")
SECOND_ORDER = Words("e²/(2R), the centre found lies {offset} µm off")
LAST_DIGIT = Words("last digit of the readings")
STEPS = Words("steps of the readings, coarser than their last digit")

ACTS: Mapping[Acts, Words] = {
    Acts.ALONG_THE_LENGTH: Words("all readings, in proportion to the distance from the first target"),
    Acts.BETWEEN_DIRECTIONS: Words(
        "all readings of the negative direction, against those of the positive one"
    ),
    Acts.WITH_THE_READING: Words("all readings, in proportion to what was read"),
    Acts.AT_THE_DATUM: Words("all readings alike"),
    Acts.AT_EACH_POSITION: Words("all readings of a target alike"),
    Acts.ROUND_THE_CIRCLE: Words(
        "all readings of an angle alike, and smooth round the circle (second to fourth harmonic)"
    ),
    Acts.OFF_CENTRE: Words("all readings as by a centre that lies off"),
    Acts.AT_EACH_APPROACH: Words("all readings of a target in one direction alike"),
    Acts.IN_TIME: Words(
        "readings that are near in time; of the kind of drift that disturbs a parameter most"
    ),
    Acts.AT_EACH_READING: Words("each reading by itself"),
}
DISTRIBUTIONS: Mapping[Distribution, Words] = {
    Distribution.NORMAL: Words("normal"),
    Distribution.RECTANGULAR: Words("rectangular"),
    Distribution.TRIANGULAR: Words("triangular"),
    Distribution.ONE_SIDED: Words("rectangular, from zero"),
}

_VALUE, _BELOW = Words("{symbol} = {value}"), Words("{symbol} < {value}")
_EXPANDED = Words("U = {value} (k = {factor})")


def say_calibration(certificate: str | None) -> Words:
    """Return where an instrument's uncertainty is known from."""
    return _CALIBRATION.given(certificate=certificate) if certificate else STATED


def say_full_range(symbol: str, value: float, unit: str) -> Words:
    """Return a full range as it is stated."""
    return _VALUE.given(symbol=symbol, value=say_with_unit(value, unit))


def say_range_below(symbol: str, least: float, unit: str) -> Words:
    """Return of a full range only that it is smaller."""
    return _BELOW.given(symbol=symbol, value=say_with_unit(least, unit))


def say_standard_uncertainty(value: float, unit: Unit) -> Words:
    """Return a standard uncertainty as it is stated."""
    return _VALUE.given(symbol="u", value=say_with_unit(value, unit.symbol))


def say_expanded_uncertainty(value: float, unit: str, factor: float) -> Words:
    """Return an expanded uncertainty as it is stated."""
    return _EXPANDED.given(value=say_with_unit(value, unit), factor=factor)
