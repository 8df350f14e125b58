"""Circles of ISO 230-4: against a case that was worked out, another way of computing, and what must hold."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from installed import registry
from plugins.standards.circle_oracle import least_squares, minimum_zone_width
from zlmreport.plugin.standard import position_statistics
from zlmreport_plugins.standards.iso230_4.circles import (
    find_minimum_zone,
    find_zone_about,
    fit_least_squares_circle,
    is_full_turn,
    measure_covered_arc,
)

STANDARD = registry().standard("iso230-4:2005")
CIRCLE = {"radius": 150, "feed": 1000, "calibrated_length": True}
CALIBRATED = STANDARD.options(circle=CIRCLE)
UNCALIBRATED = STANDARD.options(circle={**CIRCLE, "calibrated_length": False})
UM = 1e-6


def circle_of_the_note(count: int = 3600) -> tuple[np.ndarray, np.ndarray]:
    """Return angles, and both paths, µm: squareness, lost motion of both axes, radius, set-up.

    r = R·α/2·sin 2θ + 2 + 3·sgn(ẋ)·cos θ + 2·sgn(ẏ)·sin θ + 30·cos θ − 15·sin θ, R = 150 mm, α = 20 µrad.
    """
    angles = 2 * np.pi * np.arange(count) / count
    cosine, sine = np.round(np.cos(angles), 12), np.round(np.sin(angles), 12)
    base = 1.5 * np.sin(2 * angles) + 2 + 30 * cosine - 15 * sine
    paths = [base + 3 * np.sign(-way * sine) * cosine + 2 * np.sign(way * cosine) * sine for way in (1, -1)]
    return angles, np.array(paths)


def parameters(paths, angles, options=CALIBRATED):
    """Return the parameters, µm, of paths, µm, (approach, m) or (approach, m, run)."""
    grid = np.asarray(paths, dtype=float)
    grid = grid[..., np.newaxis] if grid.ndim == 2 else grid
    found = STANDARD.arithmetic(position_statistics(grid * UM, angles), options).parameters
    return {symbol: float(value) / UM for symbol, value in found.items()}


def test_the_case_that_was_worked_out() -> None:
    # Derived with 3600 points; both circles agree to 1e-4 there.
    angles, paths = circle_of_the_note()
    for reference_circle in ("minimum-zone", "least-squares"):
        options = CALIBRATED.model_copy(update={"reference_circle": reference_circle})
        found = parameters(paths, angles, options)
        assert found["G_ccw"] == pytest.approx(5.9825, abs=5e-5)
        assert found["G_cw"] == pytest.approx(6.2626, abs=5e-5)
        assert found["G_b"] == pytest.approx(6.2626, abs=5e-5)
        assert found["D"] == pytest.approx(2.0, abs=5e-5)
        assert found["F_max_ccw"] == pytest.approx(4.991, abs=5e-4)
        assert found["F_min_ccw"] == pytest.approx(-0.991, abs=5e-4)
        assert found["F_max_cw"] == pytest.approx(5.131, abs=5e-4)
        assert found["F_min_cw"] == pytest.approx(-1.131, abs=5e-4)


def test_the_set_up_of_that_case_is_found() -> None:
    angles, paths = circle_of_the_note()
    found = fit_least_squares_circle(paths.ravel(), np.tile(angles, 2))
    np.testing.assert_allclose(found.centre, [30, -15], atol=1e-9)


@pytest.mark.parametrize("seed", range(20))
def test_the_minimum_zone_is_that_of_its_dual(seed: int) -> None:
    chance = random.Random(seed)
    count = chance.randint(4, 9)
    angles = sorted(chance.uniform(0, 2 * math.pi) for _ in range(count))
    paths = [
        [chance.gauss(0, 1) + 20 * math.cos(t - 1) for t in angles] for _ in range(chance.choice([1, 2]))
    ]
    points = [(t, r) for path in paths for t, r in zip(angles, path, strict=True)]
    zone = find_minimum_zone(np.array([r for _, r in points]), np.array([t for t, _ in points]))
    assert float(zone.width) == pytest.approx(minimum_zone_width(points), rel=1e-9)


@pytest.mark.parametrize("apart", [0.1, 3.0, 30.0])
def test_two_paths_far_apart_are_held_by_the_widest_gap_at_least(apart: float) -> None:
    # Where one path lies outside and the other inside at every angle, four points by turns do not hold them.
    angles, noise = np.linspace(0, 2 * np.pi, 24, endpoint=False), np.random.default_rng(5)
    first = noise.normal(0, 0.2, 24)
    second = first + apart + noise.normal(0, 0.2, 24)
    zone = find_minimum_zone(np.concatenate([first, second]), np.tile(angles, 2))
    points = [(t, r) for path in (first, second) for t, r in zip(angles.tolist(), path.tolist(), strict=True)]
    assert float(zone.width) == pytest.approx(minimum_zone_width(points), rel=1e-9)
    assert zone.width >= np.abs(first - second).max() * (1 - 1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_the_circle_of_least_squares_is_that_of_the_normal_equations(seed: int) -> None:
    chance = random.Random(seed)
    points = [(chance.uniform(0, 6), chance.gauss(3, 5)) for _ in range(chance.randint(3, 40))]
    x, y, radius = least_squares(points)
    found = fit_least_squares_circle(np.array([r for _, r in points]), np.array([t for t, _ in points]))
    assert (*found.centre, found.radius) == pytest.approx((x, y, radius), rel=1e-8, abs=1e-8)


def a_path(seed: int, count: int = 90) -> tuple[np.ndarray, np.ndarray]:
    chance = np.random.default_rng(seed)
    angles = np.linspace(0, 2 * np.pi, count, endpoint=False)
    shape = sum(chance.normal() * np.cos(k * angles + chance.uniform(0, 6)) for k in range(2, 7))
    return angles, shape + chance.normal(0, 0.3, (2, count))


@settings(max_examples=25, deadline=None)
@given(
    seed=st.integers(0, 1000),
    turned=st.floats(0, 2 * np.pi),
    shift=st.tuples(st.floats(-50, 50), st.floats(-50, 50)),
    factor=st.floats(0.01, 100),
)
def test_neither_start_nor_set_up_nor_unit_changes_the_form(seed, turned, shift, factor) -> None:
    angles, paths = a_path(seed)
    before = parameters(paths, angles)
    turned_angles = np.mod(angles + turned, 2 * np.pi)
    order = np.argsort(turned_angles)
    rotated = parameters(paths[:, order], turned_angles[order])
    moved = parameters(paths + shift[0] * np.cos(angles) + shift[1] * np.sin(angles), angles)
    scaled = parameters(factor * paths, angles)
    for symbol, value in before.items():
        assert rotated[symbol] == pytest.approx(value, rel=1e-9, abs=1e-9), symbol
        assert moved[symbol] == pytest.approx(value, rel=1e-9, abs=1e-9), symbol
        assert scaled[symbol] == pytest.approx(factor * value, rel=1e-9, abs=1e-9 * factor), symbol


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 1000))
def test_both_senses_together_are_no_rounder_than_each(seed: int) -> None:
    angles, paths = a_path(seed)
    found = parameters(paths, angles)
    assert found["G_b"] >= max(found["G_ccw"], found["G_cw"]) - 1e-9
    flat = parameters(paths, angles, CALIBRATED.model_copy(update={"reference_circle": "least-squares"}))
    for symbol in ("G_ccw", "G_cw", "G_b"):
        assert found[symbol] <= flat[symbol] + 1e-9
    assert found["F_max_ccw"] - found["F_min_ccw"] == pytest.approx(flat["G_ccw"])


def test_without_a_calibrated_length_neither_radial_deviation_is_defined() -> None:
    angles, paths = circle_of_the_note(360)
    found = parameters(paths, angles, UNCALIBRATED)
    defined = {symbol for symbol, value in found.items() if not math.isnan(value)}
    assert defined == {"G_ccw", "G_cw", "G_b"}


@pytest.mark.parametrize(("sense", "other"), [("ccw", "cw"), ("cw", "ccw")])
def test_of_one_sense_there_is_the_form_of_this_sense_only(sense: str, other: str) -> None:
    angles, paths = circle_of_the_note(360)
    paths[["ccw", "cw"].index(other)] = np.nan
    found = parameters(paths, angles)
    defined = {symbol for symbol, value in found.items() if not math.isnan(value)}
    assert defined == {f"G_{sense}", f"F_max_{sense}", f"F_min_{sense}"}


def test_an_arc_has_no_mean_radius_and_radial_deviations_about_the_centre_of_the_set_up() -> None:
    angles, paths = circle_of_the_note(360)
    on_arc = angles < np.radians(220)
    found = parameters(paths[:, on_arc], angles[on_arc])
    assert math.isnan(found["D"])
    assert found["F_max_ccw"] == pytest.approx(paths[0, on_arc].max())
    assert found["G_ccw"] <= parameters(paths, angles)["G_ccw"]
    assert not is_full_turn(angles[on_arc])
    assert np.degrees(measure_covered_arc(angles[on_arc])) == pytest.approx(219.0)


def test_several_turns_are_one_mean_path() -> None:
    angles, paths = circle_of_the_note(360)
    scatter = np.random.default_rng(2).normal(0, 1, (2, 360, 4))
    scatter -= scatter.mean(axis=-1, keepdims=True)
    assert parameters(paths[..., np.newaxis] + scatter, angles) == pytest.approx(parameters(paths, angles))


def test_a_missing_reading_is_left_out_of_its_path_only() -> None:
    angles, paths = circle_of_the_note(360)
    paths[0, 100] = np.nan
    found = parameters(paths, angles)
    points = [(t, r) for t, r in zip(angles.tolist(), paths[0].tolist(), strict=True) if not math.isnan(r)]
    zone = find_zone_about(
        fit_least_squares_circle(np.array([r for _, r in points]), np.array([t for t, _ in points])).centre,
        np.array([r for _, r in points]),
        np.array([t for t, _ in points]),
    )
    assert found["G_ccw"] <= float(zone.width) + 1e-9
    assert found["G_cw"] == pytest.approx(parameters(circle_of_the_note(360)[1], angles)["G_cw"])


def test_a_shift_of_the_set_up_of_30_um_costs_three_nanometres() -> None:
    # The limaçon stands for a circle: e²/(2R), 0.003 µm at e = 30 µm and R = 150 mm.
    angles, radius, shift = np.linspace(0, 2 * np.pi, 720, endpoint=False), 150e3, 30.0
    true = shift * np.cos(angles) + np.sqrt(radius**2 - (shift * np.sin(angles)) ** 2) - radius
    found = parameters(np.array([true, true]), angles)
    assert found["G_b"] <= shift**2 / (2 * radius) * (1 + 1e-6)
    assert abs(found["D"]) <= shift**2 / (2 * radius)
