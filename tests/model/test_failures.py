"""Where a model fails: each test sees what it is for, is blind to what it says, and keeps quiet otherwise."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache

import numpy as np
import pytest

from model.axis_tests import SIGMA, USUAL, hidden, known, linear_test, model_of, noise, pendulum_test
from zlmreport.model.diagnosis.residual_tests import find_failures, report_flagged, run_residual_tests
from zlmreport.model.diagnosis.residuals import Failure, ResidualTest, find_residuals_of
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.model.fitting.blunders import find_outliers
from zlmreport.model.fitting.fit import Assumptions, fit
from zlmreport.model.fitting.observations import select_readings
from zlmreport.plugin import FloatArray, Language
from zlmreport.plugin.effect import Design

DESIGN = linear_test()


def _tests(
    added: FloatArray | float = 0.0, *, model: AxisModel = USUAL, design: Design = DESIGN
) -> dict[ResidualTest, Failure]:
    fitted = fit(model, design, known(design) + noise(design) + added, Assumptions(parts=()))
    found: dict[ResidualTest, Failure] = {}
    for each in run_residual_tests(find_residuals_of(fitted, fitted.noise)):
        if each.test not in found or each.p_value < found[each.test].p_value:
            found[each.test] = each
    return found


def _english(failure: Failure) -> str:
    return failure.statement.in_language(Language.ENGLISH)


def _where(failure: Failure) -> str:
    return failure.where.in_language(Language.ENGLISH)


@cache
def _by_chance() -> Mapping[ResidualTest, FloatArray]:
    """Return the p-values of tests of axes of which the model is true; the least where there are several."""
    design = linear_test(11, 4)
    found: dict[ResidualTest, list[float]] = {}
    for seed in range(TRIALS):
        fitted = fit(USUAL, design, known(design) + noise(design, 1000 + seed), Assumptions(parts=()))
        for each in run_residual_tests(find_residuals_of(fitted, fitted.noise)):
            found.setdefault(each.test, []).append(each.p_value)
    return {test: np.array(values) for test, values in found.items()}


QUIET = _tests()
TRIALS = 120


@pytest.mark.parametrize("test", QUIET)
def test_where_nothing_is_missing_every_test_is_passed(test: ResidualTest) -> None:
    assert QUIET[test].p_value > 0.005


def test_no_passed_test_is_a_failure() -> None:
    assert find_failures(tuple(QUIET.values())) == ()


@pytest.mark.parametrize("test", QUIET)
@pytest.mark.parametrize("level", [0.05, 0.25])
def test_chance_fails_a_test_no_more_often_than_is_stated(test: ResidualTest, level: float) -> None:
    p_values = _by_chance()[test]
    deviation = math.sqrt(level * (1 - level) / TRIALS)
    assert np.mean(p_values < level) <= level + 3 * deviation


@pytest.mark.parametrize(
    "test",
    [ResidualTest.LACK_OF_FIT, ResidualTest.RUNS, ResidualTest.TIME_ORDER, ResidualTest.SPREAD],
    ids=lambda test: test.value,
)
def test_p_values_of_a_single_question_are_uniform(test: ResidualTest) -> None:
    p_values = _by_chance()[test]
    # The mean of n uniform values has the standard deviation √(1/(12·n)).
    assert np.mean(p_values) == pytest.approx(0.5, abs=3 * math.sqrt(1 / (12 * TRIALS)))


def test_means_off_the_model_are_no_chance() -> None:
    found = _tests(hidden(DESIGN, "scale-kink", [0.5], size=2.0))[ResidualTest.LACK_OF_FIT]
    assert found.p_value < 1e-12
    assert "deviate from the model by up to" in _english(found)
    assert _where(found).startswith("largest at ")


def test_a_failure_points_at_the_readings_that_it_names() -> None:
    cell = _tests(hidden(DESIGN, "scale-kink", [0.5], size=2.0))[ResidualTest.LACK_OF_FIT].readings
    assert len(cell) == 5
    assert len({(DESIGN.target[each], DESIGN.direction[each]) for each in cell.tolist()}) == 1
    run = _tests(np.where(DESIGN.run == 4, 3 * SIGMA, 0.0))[ResidualTest.RUNS].readings
    assert run.tolist() == np.flatnonzero(DESIGN.run == 4).tolist()
    uneven = noise(DESIGN, 5) * np.where(DESIGN.target == 12, 6.0, 0.0)
    target = _tests(uneven)[ResidualTest.SPREAD].readings
    assert target.tolist() == np.flatnonzero(DESIGN.target == 12).tolist()


def test_a_failure_of_all_readings_points_at_none() -> None:
    found = _tests(hidden(DESIGN, "screw-pitch", [0.01], size=2.0))[ResidualTest.PERIOD_IN_POSITION]
    assert found.readings.size == 0


def test_lack_of_fit_is_blind_to_drift_in_the_linear_method() -> None:
    found = _tests(hidden(DESIGN, "thermal-drift", [700.0], size=1.0))
    assert found[ResidualTest.LACK_OF_FIT].p_value > 0.05
    assert found[ResidualTest.TIME_ORDER].p_value < 0.005


def test_drift_is_said_with_its_size() -> None:
    drift = 6e-6 * DESIGN.time / DESIGN.duration
    found = _tests(drift)[ResidualTest.TIME_ORDER]
    # Two thirds of 6 µm, less what the cubic takes; σ of a third of the readings is 0.1 µm.
    assert float(_english(found).split("by ")[1].split(" µm")[0]) == pytest.approx(4.0, abs=0.4)


def test_what_is_there_in_the_middle_alone_comes_and_goes() -> None:
    found = _tests(5e-6 * (DESIGN.run == 3))[ResidualTest.TIME_ORDER]
    before, _, after = _english(found).partition(", by ")
    assert before.endswith("something comes and goes with time")
    # Three fifths of the middle third are displaced by 5 µm.
    assert float(after.split(" µm")[0]) == pytest.approx(3.0, abs=0.3)


def test_what_moves_while_each_target_is_visited_has_no_size_over_the_test() -> None:
    """In each third of the test stand all repeats of its targets: their mean is nought, but for rounding."""
    design = pendulum_test(targets=21, runs=5)
    first = 4e-6 * np.exp(-(design.run - 1.0))
    found = _tests(first, design=design)[ResidualTest.TIME_ORDER]
    assert found.p_value < 0.005
    assert _english(found).endswith("alike: something moves while a target is visited again and again")


def test_a_wave_is_no_larger_than_what_was_seen_of_it() -> None:
    # Of a straight line on eleven targets a wave of nearly two distances describes most, and is far larger.
    design = pendulum_test(11, 5)
    slope = 40e-6 * design.position
    fitted = fit(model_of("offset"), design, slope + noise(design), Assumptions(parts=()))
    tests = run_residual_tests(find_residuals_of(fitted, fitted.noise))
    (found,) = (each for each in tests if each.test is ResidualTest.PERIOD_IN_POSITION)
    amplitude = float(_where(found).partition("amplitude ")[2].partition(" µm")[0])
    assert amplitude <= 1.05e6 * np.abs(fitted.residual).max()


def test_the_residual_repeats_with_the_pitch() -> None:
    found = _tests(hidden(DESIGN, "screw-pitch", [0.01], size=2.0))[ResidualTest.PERIOD_IN_POSITION]
    assert found.p_value < 0.005
    assert _english(found) == "the residual repeats every 10.0 mm"
    assert found.statement.in_language(Language.GERMAN) == "das Residuum wiederholt sich alle 10,0 mm"
    # Two harmonics of the same amplitude: together their root mean square is that amplitude.
    amplitude = float(_where(found).partition("amplitude ")[2].partition(" µm")[0])
    assert amplitude == pytest.approx(2.0 * SIGMA * 1e6, rel=0.2)


def test_the_residual_repeats_in_time() -> None:
    # By this linear method the axis itself comes back every 400 s: what the model takes must not mislead.
    found = _tests(hidden(DESIGN, "time-periodic", [400.0], size=2.0))[ResidualTest.PERIOD_IN_TIME]
    assert found.p_value < 0.005
    assert float(_english(found).split("every ")[1].split(" s")[0]) == pytest.approx(400.0, abs=5.0)
    assert _where(found).startswith("during the whole test, amplitude ")


def test_a_gap_between_the_directions_is_said_with_its_size() -> None:
    model = model_of("polynomial")
    # The known backlash is −3 µm; the difference of two means of 105 readings is known to 0.11 µm.
    for gap, higher, lower in ((4e-6, "upwards", "downwards"), (2e-6, "downwards", "upwards")):
        found = _tests(gap / 2 * DESIGN.direction, model=model)[ResidualTest.DIRECTION]
        assert found.p_value < 1e-6
        before, _, after = _english(found).partition(" the residuals lie ")
        size, unit, *_, than = after.split()
        assert (before, unit, than) == (higher, "µm", lower)
        assert float(size) == pytest.approx(1.0, abs=0.25)


def test_a_gap_that_grows_along_the_axis_is_told_from_a_constant_one() -> None:
    found = _tests(hidden(DESIGN, "backlash-gradient", size=2.0))[ResidualTest.DIRECTION]
    assert _english(found) == "the difference between up and down changes with the position"


def test_a_run_that_stands_off_is_named() -> None:
    found = _tests(np.where(DESIGN.run == 4, 3 * SIGMA, 0.0))[ResidualTest.RUNS]
    assert found.p_value < 1e-6
    assert _where(found) == "run 4"
    # 2.4 µm, less the mean over the five runs; a run's 42 readings know their mean to 0.12 µm.
    assert float(_english(found).split("up to ")[1].split(" µm")[0]) == pytest.approx(1.92, abs=0.3)


def test_the_condition_that_the_residuals_follow_is_named() -> None:
    found = _tests(hidden(DESIGN, "screw-expansion", size=2.0))[ResidualTest.CONDITION]
    assert found.p_value < 1e-6
    assert _where(found) == "screw_temperature"


def test_signs_that_last_are_no_chance() -> None:
    found = _tests(hidden(DESIGN, "scale-kink", [0.5], size=3.0))[ResidualTest.SIGNS]
    assert found.p_value < 0.01


def test_scatter_that_differs_is_said_with_its_place() -> None:
    uneven = noise(DESIGN, 5) * np.where(DESIGN.target == 12, 6.0, 0.0)
    found = _tests(uneven)[ResidualTest.SPREAD]
    assert found.p_value < 0.01
    assert _where(found) == f"most at {1e3 * DESIGN.position[DESIGN.target == 12][0]:.1f} mm"


def test_failures_stand_in_the_order_of_their_clearness() -> None:
    found = find_failures(tuple(_tests(hidden(DESIGN, "screw-pitch", [0.01], size=3.0)).values()))
    assert [each.p_value for each in found] == sorted(each.p_value for each in found)
    assert found[0].test is ResidualTest.LACK_OF_FIT


def test_a_reading_that_was_set_aside_is_named_with_target_direction_and_run() -> None:
    readings = known(DESIGN) + noise(DESIGN)
    readings[30] += 20 * SIGMA
    found = report_flagged(DESIGN, find_outliers(DESIGN, readings))
    assert found is not None
    assert _where(found) == f"at {1e3 * DESIGN.position[30]:.1f} mm, ↓, run 1"
    assert not math.isnan(found.p_value)


def test_nothing_is_said_where_nothing_was_set_aside() -> None:
    assert report_flagged(DESIGN, find_outliers(DESIGN, noise(DESIGN))) is None


@pytest.mark.parametrize("design", [linear_test(5, 1), pendulum_test(7, 2)], ids=["one run", "two runs"])
def test_small_tests_have_the_tests_that_they_allow(design: Design) -> None:
    model = AxisModel(model_of("offset", "scale-error", "backlash").terms)
    fitted = fit(model, design, known(design) + noise(design))
    found = {each.test for each in run_residual_tests(find_residuals_of(fitted, fitted.noise))}
    has_repeats = len(np.unique(design.run)) > 1
    assert (ResidualTest.TIME_ORDER in found) is has_repeats
    assert (ResidualTest.RUNS in found) is has_repeats


@pytest.mark.parametrize("test", ResidualTest)
def test_every_test_says_what_it_is(test: ResidualTest) -> None:
    assert test.title.in_language(Language.ENGLISH) != test.title.in_language(Language.GERMAN)


def test_a_test_without_direction_has_none_to_compare() -> None:
    design = linear_test(9, 3)
    up = np.flatnonzero(design.direction > 0)
    one_way = select_readings(design, up)
    fitted = fit(model_of("offset", "scale-error"), one_way, (known(design) + noise(design))[up])
    assert ResidualTest.DIRECTION not in {
        each.test for each in run_residual_tests(find_residuals_of(fitted, fitted.noise))
    }
