"""When a reading is taken, and what is said of everything else that an axis does."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from itertools import chain, pairwise, takewhile
from math import exp

import numpy as np
import pytest

from live.capture.moves import MM, SETTINGS, UM, Axis, following, happened, kinds, listed, planned
from zlmreport.live.capture.display import DEGREES
from zlmreport.live.capture.events import (
    Closed,
    Elsewhere,
    Missed,
    MovedBeforeDatum,
    Passed,
    Recorded,
    Resumed,
    Retake,
    Skipped,
    TooSlow,
    TrackLost,
    Unclear,
    WrongDirection,
)
from zlmreport.live.capture.follower import Follower
from zlmreport.live.capture.progress import Progress
from zlmreport.live.capture.visits import number_visits
from zlmreport.model.planning.methods import Method
from zlmreport.model.planning.plan import AxisPlan
from zlmreport.plugin import Approach
from zlmreport.plugin.instrument import DatumMoved, DatumTaken, Fault, LiveReading, ZeroLost

BEAM_LOST = {"faults": Fault.BEAM_LOST, "message": "the beam is broken", "value": float("nan")}
UNREADABLE = {"faults": Fault.UNREADABLE, "value": float("nan")}


def test_a_whole_test_is_taken_in_the_order_of_its_visits() -> None:
    axis, follower = Axis(), following(listed(runs=2))
    events = happened(
        chain(
            axis.stand(),
            *(
                chain(axis.go(0, 100, 200), axis.turn(205), axis.go(200, 100, 0), axis.turn(-5))
                for _ in range(2)
            ),
        ),
        follower,
    )
    assert kinds(events) == [*(f"visit {number}" for number in range(1, 13)), "Finished"]


@pytest.mark.parametrize("method", [Method.PENDULUM, Method.QUASI_PILGRIM, Method.UNIDIRECTIONAL])
def test_every_method_is_taken_whole(method: Method) -> None:
    stops, axis = planned(method, runs=2).stops, Axis()
    moves = (
        axis.turn(stop.position / MM) if stop.target is None else axis.go(stop.position / MM)
        for stop in stops
    )
    visits = listed(method, runs=2)
    events = happened(chain(axis.stand(), *moves, axis.stand(2)), following(visits))
    assert kinds(events) == [*(f"visit {visit.number}" for visit in visits), "Finished"]


def test_a_reading_is_the_mean_over_half_the_dwell_and_its_deviation_that_of_the_axis() -> None:
    axis, follower = Axis(error={0: 0.004}), following(listed())
    (taken,) = happened(chain(axis.stand(), axis.go(0, stay=1.5)), follower)
    assert isinstance(taken, Recorded)
    assert taken.deviation == pytest.approx(4 * UM, abs=1e-12)
    assert taken.mean.duration == pytest.approx(SETTINGS.dwell / 2, abs=axis.step)
    assert taken.mean.count == pytest.approx(51, abs=1)


#: Ways of an axis that stood at its start, over targets at 0, 100 and 200 mm, and what is said of them.
WAYS: dict[str, tuple[Callable[[Axis], Iterable[Iterator[LiveReading]]], list[str]]] = {
    "a target passed without standstill takes nothing": (lambda at: [at.go(60)], ["Passed", "Elsewhere"]),
    "the same standstill is not read twice": (lambda at: [at.go(0, stay=5)], ["visit 1"]),
    "a display that shows the same for too long": (lambda at: [at.go(0, stay=8)], ["visit 1", "Frozen"]),
    "a later reading takes the place of the earlier": (
        lambda at: [at.go(0), at.turn(-5), at.go(0)],
        ["visit 1", "visit 1"],
    ),
    "a stop after the target": (lambda at: [at.go(0, 0.6, 100)], ["visit 1", "Repeated", "visit 2"]),
    "a pause between targets": (lambda at: [at.go(0, 40, 100)], ["visit 1", "Elsewhere", "visit 2"]),
    "a missed visit renumbers nothing": (
        lambda at: [at.go(0), at.go(100, stay=0.5), at.go(200)],
        ["visit 1", "Passed", "Missed", "visit 3"],
    ),
    "the first visit can be missed": (lambda at: [at.go(100)], ["Passed", "Missed", "visit 2"]),
    "a visit that was passed is taken when the axis comes back": (
        lambda at: [at.go(0), at.go(120, stay=0.5), at.turn(95), at.go(100)],
        ["visit 1", "Passed", "visit 2"],
    ),
    "from the wrong side": (
        lambda at: [at.go(0), at.turn(105), at.go(100)],
        ["visit 1", "Passed", "WrongDirection"],
    ),
    "an overshoot of less than ten times the stability range turns no direction": (
        lambda at: [at.go(0.008, stay=0.05), at.go(0)],
        ["visit 1"],
    ),
    "a larger overshoot is an approach from the other side": (
        lambda at: [at.go(0.05, stay=0.05), at.go(0)],
        ["WrongDirection"],
    ),
}


@pytest.mark.parametrize(("ways", "said"), WAYS.values(), ids=WAYS)
def test_what_an_axis_does_is_a_visit_or_has_its_name(
    ways: Callable[[Axis], Iterable[Iterator[LiveReading]]], said: list[str]
) -> None:
    axis = Axis()
    assert kinds(happened(chain(axis.stand(), *ways(axis)), following(listed()))) == said


def test_a_standstill_shorter_than_the_dwell_takes_nothing() -> None:
    axis = Axis()
    (event,) = happened(chain(axis.stand(), axis.go(0, stay=0.9), axis.turn(50)), following(listed()))
    assert isinstance(event, Passed)
    assert event.seconds == pytest.approx(0.93, abs=0.03)


def test_readings_that_swing_more_than_the_stability_range_take_nothing() -> None:
    axis = Axis()
    swinging = (
        replace(reading, value=reading.value + (1.1 * UM if number % 10 == 0 else 0))
        for number, reading in enumerate(axis.go(0))
    )
    assert kinds(happened(chain(axis.stand(), swinging), following(listed()))) == []


def test_readings_that_swing_within_the_stability_range_are_taken() -> None:
    axis = Axis()
    swinging = (
        replace(reading, value=reading.value + (0.9 * UM if number % 10 == 0 else 0))
        for number, reading in enumerate(axis.go(0))
    )
    assert kinds(happened(chain(axis.stand(), swinging), following(listed()))) == ["visit 1"]


def test_a_standstill_outside_the_tolerance_takes_nothing() -> None:
    axis = Axis(error={0: 1.01})
    assert kinds(happened(chain(axis.stand(), axis.go(0)), following(listed()))) == ["Elsewhere"]


def test_a_standstill_of_which_one_reading_is_outside_the_tolerance_takes_nothing() -> None:
    axis = Axis(error={0: -0.0999})
    beyond = (
        replace(reading, value=-0.1002 * MM) if number == 550 else reading
        for number, reading in enumerate(chain(axis.stand(), axis.go(0, stay=2)))
    )
    narrow = replace(SETTINGS, tolerance=0.1 * MM)
    assert kinds(happened(beyond, following(listed(), settings=narrow))) == ["visit 1"]


def test_motion_of_less_than_ten_times_the_stability_range_is_no_new_visit() -> None:
    """But the reading of the visit is its last standstill."""
    axis, follower = Axis(), following(listed(Method.PENDULUM))
    events = happened(chain(axis.stand(), axis.go(0), axis.go(-0.009), axis.go(-0.002)), follower)
    assert kinds(events) == ["visit 1", "visit 1", "visit 1"]
    assert follower.progress.read[1, Approach.POSITIVE].position == pytest.approx(-2 * UM)


@pytest.mark.parametrize("dwell", [0.3, 0.5, 1.0])
@pytest.mark.parametrize("after", [0.5, 1.2])
@pytest.mark.parametrize("correction", [25, 5, 0.8, -5, -9])
@pytest.mark.parametrize("error", [4.25, -4.25, 46, 150])
def test_a_control_that_corrects_its_position_is_read_where_it_stands_at_last(
    dwell: float, after: float, correction: float, error: float
) -> None:
    """−21.0 µm once was filed for +4.25, and what followed was dropped."""
    axis = Axis(error={100: error * 1e-3})
    follower = following(listed(), settings=replace(SETTINGS, dwell=dwell))
    happened(
        chain(axis.stand(), axis.go(0), axis.go(100 + (error - correction) * 1e-3, stay=after)), follower
    )
    happened(chain(axis.go(100), axis.go(150)), follower)
    assert follower.progress.read[2, Approach.POSITIVE].deviation == pytest.approx(error * UM, abs=0.1 * UM)


def test_a_position_that_settles_slowly_is_read_when_it_has_settled() -> None:
    """A control with a long integral part: 10 µm short, and every 0.8 s a third of what is left."""
    axis, follower = Axis(), following(listed())
    begin = 0.0

    def settling(readings):
        nonlocal begin
        begin = axis.time
        for reading in readings:
            yield replace(reading, value=reading.value - 10 * UM * exp(-(reading.time - begin) / 0.8))

    happened(chain(axis.stand(), axis.go(0), axis.turn(100), settling(axis.stand(6)), axis.go(200)), follower)
    assert follower.progress.read[2, Approach.POSITIVE].deviation == pytest.approx(0.0, abs=0.1 * UM)


@pytest.mark.parametrize(("settle", "filed"), [(0.0, 0.0), (0.4, 0.0), (2.0, -0.02), (0.2, 0.002)])
def test_only_a_standstill_as_long_as_it_must_settle_is_a_reading(settle: float, filed: float) -> None:
    """2.5 s at −20 µm, 1.2 s at 0, 0.3 s at +2 µm."""
    axis = Axis(error={100: -0.02})
    follower = following(listed(), settings=replace(SETTINGS, settle=settle))
    stops = chain(axis.go(100, stay=2.5), axis.go(100.0001, stay=1.2), axis.go(100.002, stay=0.3))
    happened(chain(axis.stand(), axis.go(0), stops, axis.go(200)), follower)
    assert follower.progress.read[2, Approach.POSITIVE].deviation == pytest.approx(filed * MM, abs=0.15 * UM)


def test_a_stop_short_of_its_target_gives_way_to_the_one_that_follows() -> None:
    """A feed hold 0.6 mm before the target."""
    axis, follower = Axis(), following(listed())
    events = happened(chain(axis.stand(), axis.go(-0.6), axis.go(0)), follower)
    assert kinds(events) == ["Repeated", "visit 1"]
    assert follower.progress.read[1, Approach.POSITIVE].position == 0.0


def test_an_axis_that_creeps_to_its_target_is_read_where_it_stands_at_last() -> None:
    axis, follower = Axis(), following(listed())
    events = happened(chain(axis.stand(), axis.go(-0.025, stay=1.5), axis.go(0)), follower)
    assert kinds(events) == ["visit 1", "visit 1"]
    assert follower.progress.read[1, Approach.POSITIVE].position == 0.0


def test_a_reading_that_departs_from_earlier_runs_is_asked_about() -> None:
    axis, follower = Axis(), following(listed(Method.UNIDIRECTIONAL, runs=2))
    happened(chain(axis.stand(), axis.go(0, 100, 200), axis.turn(-5)), follower)
    axis.error = {0: 0.06}
    (event,) = happened(axis.go(0, 20), follower)
    assert isinstance(event, Unclear)
    assert event.expected == pytest.approx(0.0)
    assert event.candidates[0][0] == listed(Method.UNIDIRECTIONAL, runs=2)[3]


@pytest.mark.parametrize(("answer", "expected"), [(1, ["Placed", "visit 1"]), (None, ["Placed", "Repeated"])])
def test_a_doubted_reading_is_filed_or_dropped_as_the_operator_says(answer, expected: list[str]) -> None:
    axis, follower = Axis(error={0: 0.3}), following(listed(), is_watched=True)
    (event,) = happened(chain(axis.stand(), axis.go(0)), follower)
    assert isinstance(event, Unclear)
    assert kinds(follower.take_answer(listed()[answer - 1] if answer else None)) == expected


@pytest.mark.parametrize(("slip", "holds"), [(0.004, True), (0.011, False)])
def test_the_capture_closes_on_the_datum_and_states_by_how_much_it_slipped(slip, holds) -> None:
    axis = Axis(error={-5: slip})
    follower = following(listed(Method.UNIDIRECTIONAL), datum=-5 * MM)
    events = happened(chain(axis.stand(), axis.go(0, 100, 200, -5)), follower)
    assert kinds(events)[-3:] == ["visit 3", "Closed", "Finished"]
    assert events[-2] == Closed(pytest.approx(slip * MM), holds)


def test_a_program_that_ends_where_it_stands_is_not_waited_for() -> None:
    axis, follower = Axis(), following(listed(Method.UNIDIRECTIONAL), datum=-5 * MM)
    events = happened(chain(axis.stand(), axis.go(0, 100, 200), axis.stand(2)), follower)
    assert kinds(events)[-2:] == ["visit 3", "Finished"]


@pytest.mark.parametrize("factor", [-1.0, 25.4, 1000.0, DEGREES, 0.5])
def test_a_display_that_reads_wrong_by_a_factor_is_known_by_it(factor: float) -> None:
    axis, follower = Axis(), following(listed(targets=(50, 100, 150)), datum=-5 * MM)
    wrong = (
        replace(reading, value=(reading.value + 5 * MM) / factor)
        for reading in chain(axis.stand(), axis.go(50))
    )
    *_, event = happened(wrong, follower)
    assert isinstance(event, Elsewhere)
    assert event.factor == factor


def test_readings_that_drift_at_a_target_are_named_with_their_rate() -> None:
    axis, follower = Axis(), following(listed())
    drifting = (
        replace(reading, value=reading.value + 3 * UM * max(0.0, reading.time - 103))
        for reading in chain(axis.stand(), axis.go(0, 50))
    )
    event = next(event for event in happened(drifting, follower) if isinstance(event, Passed))
    assert event.drift == pytest.approx(3 * UM, rel=0.05)


def test_a_pendulum_that_comes_back_to_its_last_visit_has_missed_none() -> None:
    axis = Axis()
    events = happened(
        chain(axis.stand(), axis.go(0), axis.turn(5), axis.go(0), axis.turn(5), axis.go(0)),
        following(listed(Method.PENDULUM, runs=2)),
    )
    assert kinds(events) == ["visit 1", "visit 2", "visit 2"]


def test_several_visits_that_were_passed_are_all_missed() -> None:
    axis = Axis()
    targets = (0, 50, 100, 150, 200)
    events = happened(chain(axis.stand(), axis.go(0), axis.go(200)), following(listed(targets=targets)))
    assert [event.visit.number for event in events if isinstance(event, Missed)] == [2, 3, 4]
    assert kinds(events)[-1] == "visit 5"


def test_two_missed_visits_of_a_pendulum_shift_no_run() -> None:
    axis, visits = Axis(), listed(Method.PENDULUM, runs=3)
    events = happened(
        chain(
            axis.stand(),
            axis.go(0),
            axis.turn(5),
            axis.go(0),
            axis.turn(-5),
            axis.go(0, stay=0.5),  # run 2
            axis.turn(5),
            axis.go(0, stay=0.5),
            axis.turn(-5),
            axis.go(0),  # run 3
        ),
        following(visits),
    )
    assert kinds(events) == ["visit 1", "visit 2", "Passed", "Passed", "Missed", "Missed", "visit 5"]
    assert visits[4].run == 3


def test_after_a_wrong_direction_the_right_one_is_taken() -> None:
    axis = Axis(position=5.0)
    events = happened(chain(axis.stand(), axis.go(0), axis.turn(-5), axis.go(0)), following(listed()))
    (wrong, taken) = events
    assert isinstance(wrong, WrongDirection)
    assert wrong.approach is Approach.NEGATIVE
    assert kinds([taken]) == ["visit 1"]


def test_an_axis_that_stands_at_the_target_from_the_beginning_has_no_direction() -> None:
    axis = Axis(position=0.0)
    (event,) = happened(axis.stand(), following(listed()))
    assert event == WrongDirection(listed()[0], None)


def test_a_rest_where_the_axis_turns_round_beyond_its_targets_is_no_question() -> None:
    axis, follower = Axis(), following(listed())
    happened(chain(axis.stand(), axis.go(0, 100, 200)), follower)
    assert kinds(happened(axis.go(200 + SETTINGS.overrun / MM), follower)) == []
    assert kinds(happened(axis.go(215), follower)) == ["Elsewhere"]


def test_a_stop_far_from_what_is_next_is_named_and_not_taken() -> None:
    axis = Axis(position=205.0)
    events = happened(chain(axis.stand(), axis.go(200)), following(listed()))
    assert kinds(events) == ["NotNext"]


def test_an_axis_that_moves_before_its_datum_is_taken_ends_it() -> None:
    axis, follower = Axis(), following(listed(), datum=-5 * MM)
    events = happened(chain(axis.turn(0), axis.go(0, stay=2)), follower)
    assert events == [MovedBeforeDatum(-5 * MM)]
    assert follower.progress.zero is None


def test_a_motion_that_a_bad_line_hides_before_the_datum_is_seen_all_the_same() -> None:
    axis, follower = Axis(), following(listed(), datum=-5 * MM)
    before, after = list(axis.stand(0.5)), list(axis.go(0, stay=2))
    hidden = [replace(reading, **UNREADABLE) for reading in after[:-150]]
    events = happened(chain(before, hidden, after[-150:]), follower)
    assert events == [MovedBeforeDatum(-5 * MM)]


def test_the_datum_is_taken_where_the_axis_stands_first() -> None:
    axis, follower = Axis(), following(listed(), datum=-5 * MM)
    shifted = (
        replace(reading, value=reading.value + 7.0) for reading in chain(axis.stand(), axis.go(0, stay=2))
    )
    datum, taken = happened(shifted, follower)
    assert isinstance(datum, DatumTaken)
    assert isinstance(taken, Recorded)
    assert taken.position == pytest.approx(0.0, abs=1e-12)
    assert taken.mean.value == pytest.approx(7.0)


def test_a_lost_zero_voids_the_rest_of_the_run_and_keeps_what_was_taken() -> None:
    axis, follower = Axis(), following(listed(runs=2))
    events = happened(
        chain(axis.stand(), axis.go(0, 100), axis.stand(0.01, **BEAM_LOST), axis.go(200)), follower
    )
    assert kinds(events) == ["visit 1", "visit 2", "ZeroLost"]
    assert follower.is_halted
    lost = events[-1]
    assert isinstance(lost, ZeroLost)
    assert [visit.number for visit in lost.void] == [3, 4, 5, 6]
    assert lost.message == "the beam is broken"


def test_after_a_lost_zero_the_run_is_taken_again_as_another_attempt() -> None:
    axis, first = Axis(), following(listed(runs=2), datum=-5 * MM)
    happened(chain(axis.stand(), axis.go(0, 100), axis.stand(1.5, **BEAM_LOST)), first)
    axis = Axis(time=500.0)
    second = Follower(first.progress.take_event(Resumed()), SETTINGS)
    events = happened(chain(axis.stand(), axis.go(0)), second)
    assert kinds(events) == ["DatumTaken", "visit 1"]
    assert events[1].attempt == 2


def test_a_zero_that_is_lost_between_two_runs_repeats_none() -> None:
    axis, follower = Axis(), following(listed(Method.UNIDIRECTIONAL, runs=2))
    happened(chain(axis.stand(), axis.go(0, 100, 200), axis.stand(1.5, **BEAM_LOST)), follower)
    assert (follower.progress.next.number, follower.progress.attempt) == (4, 1)


def test_a_pendulum_whose_zero_is_lost_begins_again_as_a_whole() -> None:
    axis, follower = Axis(), following(listed(Method.PENDULUM))
    happened(
        chain(
            axis.stand(), axis.go(0), axis.turn(5), axis.go(0), axis.turn(95), axis.stand(0.01, **BEAM_LOST)
        ),
        follower,
    )
    assert (follower.progress.next.number, follower.progress.attempt) == (1, 2)


def test_unreadable_lines_in_a_window_do_not_end_it() -> None:
    axis = Axis()
    events = happened(
        chain(axis.stand(), axis.go(0, stay=0.7), axis.stand(0.05, **UNREADABLE), axis.stand(0.3)),
        following(listed()),
    )
    assert kinds(events) == ["visit 1"]
    assert events[0].mean.skipped == 5


@pytest.mark.parametrize("fault", [Fault.DEVICE_ERROR, Fault.UNREADABLE, Fault.BEAM_LOST, Fault.TOO_FAST])
@pytest.mark.parametrize("lasts", [0.03, 0.3, 0.65])
def test_an_interruption_shorter_than_the_dwell_loses_nothing(fault: Fault, lasts: float) -> None:
    axis = Axis()
    broken = axis.stand(lasts, faults=fault, value=float("nan"))
    events = happened(
        chain(axis.stand(), axis.go(0, stay=0.7), broken, axis.stand(0.9 - lasts)), following(listed())
    )
    held = ["BeamHeld"] if fault in Fault.BEAM_LOST | Fault.TOO_FAST else []
    assert kinds(events) == [*held, "visit 1"]


@pytest.mark.parametrize("shift", [0.002, 1.58, -12.0])
@pytest.mark.parametrize("lasts", [0.03, 0.65])
def test_a_beam_after_which_the_display_shows_something_else_has_lost_the_zero(shift, lasts) -> None:
    axis = Axis()
    broken = axis.stand(lasts, **BEAM_LOST)
    events = happened(chain(axis.stand(), axis.go(0, stay=0.7), broken), follower := following(listed()))
    axis.position += shift
    assert kinds(events + happened(axis.stand(2.0), follower)) == ["ZeroLost"]


def test_a_beam_that_is_lost_in_motion_has_lost_the_zero() -> None:
    axis = Axis()
    moving = chain(axis.stand(), axis.go(0), axis.turn(50), axis.stand(0.01, **BEAM_LOST))
    assert kinds(happened(moving, following(listed()))) == ["visit 1", "ZeroLost"]


def test_a_gap_of_a_dwell_in_a_window_begins_it_anew_and_the_visit_is_taken_all_the_same() -> None:
    axis, follower = Axis(), following(listed())
    early = happened(chain(axis.stand(), axis.go(0, stay=0.7)), follower)
    axis.unseen(1.1)
    assert kinds(early + happened(axis.stand(0.9), follower)) == []
    assert kinds(happened(axis.stand(0.2), follower)) == ["visit 1"]


def test_a_direction_that_nobody_saw_is_not_guessed() -> None:
    axis, follower = Axis(), following(listed(Method.PENDULUM))
    happened(chain(axis.stand(), axis.go(-3, stay=0.02)), follower)
    axis.unseen(0.2, position=0.0)  # over the target and back, or straight to it
    (event,) = happened(axis.stand(), follower)
    assert event == WrongDirection(listed(Method.PENDULUM)[0], None)


def test_a_reversal_that_nobody_saw_takes_no_reading_for_that_before_it() -> None:
    axis, follower = Axis(), following(listed(Method.PENDULUM))
    swinging = (
        replace(reading, value=reading.value + (2 * UM if number % 2 else 0))
        for number, reading in enumerate(axis.go(0, stay=2.9))
    )
    assert kinds(happened(chain(axis.stand(), swinging), follower)) == []
    axis.unseen(0.3)  # its time at the target is over: it may have turned round
    assert "visit 1" not in kinds(happened(axis.stand(), follower))


def test_dropped_readings_count_for_the_time_that_they_took() -> None:
    axis, follower = Axis(), following(listed(Method.PENDULUM))
    happened(chain(axis.stand(), axis.go(-3, stay=0.02)), follower)
    axis.position = 0.0
    (event,) = happened(chain(axis.stand(0.01, skipped=30), axis.stand()), follower)
    assert event == WrongDirection(listed(Method.PENDULUM)[0], None)


def test_a_silence_in_which_a_visit_may_have_gone_unseen_is_named() -> None:
    axis, follower = Axis(), following(listed())
    happened(chain(axis.stand(), axis.go(0)), follower)
    axis.unseen(3.0)
    (event,) = happened(axis.stand(), follower)
    assert isinstance(event, TrackLost)


def test_readings_that_come_too_seldom_to_see_a_reversal_are_refused() -> None:
    axis, follower = Axis(step=0.5), following(listed())
    (event,) = happened(axis.stand(10), follower)
    assert isinstance(event, TooSlow)
    assert event.spacing == pytest.approx(0.5)


def test_an_axis_that_moves_before_its_datum_is_read_often_enough_is_told_of_that() -> None:
    axis, follower = Axis(step=0.5, position=-5.0), following(listed(), datum=-5 * MM)
    (event,) = happened(chain(axis.stand(2), axis.go(0, stay=2)), follower)
    assert isinstance(event, TooSlow)


def test_readings_of_which_none_may_see_the_axis_beyond_its_target_are_refused() -> None:
    axis, turn = Axis(step=0.06), replace(SETTINGS, turn=0.066)  # of which 0.053 beyond the tolerance
    (event,) = happened(axis.stand(10), following(listed(), settings=turn))
    assert isinstance(event, TooSlow)
    assert event.largest == pytest.approx(0.066 - 2 * 1 / 150)


@pytest.mark.parametrize("speed", [100, 150])
@pytest.mark.parametrize("step", [0.03, 0.04, 0.05])
def test_a_turn_that_few_readings_see_is_not_held_for_a_longer_stay(step: float, speed: float) -> None:
    settings = replace(SETTINGS, turn=2 * 5 / 150)
    for begin in np.linspace(0, step, 7, endpoint=False):
        events = happened(_read_with_lost_motion(speed, step, begin), following(listed(), settings=settings))
        filed = [event for event in events if isinstance(event, Recorded)]
        assert all(event.deviation * event.visit.approach > 0 for event in filed)
        assert {event.visit.number for event in filed} >= {1, 2, 3}


def test_a_turn_that_readings_see_at_uneven_distances_is_not_held_for_a_longer_stay() -> None:
    axis, settings = Axis(), replace(SETTINGS, turn=2 * 5 / 150)
    follower = following(listed(Method.PENDULUM), settings=settings)
    happened(chain(axis.stand(), axis.go(0)), follower)
    seen = []
    for elapsed, position in ((0.03, 0.6), (0.03, 4.9), (0.027, 0.85), (0.024, 0.0)):  # at 150 mm/s
        axis.unseen(elapsed - axis.step, position)
        seen.append(axis.reading())
    assert kinds(happened(chain(seen, axis.stand()), follower)) == ["WrongDirection"]


@pytest.mark.parametrize("method", Method)
def test_a_turn_that_two_readings_see_loses_no_visit(method: Method) -> None:
    speed, step = 50 / 3, 0.17
    settings = replace(SETTINGS, dwell=0.8, turn=2 * 5 / (1.5 * speed), feed=speed * MM)
    visits = listed(method, targets=(0, 20, 40), runs=2)
    assert step < settings.beyond < 2 * step  # at the largest feed one reading alone may see it
    for begin in np.linspace(0, step, 7, endpoint=False):
        readings = _read_with_lost_motion(speed, step, begin, planned(method, targets=(0, 20, 40), runs=2))
        events = happened(readings, following(visits, settings=settings))
        filed = [event for event in events if isinstance(event, Recorded)]
        assert [event.visit for event in filed] == list(visits)
        assert all(event.deviation * event.visit.approach > 0 for event in filed)


def test_gaps_in_which_the_axis_could_turn_round_hide_no_standstill() -> None:
    axis, follower = Axis(), following(listed())
    shown = [*axis.stand(), *axis.go(-3, stay=0.02)]
    axis.position = 0.0
    for _ in range(8):
        axis.unseen(0.2)
        shown += axis.stand(0.2)
    assert kinds(happened(shown, follower)) == ["WrongDirection"]


def test_a_line_that_another_overtook_is_no_turn() -> None:
    speed, step = 22, 0.1
    settings = replace(SETTINGS, dwell=0.8, turn=2 * 5 / (1.5 * speed), feed=speed * MM)
    plan = planned(Method.QUASI_PILGRIM, targets=(0, 20), runs=2)
    readings = list(_read_with_lost_motion(speed, step, 0.03, plan))
    moves = [
        place for place, (here, there) in enumerate(pairwise(readings)) if abs(there.value - here.value) > MM
    ]
    for place in moves[50:]:
        late, other = readings[place : place + 2]
        overtaken = [other, replace(late, time=other.time + 0.01)]
        lines = [*readings[:place], *overtaken, *readings[place + 2 :]]
        events = happened(lines, following(number_visits(plan), settings=settings))
        assert [event.visit for event in events if isinstance(event, Recorded)] == list(number_visits(plan))


def _read_with_lost_motion(
    speed: float, step: float, begin: float, plan: AxisPlan | None = None
) -> Iterator[LiveReading]:
    """Yield the readings of a test at a speed, mm/s, of an axis that stays 2 µm behind the way it came."""
    plan = plan or planned()
    stops = plan.stops
    rests = [0.0 if stop.target is None else 3.0 for stop in stops[1:]]
    corners = np.repeat([stop.position / MM for stop in stops], 2)
    ways = np.diff(corners)
    ways[::2] = 0.0
    headings = np.repeat(np.sign(ways[1::2]), 2)
    durations = zip(abs(ways[1::2]) / speed, rests, strict=True)
    times = np.cumsum([0.0, 3.0, *chain.from_iterable(durations)])
    for time in np.arange(begin, times[-1] - step, step):
        heading = np.append(headings[0], headings)[np.searchsorted(times, time, side="right") - 1]
        yield LiveReading(np.interp(time, times, corners) * MM + 2 * UM * heading, 100 + time)


def test_a_gap_in_which_the_axis_cannot_have_come_from_elsewhere_loses_no_visit() -> None:
    axis, follower = Axis(), following(listed())
    happened(chain(axis.stand(), axis.go(0), axis.turn(91)), follower)
    assert SETTINGS.beyond < 0.095 < SETTINGS.turn
    axis.unseen(0.085, position=100)
    assert kinds(happened(axis.stand(), follower)) == ["visit 2"]


def test_a_gap_too_short_to_turn_round_loses_no_visit_however_short_the_dwell_is() -> None:
    axis, brief = Axis(), replace(SETTINGS, dwell=0.15)
    follower = following(listed(), settings=brief)
    happened(chain(axis.stand(), axis.go(0), axis.turn(97)), follower)
    assert brief.largest_gap < 0.08 < brief.beyond
    axis.unseen(0.07, position=100)
    assert kinds(happened(axis.stand(), follower)) == ["visit 2"]


def test_a_gap_in_which_an_axis_at_rest_could_turn_round_does_not_delay_its_datum() -> None:
    axis, follower = Axis(), following(listed(), datum=-5 * MM)
    early = happened(axis.stand(0.7), follower)
    axis.unseen(0.2)
    assert kinds(early + happened(axis.stand(0.2), follower)) == ["DatumTaken"]


def test_a_gap_in_which_the_axis_may_have_turned_round_leaves_its_direction_unknown() -> None:
    axis, follower = Axis(), following(listed())
    happened(chain(axis.stand(), axis.go(0), axis.turn(100.9)), follower)
    axis.unseen(0.085, position=100)
    assert kinds(happened(axis.stand(), follower)) == ["WrongDirection"]


@pytest.mark.parametrize("value", [0.9, 1.4 * MM])  # further than the axis goes in that time, and not
@pytest.mark.parametrize("stay", [0.5, 3.0])
def test_a_single_damaged_reading_is_no_motion(value: float, stay: float) -> None:
    axis, follower = Axis(), following(listed(Method.PENDULUM))
    damaged = axis.stand(0.01, value=value)
    events = happened(chain(axis.stand(), axis.go(0, stay=stay), damaged, axis.stand(2)), follower)
    assert kinds(events) == ["visit 1"]


def test_a_single_damaged_reading_is_in_no_mean() -> None:
    axis, follower = Axis(), following(listed())
    (taken,) = happened(
        chain(axis.stand(), axis.go(0, stay=0.5), axis.stand(0.01, value=50 * UM), axis.stand(2)), follower
    )
    assert isinstance(taken, Recorded)
    assert taken.position == 0.0


def test_conditions_are_those_beside_the_reading() -> None:
    axis, follower = Axis(), following(listed())
    warm = (replace(each, conditions={"air_temperature": 293.65}) for each in axis.go(0))
    (taken,) = happened(chain(axis.stand(), warm), follower)
    assert taken.mean.conditions == {"air_temperature": 293.65}


def _interrupted(moved_by: float = 0.0) -> tuple[Axis, Follower]:
    """Return an axis and a follower that was interrupted after two visits."""
    axis, first = Axis(), following(listed())
    happened(chain(axis.stand(), axis.go(0, 100)), first)
    axis.time += 1000
    axis.error = dict.fromkeys((0, 100, 200), moved_by)
    return axis, Follower(first.progress.take_event(Resumed()), SETTINGS)


def test_after_an_interruption_the_datum_is_held_against_an_earlier_reading() -> None:
    axis, follower = _interrupted(moved_by=0.003)
    events = happened(chain(axis.turn(95), axis.go(100, 200)), follower)
    assert kinds(events) == ["DatumHolds", "visit 3"]
    assert events[0].difference == pytest.approx(3 * UM, abs=1e-12)


def test_where_the_datum_is_checked_comes_next_and_a_way_there_that_nobody_saw_is_told_of() -> None:
    axis, follower = _interrupted()
    assert (follower.progress.check, follower.progress.destination) == (listed()[1], 100 * MM)
    axis.position = 100.0
    (told,) = happened(axis.stand(), follower)
    assert told == WrongDirection(listed()[1], None)
    happened(chain(axis.turn(95), axis.go(100)), follower)
    assert (follower.progress.check, follower.progress.destination) == (None, 200 * MM)


def test_an_order_to_take_a_visit_again_outlives_a_standstill_that_goes_on() -> None:
    axis, follower = Axis(), following(listed())
    happened(chain(axis.stand(), axis.go(0, 100)), follower)
    visits = follower.progress.visits
    follower.take_order(Retake(visits[0], visits[0]))
    axis.error = {100: 0.003}
    events = happened(chain(axis.go(100), axis.turn(-5), axis.go(0, 200)), follower)
    assert kinds(events) == ["visit 1", "visit 3"]


@pytest.mark.parametrize(("method", "way"), [(Method.PENDULUM, (5, 0)), (Method.UNIDIRECTIONAL, (0, 20))])
def test_a_program_that_begins_after_a_visit_that_is_left_out_repeats_none(
    method: Method, way: tuple[float, float]
) -> None:
    """The way is that of a program that comes back to its last visit, too: the operator is asked."""
    axis, follower = Axis(), following(listed(method, targets=(0, 20), runs=2))
    corner, target = way
    happened(chain(axis.stand(), axis.go(0), axis.turn(5), axis.go(target)), follower)
    follower.take_order(Skipped(follower.progress.next))
    (asked,) = happened(chain(axis.turn(corner), axis.go(target)), follower)
    assert isinstance(asked, Unclear)
    (visit, share), *_ = asked.candidates
    assert visit.number == 4
    assert share == pytest.approx(1 / (1 + exp(-4.0)), abs=1e-3)


def test_after_an_interruption_nothing_is_taken_before_the_datum_is_checked() -> None:
    axis, follower = _interrupted()
    assert kinds(happened(axis.go(200), follower)) == ["NotChecked"]


def test_the_visit_that_checks_the_datum_is_not_taken_for_a_later_one() -> None:
    axis, first = Axis(), following(listed(Method.PENDULUM, runs=2))
    happened(chain(axis.stand(), axis.go(0), axis.turn(5), axis.go(0)), first)
    axis.time += 1000
    second = Follower(first.progress.take_event(Resumed()), SETTINGS)
    events = happened(chain(axis.turn(5), axis.go(0), axis.turn(-5), axis.go(0)), second)
    assert kinds(events) == ["DatumHolds", "visit 3"]


def test_a_datum_that_has_moved_voids_the_rest_of_the_run() -> None:
    axis, follower = _interrupted(moved_by=0.011)
    (event,) = happened(chain(axis.turn(95), axis.go(100, 200)), follower)
    assert isinstance(event, DatumMoved)
    assert [visit.number for visit in event.void] == [3, 4, 5, 6]
    assert follower.progress.attempt == 2


def test_in_a_later_run_the_check_is_a_visit_itself() -> None:
    axis, first = Axis(), following(listed(Method.UNIDIRECTIONAL, runs=2))
    happened(chain(axis.stand(), axis.go(0, 100, 200)), first)
    axis.time += 1000
    second = Follower(first.progress.take_event(Resumed()), SETTINGS)
    assert kinds(happened(chain(axis.turn(-5), axis.go(0)), second)) == ["DatumHolds", "visit 4"]


def test_following_ends_when_the_test_is_over() -> None:
    axis, visits = Axis(), listed(Method.UNIDIRECTIONAL)
    readings = chain(axis.stand(), axis.go(0, 100, 200), iter(axis.reading, None))
    follower = Follower(Progress.begin(visits, None), SETTINGS)
    until_halted = takewhile(lambda _: not follower.is_halted, readings)
    *_, last = chain.from_iterable(map(follower.feed, until_halted))
    assert type(last).__name__ == "Finished"
