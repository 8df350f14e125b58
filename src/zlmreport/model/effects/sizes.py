"""Whether the size of a parameter is usual, and the question that an unusual one raises."""

from __future__ import annotations

from zlmreport.language import Words
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.model.effects import wording
from zlmreport.model.effects.effect import Parameter, find_unit_of

#: So many times beyond what is usual, or below it, a value is asked for.
_FAR = 2.0
_IS_IT = Words("{name} {value}: {times} times what is usual; measured so, and in the right unit?")
_IS_IT_SO_LITTLE = Words(
    "{name} {value}, where {least} or more is usual: measured so, and in the right unit?"
)
_IS_IT_AT_ALL = Words("{name} {value}: beyond what is usual; measured so, and with the right sign?")


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
    if question is None and times < 1.0:
        question = _IS_IT_SO_LITTLE.given(least=_write_value(parameter, low, axis))
    elif question is None:
        question = _IS_IT_AT_ALL if times == float("inf") else _IS_IT
    return question.given(
        name=parameter.description, value=_write_value(parameter, value, axis), times=float(f"{times:.2g}")
    )


def _write_value(parameter: Parameter, value: float, axis: Axis) -> Words:
    return wording.quantity(find_unit_of(parameter.dimension, axis.kind), value, 2)


def name_of(parameter: Parameter, value: float) -> Words | None:
    """Return the name that a value of a parameter, SI, has; None if it has none."""
    return next((each.says for each in parameter.named if each.low <= value <= each.high), None)
