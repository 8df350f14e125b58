"""The emulated probe touches where sphere and box touch, and shows what the machine's errors make of it."""

from __future__ import annotations

import numpy as np
import pytest

from zlmreport_step_gauge.machines.emulated import Boxes, CoordinateMachine, make_errors_along

RADIUS = 2e-3
CUBE = Boxes(
    np.array([0.1, 0.2, 0.3]), np.eye(3), np.array([[-5e-3, -5e-3, -5e-3]]), np.array([[5e-3, 5e-3, 5e-3]])
)


def at(machine: CoordinateMachine, *point: float) -> CoordinateMachine:
    machine.position = np.array(point)
    return machine


def test_a_touch_lies_a_radius_before_the_face() -> None:
    touched = at(CoordinateMachine(CUBE), 0.05, 0.2, 0.3).probe(np.array([0.1, 0.2, 0.3]))
    assert touched == pytest.approx([0.1 - 5e-3 - RADIUS, 0.2, 0.3], abs=1e-12)


def test_an_edge_is_touched_where_the_sphere_meets_it() -> None:
    # 1.2 mm above the upper edge, the sphere of 2 mm reaches it 1.6 mm before the face
    touched = at(CoordinateMachine(CUBE), 0.05, 0.2, 0.3 + 6.2e-3).probe(np.array([0.1, 0.2, 0.3 + 6.2e-3]))
    assert touched[0] == pytest.approx(0.1 - 5e-3 - 1.6e-3, abs=1e-12)


def test_a_turned_box_is_touched_on_its_turned_face() -> None:
    half = np.sqrt(0.5)
    axes = np.array([[half, half, 0.0], [half, -half, 0.0], [0.0, 0.0, 1.0]])
    boxes = Boxes(np.zeros(3), axes, CUBE.lower, CUBE.upper)
    touched = at(CoordinateMachine(boxes), *(-0.03 * axes[0])).probe(np.zeros(3))
    assert touched == pytest.approx(-(5e-3 + RADIUS) * axes[0], abs=1e-12)


def test_a_move_that_passes_touches_nothing() -> None:
    machine = at(CoordinateMachine(CUBE), 0.05, 0.2, 0.3 + 5e-3 + RADIUS + 1e-6)
    assert machine.travel(np.array([0.15, 0.2, 0.3 + 5e-3 + RADIUS + 1e-6]))
    assert machine.position[0] == 0.15


def test_a_collision_leaves_the_tip_where_it_touched() -> None:
    machine = at(CoordinateMachine(CUBE), 0.05, 0.2, 0.3)
    assert not machine.travel(np.array([0.15, 0.2, 0.3]))
    assert machine.position[0] == pytest.approx(0.1 - 5e-3 - RADIUS)


def test_errors_of_the_machine_are_shown_along_their_line() -> None:
    x = np.array([1.0, 0.0, 0.0])
    errors = make_errors_along(x, np.zeros(3), np.array([0.0, 0.2]), np.array([0.0, 20e-6]))
    touched = at(CoordinateMachine(CUBE, errors), 0.05, 0.2, 0.3).probe(np.array([0.1, 0.2, 0.3]))
    true = 0.1 - 5e-3 - RADIUS
    assert touched[0] - true == pytest.approx(1e-4 * true, abs=1e-12)
    assert touched[1:] == pytest.approx([0.2, 0.3])


def test_errors_stay_beyond_the_ends_of_their_line() -> None:
    errors = make_errors_along(
        np.array([0.0, 1.0, 0.0]), np.zeros(3), np.array([0.0, 0.1]), np.array([1e-6, 3e-6])
    )
    points = np.array([[5.0, -1.0, 0.0], [0.0, 0.05, 7.0], [0.0, 9.0, 0.0]])
    assert errors(points)[:, 1] == pytest.approx([1e-6, 2e-6, 3e-6])
    assert not errors(points)[:, [0, 2]].any()


def test_noise_scatters_what_is_shown_by_its_standard_deviation() -> None:
    machine = CoordinateMachine(CUBE, noise=1e-6)
    shown = []
    for _ in range(400):
        touched = at(machine, 0.09, 0.2, 0.3).probe(np.array([0.1, 0.2, 0.3]))
        shown.append(touched[0])
    assert np.std(shown) == pytest.approx(1e-6, rel=0.15)  # 4 standard deviations of s are 0.14


def test_the_volume_holds_what_lies_in_it() -> None:
    machine = CoordinateMachine(CUBE, volume=((0.0, 0.5), (0.0, 0.5), (0.0, 0.4)))
    assert machine.can_reach(np.array([0.5, 0.0, 0.4]))
    assert not machine.can_reach(np.array([0.5, 0.0, 0.41]))
