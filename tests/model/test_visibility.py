"""What a plan can see of each effect, and what it hides, before anything is measured."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model.axis_tests import (
    EFFECTS,
    INSTALLED,
    PITCH,
    SIGMA,
    USUAL,
    hidden,
    linear_test,
    noise,
    pendulum_test,
)
from zlmreport.model.diagnosis.contest import Contest
from zlmreport.model.diagnosis.null_distribution import Scores, simulate_null
from zlmreport.model.diagnosis.trials import Trials
from zlmreport.model.diagnosis.visibility import Visibility, plan_visibility
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.plugin.effect import Design

DESIGN = linear_test(11, 4)
SETS = 300


def _seen(
    design: Design = DESIGN, *effects: str, model: AxisModel = USUAL, sigma: float = SIGMA
) -> Visibility:
    """Return the visibility of one effect; the plan is judged for all effects unless some are named."""
    (found,) = plan_visibility(model, design, [EFFECTS[each] for each in effects], sigma)
    return found


def test_a_regular_grid_on_multiples_of_the_pitch_cannot_see_the_pitch() -> None:
    regular = replace(DESIGN, position=np.round(DESIGN.position / PITCH) * PITCH)
    assert _seen(DESIGN, "screw-pitch").share > 0.5
    hidden_ = _seen(regular, "screw-pitch")
    assert hidden_.share < 1e-6
    assert hidden_.smallest_rms == np.inf


def test_a_pendulum_test_hides_warm_up() -> None:
    along, to_and_fro = (_seen(each, "thermal-drift") for each in (DESIGN, pendulum_test(11, 4)))
    assert to_and_fro.share < 0.5 * along.share
    assert to_and_fro.smallest_rms > 2 * along.smallest_rms


def test_what_the_model_imitates_is_not_seen() -> None:
    assert _seen(DESIGN, "scale-error").share == 0.0


def test_what_the_model_contains_is_not_asked_for() -> None:
    found = plan_visibility(USUAL, DESIGN, INSTALLED, SIGMA)
    assert "backlash" not in {each.effect for each in found}


def test_what_cannot_be_tried_is_there_with_its_reason() -> None:
    found = _seen(DESIGN, "eccentricity")
    assert (found.share, found.smallest_rms) == (0.0, np.inf)
    assert found.reason is not None
    assert found.reason.en == "for rotary axes only"


@pytest.mark.parametrize("effect", ["backlash-bow", "screw-pitch", "thermal-drift"])
def test_the_smallest_effect_that_is_found_grows_with_the_scatter(effect: str) -> None:
    assert _seen(DESIGN, effect, sigma=3 * SIGMA).smallest_rms == pytest.approx(
        3 * _seen(DESIGN, effect).smallest_rms
    )


def test_the_smallest_value_of_the_only_coefficient_is_that_of_the_smallest_effect() -> None:
    found = _seen(DESIGN, "backlash-bow")
    assert found.smallest is not None
    parameter, value = found.smallest
    column = EFFECTS["backlash-bow"].columns(DESIGN, np.empty(0))
    assert parameter.name == "bow"
    assert value * np.sqrt(np.mean(column**2)) == pytest.approx(found.smallest_rms)


def test_more_runs_find_a_smaller_effect() -> None:
    four, sixteen = (_seen(linear_test(11, runs), "backlash-bow").smallest_rms for runs in (4, 16))
    # The scatter of the means is half as large; the threshold is simulated anew, to a few percent.
    assert sixteen == pytest.approx(four / 2, rel=0.15)


def _share_beyond(length: float, coefficients: int) -> float:
    """Return how often a vector of a length is longer than that with noise of one in each direction."""
    noise_of_one = np.random.default_rng(1).standard_normal((200_000, coefficients))
    noise_of_one[:, 0] += length
    return float(np.mean(np.sum(noise_of_one**2, axis=1) > length**2))


@pytest.mark.parametrize(
    ("effect", "theta", "coefficients"), [("backlash-bow", [], 1), ("screw-pitch", [PITCH], 2)]
)
def test_the_smallest_effect_is_found_about_half_of_the_time(
    effect: str, theta: list[float], coefficients: int
) -> None:
    base = np.concatenate([term.effect.columns(DESIGN, np.empty(0)) for term in USUAL.terms], axis=1)
    contest = Contest.of(DESIGN, base, [EFFECTS[effect]])
    null = simulate_null(contest, contest.quiet)
    shape = hidden(DESIGN, effect, theta)
    size = _seen(DESIGN, effect).smallest_rms / np.sqrt(np.mean(shape**2))
    readings = [noise(DESIGN, seed) + size * shape for seed in range(SETS)]
    trials = Trials(contest, contest.quiet, [], np.column_stack(readings))
    # What a curve without a name finds beside it is another matter.
    nothing = np.full_like(trials.nameless, -np.inf)
    found = null.compute_excess(Scores(trials.ratios, nothing)) > null.threshold
    # Of a wave the noise may shift the phase, too. 300 sets know the share to 3 %, the threshold of 400 tests
    # shifts it by 5 %.
    expected = _share_beyond(float(np.sqrt(null.usual[0] + null.threshold)), coefficients)
    assert np.mean(found) == pytest.approx(expected, abs=0.12)
