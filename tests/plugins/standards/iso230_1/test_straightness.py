"""Straightness by three reference lines: printed numbers, an independent search, and what must not matter."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from hypothesis.extra.numpy import arrays

from installed import registry
from plugins.standards.iso230_1.lines import evaluated, hp, line, values
from zlmreport.plugin import Language
from zlmreport.plugin.standard import Arithmetic, position_statistics

STANDARD = registry().standard("iso230-1:2012")
LINES = ("least-squares", "end-points", "minimum-zone")


def arithmetic(x: np.ndarray, y: np.ndarray, kind: str) -> Arithmetic:
    """Return what the standard computes of readings in one direction, (..., position), m."""
    readings = np.stack([y, np.full_like(y, np.nan)], axis=-2)[..., np.newaxis]
    options = STANDARD.options.model_validate({"reference_line": kind, "window": 0})
    return STANDARD.arithmetic(position_statistics(readings, x), options)


def straightness(x: np.ndarray, y: np.ndarray, kind: str) -> np.ndarray:
    return arithmetic(x, y, kind).parameters[STANDARD.quantities[0].symbol]


def slope(x: np.ndarray, y: np.ndarray, kind: str) -> np.ndarray:
    return arithmetic(x, y, kind).parameters["slope"]


def residuals(x: np.ndarray, y: np.ndarray, kind: str) -> np.ndarray:
    return arithmetic(x, y, kind).positions["d"]


@pytest.mark.parametrize(
    ("axis", "kind", "printed_slope", "computed_slope", "span"),
    [
        (1, "end-points", 8.3, 8.33333, 0.86667),
        (1, "least-squares", 7.65, 7.65455, 0.70364),
        (1, "minimum-zone", None, 7.83333, 0.65000),
        (2, "end-points", -18.44, -18.44444, 1.28889),
        (2, "least-squares", -17.42, -17.41818, 1.08364),
        (2, "minimum-zone", None, -16.66667, 0.93333),
    ],
)
def test_the_printed_lines_have_the_printed_slopes(
    axis: int, kind: str, printed_slope: float | None, computed_slope: float, span: float
) -> None:
    found = values(line("EYX", *hp(axis)), reference_line=kind)
    assert found["slope"] == pytest.approx(computed_slope, abs=5e-6)
    assert found["EYX"] == pytest.approx(span, abs=5e-6)
    if printed_slope is not None:
        assert found["slope"] == pytest.approx(printed_slope, abs=0.05)


def smallest_zone(x: np.ndarray, y: np.ndarray) -> float:
    """Return the width of the minimum zone: that of the best line through any two points."""
    slopes = [(y[j] - y[i]) / (x[j] - x[i]) for i, j in itertools.combinations(range(len(x)), 2)]
    return min(float(np.ptp(y - each * x)) for each in slopes)


CURVES = st.integers(3, 14).flatmap(
    lambda number: st.tuples(
        st.lists(st.integers(1, 400), min_size=number - 1, max_size=number - 1),
        arrays(np.float64, number, elements=st.integers(-500, 500).map(lambda each: each * 1e-8)),
    )
)


def placed(curve: tuple[list[int], np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    steps, y = curve
    return np.concatenate(([0.0], np.cumsum(steps))) * 1e-3, y


@given(CURVES)
def test_the_minimum_zone_is_that_of_the_best_line_through_two_points(
    curve: tuple[list[int], np.ndarray],
) -> None:
    x, y = placed(curve)
    assert straightness(x, y, "minimum-zone") == pytest.approx(smallest_zone(x, y), abs=1e-18, rel=1e-9)


@given(CURVES)
def test_no_line_has_a_smaller_span_than_the_minimum_zone(curve: tuple[list[int], np.ndarray]) -> None:
    x, y = placed(curve)
    zone = straightness(x, y, "minimum-zone")
    for kind in ("least-squares", "end-points"):
        assert zone <= straightness(x, y, kind) * (1 + 1e-9) + 1e-18


@given(CURVES, st.integers(-300, 300), st.integers(-900, 900), st.sampled_from(LINES))
def test_a_line_that_is_shifted_and_tilted_is_as_straight(
    curve: tuple[list[int], np.ndarray], offset: int, tilt: int, kind: str
) -> None:
    x, y = placed(curve)
    moved = y + offset * 1e-7 + tilt * 1e-7 * x
    assert straightness(x, moved, kind) == pytest.approx(straightness(x, y, kind), abs=1e-15)
    assert slope(x, moved, kind) == pytest.approx(slope(x, y, kind) + tilt * 1e-7, abs=1e-13)


@given(CURVES, st.integers(2, 9), st.sampled_from(LINES))
def test_a_line_that_is_scaled_is_as_many_times_less_straight(
    curve: tuple[list[int], np.ndarray], factor: int, kind: str
) -> None:
    x, y = placed(curve)
    assert straightness(x, factor * y, kind) == pytest.approx(factor * straightness(x, y, kind), abs=1e-15)


@given(CURVES, st.sampled_from(LINES))
def test_a_line_that_is_seen_from_its_other_end_is_as_straight(
    curve: tuple[list[int], np.ndarray], kind: str
) -> None:
    x, y = placed(curve)
    assert straightness((x[-1] - x)[::-1], y[::-1], kind) == pytest.approx(
        straightness(x, y, kind), abs=1e-15
    )


@settings(max_examples=30)
@given(
    arrays(np.float64, (5, 7), elements=st.one_of(st.just(np.nan), st.integers(-99, 99).map(float))),
    st.sampled_from(LINES),
)
def test_missing_positions_are_as_if_they_had_not_been_measured(curves: np.ndarray, kind: str) -> None:
    x = np.array([0.0, 0.1, 0.25, 0.4, 0.62, 0.8, 1.0])
    of_stack = straightness(x, curves, kind)
    for curve, found in zip(curves, of_stack, strict=True):
        there = ~np.isnan(curve)
        alone = straightness(x[there], curve[there], kind) if there.sum() > 2 else np.nan
        assert found == pytest.approx(float(alone), nan_ok=True, abs=1e-12)


def test_unevenly_spaced_positions_on_an_exact_line_are_straight() -> None:
    positions = np.array([0.0, 20.0, 50.0, 300.0, 310.0, 900.0])
    found = values(line("EYX", positions, 3.0 + 0.01 * positions))
    assert found["EYX"] == pytest.approx(0.0, abs=1e-9)
    assert found["slope"] == pytest.approx(10.0)


def test_two_positions_tell_nothing_of_straightness() -> None:
    evaluation = evaluated(line("EYX", [0.0, 900.0], [0.0, 7.0]))
    assert [each.quantity.symbol for each in evaluation.parameters] == []
    assert any(
        each.met is False and "3 positions" in each.requirement.in_language(Language.ENGLISH)
        for each in evaluation.findings
    )


@pytest.mark.parametrize("kind", LINES)
def test_directions_and_runs_have_lines_of_their_own(kind: str) -> None:
    positions = np.linspace(0, 800, 9)
    bow = 4e-6 * positions * (800 - positions)
    up = np.stack([bow + 0.5, bow * 1.2 + 0.002 * positions], axis=1)
    down = np.stack([bow * 0.5 - 0.5, bow * 0.7 - 0.003 * positions], axis=1)

    found = values(line("EYX", positions, up, down), reference_line=kind, window=0)

    whole = values(line("EYX", positions, bow), reference_line=kind)["EYX"]
    assert found["EYX_fwd"] == pytest.approx(1.1 * whole)
    assert found["EYX_bwd"] == pytest.approx(0.6 * whole)
    assert found["EYX"] == pytest.approx(0.85 * whole)
    assert found["EYX_run"] == pytest.approx(1.2 * whole)
    assert "EYX_local" not in found


def test_the_worst_part_is_found_about_its_own_line() -> None:
    positions = np.arange(0.0, 1001.0, 100.0)
    step = np.where(positions == 600.0, 2.0, 0.0)  # one point 2 µm aside: of any part of 300 mm the worst
    found = values(line("EYX", positions, step + 0.02 * positions), reference_line="end-points", window=300)
    assert found["EYX_local"] == pytest.approx(2.0)
    short = values(line("EYX", positions[:4], step[:4]), reference_line="end-points", window=300)
    assert "EYX_local" not in short


def test_what_is_drawn_is_zero_on_the_line() -> None:
    x = np.linspace(0, 1, 6)
    y = np.array([2.0, 3.0, 1.0, 4.0, 1.0, 5.0])
    assert residuals(x, y, "end-points")[[0, -1]] == pytest.approx([0.0, 0.0])
    assert residuals(x, y, "least-squares").sum() == pytest.approx(0.0, abs=1e-12)
    zone = residuals(x, y, "minimum-zone")
    assert zone.max() == pytest.approx(-zone.min())
