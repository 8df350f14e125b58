"""Each formula of the budget, against the rounded factors that workshops use for k = 2."""

from __future__ import annotations

import math

import pytest

from zlmreport.evaluation.uncertainty.budget import (
    compute_expansion_range,
    compute_misalignment_range,
    compute_temperature_range,
    from_range,
)
from zlmreport.plugin.extension import Distribution

RECTANGULAR = Distribution.RECTANGULAR
#: 0.6 stands for 2/√12 = 0.577.
ROUNDED = 0.04


@pytest.mark.parametrize(
    ("distribution", "divisor"),
    [
        (Distribution.RECTANGULAR, math.sqrt(12)),
        (Distribution.TRIANGULAR, math.sqrt(24)),
        (Distribution.ONE_SIDED, math.sqrt(3)),
        (Distribution.NORMAL, math.inf),
    ],
)
def test_a_range_is_divided_by_what_its_distribution_asks(distribution: Distribution, divisor: float) -> None:
    assert from_range(1.0, distribution) == pytest.approx(1 / divisor, rel=1e-15)


def test_a_cosine_error_reaches_half_the_square_of_the_misalignment_over_the_length() -> None:
    # The exact L − √(L² − R²), for 1 mm over 500 mm: the next term is (R/L)²/4 of it.
    exact = 0.5 - math.sqrt(0.5**2 - 0.001**2)

    assert compute_misalignment_range(1e-3, 0.5) == pytest.approx(exact, rel=(1e-3 / 0.5) ** 2)


def test_the_expanded_uncertainty_of_a_cosine_error_about_its_mean_is_0_3_r_squared_over_l() -> None:
    # R = 1 mm, L = 1 m, as stated about the middle of the range: 0.3 µm.
    about_mean = 2 * compute_misalignment_range(1e-3, 1.0) / math.sqrt(12)

    assert about_mean == pytest.approx(0.3e-6, rel=ROUNDED)


def test_a_single_target_has_no_length_that_could_be_misaligned() -> None:
    assert compute_misalignment_range(1e-3, 0.0) == 0.0


def test_the_temperature_measurement_contributes_0_6_alpha_l_r() -> None:
    # α = 12 µm/(m·K), L = 1.5 m, R(θ) = 0.5 K.
    found = 2 * from_range(compute_temperature_range(12e-6, 1.5, 0.5), RECTANGULAR)

    assert found == pytest.approx(0.6 * 12e-6 * 1.5 * 0.5, rel=ROUNDED)


def test_the_expansion_coefficient_contributes_0_6_l_delta_t_r() -> None:
    # L = 1.5 m, ΔT = −3 K, R(α) = 2 µm/(m·K).
    found = 2 * from_range(compute_expansion_range(1.5, -3.0, 2e-6), RECTANGULAR)

    assert found == pytest.approx(0.6 * 1.5 * 3.0 * 2e-6, rel=ROUNDED)


def test_a_negative_coefficient_contributes_as_much_as_a_positive_one() -> None:
    assert compute_temperature_range(-1e-6, 1.0, 0.5) == compute_temperature_range(1e-6, 1.0, 0.5)
