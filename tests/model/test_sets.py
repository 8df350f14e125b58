"""The search over sets: causes together, beside what has no name; stand-ins that go out again."""

from __future__ import annotations

import numpy as np
import pytest

from model.axis_tests import EFFECTS, INSTALLED, SIGMA, hidden, linear_test, model_of, noise, pendulum_test
from zlmreport.model.diagnosis.contest import Contest
from zlmreport.model.diagnosis.effect_set import (
    EffectSet,
    count_nameless,
    has_nameless,
    make_member,
)
from zlmreport.model.diagnosis.effects_to_try import list_effects_to_try
from zlmreport.model.diagnosis.forms import list_unnamed_forms
from zlmreport.model.diagnosis.random_curves import Course
from zlmreport.model.diagnosis.refining import jump_along_grids
from zlmreport.model.diagnosis.set_costs import UNUSUAL, weigh_size
from zlmreport.model.diagnosis.set_members import make_members_of, renumber
from zlmreport.model.diagnosis.set_pairs import list_pairs
from zlmreport.model.diagnosis.sets import SetSearch
from zlmreport.plugin import FloatArray
from zlmreport.plugin.effect import Design, Effect

DESIGN = linear_test()
EMPTY = model_of("offset")


def _contest(
    deviation: FloatArray, design: Design = DESIGN, effects: tuple[Effect, ...] = INSTALLED
) -> Contest:
    tried = list_effects_to_try(EMPTY, design, effects).forms
    base = np.ones((len(design.position), 1))
    return Contest.of(design, base, tried, deviation, forms=list_unnamed_forms(design))


def _found(deviation: FloatArray, design: Design = DESIGN) -> EffectSet:
    return SetSearch(_contest(deviation, design)).find_best()


def _names(found: EffectSet) -> set[str]:
    return {each.identifier for each in found.named}


def _hiding(*effects: tuple[str, list[float]], design: Design = DESIGN, size: float = 2.0) -> FloatArray:
    parts = [hidden(design, name, theta, size=size, model=EMPTY) for name, theta in effects]
    return np.asarray(np.sum(parts, axis=0) + 4e-6 + noise(design))


def test_three_causes_are_found_from_an_empty_model() -> None:
    found = _found(_hiding(("backlash", []), ("screw-pitch", [0.01]), ("thermal-drift", [300.0])))
    assert _names(found) == {"backlash", "screw-pitch", "thermal-drift"}
    assert found.unnamed == ()


def test_causes_are_found_beside_a_bump_that_nobody_knows() -> None:
    bump = 6 * SIGMA * np.exp(-4 * np.log(2) * ((DESIGN.position - 0.42) / 0.12) ** 2)
    found = _found(_hiding(("backlash", []), ("thermal-drift", [300.0])) + bump)
    assert _names(found) == {"backlash", "thermal-drift"}
    (left,) = found.unnamed
    assert left.identifier == "bump"
    assert left.theta == pytest.approx([0.42, 0.12], abs=0.03)


@pytest.mark.long
def test_a_narrow_bump_that_many_targets_show_is_neither_another_form_nor_several_names() -> None:
    places = np.sort(np.random.default_rng([77, 8]).uniform(0.0, 1.0, 161))
    design = linear_test(161, 3, places=places)
    causes: dict[str, list[float]] = {
        "backlash": [],
        "screw-pitch": [0.01],
        "thermal-drift": [1500.0],
        "scale-error": [],
    }
    bump = 5 * SIGMA * np.exp(-4 * np.log(2) * ((design.position - 0.42) / 0.05) ** 2)
    found = _found(_hiding(*causes.items(), design=design, size=3.0) + bump, design)
    assert _names(found) == causes.keys()
    (left,) = found.unnamed
    assert left.identifier == "bump"
    assert left.theta == pytest.approx([0.42, 0.05], abs=0.004)


@pytest.mark.long
def test_a_random_curve_of_the_axis_is_no_polynomial() -> None:
    random = np.random.default_rng(3)
    values = np.convolve(random.standard_normal(60), np.hanning(9), "valid")
    curve = np.interp(DESIGN.position, np.linspace(0.0, 1.0, len(values)), values)
    search = SetSearch(_contest(_hiding(("backlash", [])) + 2e-6 * curve))
    found = search.find_best()
    assert "backlash" in _names(found)
    assert "polynomial" not in _names(found)
    assert has_nameless(search.contest, found)


def test_a_wave_in_time_leaves_the_bow_of_the_reversal_to_the_bow() -> None:
    found = _found(_hiding(("backlash-bow", []), ("time-periodic", [290.0])))
    assert _names(found) == {"backlash-bow", "time-periodic"}


def test_what_came_in_first_goes_out_for_what_is_better_without_it() -> None:
    # Over a run to and fro a slope looks much like a wave in time, which takes in lost motion as well.
    design = linear_test(15, 4)
    found = _found(1e-5 * design.position - 1.5e-6 * design.direction + noise(design), design)
    assert _names(found) == {"backlash", "scale-error"}


def test_a_stretch_that_is_displaced_is_no_pair_of_joints() -> None:
    stretch = 4 * SIGMA * ((DESIGN.position > 0.32) & (DESIGN.position < 0.58))
    found = _found(_hiding(("backlash", [])) + stretch)
    assert _names(found) == {"backlash"}
    (left,) = found.unnamed
    assert left.identifier == "plateau"
    assert left.theta == pytest.approx([0.32, 0.58], abs=0.03)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_stretch_that_is_displaced_is_found_to_the_gap_among_many_targets(seed: int) -> None:
    places = np.sort(np.random.default_rng(seed).uniform(0.0, 1.0, 61))
    design = linear_test(61, 3, places=places)
    stretch = 4 * SIGMA * ((design.position > places[21]) & (design.position < places[37]))
    found = _found(_hiding(("backlash", []), design=design) + stretch, design)
    assert _names(found) == {"backlash"}
    (left,) = found.unnamed
    assert left.identifier == "plateau"
    first, last = left.theta
    assert places[21] <= first < places[22]
    assert places[36] < last <= places[37]


@pytest.mark.long
def test_an_effect_for_which_others_may_stand_has_less_evidence_than_the_set_loses_without_it() -> None:
    curve = 3 * SIGMA * np.sin(9.0 * DESIGN.position**2)
    search = SetSearch(_contest(_hiding(("scale-kink", [0.6]), ("backlash", [])) + curve))
    found = search.find_best()
    for own, member in zip(search.compute_own_evidence(found), found.members, strict=True):
        if member.family.is_named:
            assert search.seen.compute_evidence_of(found, {member.identifier}) <= own + 1e-9
    assert search.seen.compute_evidence_of(found, {"backlash"}) > 6


def test_what_is_left_of_a_set_has_the_same_effects_and_no_others() -> None:
    search = SetSearch(_contest(_hiding(("screw-pitch", [0.01]), ("backlash", []))))
    found = search.find_best()
    kept = [each for each in found.named if each.identifier == "backlash"]
    assert _names(search.find_best_holding(found, kept)) == {"backlash"}


def test_names_alone_take_the_place_of_what_has_none_one_for_each() -> None:
    search = SetSearch(_contest(_hiding(("screw-pitch", [0.01]), ("backlash", []), ("polynomial", []))))
    whole = search.find_best()
    assert _names(whole) == {"screw-pitch", "backlash", "polynomial"}
    [place] = [number for number, each in enumerate(whole.members) if each.identifier == "polynomial"]
    beside = search.without(whole, place)
    assert count_nameless(search.contest, beside) == 1
    alone = search.seen.find_names_alone(beside, 0.0)
    assert alone is not None
    assert _names(alone) == _names(whole)
    assert search.seen.find_names_alone(beside, whole.score - beside.score - 1.0) is None


def test_a_late_beginning_does_not_begin_with_the_test() -> None:
    late = [each for each in list_unnamed_forms(DESIGN) if each.form.name == "late"]
    assert late
    start = float(DESIGN.time.min()) + 0.1 * DESIGN.duration
    assert all(each.grid(DESIGN)[:, 0].min() > start for each in late)


def test_a_slope_that_differs_from_run_to_run_is_nothing_at_the_zero_of_the_axis() -> None:
    slopes = 3 * SIGMA * np.array([2.0, -3.0, 1.0, 4.0, -1.0])[DESIGN.run - DESIGN.run.min()]
    assert _list_left_beside_lost_motion(slopes * DESIGN.position) == [Course.RUNS]


def _list_left_beside_lost_motion(shape: FloatArray) -> list[Course | str]:
    """Return what has no name beside the only cause that is named: courses of curves, and forms."""
    search = SetSearch(_contest(_hiding(("backlash", [])) + shape))
    found = search.find_best()
    assert _names(found) == {"backlash"}
    loud = [
        part.course
        for part, level in zip(search.contest.parts, found.amplitudes, strict=True)
        if level >= part.noise_levels
    ]
    return [*loud, *(each.identifier for each in found.unnamed)]


def test_a_wave_that_grows_along_the_axis_is_one_thing_without_a_name() -> None:
    # Two or three steady waves would describe it, and none of them is there.
    place = (DESIGN.position - DESIGN.span[0]) / DESIGN.length
    wave = 6 * SIGMA * place**2 * np.sin(2 * np.pi * (5.3 * place + 0.2))
    assert _list_left_beside_lost_motion(wave) == [Course.PLACE]


def test_a_bow_that_comes_with_the_warmth_is_one_thing_without_a_name() -> None:
    # A growth, a drift and a curve along the axis would share it.
    place = (DESIGN.position - DESIGN.span[0]) / DESIGN.length
    warmth = -np.expm1(-(DESIGN.time - DESIGN.time.min()) / (0.5 * DESIGN.duration))
    bow = 9 * SIGMA * warmth * np.exp(-0.5 * ((place - 0.4) / 0.25) ** 2)
    assert _list_left_beside_lost_motion(bow) == [Course.PLACE_IN_TIME]


@pytest.mark.parametrize("targets", [5, 8])
def test_a_wave_is_not_shorter_than_two_steps_between_targets(targets: int) -> None:
    design = linear_test(targets, places=np.linspace(0.0, 1.0, targets))
    waves = [each for each in list_unnamed_forms(design) if each.form.name == "wave" and each.carrier == ""]
    assert all(float(each.starts.min()) >= 2.0 / (targets - 1) for each in waves)
    # Of five targets a line leaves three numbers, and any wave has three.
    assert bool(waves) is (targets > 5)


def test_a_drift_that_begins_late_is_neither_a_step_of_the_zero_nor_a_passing_warmth() -> None:
    moment = (DESIGN.time - DESIGN.time.min()) / DESIGN.duration
    late = -4 * SIGMA * np.expm1(-np.maximum(0.0, moment - 0.45) / 0.12)
    assert _list_left_beside_lost_motion(late) == ["late-time"]


def test_an_effect_that_is_not_needed_goes_out_again() -> None:
    contest = _contest(_hiding(("screw-pitch", [0.01]), ("backlash", [])))
    search = SetSearch(contest)
    [start] = make_members_of(search.contest, [(EFFECTS["first-run"], np.empty(0))])
    assert _names(search.find_best([start])) == {"screw-pitch", "backlash"}


def test_without_any_effect_there_is_nothing_but_noise() -> None:
    search = SetSearch(_contest(4e-6 + noise(DESIGN)))
    found = search.find_best()
    assert found.members == ()
    assert not has_nameless(search.contest, found)


def test_evidence_of_its_own_is_what_the_set_loses_without_an_effect() -> None:
    search = SetSearch(_contest(_hiding(("screw-pitch", [0.01]), ("backlash", []))))
    found = search.find_best()
    for number, evidence in enumerate(search.compute_own_evidence(found)):
        assert evidence == pytest.approx(search.without(found, number).score - found.score)
        assert evidence > 5


def test_a_searched_parameter_need_not_lie_on_the_grid() -> None:
    places = EFFECTS["scale-kink"].grid(DESIGN)[:, 0]
    between = float(places[7] + places[8]) / 2
    found = _found(_hiding(("scale-kink", [between]), size=4.0))
    (kink,) = found.named
    assert kink.identifier == "scale-kink"
    assert kink.theta[0] == pytest.approx(between, abs=(places[8] - places[7]) / 4)


def test_a_pitch_between_those_that_are_tried_is_not_given_up_for_the_stated_one() -> None:
    other = next(
        each for each in EFFECTS["screw-pitch"].forms() if each.settings.model_dump()["pitch"] == "other"
    )
    pitch = np.array([0.01053])
    readings = noise(DESIGN) + 2 * SIGMA * np.sqrt(2) * other.columns(DESIGN, pitch)[:, 0]
    contest = _contest(readings)
    (member,) = make_members_of(contest, [(other, pitch)])
    (kept,), has_moved = jump_along_grids(contest, [member], contest.quiet)
    assert not has_moved
    assert kept.theta == pytest.approx(pitch)


def test_a_jump_within_the_readings_of_one_target_is_found_where_it_is() -> None:
    design = pendulum_test()
    moment = float((design.time[103] + design.time[104]) / 2)
    deviation = noise(design) + 8 * SIGMA * (design.time > moment)
    (step,) = _found(deviation, design).named
    assert step.identifier == "datum-step"
    assert design.time[103] < step.theta[0] < design.time[104]


def test_a_value_beyond_what_is_usual_costs_evidence_and_is_found_all_the_same() -> None:
    huge = 400e-6 * DESIGN.direction + noise(DESIGN)
    found = _found(huge)
    assert _names(found) == {"backlash"}
    usual = _found(huge / 10)
    assert found.score > usual.score


def test_of_the_forms_of_an_effect_one_is_chosen() -> None:
    deviation = _hiding(("screw-pitch", [0.01]))
    (member,) = _found(deviation).named
    assert member.effect.settings.model_dump()["harmonics"] in {(1,), (1, 2)}


def test_a_search_gives_the_same_set_whatever_the_unit() -> None:
    deviation = _hiding(("backlash", []), ("thermal-drift", [300.0]))
    one, other = (_found(each) for each in (deviation, deviation / 7))  # smaller is as usual
    assert [each.identifier for each in one.members] == [each.identifier for each in other.members]
    assert other.score - one.score == pytest.approx(-2 * (len(deviation) - 1) * np.log(7), abs=1e-4)


def test_a_screw_that_hardly_grows_is_unusual_like_one_that_grows_too_much() -> None:
    screw = EFFECTS["screw-expansion"]
    (growth,) = screw.linear  # steel grows by 8 to 13 µm/(m·K); beyond 25 it is no metal of a screw
    little, usual, much, far = (
        weigh_size(screw, DESIGN, growth, each, 0.0) for each in (1e-6, 10e-6, 20e-6, 100e-6)
    )
    assert usual == 0
    assert little == pytest.approx(2 * np.log(8))
    assert much == pytest.approx(2 * np.log(20 / 13))
    assert far == pytest.approx(UNUSUAL + 2 * np.log(100 / 13))


def test_what_is_within_its_uncertainty_of_the_usual_costs_nothing() -> None:
    (growth,) = EFFECTS["screw-expansion"].linear
    assert weigh_size(EFFECTS["screw-expansion"], DESIGN, growth, 1e-6, 4e-6) == 0


def test_a_name_of_a_value_reaches_as_far_as_the_value_may() -> None:
    effect = EFFECTS["dead-path"]
    (path,) = effect.linear  # preset at the far end: as long as the travel, not six metres
    assert weigh_size(effect, DESIGN, path, -0.9, 0.1) == 0
    assert weigh_size(effect, DESIGN, path, -6.0, 0.4) > UNUSUAL


def test_a_member_that_is_there_costs_what_its_value_had_to_be_searched_for() -> None:
    search = SetSearch(_contest(_hiding(("time-periodic", [290.0]), ("backlash", []))))
    wave, lost = make_members_of(
        search.contest, [(EFFECTS["time-periodic"], np.array([290.0])), (EFFECTS["backlash"], np.empty(0))]
    )
    assert wave.spread > 2
    assert lost.spread == pytest.approx(0.0, abs=1e-9)


def _with_two_joints(*places: float) -> tuple[SetSearch, list[Effect]]:
    """Return a search in a contest of a joint and a second one, on readings with joints at places, m."""
    joints = [EFFECTS["scale-joint"], EFFECTS["scale-joint"].repeated(2)]
    deviation = _hiding(*(("scale-joint", [place]) for place in places), size=4.0)
    return SetSearch(Contest.of(DESIGN, np.ones((len(DESIGN.position), 1)), joints, deviation)), joints


def test_no_effect_stands_for_the_second_time_that_does_not_stand_once() -> None:
    search, (first, second) = _with_two_joints(0.5)
    once, twice = make_members_of(search.contest, [(first, np.array([0.3])), (second, np.array([0.5]))])
    alone, both = (renumber(search.contest, search.as_noise(each)) for each in ((twice,), (once, twice)))
    assert [each.identifier for each in alone.members] == ["scale-joint"]
    assert alone.members[0].theta == pytest.approx([0.5])
    assert [each.identifier for each in both.members] == ["scale-joint", "scale-joint-2"]


def test_an_effect_for_the_second_time_is_no_rival_of_itself() -> None:
    search, (first, _) = _with_two_joints(0.5)
    found = search.as_noise(make_members_of(search.contest, [(first, np.array([0.5]))]))
    assert search.list_rivals(found, search.without(found, 0), 40.0) == []


def test_what_explains_most_by_itself_is_no_makeshift_for_two() -> None:
    names = ("worn-zone", "backlash", "backlash-bow", "backlash-gradient", "one-way-step")
    step, wave = EFFECTS["lost-motion-step"], EFFECTS["lost-motion-wave"]
    design = linear_test(21, 3, seed=7)
    readings = step.columns(design, np.array([0.083])) @ np.array([6.5e-6]) + noise(design, 7)
    readings = readings + wave.columns(design, np.array([0.718])) @ np.array([-2.18e-6, 1.47e-6])
    few = (*(EFFECTS[name] for name in names), step, wave)
    found = SetSearch(_contest(readings, design, few)).find_best()
    assert {"lost-motion-step", "lost-motion-wave"} <= _names(found)
    assert "worn-zone" not in _names(found)


def test_two_of_which_neither_explains_anything_alone_are_a_pair() -> None:
    design = linear_test(21, 3)
    lever = EFFECTS["abbe"].columns(design, np.empty(0))[:, 0]
    straight = np.column_stack([np.ones(len(lever)), design.position])
    bent = lever - straight @ np.linalg.lstsq(straight, lever, rcond=None)[0]
    readings = SIGMA * bent / bent.std() + noise(design)
    names = ("backlash", "abbe", "first-run", "scale-error", "thermal-drift")
    contest = _contest(readings, design, tuple(EFFECTS[name] for name in names))
    best = list_pairs(contest, SetSearch(contest).make_bare_set(), len(contest.families))[0]
    assert _names(best) == {"abbe", "scale-error"}


def test_a_single_effect_makes_no_pair() -> None:
    contest = _contest(_hiding(("backlash", [])), effects=(EFFECTS["backlash"],))
    assert list_pairs(contest, SetSearch(contest).make_bare_set(), len(contest.families)) == []


def test_what_a_polynomial_shares_with_the_model_is_no_column_of_a_set() -> None:
    contest = _contest(noise(DESIGN))
    family = next(each for each in contest.families if each.identifier == "polynomial")
    columns = contest.columns.select_columns(make_member(family, 0, 0.0).columns)
    assert columns.shape[1] == len(family.effect.linear) - 1
    assert np.linalg.norm(columns, axis=0) == pytest.approx(np.ones(columns.shape[1]))
