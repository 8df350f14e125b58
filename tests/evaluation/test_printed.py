"""Positions and deviations in words."""

from __future__ import annotations

import math

import pytest

from zlmreport.evaluation import printed
from zlmreport.language import Language, Words
from zlmreport.measurement.axis import Axis, AxisKind

LINEAR, ROTARY = Axis("X"), Axis("C", AxisKind.ROTARY)


@pytest.mark.parametrize(
    ("words", "english", "german"),
    [
        (printed.position(LINEAR, 0.0125), "12.5 mm", "12,5 mm"),
        (printed.position(ROTARY, math.pi / 2), "90°", "90°"),
        (printed.deviation(LINEAR, -1.5e-6), "−1.5 µm", "−1,5 µm"),
        (printed.deviation(ROTARY, math.radians(2.5 / 3600)), "2.5″", "2,5″"),
        (printed.positions(1), "1 position", "1 Position"),
        (printed.positions(21), "21 positions", "21 Positionen"),
        (printed.runs(1), "1 run", "1 Durchlauf"),
        (printed.runs(5), "5 runs", "5 Durchläufe"),
    ],
)
def test_values_are_written_in_the_units_and_manner_of_the_page(
    words: Words, english: str, german: str
) -> None:
    assert words.in_language(Language.ENGLISH) == english
    assert words.in_language(Language.GERMAN) == german
