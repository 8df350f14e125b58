"""The evaluation of a step gauge against numbers worked by hand: two blocks, two cycles, in µm."""

from __future__ import annotations

import numpy as np
import pytest

from installed import registry
from zlmreport.plugin import FloatArray
from zlmreport.plugin.standard import position_statistics

STANDARD = registry().standard("step-gauge")
NAN = float("nan")
FORWARD = [[0.0, 2.0], [NAN, NAN], [4.0, 6.0], [NAN, NAN]]
BACKWARD = [[NAN, NAN], [1.0, 1.0], [NAN, NAN], [2.0, 6.0]]


def found() -> tuple[dict[str, float], dict[str, FloatArray]]:
    arithmetic = STANDARD.arithmetic(position_statistics(np.array([FORWARD, BACKWARD])), STANDARD.options())
    return {symbol: float(value) for symbol, value in arithmetic.parameters.items()}, dict(
        arithmetic.positions
    )


@pytest.mark.parametrize(
    ("symbol", "by_hand"),
    [
        ("W", 4.0),  # means 1, 1, 5, 4
        ("W_fwd", 4.0),
        ("W_bwd", 3.0),
        ("S2", 2 * 8**0.5),  # 2 and 6: s² = 8
        ("S2_fwd", 2 * 2**0.5),
        ("S2_bwd", 2 * 8**0.5),
        ("XR", 2.5),  # at the second face 1 − 3, at the third 2.5 − 5
        ("XR_mean", -2.25),
        ("B_mean", 2.25),
    ],
)
def test_a_parameter_is_the_one_worked_by_hand(symbol: str, by_hand: float) -> None:
    assert found()[0][symbol] == pytest.approx(by_hand)


@pytest.mark.parametrize(
    ("symbol", "by_hand"),
    [
        ("XF", [1.0, 3.0, 5.0, NAN]),
        ("XB", [NAN, 1.0, 2.5, 4.0]),
        ("XM", [NAN, 2.0, 3.75, NAN]),
        ("S2F", [2 * 2**0.5, 2 * 2**0.5, 2 * 2**0.5, NAN]),
        ("S2B", [NAN, 0.0, 8**0.5, 2 * 8**0.5]),
        ("XR", [NAN, -2.0, -2.5, NAN]),
        ("B", [NAN, 2.0, 2.5, NAN]),
    ],
)
def test_a_column_interpolates_between_neighbours_and_leaves_the_ends_open(
    symbol: str, by_hand: list[float]
) -> None:
    assert found()[1][symbol] == pytest.approx(by_hand, nan_ok=True)


def test_bandwidth_and_repeatability_are_of_measured_values_only() -> None:
    """An interpolated value lies between two measured ones and widens nothing."""
    parameters, columns = found()
    measured = np.array([1.0, 1.0, 5.0, 4.0])
    assert parameters["W"] == pytest.approx(np.ptp(measured))
    assert np.nanmax(columns["XF"]) <= measured.max()


def test_a_step_beside_a_missing_one_is_not_interpolated() -> None:
    forward = np.array([[1.0], [NAN], [NAN], [NAN], [5.0]])
    readings = position_statistics(np.array([forward, NAN * forward]))
    found = STANDARD.arithmetic(readings, STANDARD.options()).positions["XF"]
    assert np.isnan(found).tolist() == [False, True, True, True, False]
