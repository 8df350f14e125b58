"""What the gauge contributes to the budget, by hand; and that it holds the errors of a simulated machine."""

from __future__ import annotations

import math
import sys

import numpy as np
import pytest
from hypothesis import given, strategies as st

from environments import ROOT
from step_gauge.gauges import gauge, set_up
from step_gauge.probing import RADIUS
from step_gauge.test_measurements import measured
from zlmreport.plugin import FloatArray
from zlmreport.plugin.extension import Acts
from zlmreport_step_gauge.set_up import Expansion, GaugeSetUp, StatedRadius
from zlmreport_step_gauge.uncertainty import list_gauge_contributions, part_uncertainty

GAUGE = gauge()


def sizes(of: GaugeSetUp) -> dict[Acts, float]:
    found = list_gauge_contributions(of, measured())
    return {
        acts: math.sqrt(sum(each.standard_uncertainty**2 for each in found if each.acts is acts))
        for acts in Acts
    }


def test_faces_of_one_uncertainty_have_it_each_by_itself() -> None:
    found = sizes(set_up(GAUGE, effective_radius=StatedRadius(RADIUS, 0.0)))
    assert found[Acts.AT_EACH_APPROACH] == pytest.approx(0.1e-6)
    assert found[Acts.ALONG_THE_LENGTH] == 0.0


def test_the_radius_parts_the_directions_by_twice_its_uncertainty() -> None:
    found = sizes(set_up(GAUGE, effective_radius=StatedRadius(RADIUS, 0.25e-6)))
    assert found[Acts.BETWEEN_DIRECTIONS] == pytest.approx(0.5e-6)


def test_a_radius_that_the_machine_corrected_contributes_nothing_here() -> None:
    assert sizes(set_up(GAUGE, radius_is_corrected=True))[Acts.BETWEEN_DIRECTIONS] == 0.0


def test_touches_count_at_each_reading_and_their_mean_at_the_reference_face() -> None:
    of = set_up(GAUGE, effective_radius=StatedRadius(RADIUS, 0.0), probing_uncertainty=0.4e-6)
    found = sizes(of)
    assert found[Acts.AT_EACH_READING] == pytest.approx(0.4e-6)
    assert found[Acts.AT_THE_DATUM] == pytest.approx(0.4e-6 / math.sqrt(2))


def test_the_expansion_coefficient_counts_with_the_temperature_that_is_compensated() -> None:
    uncertain = gauge(expansion_uncertainty=0.5e-6)
    of = set_up(
        uncertain,
        effective_radius=StatedRadius(RADIUS, 0.0),
        gauge_expansion=Expansion(11.5e-6, 2.0),
    )
    assert sizes(of)[Acts.ALONG_THE_LENGTH] == pytest.approx(0.09 * 2.0 * 0.5e-6)


@given(
    st.lists(st.floats(0.05, 2.0), min_size=3, max_size=30),
)
def test_the_two_parts_of_the_faces_are_nowhere_less_than_the_certificate(stated: list[float]) -> None:
    uncertainty: FloatArray = np.array(stated)
    distance = np.linspace(0, 1, len(stated))
    at_each, along = part_uncertainty(distance, uncertainty)
    assert np.all(at_each**2 + (along * distance) ** 2 >= uncertainty**2 * (1 - 1e-9))


def test_the_two_parts_are_exact_at_the_end_where_the_uncertainty_grows() -> None:
    distance = np.linspace(0, 1, 11)
    uncertainty = 0.2 + 0.5 * 0.42 * distance
    at_each, along = part_uncertainty(distance, uncertainty)
    assert math.hypot(at_each, along) == pytest.approx(uncertainty[-1])


@pytest.mark.parametrize("radius_is_determined", [False, True])
def test_stated_intervals_hold_the_true_errors(
    monkeypatch: pytest.MonkeyPatch, *, radius_is_determined: bool
) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "benchmarks"))
    monkeypatch.delitem(sys.modules, "step_gauge_coverage", raising=False)
    from step_gauge_coverage import coverage

    # 120 calibrations of 23 faces, of which those of one share some errors: ± 2.5 % at three standard errors
    assert 0.93 <= coverage(120, radius_is_determined=radius_is_determined).all_faces <= 0.99
