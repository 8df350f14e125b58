"""From centres of the tip to errors: radius, reference, temperature; and what cannot be this gauge."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from refusals import refusal
from step_gauge.gauges import gauge, set_up
from step_gauge.probing import FILE, RADIUS, deviations, probed, touched
from zlmreport.plugin import InputError
from zlmreport_step_gauge.deviations import RadiusSource, compute_deviations_of, compute_radius_uncertainty
from zlmreport_step_gauge.gauge import Side
from zlmreport_step_gauge.probed import ProbedPoint
from zlmreport_step_gauge.set_up import Expansion, StatedRadius

GAUGE = gauge()
STATED = StatedRadius(RADIUS, 0.2e-6)
NANOMETRE = 1e-9


def told(points: list[ProbedPoint], **stated: object) -> str:
    return refusal(deviations, points, set_up(GAUGE, **stated))


def test_a_machine_without_errors_has_none_at_any_face() -> None:
    assert np.abs(deviations(touched(GAUGE), set_up(GAUGE)).values).max() < 1e-3 * NANOMETRE


def test_the_radius_of_a_machine_without_errors_is_the_true_one_at_every_block() -> None:
    found = deviations(touched(GAUGE), set_up(GAUGE)).radius
    assert found.by_block == pytest.approx(np.full(5, RADIUS), abs=1e-3 * NANOMETRE)
    assert found.source is RadiusSource.BLOCKS


def test_errors_are_relative_to_the_first_face() -> None:
    found = deviations(touched(GAUGE, lambda x, _: 5e-6 + 10e-6 * x), set_up(GAUGE, effective_radius=STATED))
    distances = np.array([face.distance for face in GAUGE.faces])
    assert found.values[:, 0] == pytest.approx(10e-6 * distances, abs=NANOMETRE)


def test_the_determined_radius_takes_the_reversal_with_it() -> None:
    def lost(_: float, side: Side) -> float:
        return side * 3e-6

    determined = deviations(touched(GAUGE, lost), set_up(GAUGE))
    stated = deviations(touched(GAUGE, lost), set_up(GAUGE, effective_radius=STATED))
    assert determined.radius.radius - RADIUS == pytest.approx(3e-6, abs=NANOMETRE)
    assert determined.values[1, 0] == pytest.approx(0.0, abs=NANOMETRE)
    assert stated.values[1, 0] == pytest.approx(6e-6, abs=NANOMETRE)


def test_the_determined_radius_takes_the_error_within_a_block_with_it() -> None:
    found = deviations(touched(GAUGE, lambda x, _: 100e-6 * x), set_up(GAUGE)).radius
    assert found.radius - RADIUS == pytest.approx(100e-6 * 10e-3 / 2, abs=NANOMETRE)


def test_the_uncertainty_of_the_radius_is_that_of_the_mean_of_the_blocks() -> None:
    # s = 1 µm of 1, 2, 3 µm, over √3
    assert compute_radius_uncertainty(np.array([1e-6, 2e-6, 3e-6]), GAUGE.faces[:6]) == pytest.approx(
        1e-6 / 3**0.5
    )


def test_blocks_that_happen_to_agree_leave_the_uncertainty_of_their_calibration() -> None:
    # six faces of u = 0.1 µm: √6·0.1/(2·3)
    assert compute_radius_uncertainty(np.full(3, 1e-6), GAUGE.faces[:6]) == pytest.approx(0.1e-6 * 6**0.5 / 6)


def test_points_beside_the_line_are_projected_on_it() -> None:
    aside = [
        replace(each, coordinates=(each.coordinates[0], 0.2 + 1e-3 * (each.face % 3), 0.3))
        for each in touched(GAUGE)
    ]
    along_x = probed(aside, GAUGE).coordinates @ np.array([1.0, 0.0, 0.0])
    straight = probed(touched(GAUGE), GAUGE).coordinates[..., 0]
    assert along_x == pytest.approx(straight)


def test_the_expansion_of_the_gauge_is_taken_off() -> None:
    expansion = Expansion(11.5e-6, 0.5)
    points = touched(GAUGE, growth=11.5e-6 * 0.5)
    bare = deviations(points, set_up(GAUGE, effective_radius=STATED))
    taken = deviations(points, set_up(GAUGE, effective_radius=STATED, gauge_expansion=expansion))
    grown = GAUGE.faces[-1].distance * 11.5e-6 * 0.5
    assert bare.values[-1, 0] == pytest.approx(grown, abs=NANOMETRE)
    assert taken.values[-1, 0] == pytest.approx(0.0, abs=NANOMETRE)
    assert taken.compensated[-1] == pytest.approx(-grown, abs=NANOMETRE)


def test_a_scale_that_has_grown_like_the_gauge_hides_nothing() -> None:
    grown = Expansion(8e-6, 1.0)
    points = touched(GAUGE)  # as gauge and scale have grown alike, the machine sees the calibrated distances
    of = set_up(GAUGE, effective_radius=STATED, gauge_expansion=grown, scale_expansion=grown)
    assert np.abs(deviations(points, of).values).max() < 1e-3 * NANOMETRE


@pytest.mark.parametrize("side", list(Side))
def test_faces_of_one_side_need_no_radius(side: Side) -> None:
    found = deviations(touched(GAUGE), set_up(GAUGE), side)
    assert np.abs(found.values).max() < 1e-3 * NANOMETRE
    assert found.radius.source is RadiusSource.NOWHERE


def test_surface_points_that_are_taken_for_centres_are_told() -> None:
    assert "state step_gauge.radius_correction: true" in told(touched(GAUGE, radius=0.0))


def test_a_tip_of_another_size_is_told() -> None:
    message = told(touched(GAUGE, radius=1.5e-3))
    assert "the effective radius is 1.5000 mm, and the nominal one 2.0000 mm" in message


def test_distances_need_no_radius() -> None:
    distances = [
        replace(each, coordinates=(face.distance,))
        for each in touched(GAUGE)
        for face in [GAUGE.find_face(each.face)]
        if face
    ]
    found = compute_deviations_of(probed(distances, GAUGE), set_up(GAUGE), FILE, is_corrected=True)
    assert np.abs(found.values).max() < 1e-3 * NANOMETRE
    assert found.direction is None


def test_a_gauge_that_lies_the_other_way_round_is_told() -> None:
    departures = tuple(round((face.distance - face.nominal) * 1e6, 6) for face in GAUGE.faces)
    turned = gauge(tuple(-(each - departures[-1]) for each in reversed(departures)))
    assert "the gauge lies the other way round" in told(touched(turned))


def test_a_calibration_with_the_wrong_sign_is_told() -> None:
    departures = tuple(round((face.distance - face.nominal) * 1e6, 6) for face in GAUGE.faces)
    exchanged = gauge(tuple(-each for each in departures))
    assert "were nominal − calibrated entered for calibrated − nominal?" in told(touched(exchanged))
    of_the_machine = touched(exchanged, lambda x, side: 2e-6 * np.sin(x / 0.02) + side * 1e-6)
    deviations(of_the_machine, set_up(GAUGE))  # errors as large as the departures: nobody can tell


def test_a_machine_with_errors_does_not_turn_the_gauge_round() -> None:
    deviations(touched(GAUGE, lambda x, side: 8e-6 * np.sin(x / 0.01) + side * 1e-6), set_up(GAUGE))


def test_a_missed_face_that_shifts_the_others_is_told_with_its_line() -> None:
    shifted = [
        replace(each, coordinates=(each.coordinates[0] + 20e-3 * (each.face > 4), 0.2, 0.3))
        for each in touched(GAUGE)
    ]
    message = told(shifted)
    assert message.startswith("probed.csv:6:1: face 5 lies")
    assert "is this the section that was probed" in message


def test_a_face_off_the_section_is_named_with_its_line() -> None:
    with pytest.raises(InputError, match=r"probed\.csv:10:1: face 9 is not on the section"):
        probed(touched(GAUGE), gauge(tuple(0.0 for _ in range(8))))


def test_a_point_that_is_there_twice_is_refused() -> None:
    points = touched(GAUGE)
    with pytest.raises(InputError, match="face 1, cycle 1, stands in line 2 already"):
        probed([*points, replace(points[0], place=FILE)], GAUGE)
