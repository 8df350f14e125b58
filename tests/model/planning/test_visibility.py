"""What a plan will see of each effect, what it hides, and which change of it was found to help."""

from __future__ import annotations

import numpy as np
import pytest

from model.planning.planned import REGISTRY, WHOLE_PITCHES, plan_of_test, sight_of
from zlmreport.model.planning.plan import expect_conditions
from zlmreport.model.planning.visibility import Sight, list_logs_of
from zlmreport.plugin import InputError, Language, Words

PENDULUM = ("method: linear", "method: pendulum")
ONE_WAY = ("method: linear", "method: unidirectional")


def _said(words: Words) -> str:
    return words.in_language(Language.ENGLISH)


@pytest.mark.parametrize("effect", ["screw-pitch", "directional-pitch"])
def test_targets_on_whole_pitches_hide_what_repeats_with_the_pitch(effect: str) -> None:
    seen = sight_of(plan_of_test(("plan: {}", WHOLE_PITCHES)), effect)
    assert seen.sight is Sight.HIDDEN
    assert seen.visibility.share == 0


@pytest.mark.parametrize("effect", ["screw-pitch", "directional-pitch"])
def test_random_fractions_show_what_repeats_with_the_pitch(effect: str) -> None:
    seen = sight_of(plan_of_test(), effect)
    assert seen.sight is Sight.VISIBLE
    assert seen.visibility.share > 0.7


def test_remedy_for_whole_pitches_are_random_fractions() -> None:
    remedy = plan_of_test(("plan: {}", WHOLE_PITCHES)).remedies["screw-pitch"]
    assert remedy.reason is not None
    assert _said(remedy.reason) == "all targets lie at the same phase of the pitch of 10 mm"
    assert _said(remedy.advice) == "choose targets with a random fraction"
    assert remedy.share is not None
    assert remedy.share > 0.7


def test_pendulum_hides_warming_up_and_the_linear_method_is_advised() -> None:
    planned = plan_of_test(PENDULUM)
    assert sight_of(planned, "thermal-growth").sight is Sight.HIDDEN
    remedy = planned.remedies["thermal-growth"]
    assert _said(remedy.advice) == "measure by the linear method"
    seen = sight_of(plan_of_test(), "thermal-growth")
    assert seen.sight is Sight.VISIBLE
    assert remedy.share == pytest.approx(seen.visibility.share)


def test_changes_are_advised_together_where_none_helps_alone() -> None:
    scarce = "plan: {targets: {positions: [0, 50, 100]}, runs: 2}"
    remedy = plan_of_test((", travel: [0, 600]", ""), ("plan: {}", scarce)).remedies["screw-expansion"]
    assert _said(remedy.advice) == "take 21 targets with random fractions and measure 5 runs"


def test_test_of_which_a_diagnosis_could_say_nothing_is_refused() -> None:
    few = ("plan: {}", "plan: {targets: {positions: [0, 100]}, runs: 2}")
    with pytest.raises(
        InputError, match=r"job.yaml:9:1: plan: too few readings \(8\): the model has 3 parameters"
    ):
        plan_of_test(few)


def test_advice_is_sought_even_where_the_overrun_is_longer_than_the_travel() -> None:
    far = ("plan: {}", WHOLE_PITCHES.replace("]}", "]}, overrun: 700"))
    assert plan_of_test(far).remedies["screw-pitch"].share is not None


def test_what_the_model_imitates_on_any_targets_is_told_by_another_measurement() -> None:
    remedy = plan_of_test().remedies["cosine-error"]
    assert remedy.reason is not None
    assert _said(remedy.reason) == "scale-error imitates it"
    assert "align the beam" in _said(remedy.advice)
    assert remedy.share is None


def test_effect_found_only_beyond_what_is_plausible_needs_livelier_conditions() -> None:
    planned = plan_of_test(("plan: {}", "plan: {repeatability: 5}"))
    seen = sight_of(planned, "air-index")
    assert seen.sight is Sight.TOO_SMALL
    assert seen.visibility.smallest is not None
    assert seen.visibility.smallest[1] > 1
    assert "larger changes of air_temperature" in _said(planned.remedies["air-index"].advice)


def test_smallest_effect_grows_in_proportion_to_the_scatter() -> None:
    one = sight_of(plan_of_test(), "datum-step").visibility
    other = sight_of(plan_of_test(("plan: {}", "plan: {repeatability: 3}")), "datum-step").visibility
    assert other.smallest_rms == pytest.approx(3 * one.smallest_rms)
    assert other.share == one.share


def test_smallest_coefficient_falls_as_temperatures_change_more() -> None:
    one = sight_of(plan_of_test(), "datum-temperature").visibility.smallest
    warmer = ("plan: {}", "plan: {temperature_change: 4}")
    other = sight_of(plan_of_test(warmer), "datum-temperature").visibility.smallest
    assert one is not None
    assert other is not None
    # The air refracts not quite in proportion, which moves what chance reaches among all effects a little.
    assert other[1] == pytest.approx(one[1] / 4, rel=1e-3)


def test_more_runs_find_smaller_effects() -> None:
    few = sight_of(plan_of_test(("plan: {}", "plan: {runs: 3}")), "backlash-bow").visibility
    many = sight_of(plan_of_test(("plan: {}", "plan: {runs: 12}")), "backlash-bow").visibility
    assert few.smallest_rms == pytest.approx(2 * many.smallest_rms, rel=0.15)


def test_conditions_that_are_needed_are_known_from_the_effects_themselves() -> None:
    logs = plan_of_test().logs
    assert "scale-expansion" in logs["axis_temperature"]
    assert {"air-index", "dead-path"} <= set(logs["air_pressure"])
    assert "relative_humidity" not in logs  # it changes the index so little that it may stay
    assert "face" not in logs  # nothing can be expected of it: it belongs to a gauge


def test_effects_of_rotary_axes_belong_to_another_axis() -> None:
    assert sight_of(plan_of_test(), "eccentricity").sight is Sight.OTHER_AXIS


def test_effect_of_the_model_that_the_test_cannot_determine_is_left_out_of_it() -> None:
    planned = plan_of_test(ONE_WAY)
    assert planned.model.identifiers == ("offset", "scale-error")
    assert sight_of(planned, "backlash").sight is Sight.NOT_TESTABLE


def test_effect_of_the_model_that_its_targets_hide_is_left_out_of_it_and_named() -> None:
    modelled = ("output:", "model: {effects: [offset, scale-error, backlash, screw-pitch]}\noutput:")
    planned = plan_of_test(modelled, ("plan: {}", WHOLE_PITCHES))
    assert planned.model.identifiers == ("offset", "scale-error", "backlash")
    assert sight_of(planned, "screw-pitch").sight is Sight.HIDDEN


def test_a_wave_that_stands_in_the_model_is_planned_with_and_a_second_one_is_not_listed() -> None:
    modelled = ("output:", "model: {effects: [offset, {periodic: {period: 210}}]}\noutput:")
    planned = plan_of_test(modelled)
    assert planned.model.identifiers == ("offset", "periodic")
    assert not [each for each in planned.seen_effects if each.effect.identifier.startswith("periodic")]


def test_way_and_time_of_a_linear_test_are_those_of_arithmetic() -> None:
    planned = plan_of_test()
    plan = planned.proposal.plan
    once = 2 * (plan.targets[-1] - plan.targets[0] + 2 * plan.overrun)
    assert planned.travelled == pytest.approx(5 * once)
    assert planned.duration == pytest.approx(planned.travelled / 0.05 + 4 * 110)


def test_turning_round_beyond_the_travel_is_seen() -> None:
    assert plan_of_test().beyond_travel is None
    beyond = plan_of_test(("plan: {}", WHOLE_PITCHES)).beyond_travel
    assert beyond == pytest.approx((-0.005, 0.605))


def test_an_axis_of_a_whole_turn_that_may_have_ends_is_asked_about() -> None:
    linear, rotary = (
        "{name: X, travel: [0, 600], screw_pitch: 10}",
        "{name: B, kind: rotary, travel: [-180, 180]}",
    )
    assert plan_of_test((linear, rotary)).beyond_travel == pytest.approx(np.radians([-185, 185]))


def test_expected_temperatures_rise_by_what_the_job_says() -> None:
    time = np.linspace(0, 1200, 50)
    for name, course in expect_conditions(2.0, time).items():
        if name.endswith("temperature"):
            assert np.ptp(course) == pytest.approx(2.0)


def test_only_conditions_that_an_effect_asks_for_are_its_logs() -> None:
    design = plan_of_test().design
    found = {
        name: list_logs_of(REGISTRY.effect(name), design)
        for name in ("offset", "dead-path", "screw-expansion")
    }
    assert found == {
        "offset": (),
        "dead-path": ("air_temperature", "air_pressure"),
        "screw-expansion": ("screw_temperature",),
    }


def test_targets_that_are_whole_increments_do_not_see_the_increment_of_the_control() -> None:
    seen = sight_of(plan_of_test(("plan: {}", WHOLE_PITCHES)), "control-increment")
    assert seen.sight is Sight.HIDDEN
    assert seen.visibility.share == 0


def test_a_formula_that_overflows_at_an_end_of_its_range_is_planned_for_where_it_is_finite() -> None:
    growth = (
        "model:\n  effects:\n    - offset\n    - name: growth\n      formula: a*exp(P*P/(L*L))\n"
        "      parameters: {a: {unit: um}, L: {unit: mm, range: [20, 1000]}}\n"
    )
    assert plan_of_test(("evaluate:", f"{growth}evaluate:")).remedies
