"""What effects in question would do in the next test: readings that contradict nothing that is known."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from model.axis_tests import EFFECTS, INSTALLED, noise
from model.planning.planned import planned_job
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.fitting.fit import fit
from zlmreport.model.fitting.noise import NoiseSource, list_noise_parts
from zlmreport.model.planning.deciding import collect_experiment, make_deciding_job, make_question_of
from zlmreport.model.planning.experiment import Experiment, plan_next_experiment
from zlmreport.model.planning.methods import Method
from zlmreport.model.planning.plan import AxisPlan, ExpectedTest, Pause
from zlmreport.model.planning.rivals import Question, Rival
from zlmreport.model.planning.visibility import expect_design
from zlmreport.plugin import FloatArray, Language

SLOPE, SIGMA = 10e-6, 0.5e-6
PLAN = AxisPlan(np.linspace(0.03, 0.57, 10), Method.PENDULUM, runs=3)
EXPECTED = ExpectedTest(SIGMA, 0.02)
WARMER = replace(PLAN, after=Pause(3600.0, 3.0, "axis_temperature"))
TIED = ("scale-error", "scale-expansion")


@cache
def _question() -> Question:
    """Return which of two effects makes an axis at a steady 22 °C too long."""
    design = expect_design(planned_job().axis, PLAN, EXPECTED)
    temperature = design.conditions["axis_temperature"] + 2.0
    design = replace(design, conditions={"axis_temperature": temperature})
    deviation = SLOPE * design.position + noise(design, 3, SIGMA)
    base = fit(AxisModel((Term(EFFECTS["offset"]), Term(EFFECTS["backlash"]))), design, deviation)
    fits = [fit(base.model.with_effect(EFFECTS[name]), design, deviation) for name in TIED]
    return make_question_of(base, [Rival.of_fit(each, 0.5) for each in fits], fits)


def _second_sessions(truth: str) -> tuple[FloatArray, FloatArray]:
    """Return simulated readings of a second session 3 K warmer, and their positions."""
    question = _question()
    design = question.make_design(WARMER, EXPECTED)
    rival = question.rivals[TIED.index(truth)]
    readings = question.simulate_readings(
        design, list_noise_parts(design), rival, 50, np.random.default_rng(1)
    )
    own = design.session == 0
    assert question.first is not None
    np.testing.assert_array_equal(readings[~own], np.tile(question.first.deviation[:, np.newaxis], 50))
    return readings[own], design.position[own]


@pytest.mark.parametrize(("truth", "slope"), [("scale-error", SLOPE), ("scale-expansion", 2.5 * SLOPE)])
def test_second_session_shows_what_each_effect_makes_of_three_kelvins(truth: str, slope: float) -> None:
    readings, position = _second_sessions(truth)
    assert np.polyfit(position, readings.mean(axis=1), 1)[0] == pytest.approx(slope, rel=0.1)


def test_simulated_repeats_scatter_as_the_first_test_did() -> None:
    readings, _ = _second_sessions("scale-error")
    assert np.std(readings, axis=1).mean() == pytest.approx(SIGMA, rel=0.3)


def test_simulated_noise_is_drawn_from_what_the_readings_leave_open_of_it() -> None:
    for rival in _question().rivals:
        ratios = [each.ratios[NoiseSource.RUN] for each in rival.scatters]
        assert min(ratios) == 0.0
        assert max(ratios) > 0.0  # three runs do not exclude that they are displaced
        assert np.mean([each.sigma for each in rival.scatters]) == pytest.approx(SIGMA, rel=0.3)


def test_the_place_of_a_joint_is_drawn_from_the_whole_gap_between_two_targets() -> None:
    design = expect_design(planned_job().axis, PLAN, EXPECTED)
    deviation = np.where(design.position > 0.3, 10 * SIGMA, 0.0) + noise(design, 3, SIGMA)
    joint = Rival.of_fit(
        fit(AxisModel((Term(EFFECTS["offset"]), Term(EFFECTS["scale-joint"]))), design, deviation), 1.0
    )
    finer = expect_design(planned_job().axis, replace(PLAN, targets=np.linspace(0.03, 0.57, 55)), EXPECTED)
    grid, random = joint.effect.grid(finer), np.random.default_rng(1)
    steps = {
        float(finer.position[np.argmax(joint.sample_deviation(finer, grid, random) > 5 * SIGMA)])
        for _ in range(40)
    }
    assert len(steps) > 2
    assert 0.27 - 0.06 < min(steps) < max(steps) < 0.33 + 0.06


def test_temperatures_begin_as_in_the_first_session_and_three_kelvins_above() -> None:
    question = _question()
    assert question.first is not None
    first = question.first.design.conditions["axis_temperature"]
    again = question.make_design(PLAN, EXPECTED).conditions["axis_temperature"]
    assert again[0] == pytest.approx(first[0])
    design = question.make_design(WARMER, EXPECTED)
    warmer = design.conditions["axis_temperature"][design.session == 0]
    np.testing.assert_allclose(warmer - again, 3.0)


def test_a_test_without_times_is_not_held_together_with_another() -> None:
    question = _question()
    assert question.may_go_on
    assert question.first is not None
    counted = replace(question.first, design=replace(question.first.design, time_is_counted=True))
    assert not replace(question, first=counted).may_go_on
    assert not replace(question, first=None).may_go_on


@cache
def _experiment() -> Experiment:
    return plan_next_experiment(_question(), PLAN, EXPECTED, INSTALLED, 1)


def test_a_method_that_knows_no_pause_is_followed_by_a_warmer_session() -> None:
    found = _experiment()
    assert found.plan is not None
    assert found.plan.after is not None
    assert found.plan.after.change == 3.0
    assert found.decides >= 0.95
    assert found.minutes == pytest.approx((found.plan.after.duration + PLAN.duration) / 60)
    assert "3 K warmer or colder" in found.statement.in_language(Language.ENGLISH)


@pytest.mark.long
def test_job_of_a_second_session_names_the_first() -> None:
    job = planned_job()
    assert make_deciding_job(_experiment(), job, "../job.yaml")["model"] == {"sessions": ["../job.yaml"]}
    assert collect_experiment(_experiment(), job, Language.ENGLISH)["job"]["model"]["sessions"] == [
        "job.yaml"
    ]
