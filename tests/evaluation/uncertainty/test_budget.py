"""Budgets: what their contributions amount to together."""

from __future__ import annotations

import math

import numpy as np
import pytest

from evaluation.uncertainty.budgets import MICROMETRE, budget, contribution, expanded
from zlmreport.evaluation.uncertainty import wording
from zlmreport.evaluation.uncertainty.budget import compute_effect_along
from zlmreport.plugin import Language
from zlmreport.plugin.extension import Acts
from zlmreport.plugin.renderer import Budget
from zlmreport.testing import simulated_test

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
