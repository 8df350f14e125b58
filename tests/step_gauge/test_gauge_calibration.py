"""The calibration of a step gauge as a graph: each side by itself, with its uncertainty."""

from __future__ import annotations

import pytest

from step_gauge.gauges import DEPARTURES, gauge
from zlmreport.plugin import Language
from zlmreport_step_gauge.extension import draw_gauge_calibration

FIGURE = draw_gauge_calibration(gauge())


def test_front_and_back_faces_are_curves_of_their_own_in_the_units_of_the_page() -> None:
    front, back = FIGURE.panels[0].curves
    assert front.x == pytest.approx([0, 20, 40, 60, 80])
    assert back.x == pytest.approx([10, 30, 50, 70, 90])
    assert front.y == pytest.approx(DEPARTURES[::2])
    assert back.y == pytest.approx(DEPARTURES[1::2])


def test_the_bands_are_the_expanded_uncertainties() -> None:
    front = FIGURE.panels[0].bands[0]
    assert front.upper - front.lower == pytest.approx([0.4] * 5)


def test_who_cannot_see_it_is_told_the_ranges() -> None:
    said = FIGURE.alternative.in_language(Language.ENGLISH)
    assert "Front faces from -0.5 µm to 0.8 µm" in said.replace("−", "-")
    assert "Back faces from -1.4 µm to 1.7 µm" in said.replace("−", "-")
