"""Along which curves an instrument errs: waves, and a bend of a body, which leaves a slope in any plan."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from evaluation.uncertainty.budgets import MICROMETRE, contribution
from installed import registry
from zlmreport.evaluation.uncertainty.instrument_curves import CurveForm, list_forms, sample_waves
from zlmreport.evaluation.uncertainty.monte_carlo import Expanded, propagate
from zlmreport.plugin import STRAIGHTNESS, Axis, Evaluation, FloatArray, Measurand, error_named
from zlmreport.plugin.extension import Acts
from zlmreport.plugin.renderer import Budget
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import bidirectional_test


def evaluate_straightness(
    at: FloatArray, deviation: FloatArray, error: float, trials: int
) -> tuple[Evaluation, Mapping[str, Expanded]]:
    """Return the straightness of a line and its U; `error`: u of the body it is held against, µm."""
    readings = deviation[:, np.newaxis]
    line = bidirectional_test(at, readings, readings, axis=Axis("X", quantity=STRAIGHTNESS, error="EYX"))
    standard = registry().standard("iso230-1:2012").of_error(error_named("EYX"))
    options = standard.options()
    evaluation = evaluate(standard, line, options, {})
    mirror = replace(contribution(error, Acts.AT_EACH_POSITION), contributor="instrument")
    (found,) = propagate(
        Budget((mirror,), of_the_instrument=2 * error * MICROMETRE),
        [(evaluation, partial(standard.arithmetic, options=options))],
        trials,
    )
    return evaluation, found


def of_a_straightness(positions: int) -> tuple[float, float]:
    """Return U of the straightness and of its slope, in the instrument's U, over 1 m by so many positions."""
    at = np.linspace(0, 1000, positions)
    _, found = evaluate_straightness(at, 0.01 * np.sin(at / 50), 0.5, 6000)
    return found["EYX"].uncertainty / MICROMETRE, found["slope"].uncertainty / MICROMETRE


def test_a_slope_against_a_bent_body_is_not_known_the_better_the_more_positions_there_are() -> None:
    """Half a wave √2·u·cos(π·s) has the slope 12·√2·2/π²·u = 3.44·u over its length; u is half of U."""
    few, many = (of_a_straightness(positions)[1] for positions in (11, 101))
    assert many == pytest.approx(3.44 / 2, rel=0.02)
    assert few == pytest.approx(many, rel=0.1)


def test_the_bend_of_a_body_leaves_the_straightness_what_errors_one_by_one_make_of_it() -> None:
    """The range of eleven independent errors, 3.2·u by tables, is more than that of half a wave."""
    assert 3.2 / 2 < of_a_straightness(11)[0] < 5.0 / 2


@pytest.mark.parametrize(
    ("quantity", "contributor", "asked"),
    [
        (STRAIGHTNESS, "instrument", tuple(CurveForm)),
        (STRAIGHTNESS, None, (CurveForm.AT_EACH_POSITION,)),
        (None, "instrument", (CurveForm.AT_EACH_POSITION, CurveForm.WAVES)),
        (None, None, (CurveForm.AT_EACH_POSITION,)),
    ],
    ids=["straightness", "straightness, of something else", "positions", "positions, of something else"],
)
def test_waves_are_asked_of_an_instrument_and_a_bend_of_a_body_that_lines_are_held_against(
    quantity: Measurand | None, contributor: str | None, asked: tuple[CurveForm, ...]
) -> None:
    at, flat = np.linspace(0, 1000, 5), np.zeros((5, 1))
    axis = Axis("X", quantity=quantity, error="EYX") if quantity else Axis("X")
    error = replace(contribution(0.5, Acts.AT_EACH_POSITION), contributor=contributor)
    assert list_forms(Budget((error,)), bidirectional_test(at, flat, flat, axis=axis)) == asked


def test_u_of_a_range_holds_an_instrument_that_errs_by_a_wave() -> None:
    """Of an axis like one wave, too; drawn here anew. Independent errors alone would give less."""
    at = np.linspace(0, 1000, 11)
    curve = 4.0 * np.sin(2 * np.pi * at / 1000 + 0.3)
    readings = curve[:, np.newaxis]
    test = bidirectional_test(at, readings, readings)
    standard = registry().standard("iso230-2:2014")
    options = standard.options()
    laser = replace(contribution(0.5, Acts.AT_EACH_POSITION), contributor="instrument")
    (found,) = propagate(
        Budget((laser,)),
        [(evaluate(standard, test, options, {}), partial(standard.arithmetic, options=options))],
        6000,
    )
    generator = np.random.default_rng(5)
    phase = 2 * np.pi * generator.random((40_000, 1))
    half_waves = generator.choice((2, 4), (40_000, 1))
    waves = 0.5 * math.sqrt(2) * np.sin(np.pi * half_waves * at / 1000 + phase)
    least = np.quantile(np.abs(np.ptp(curve + waves, axis=1) - np.ptp(curve)), 0.9545)
    assert found["E"].uncertainty / MICROMETRE >= 0.98 * least
    alone = 0.5 * generator.standard_normal((40_000, 11))
    assert np.quantile(np.abs(np.ptp(curve + alone, axis=1) - np.ptp(curve)), 0.9545) < 0.95 * least


def test_waves_have_the_stated_size_at_each_position_whatever_their_number() -> None:
    for form in (CurveForm.BEND, CurveForm.WAVES):
        drawn = sample_waves(form, np.linspace(0, 1, 7), 40_000, np.random.default_rng(3))
        assert np.sqrt(np.mean(drawn**2, axis=0)) == pytest.approx(np.ones(7), rel=0.02)
        assert np.abs(drawn).max() <= math.sqrt(2)


def test_an_error_of_each_position_has_no_half_waves_in_any_version_of_python() -> None:
    assert [form.half_waves for form in CurveForm] == [(), (1,), (2, 4)]
