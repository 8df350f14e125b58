"""Where the program is: found from the stops so far, or asked for, and never guessed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain
from math import exp, inf, log
from statistics import NormalDist

import pytest

from live.capture.moves import SETTINGS, Axis, following, happened, kinds, listed
from live.capture.wandering import trial
from zlmreport.live.capture.events import Mean, Presumed, Recorded, Unclear
from zlmreport.live.capture.motion import Programme, Route
from zlmreport.live.capture.place import PlaceInProgram, TargetStandstill, _Guess, _merge
from zlmreport.live.ports.reading import LiveReading
from zlmreport.measurement.approach import Approach
from zlmreport.model.planning.methods import Method

TARGETS = (0, 50, 100, 150, 200)
THERE, BACK = TARGETS, TARGETS[::-1]


def _run(axis: Axis):
    yield from axis.go(*THERE)
    yield from axis.turn(205)
    yield from axis.go(*BACK)
    yield from axis.turn(-5)


def _stalled(axis: Axis, *targets: int):
    """Go to targets, and arrive at each while the line is silent; the rest that is left is too short."""
    for target in targets:
        yield from axis.go(target - 10, stay=axis.step)
        axis.unseen(2.5, position=target)
        yield from axis.stand(0.6)


def test_two_visits_that_nobody_saw_are_two_that_are_lost() -> None:
    """The next run's readings once were filed as this run's, and the capture never ended."""
    axis, visits = Axis(), listed(targets=TARGETS, runs=3)
    rest = chain(axis.go(150, 200), axis.turn(205), axis.go(*BACK), axis.turn(-5))
    events = happened(
        chain(axis.stand(), axis.go(0), _stalled(axis, 50, 100), rest, _run(axis), _run(axis)),
        following(visits),
    )
    seen = [f"visit {number}" for number in range(4, 31)]
    assert kinds(events) == ["visit 1", "Missed", "Missed", *seen, "Finished"]


def test_a_silence_over_whole_visits_loses_these_alone() -> None:
    axis = Axis()
    begin = happened(chain(axis.stand(), axis.go(0)), follower := following(listed(targets=TARGETS, runs=2)))
    axis.unseen(3 + 3.5 + 0.3, position=130.0)
    events = begin + happened(axis.go(150, 200), follower)
    assert kinds(events) == ["visit 1", "TrackLost", "Missed", "Missed", "visit 4", "visit 5"]


def test_a_program_that_begins_anew_is_asked_for() -> None:
    axis, follower = Axis(), following(listed(targets=TARGETS, runs=3))
    events = happened(chain(axis.stand(), axis.go(0, 50, 100), axis.turn(-5), axis.go(0)), follower)
    assert kinds(events) == ["visit 1", "visit 2", "visit 3", "Unclear"]
    question = events[-1]
    assert isinstance(question, Unclear)
    assert {visit.number for visit, share in question.candidates if visit and share > 0.1} == {1, 11, 21}
    assert follower.is_halted


def test_an_answer_files_the_reading_that_was_asked_about() -> None:
    visits = listed(targets=TARGETS, runs=3)
    axis, follower = Axis(), following(visits, is_watched=True)
    happened(chain(axis.stand(), axis.go(0, 50, 100), axis.turn(-5), axis.go(0)), follower)
    missed = ["Missed"] * 7
    assert kinds(follower.take_answer(visits[10])) == ["Placed", *missed, "visit 11"]
    assert kinds(happened(axis.go(50), follower)) == ["visit 12"]


def test_stops_that_follow_a_question_are_filed_with_its_answer() -> None:
    visits = listed(targets=TARGETS, runs=3)
    axis, follower = Axis(), following(visits, is_watched=True)
    happened(chain(axis.stand(), axis.go(0, 50, 100), axis.turn(-5), axis.go(0, 50)), follower)
    assert kinds(follower.take_answer(visits[0])) == ["Placed", "visit 1", "visit 2"]


def test_a_stop_that_is_no_visit_is_told_to_be_none() -> None:
    axis, follower = Axis(), following(listed(targets=TARGETS, runs=3), is_watched=True)
    happened(chain(axis.stand(), axis.go(0, 50, 100), axis.turn(-5), axis.go(0)), follower)
    assert kinds(follower.take_answer(None)) == ["Placed", "NotNext"]


def test_a_stop_that_was_told_to_be_none_leaves_open_that_the_program_began_anew() -> None:
    """A feed hold short of the first target of a program that began anew; then the display stood still."""
    axis, follower = Axis(), following(listed(targets=TARGETS, runs=3), is_watched=True)
    happened(chain(axis.stand(), axis.go(0, 50, 100), axis.turn(-5), axis.go(-0.6)), follower)
    assert kinds(follower.take_answer(None)) == ["Placed", "NotNext"]
    assert kinds(happened(chain(axis.stand(17), axis.go(0)), follower)) == ["Frozen", "Unclear"]


@pytest.mark.parametrize("method", Method)
def test_programs_that_do_not_go_as_planned_misfile_nothing(method: Method) -> None:
    """Skips, stalls, repeats, feed holds and new beginnings; 10,400 of them: ``./run benchmark capture``.

    Of so many, some hundredths name a run that was begun anew for the next one.
    """
    for seed in range(12):
        done = trial(method, seed)
        assert (done.misfiled, done.lost, done.unnamed) == ([], set(), set()), seed


@pytest.mark.parametrize(
    ("method", "seed"),
    [
        (Method.UNIDIRECTIONAL, 476),  # a run began anew past its first target, as the next
        (Method.PENDULUM, 1218),  # the program began in a silence, and was at its fourth visit after it
        (Method.PENDULUM, 1638),
        (Method.QUASI_PILGRIM, 1052),
    ],
)
def test_what_once_was_misfiled_or_lost_is_asked_about(method: Method, seed: int) -> None:
    done = trial(method, seed)
    assert (done.misfiled, done.lost, done.unnamed) == ([], set(), set())
    assert done.questions


#: Targets 100 mm apart: 1 s of way and 3 s of rest from one to the next.
PROGRAMME = Programme(listed(targets=TARGETS[::2], runs=2), SETTINGS)
UP, DOWN = Approach.POSITIVE, Approach.NEGATIVE


def placed(taken: int = 0) -> PlaceInProgram:
    return PlaceInProgram(PROGRAMME, SETTINGS, taken, last=None)


def stop(number: int, heading: Approach | None = UP, time: float = 0.0) -> TargetStandstill:
    """Return a stop at the target of a visit, counted from 1."""
    visit = PROGRAMME.visits[number - 1]
    return TargetStandstill(
        visit.target, heading, heading, visit.position, Mean(0.0, 0.0, 100, 0, time, 3.0, {})
    )


def test_explanations_that_end_alike_weigh_together() -> None:
    guess = _Guess(0, log(0.25), None, 0, 0)
    assert exp(_merge([guess, guess]).weight) == pytest.approx(0.5)


def test_an_operator_is_believed_who_names_a_visit_that_nothing_speaks_for() -> None:
    place, route = placed(), Route(SETTINGS.tolerance)
    route.add(PROGRAMME.start)
    place.add(stop(1), route)
    place.take_word(3)
    place.add(stop(5, DOWN, 4.0), route)
    assert place.list_odds()[4] > 0.9


def test_of_visits_that_went_unseen_many_are_less_likely_than_few() -> None:
    place = PlaceInProgram(Programme(listed(targets=TARGETS), SETTINGS), SETTINGS, 0)
    weights = [place._weigh_by_route(_Guess(0, 0.0, 0.0, 0, 0), index, []) for index in (1, 2, 3)]
    assert weights[2] < weights[1] < weights[0] == 0.0


def test_the_first_visit_at_a_place_is_the_one_that_a_program_begins_with() -> None:
    """Told to begin, the axis came from anywhere: not with the second run while the first is to be read."""
    place, route = placed(), Route(SETTINGS.tolerance)
    first, next_target, second_run = (place._weigh_from_rest(-1, index, [], route) for index in (0, 1, 6))
    assert second_run == -inf < next_target < first == 0.0


def test_a_program_that_hurried_left_out_as_many_rests_as_time_is_short() -> None:
    """Two visits on are 2 s of way and two rests of 3 s."""
    place, planned = placed(), PROGRAMME.compute_time(0, 2)
    assert planned == pytest.approx(8.0)
    likely, less = (place._weigh_hurry(0, 2, planned - 3.0 * each) for each in (1.0, 2.0))
    assert likely / less == pytest.approx(exp(1.5))
    assert place._weigh_hurry(0, 2, planned - 0.3) == pytest.approx(likely)  # one rest at the least
    assert place._weigh_hurry(0, 2, (planned - 6.0) / 2) == 0.0  # faster than an axis goes


def test_no_time_at_all_is_a_time_too_short_and_not_a_second() -> None:
    place = placed()
    guess = _Guess(0, 0.0, 5.0, 0, 0)
    at_once, late = (place._weigh_by_time(guess, 1, stop(2, time=time)) for time in (5.0, 9.0))
    assert at_once == -20.0
    assert late > 0.0


def test_a_time_is_as_likely_as_its_distance_from_the_plan_and_what_was_left_out() -> None:
    """30 % too early, in logarithms: one standard deviation; a rest left out counts as well."""
    time = PROGRAMME.compute_time(0, 1) * exp(-0.3)
    weight = placed()._weigh_by_time(_Guess(0, 0.0, 0.0, 0, 0), 1, stop(2, time=time))
    assert exp(weight) == pytest.approx(NormalDist(0, 0.3).pdf(-0.3) + exp(-3.0 - 1.5))


def test_the_way_from_the_start_with_its_turns_speaks_for_a_visit() -> None:
    """The fourth visit is behind a turn; two visits in between went unseen, and one more."""
    route = Route(SETTINGS.tolerance)
    route.add(PROGRAMME.start)
    assert placed()._weigh_from_rest(-1, 3, [0.205], route) == pytest.approx(3.0 - 1.0 * 3)


def test_an_axis_goes_on_to_the_same_target_and_only_a_little() -> None:
    near, far = (replace(stop(1), position=stop(1).position + each) for each in (1e-3, 50e-3))
    beside = replace(stop(1), target=2)
    assert [placed()._is_same(stop(1), each) for each in (near, far, beside)] == [True, False, False]


def test_a_program_that_ran_on_unwatched_did_so_from_the_last_visit_that_was_read() -> None:
    told, ran_on = PlaceInProgram(PROGRAMME, SETTINGS, 2, last=5.0)._guesses
    assert (told.place, told.is_told) == (1, True)
    assert (ran_on.place, ran_on.is_told, ran_on.time, ran_on.weight) == (1, False, 5.0, -7.0)


@pytest.mark.parametrize(
    ("before", "after", "files", "weight"),
    [
        (UP, DOWN, (1, 1), 0.0),  # it was seen how the axis came
        (None, None, (1, 1), 0.0),  # nor is it now
        (None, UP, (1, 1), 0.0),
        (None, DOWN, (1, None), -13.0),  # the other way round: no stop of the program
    ],
)
def test_an_axis_that_goes_on_shows_how_it_came(
    before: Approach | None, after: Approach | None, files: tuple[int | None, ...], weight: float
) -> None:
    guess = placed()._go_on(_Guess(1, 0.0, 0.0, 0, 0, files=(1,)), stop(2, before), stop(2, after))
    assert (guess.place, guess.files, guess.weight) == (1, files, weight)


@pytest.mark.parametrize(
    "left_out", [{1}, {1, 2}, {6}, {6, 7}, {7}, {12}, {11, 12}, {12, 13}, {13, 14}, {23, 24}]
)
def test_a_run_of_which_a_rest_or_two_are_left_out_goes_on_as_that_run(left_out: set[int]) -> None:
    """The program passes those targets without a stop; eleven passed ones would be the next run."""
    axis, follower = Axis(), following(listed(targets=range(0, 120, 20), runs=2))
    events = happened(_passing(axis, left_out), follower)
    assert not any(isinstance(event, Unclear) for event in events)
    filed = {event.visit.number for event in events if isinstance(event, Recorded)}
    assert filed == set(range(1, 25)) - left_out


def test_what_is_not_quite_sure_is_said_and_taken() -> None:
    axis, follower = Axis(), following(listed(targets=range(0, 120, 20), runs=2))
    (presumed,) = (event for event in happened(_passing(axis, {12}), follower) if isinstance(event, Presumed))
    assert presumed.visit.number == 13
    assert 0.99 < presumed.share < 0.999


def _passing(axis: Axis, left_out: set[int]) -> Iterator[LiveReading]:
    """Go through two runs over six targets; at those left out the axis does not stop."""
    yield from axis.stand(2)
    number = 0
    for _ in range(2):
        for up in (True, False):
            for target in range(0, 120, 20) if up else range(100, -20, -20):
                number += 1
                yield from axis.go(target, stay=axis.step if number in left_out else 3.0)
            yield from axis.turn(105 if up else -5)
