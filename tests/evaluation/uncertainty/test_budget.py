"""Budgets: each formula against the rounded factors of workshops, and what all amount to together."""

from __future__ import annotations

import math

import numpy as np
import pytest

from evaluation.uncertainty.budgets import MICROMETRE, budget, contribution, expanded
from zlmreport.evaluation.uncertainty import wording
from zlmreport.evaluation.uncertainty.budget import (
    compute_effect_along,
    compute_expansion_range,
    compute_misalignment_range,
    compute_temperature_range,
    from_range,
)
from zlmreport.plugin import Language
from zlmreport.plugin.extension import Acts, Distribution
from zlmreport.plugin.renderer import Budget
from zlmreport.testing import simulated_test

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


SOME = Budget(
    (
        contribution(0.3, Acts.ALONG_THE_LENGTH),
        contribution(0.4, Acts.ALONG_THE_LENGTH),
        contribution(1.2, Acts.AT_EACH_READING),
    )
)
NOTHING = budget(0.0, Acts.ALONG_THE_LENGTH)


def test_contributions_add_by_their_squares() -> None:
    assert math.sqrt(SOME.variance(Acts.ALONG_THE_LENGTH)) == pytest.approx(0.5 * MICROMETRE)
    assert SOME.variance(Acts.AT_EACH_POSITION) == 0.0
    assert SOME.standard_uncertainty == pytest.approx(1.3 * MICROMETRE)


def test_shares_add_up_to_all() -> None:
    shares = [SOME.share(each) for each in SOME.contributions]

    assert shares == pytest.approx([0.09 / 1.69, 0.16 / 1.69, 1.44 / 1.69])


def test_an_error_along_the_length_grows_from_the_first_target_to_the_last() -> None:
    assert compute_effect_along(np.array([-0.1, 0.0, 0.3])) == pytest.approx([0.0, 0.25, 1.0])


def test_over_a_single_target_there_is_no_length() -> None:
    assert compute_effect_along(np.array([0.2])) == pytest.approx([0.0])


def test_a_budget_of_nothing_leaves_no_uncertainty() -> None:
    assert {each.uncertainty for each in expanded(NOTHING, simulated_test(), trials=20).values()} == {0.0}
    assert NOTHING.share(NOTHING.contributions[0]) == 0.0


def test_a_sign_of_an_angle_follows_its_number_at_once() -> None:
    assert wording.say_full_range("R", 0.1, "″").in_language(Language.GERMAN) == "R = 0,1″"
    assert (
        wording.say_expanded_uncertainty(0.5, "µm", 2).in_language(Language.ENGLISH) == "U = 0.5 µm (k = 2)"
    )
