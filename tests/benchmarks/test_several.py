"""The benchmark of several causes: the axes that it draws, and how it counts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from hidden_effects.judge import INSTALLED
from hidden_effects.several import (
    DOWN_TO_NOISE,
    Drawn,
    Outcome,
    drawn_axis,
    followed,
    is_where_told,
    report,
)
from hidden_effects.trial import EFFECTS
from zlmreport.model.diagnosis.diagnosis import diagnose
from zlmreport.model.diagnosis.random_curves import Course
from zlmreport.model.diagnosis.remainder import Remainder
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.plugin import MILLIMETRE, FloatArray, Unit, Words


@cache
def _draw_alone() -> Drawn:
    return drawn_axis(1, with_stranger=False)


@cache
def _draw_beside() -> Drawn:
    return drawn_axis(2, with_stranger=True)


def test_the_same_number_draws_the_same_axis() -> None:
    one, other = (drawn_axis(3, with_stranger=True) for _ in range(2))
    assert one.causes == other.causes
    np.testing.assert_array_equal(one.observed.deviation, other.observed.deviation)


def test_an_axis_has_two_to_four_causes_of_the_size_that_is_stated() -> None:
    for number in range(6):
        drawn = drawn_axis(number, with_stranger=False)
        assert 2 <= len(drawn.causes) <= 4
        assert drawn.stranger is None
        assert np.std(drawn.observed.deviation) > 1.2 * drawn.sigma


def test_a_test_may_have_more_targets_than_the_pitch_has_room_for() -> None:
    drawn = drawn_axis(1, with_stranger=False, targets=101)
    assert len(drawn.observed.design.target_positions) == 101
    assert 2 <= len(drawn.causes) <= 4


@pytest.mark.long
def test_many_names_that_one_curve_replaces_are_not_told() -> None:
    drawn = drawn_axis(9022, with_stranger=True)  # a smooth curve along the axis, and three causes
    found = diagnose(AxisModel((Term(EFFECTS["offset"]),)), drawn.observed, INSTALLED)
    assert {each.identifier for each in found.together} <= set(drawn.causes)
    assert found.remainder is not None
    assert found.remainder.course is Course.PLACE


@pytest.mark.long
@pytest.mark.parametrize(("number", "with_stranger"), [(44000, False), (43009, True)])
def test_one_run_that_stands_off_has_a_name_and_runs_that_all_do_have_none(
    number: int, with_stranger: bool
) -> None:
    drawn = drawn_axis(number, with_stranger=with_stranger)  # of three runs one, beside 0.05 µm; or all
    found = diagnose(AxisModel((Term(EFFECTS["offset"]),)), drawn.observed, INSTALLED)
    assert ("run-displaced" in {each.identifier for each in found.together}) is not with_stranger
    assert (found.remainder is not None) is with_stranger


@pytest.mark.long
def test_a_jump_of_the_zero_in_the_last_block_of_a_pendulum_test_is_no_noisy_end() -> None:
    drawn = drawn_axis(45014, with_stranger=False)  # it comes after six of the ten readings of that block
    found = diagnose(AxisModel((Term(EFFECTS["offset"]),)), drawn.observed, INSTALLED)
    assert {"datum-step", "compensation-shift", "passing-warmth"} <= {
        each.identifier for each in found.together
    }
    assert found.error_after.rms < DOWN_TO_NOISE * drawn.sigma


@pytest.mark.long
def test_a_name_that_is_as_likely_as_a_form_goes_before_it() -> None:
    drawn = drawn_axis(
        47008, with_stranger=True
    )  # a bow of the reversal, or one upwards only beside saw teeth
    found = diagnose(AxisModel((Term(EFFECTS["offset"]),)), drawn.observed, INSTALLED)
    assert "backlash-bow" in {each.identifier for each in found.together}


@pytest.mark.long
def test_a_bump_has_the_place_of_three_names_that_describe_it() -> None:
    drawn = drawn_axis(46006, with_stranger=True)  # a polynomial, a worn zone and a kink, or one bump
    found = diagnose(AxisModel((Term(EFFECTS["offset"]),)), drawn.observed, INSTALLED)
    assert not {"polynomial", "worn-zone", "scale-kink"} & {each.identifier for each in found.together}
    assert found.remainder is not None
    assert is_where_told(found.remainder, drawn)


@pytest.mark.long
def test_a_displaced_stretch_among_many_targets_is_no_joint_and_another_back() -> None:
    drawn = drawn_axis(33010, with_stranger=True, targets=101)
    found = diagnose(AxisModel((Term(EFFECTS["offset"]),)), drawn.observed, INSTALLED)
    names = {each.identifier for each in found.together}
    assert not names & {"scale-joint", "datum-step"}
    assert found.remainder is not None
    assert is_where_told(found.remainder, drawn)


@pytest.mark.long
@pytest.mark.parametrize(
    ("number", "cause"),
    [
        (
            9006,
            "encoder-interpolation",
        ),  # a reversal value that changes in time, in one run to the other sign
        (9009, "backlash"),  # slopes of runs apart, and a screw that grows with its temperature
    ],
)
def test_what_changes_without_a_name_is_no_slip_in_recording(number: int, cause: str) -> None:
    drawn = drawn_axis(number, with_stranger=True)
    found = diagnose(AxisModel((Term(EFFECTS["offset"]),)), drawn.observed, INSTALLED)
    assert found.faults == ()
    assert cause in {each.identifier for each in found.together}


@pytest.mark.long
@pytest.mark.parametrize(
    "number",
    [
        9020,  # a step of the zero and a wave in time, which a single curve in time nearly describes
        10015,  # a displaced run, in the place of which a slope beside a curve is as good
        15001,  # a polynomial, in the place of which a smooth curve is as good
        16027,  # three, beside which a fourth is needless, and then two go for a curve
        19021,  # an axis that warms up, which is no late beginning
        21005,  # a kink in one direction, in the place of which a fading is as good
    ],
)
def test_causes_are_built_down_to_the_noise_each_by_its_name(number: int) -> None:
    outcome = followed(drawn_axis(number, with_stranger=False))
    # Lost motion is told before lost motion that settles, its equal there.
    assert sorted(outcome.as_equals) == sorted(outcome.drawn.causes)
    assert len(outcome.built) == len(outcome.drawn.causes)
    assert not outcome.wrong
    assert outcome.left < DOWN_TO_NOISE


@pytest.mark.long
def test_what_is_irregular_does_not_take_in_what_has_a_name() -> None:
    drawn = drawn_axis(
        14012, with_stranger=True
    )  # whole increments of a control, a pitch, a stretch displaced
    found = diagnose(AxisModel((Term(EFFECTS["offset"]),)), drawn.observed, INSTALLED)
    assert {"compensation-sign", "control-increment"} <= {each.identifier for each in found.together}


@pytest.mark.long
@pytest.mark.parametrize(
    ("number", "causes"),
    [
        (15004, {"first-run", "run-displaced", "scale-kink"}),  # slopes of runs apart, about the zero
        # A saw along the axis; a slope about the middle took in the step of the zero and the drift.
        (15016, {"control-increment", "datum-step", "thermal-drift"}),
    ],
)
def test_a_slope_that_changes_is_nothing_at_the_zero_of_the_axis(number: int, causes: set[str]) -> None:
    drawn = drawn_axis(number, with_stranger=True)
    found = diagnose(AxisModel((Term(EFFECTS["offset"]),)), drawn.observed, INSTALLED)
    assert {each.identifier for each in found.together} == causes


@pytest.mark.long
def test_what_is_sure_stays_where_something_beside_it_is_not() -> None:
    # Runs apart, and warmth of which several effects may be the cause.
    drawn = drawn_axis(12006, with_stranger=True)
    found = diagnose(AxisModel((Term(EFFECTS["offset"]),)), drawn.observed, INSTALLED)
    assert "backlash" in {each.identifier for each in found.together} <= set(drawn.causes)


@pytest.mark.long
def test_a_search_that_comes_by_sets_that_are_nearly_known_ends() -> None:
    drawn = drawn_axis(12019, with_stranger=True)
    found = diagnose(AxisModel((Term(EFFECTS["offset"]),)), drawn.observed, INSTALLED)
    assert "abbe" in {each.identifier for each in found.together}


def test_a_stranger_stands_beside_the_causes() -> None:
    assert _draw_beside().stranger is not None


def _outcome(
    drawn: Drawn,
    built: tuple[str, ...],
    equals: Mapping[str, frozenset[str]],
    left: float,
    **told: bool | float,
) -> Outcome:
    """Return what came of building a model, of which nothing was told but what is stated."""
    silent = dict.fromkeys(("remainder", "is_placed", "is_unexplained", "is_nameless"), False)
    return Outcome(drawn, built, equals, left, **{**silent, "seconds": 2.0, **told})


def test_names_that_no_cause_has_are_wrong_and_the_whole_set_is_counted() -> None:
    drawn = _draw_alone()
    whole = _outcome(drawn, drawn.causes, {}, 1.0)
    first, *_ = drawn.causes
    half = _outcome(drawn, (first, "no such effect"), {}, 3.0, remainder=True, seconds=4.0)
    assert (half.found, half.wrong) == ((first,), ("no such effect",))
    causes = len(drawn.causes)
    last = report([whole, half]).splitlines()[-2]
    assert last.startswith(f"2 axes: {causes + 1} of {2 * causes} causes found, other names: 1, of them ")
    assert "wrong: 1, the whole set in 1," in last
    assert "down to 1.15 σ in 1, something left without a name in 1" in last
    assert "3.0 s of CPU" in last


def test_it_is_told_apart_whether_a_name_stands_beside_what_nothing_surely_explains() -> None:
    drawn = _draw_alone()
    named, nameless = (
        _outcome(drawn, (), {}, 2.0, is_unexplained=True, is_nameless=each) for each in (False, True)
    )
    told = report([named, nameless]).splitlines()[-2]
    assert "explains what is left in 2, in 1 of them without a name" in " ".join(told.split())


def test_a_cause_that_is_named_as_an_equal_of_what_was_added_makes_one_name_right() -> None:
    drawn = _draw_alone()
    first, *others = drawn.causes
    equals = {"its twin": frozenset({first}), "another": frozenset({first})}
    built = ("its twin", "another", *others)
    outcome = _outcome(drawn, built, equals, 1.0)
    assert outcome.others == ("its twin", "another")
    assert outcome.wrong == ("another",)
    assert outcome.as_equals == drawn.causes
    assert "(its twin), another |" in report([outcome])


@pytest.mark.parametrize(("mean", "names"), [(2.0, ("backlash",)), (0.0, ())])
def test_lost_motion_is_the_mean_of_a_gap_that_changes(mean: float, names: tuple[str, ...]) -> None:
    drawn = _draw_beside()
    design = drawn.observed.design
    gap = design.direction * (mean * drawn.sigma + drawn.sigma * np.sin(20 * design.position))
    even = gap - design.direction * (np.mean(design.direction * gap) - mean * drawn.sigma)
    beside = replace(drawn, beside=even)
    assert beside.in_stranger == names
    equals = {"backlash-gradient": frozenset({"backlash"})}
    built = (*drawn.causes, "backlash-gradient")
    said = _outcome(
        beside, built, equals, 1.0, remainder=True, is_placed=True, is_unexplained=True, is_nameless=True
    )
    assert said.wrong == (() if names else ("backlash-gradient",))


def test_scale_error_is_the_mean_of_a_slope_that_changes() -> None:
    drawn = _draw_beside()
    slope = 5.0 * drawn.sigma * drawn.observed.design.position
    changing = replace(drawn, stranger="slope that jumps", beside=slope - slope.mean())
    assert "scale-error" in changing.in_stranger
    assert "scale-error" not in replace(changing, stranger="chirp in position").in_stranger


def test_what_a_cause_has_as_a_part_by_its_definition_is_no_wrong_name() -> None:
    drawn = replace(_draw_alone(), causes=("backlash", "polynomial"))
    built = ("backlash", "scale-error")
    part = _outcome(drawn, built, {}, 1.0, remainder=True)
    assert part.wrong == ()
    whole = replace(part, built=(*built, "polynomial"))
    assert whole.wrong == ("scale-error",)


def _left(low: float, high: float, unit: Unit = MILLIMETRE) -> Remainder:
    """Return what is told to be left between two places, or moments."""
    nowhere = Words("anywhere")
    return Remainder(
        rms=1e-6,
        share=0.5,
        where=nowhere,
        low=low,
        high=high,
        unit=unit,
        shape=nowhere,
        size=1e-6,
        peak=(low + high) / 2,
        formula=None,
        course=Course.PLACE,
    )


def _with_stranger(drawn: Drawn, values: FloatArray) -> Drawn:
    return replace(drawn, beside=values - values.mean())


def test_a_stranger_is_placed_where_it_is_larger_than_elsewhere() -> None:
    drawn = _draw_alone()
    where = drawn.observed.design.position
    bump = _with_stranger(drawn, np.exp(-0.5 * ((where - 0.4) / 0.05) ** 2))
    assert is_where_told(_left(0.3, 0.5), bump)
    assert not is_where_told(_left(0.6, 0.9), bump)
    assert not is_where_told(_left(2.0, 3.0), bump)  # no reading lies there
    assert not is_where_told(_left(0.3, 0.5), drawn)


def test_only_a_stranger_that_takes_most_of_the_axis_lies_in_all_of_it() -> None:
    drawn = _draw_alone()
    where = drawn.observed.design.position
    all_of_it = _left(*drawn.observed.design.span)
    assert is_where_told(all_of_it, _with_stranger(drawn, np.sin(40 * where)))
    assert not is_where_told(all_of_it, _with_stranger(drawn, np.exp(-0.5 * ((where - 0.4) / 0.05) ** 2)))


def test_a_stranger_of_one_run_is_placed_by_the_run() -> None:
    drawn = _draw_alone()
    cycle = drawn.observed.design.cycle
    last = _with_stranger(drawn, 1.0 * (cycle == cycle.max()))
    whole = _left(0.0, float(drawn.observed.design.time.max()), Unit("s", "s", 1.0))
    for run in np.unique(cycle).tolist():
        told = replace(whole, where=Words("most in run {run}").given(run=run))
        assert is_where_told(told, last) == (run == cycle.max())


def test_a_stranger_in_time_is_placed_by_the_moment() -> None:
    drawn = _draw_alone()
    moment = drawn.observed.design.time
    end = float(moment.max())
    late = _with_stranger(drawn, 1.0 * (moment > 0.7 * end))
    seconds = Unit("s", "s", 1.0)
    assert is_where_told(_left(0.75 * end, end, seconds), late)
    assert not is_where_told(_left(0.0, 0.5 * end, seconds), late)


def test_what_is_left_is_placed_where_the_stranger_is_largest() -> None:
    drawn = _draw_beside()
    last = report(
        [
            _outcome(
                drawn,
                (),
                {},
                2.0,
                remainder=True,
                is_placed=True,
                is_unexplained=True,
                is_nameless=True,
                seconds=1.0,
            )
        ]
    )
    assert "where the stranger is in 1 of 1" in last
