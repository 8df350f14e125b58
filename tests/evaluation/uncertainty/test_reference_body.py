"""Straightness held against a body that may be bent: that is a slope, whatever the number of positions."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from evaluation.uncertainty.budgets import MICROMETRE, contribution
from zlmreport.evaluation.evaluate import evaluate
from zlmreport.evaluation.uncertainty.budget import Acts, Budget
from zlmreport.evaluation.uncertainty.monte_carlo import propagate
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.error_symbol import evaluate_for_error
from zlmreport.measurement.measurand import STRAIGHTNESS
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import bidirectional_test


def of_a_straightness(positions: int) -> tuple[float, float]:
    """Return U of the straightness and of its slope, in the instrument's U, over 1 m by so many positions."""
    at = np.linspace(0, 1000, positions)
    flat = 0.01 * np.sin(at / 50)[:, np.newaxis]
    line = bidirectional_test(at, flat, flat, axis=Axis("X", quantity=STRAIGHTNESS, error="EYX"))
    standard = evaluate_for_error(find_plugins().standard("iso230-1:2012"), "EYX")
    options = standard.options()
    evaluation = evaluate(standard, line, options, {})
    mirror = replace(contribution(0.5, Acts.AT_EACH_POSITION), contributor="instrument")
    (found,) = propagate(
        Budget((mirror,), of_the_instrument=MICROMETRE),
        [(evaluation, partial(standard.arithmetic, options=options))],
        4000,
    )
    return found["EYX"].uncertainty / MICROMETRE, found["slope"].uncertainty / MICROMETRE


def test_a_slope_against_a_bent_body_is_not_known_the_better_the_more_positions_there_are() -> None:
    """Half a wave √2·u·cos(π·s) has the slope 12·√2·2/π²·u = 3.44·u over its length; u is half of U."""
    few, many = (of_a_straightness(positions)[1] for positions in (11, 101))
    assert many == pytest.approx(3.44 / 2, rel=0.02)
    assert few == pytest.approx(many, rel=0.1)


def test_the_bend_of_a_body_leaves_the_straightness_what_errors_one_by_one_make_of_it() -> None:
    """The range of eleven independent errors, 3.2·u by tables, is more than that of half a wave."""
    assert 3.2 / 2 < of_a_straightness(11)[0] < 5.0 / 2
