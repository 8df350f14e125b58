"""Values in sentences: so many digits, in the unit of the axis, with the decimal sign of the language."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from model.axis_tests import AXIS, linear_test
from zlmreport.model.effects import wording
from zlmreport.plugin import Axis, AxisKind, Language

DESIGN = linear_test()
ROTARY = Axis("C", kind=AxisKind.ROTARY)


def test_a_period_that_rounding_errors_make_slightly_smaller_has_no_digit_more() -> None:
    assert wording.length(AXIS, 0.01 - 1e-17).in_language(Language.ENGLISH) == "10.0 mm"


def test_the_decimal_sign_is_that_of_the_language() -> None:
    assert wording.length(AXIS, 0.0123).in_language(Language.GERMAN) == "12,3 mm"


@pytest.mark.parametrize(
    ("axis", "deviation", "position"), [(AXIS, "1.2 µm", "123.4 mm"), (ROTARY, "2.1″", "10.00°")]
)
def test_units_are_those_of_the_axis(axis: Axis, deviation: str, position: str) -> None:
    # 1.234 µm, or 10 µrad = 2.06″.
    value, place = (1.234e-6, 0.1234) if axis is AXIS else (10e-6, math.radians(10.0))
    assert wording.deviation(axis, value).in_language(Language.ENGLISH) == deviation
    assert wording.position(axis, place).in_language(Language.ENGLISH) == position


@pytest.mark.parametrize(
    ("time", "is_counted", "text"),
    [
        (23.34, False, "23.3 s"),
        (599.6, False, "600 s"),
        (720.0, False, "12.0 min"),
        (6.6, True, "6.6 readings"),
    ],
)
def test_time_is_told_in_seconds_minutes_or_readings(*, time: float, is_counted: bool, text: str) -> None:
    design = replace(DESIGN, time_is_counted=is_counted)
    assert wording.span_of_time(design, time).in_language(Language.ENGLISH) == text


def test_a_reading_is_named_by_target_direction_and_run() -> None:
    downwards = int((DESIGN.direction < 0).argmax())
    place = f"{1e3 * DESIGN.position[downwards]:.1f} mm"
    assert wording.cell(DESIGN, downwards).in_language(Language.ENGLISH) == f"{place}, ↓"
    assert wording.reading_at(DESIGN, downwards).in_language(Language.GERMAN).endswith(" mm, ↓, Durchlauf 1")
