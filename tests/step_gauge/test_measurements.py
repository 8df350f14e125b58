"""Faces become targets of one direction, or blocks targets of both; nothing is filled in."""

from __future__ import annotations

import numpy as np
import pytest

from installed import registry
from step_gauge.gauges import gauge, set_up
from step_gauge.probing import FILE, RADIUS, deviations, probed, touched
from zlmreport.plugin import Axis, Language, MeasurementSet, Options
from zlmreport.plugin.standard import evaluate, no_missing_readings
from zlmreport_step_gauge.gauge import Side
from zlmreport_step_gauge.measurements import (
    _NO_LOCATION,
    Sign,
    Targets,
    _say_direction,
    make_measurement_set,
)
from zlmreport_step_gauge.probed import ProbedPoint
from zlmreport_step_gauge.set_up import GaugeSetUp, StatedRadius

GAUGE = gauge()
STATED = StatedRadius(RADIUS, 0.2e-6)
ISO = registry().standard("iso230-2:2014")


def lost(_: float, side: Side) -> float:
    """Return the error of an axis that reads 4 µm more on its way back."""
    return 4e-6 if side is Side.BACK else 0.0


def measured(
    targets: Targets = Targets.FACES,
    points: list[ProbedPoint] | None = None,
    of: GaugeSetUp | None = None,
    origin: float = 0.0,
    sign: Sign = Sign.INDICATION,
) -> MeasurementSet:
    taken = points or touched(GAUGE, lost)
    stated = of or set_up(GAUGE, effective_radius=STATED)
    return make_measurement_set(
        probed(taken, GAUGE),
        deviations(taken, stated),
        stated,
        Axis("X"),
        targets=targets,
        sign=sign,
        origin=origin,
        source="step-gauge",
        files=(),
        place=FILE,
    )


def said(measurements: MeasurementSet) -> str:
    return "\n".join(each.in_language(Language.ENGLISH) for each in measurements.provenance.remarks)


def test_each_face_is_a_target_at_its_nominal_place_beyond_the_origin() -> None:
    found = measured(origin=40e-3)
    assert found.target_positions == pytest.approx(40e-3 + 10e-3 * np.arange(10))


def test_a_front_face_is_read_in_the_positive_and_a_back_face_in_the_negative_direction() -> None:
    grid = np.isfinite(measured().deviations()).all(axis=-1)
    assert grid[0].tolist() == [True, False] * 5
    assert grid[1].tolist() == [False, True] * 5


def test_the_side_that_cannot_be_reached_is_no_missing_reading() -> None:
    found = measured()
    assert found.one_sided_targets
    assert found.missing() == ()


def test_a_face_that_was_missed_in_a_cycle_is_a_missing_reading() -> None:
    points = touched(GAUGE, lost)
    found = measured(points=points[:-1])
    assert [(each.target_position, each.run) for each in found.missing()] == [(pytest.approx(0.09), 2)]


def test_of_a_missed_face_it_is_said_by_how_many_readings_the_others_are_evaluated() -> None:
    found = measured(points=touched(GAUGE, lost)[:-1])
    assert no_missing_readings(found).found.in_language(Language.ENGLISH) == (
        "1 of 20 missing; n from 1 to 2, evaluated by what is there"
    )


def test_the_direction_of_a_line_without_initial_points_is_written_as_the_language_writes() -> None:
    remark = next(each for each in measured().provenance.remarks if "direction (" in each.en)
    assert "direction (1; 0; 0)" in remark.in_language(Language.ENGLISH)
    askew = _NO_LOCATION.given(direction=_say_direction((0.6, -0.8, -1e-9)))
    assert "(0,6; −0,8; 0)" in askew.in_language(Language.GERMAN)


def test_iso_reports_of_faces_what_needs_one_direction_at_a_target_and_nothing_else() -> None:
    found = evaluate(ISO, measured(), ISO.options(), {})
    reported = {each.quantity.symbol for each in found.parameters}
    assert {"A", "A_fwd", "A_bwd", "E", "E_fwd", "E_bwd", "R_fwd", "R_bwd"} == reported
    assert any(each.met is False and "in one direction only" in each.found.en for each in found.findings)


def test_blocks_are_targets_of_both_directions_at_their_middles() -> None:
    found = measured(Targets.BLOCKS)
    assert found.target_positions == pytest.approx(5e-3 + 20e-3 * np.arange(5))
    assert not found.one_sided_targets
    assert evaluate(ISO, found, ISO.options(), {}).value("B") == pytest.approx(4e-6, rel=1e-6)


def test_a_radius_from_the_gauge_itself_makes_the_reversal_relative() -> None:
    found = measured(Targets.BLOCKS, of=set_up(GAUGE))
    assert found.reversal_is_relative
    findings = evaluate(ISO, found, ISO.options(), {}).findings
    assert any(each.met is False and "relative to their mean" in each.found.en for each in findings)


def test_each_reading_names_its_face_for_the_error_model() -> None:
    found = measured()
    assert np.array_equal(found.conditions["face"], found.approach)


def test_a_machine_that_reads_too_much_stands_too_near() -> None:
    reads_more = touched(GAUGE, lambda x, _: 10e-6 * x)
    last_front = 8
    indicated, position = (
        measured(points=reads_more, sign=sign).deviations()[0, last_front, 0]
        for sign in (Sign.INDICATION, Sign.POSITION)
    )
    assert indicated == pytest.approx(10e-6 * 0.08, rel=1e-4)
    assert position == pytest.approx(-indicated)
    assert "by how much the machine reads too much" in said(measured())
    assert "by how much the axis stands too far when it reads a position" in said(
        measured(sign=Sign.POSITION)
    )


def test_the_remarks_say_what_the_direction_of_probing_means_and_where_the_radius_is_from() -> None:
    assert "not that in which the axis came to the position" in said(measured())
    assert ": 1.9985 mm, as stated" in said(measured())
    assert "mean of 5 blocks" in said(measured(of=set_up(GAUGE)))


def test_what_is_not_compensated_is_said() -> None:
    assert "was not compensated" in said(measured())


def test_the_evaluation_of_pahk_and_kim_has_the_reversal_with_their_sign() -> None:
    own = registry().standard("step-gauge")
    found = evaluate(own, measured(), Options(), {})
    assert found.value("XR_mean") == pytest.approx(4e-6, rel=1e-6)
    assert found.value("B_mean") == pytest.approx(-4e-6, rel=1e-6)
