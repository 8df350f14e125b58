"""A gauge is found from its 16 points wherever it lies; what is no gauge is refused with the reason."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st

from refusals import refusal
from step_gauge.gauges import gauge
from step_gauge.simulated_cmm import MachineErrors, SimulatedTest, simulate
from zlmreport.plugin import FloatArray, InputError, Place
from zlmreport_step_gauge.initial_points import InitialPoints, read_initial_points
from zlmreport_step_gauge.location import Located, compute_direction_of, locate

ROWS = [f"{block},{point},{point},2,3" for block in ("begin", "end") for point in range(1, 9)]


def written(folder: Path, rows: list[str]) -> Path:
    path = folder / "points.csv"
    path.write_text("\n".join(["block,point,x,y,z", *rows]), encoding="utf-8")
    return path


def told(folder: Path, rows: list[str]) -> str:
    return refusal(read_initial_points, written(folder, rows))


def test_points_come_by_block_and_number_in_metres_whatever_their_order(tmp_path: Path) -> None:
    found = read_initial_points(written(tmp_path, ROWS[::-1])).coordinates
    assert found.shape == (2, 8, 3)
    assert found[1, 6].tolist() == pytest.approx([7e-3, 2e-3, 3e-3])


def test_a_point_that_is_there_twice_is_named_with_its_line(tmp_path: Path) -> None:
    assert "points.csv:18:7: point 1 of block begin is there twice" in told(
        tmp_path, [*ROWS, "begin,1,0,0,0"]
    )


def test_a_ninth_point_is_refused(tmp_path: Path) -> None:
    assert "points.csv:18:5: a block has the points 1 to 8" in told(tmp_path, [*ROWS, "end,9,0,0,0"])


def test_a_third_block_is_refused(tmp_path: Path) -> None:
    assert "column block: begin or end is expected" in told(tmp_path, [*ROWS, "middle,1,0,0,0"])


def test_a_coordinate_with_a_decimal_comma_is_told_how_to_write_it(tmp_path: Path) -> None:
    semicolons = [row.replace(",", ";") for row in ROWS[:-1]]
    path = tmp_path / "points.csv"
    path.write_text("\n".join(["block;point;x;y;z", *semicolons, "end;8;8,5;2;3"]), encoding="utf-8")
    with pytest.raises(InputError, match=r"write '8\.5' if that is meant"):
        read_initial_points(path)


GAUGE = gauge()
PLACE = Place("points.csv")
RADIUS = 2e-3
COMPONENT = st.floats(-1, 1)


def points(
    direction: tuple[float, float, float] = (0.2, 1.0, 0.3), uncertainty: float = 0.0, seed: int = 1
) -> FloatArray:
    """Return the points on a gauge that begins at (290, 41, 201) mm, on a machine without errors."""
    test = SimulatedTest(
        GAUGE, (0.290, 0.041, 0.201), direction, effective_radius=RADIUS, point_uncertainty=uncertainty
    )
    return simulate(test, MachineErrors(), np.random.default_rng(seed)).initial_points


def located(coordinates: FloatArray, uncertainty: float = 1e-6) -> Located:
    return locate(InitialPoints(coordinates, PLACE), GAUGE, RADIUS, uncertainty)


@given(COMPONENT, COMPONENT, COMPONENT)
def test_the_direction_is_that_of_the_gauge_in_any_orientation(x: float, y: float, z: float) -> None:
    length = math.hypot(x, y)
    if length < 0.1 or abs(z) > 2 * length:  # upright gauges have no top that looks up
        return
    direction = np.array([x, y, z]) / np.linalg.norm([x, y, z])
    found = located(points((x, y, z)))
    assert np.allclose(found.location.direction, direction, atol=1e-9)
    assert np.allclose(found.begin.normal, -direction, atol=1e-9)
    assert abs(np.dot(found.location.upward, direction)) < 1e-9


def test_the_centre_lies_in_the_middle_of_the_block_whatever_the_radius() -> None:
    found = located(points((1.0, 0.0, 0.0)))
    # half a block of 10 mm behind its front face; the radius does not shift it
    assert found.location.begin == pytest.approx((0.295, 0.041, 0.201), abs=1e-6)


def test_the_sizes_of_the_blocks_are_free_of_the_radius() -> None:
    block = located(points()).begin
    assert (float(block.length), float(block.width), float(block.height)) == pytest.approx(
        (10e-3, 20e-3, 15e-3), abs=0.5e-6
    )


@pytest.mark.parametrize(
    "order",
    [
        pytest.param([2, 0, 1, 3, 4, 5, 6, 7], id="P1 to P3 in another order"),
        pytest.param([0, 1, 2, 4, 3, 5, 6, 7], id="sides exchanged"),
        pytest.param([0, 1, 2, 3, 4, 6, 5, 7], id="top and foot exchanged"),
    ],
)
def test_an_order_that_geometry_tells_is_accepted(order: list[int]) -> None:
    straight = located(points()).location
    assert np.allclose(located(points()[:, order]).location.begin, straight.begin, atol=1e-12)


def test_the_uncertainty_of_the_direction_is_what_directions_scatter_by() -> None:
    uncertainty = 2e-6
    true = compute_direction_of(points(), RADIUS)
    many = np.array([points(uncertainty=uncertainty, seed=seed) for seed in range(400)])
    scatter = math.sqrt(np.mean(np.sum((compute_direction_of(many, RADIUS) - true) ** 2, axis=-1)) / 2)
    stated = located(points(), uncertainty).location.direction_uncertainty
    assert stated == pytest.approx(scatter, rel=0.12)  # 3/√(2·2·400) and what the 400 leave


def test_blocks_whose_sizes_scatter_more_than_is_stated_raise_the_uncertainty() -> None:
    coordinates = points()
    coordinates[1, 3] += 0.02e-3 * np.array([0, 0, 1])  # nothing across: the size stays
    assert located(coordinates).point_uncertainty == pytest.approx(1e-6)
    coordinates = points((1.0, 0.0, 0.0))
    coordinates[1, 3, 1] -= 60e-6  # a side 60 µm farther out: √(60²/12) of it
    assert located(coordinates).point_uncertainty == pytest.approx(60e-6 / math.sqrt(12), rel=0.01)


def test_a_face_that_is_square_to_the_line_is_within_its_uncertainty() -> None:
    found = located(points(uncertainty=1e-6))
    assert not found.begin_misalignment.is_significant
    assert not found.end_misalignment.is_significant


def test_a_face_that_is_tilted_is_reported_as_misaligned() -> None:
    coordinates = points((1.0, 0.0, 0.0))
    coordinates[0, 2, 0] += 20e-6  # P3 lies 9 mm above P1 and P2
    found = located(coordinates).begin_misalignment
    assert found.angle == pytest.approx(20e-6 / 9e-3, rel=0.02)  # the direction turns a little with it
    assert found.is_significant


def test_exchanged_ends_are_refused() -> None:
    assert "beginning and end are exchanged" in refusal(located, points()[::-1])


def test_a_point_on_the_wrong_face_is_refused() -> None:
    coordinates = points()
    coordinates[0, 7] = coordinates[0, 0]
    assert "P1 to P3 belong on the front, P8 on the back" in refusal(located, coordinates)


def test_sides_that_are_no_sides_are_refused() -> None:
    coordinates = points()
    coordinates[1, 3] = coordinates[1, 4]
    assert "block end: P4 and P5 do not lie on opposite sides" in refusal(located, coordinates)


def test_a_block_of_another_width_is_refused_with_both_widths() -> None:
    coordinates = points((1.0, 0.0, 0.0))
    coordinates[:, 3, 1] -= 3e-3
    told = refusal(located, coordinates)
    assert "a width of 23.000 mm by these points, and the gauge one of 20.000 mm" in told


def test_a_section_of_another_number_of_blocks_is_refused_with_the_one_that_fits() -> None:
    coordinates = points((1.0, 0.0, 0.0))
    coordinates[1, :, 0] -= 20e-3
    message = refusal(located, coordinates)
    assert "mm apart by these points, and the blocks 1 and 5 of the section 80.000 mm" in message
    assert "they fit the blocks 1 to 4" in message
