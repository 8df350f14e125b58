"""Whether the size of a parameter is usual, and the question that an unusual one raises."""

from __future__ import annotations

from zlmreport.language import Words
from zlmreport.language.numbers import write_significant
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.units import write_behind
from zlmreport.model.effects.effect import Parameter, find_unit_of

#: So many times beyond what is usual, or below it, a value is asked for.
_FAR = 2.0
_VALUE = Words("{value}{unit}")
_IS_IT = Words("{value} ({name}): {times} times what is usual; measured so, and in the right unit?")
_IS_IT_AT_ALL = Words("{value} ({name}): beyond what is usual; measured so, and with the right sign?")


def find_usual_range(parameter: Parameter, kind: AxisKind = AxisKind.LINEAR) -> tuple[float, float]:
    """Return between which values, SI, a parameter is usual; infinite where nothing is known."""
    if kind is AxisKind.ROTARY and parameter.usual_on_rotary is not None:
        return parameter.usual_on_rotary
    if parameter.usual is not None:
        return parameter.usual
    low, high = parameter.smallest, parameter.largest
    return -float("inf") if low is None else low, float("inf") if high is None else high


def compute_times_usual(parameter: Parameter, value: float, kind: AxisKind = AxisKind.LINEAR) -> float:
    """Return how many times what is usual a value is, less than 1 where the usual ends above it.

    It is 1 within the usual, and infinite where the end is zero.
    """
    low, high = find_usual_range(parameter, kind)
    if low <= value <= high:
        return 1.0
    end = high if value > high else low
    return value / end if end and value / end > 0 else float("inf")


def ask_of(parameter: Parameter, value: float, axis: Axis) -> Words | None:
    """Return what is asked of a value far beyond what is usual; None of any other.

    `value`: SI.
    """
    times = compute_times_usual(parameter, value, axis.kind)
    if max(times, 1.0 / times) < _FAR:
        return None
    low, _ = find_usual_range(parameter, axis.kind)
    question = (parameter.question_below or parameter.question) if value < low else parameter.question
    usual = _IS_IT_AT_ALL if times == float("inf") else _IS_IT
    unit = find_unit_of(parameter.dimension, axis.kind)
    written = _VALUE.given(value=write_significant(unit.from_si(value), 2), unit=write_behind(unit.symbol))
    given = (question or usual).given(value=written, times=float(f"{times:.2g}"))
    return given if question else given.given(name=parameter.description)


def name_of(parameter: Parameter, value: float) -> Words | None:
    """Return the name that a value of a parameter, SI, has; None if it has none."""
    return next((each.says for each in parameter.named if each.low <= value <= each.high), None)
