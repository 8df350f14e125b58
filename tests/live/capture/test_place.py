"""Where the program is: found from the stops so far, or asked for, and never guessed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain
from math import exp, log
from statistics import NormalDist

import pytest

from live.capture.moves import SETTINGS, Axis, following, happened, kinds, listed
from live.capture.wandering import trial
from zlmreport.live.capture.events import Mean, Presumed, Recorded, Unclear
from zlmreport.live.capture.motion import PlannedRoute, Route
from zlmreport.live.capture.place import PlaceInProgram, TargetStandstill
from zlmreport.model.planning.methods import Method
from zlmreport.plugin import Approach
from zlmreport.plugin.instrument import LiveReading

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
PLANNED = PlannedRoute(listed(targets=range(0, 500, 100), runs=2), SETTINGS)
UP, DOWN = Approach.POSITIVE, Approach.NEGATIVE


def stop(number: int, heading: Approach | None = UP, time: float = 0.0) -> TargetStandstill:
    """Return a stop at the target of a visit, counted from 1."""
    visit = PLANNED.visits[number - 1]
    return TargetStandstill(
        visit.target, heading, heading, visit.position, Mean(0.0, 0.0, 100, 0, time, 3.0, {})
    )


def from_start(*turns: float) -> Route:
    """Return the way from the start of the program, with turning points."""
    route = Route(SETTINGS.tolerance)
    for position in (PLANNED.start, PLANNED.start + 0.01, *turns, *(each - 0.01 for each in turns)):
        route.add(position)
    return route


def at_first_visit(*, is_seen: bool = True) -> tuple[PlaceInProgram, Route]:
    """Return a program that made its first visit at 0 s; nobody sees what comes then, if it is not seen."""
    place, route = PlaceInProgram(PLANNED, SETTINGS, 0), from_start()
    place.add(stop(1), route)
    assert [index for _, index, _ in place.settle_stops()] == [0]
    if not is_seen:
        route.lose()
    return place, route


def weigh(place: PlaceInProgram, number: int) -> float:
    """Return the logarithm of how much likelier a visit is than that the stop is none of the program."""
    odds = place.list_odds()
    return log(odds[number - 1] / odds[None])


def test_an_operator_is_believed_who_names_a_visit_that_nothing_speaks_for() -> None:
    place, route = PlaceInProgram(PLANNED, SETTINGS, 0), Route(SETTINGS.tolerance)
    route.add(PLANNED.start)
    place.add(stop(1), route)
    place.take_word(5)
    place.add(stop(7, DOWN, 4.0), route)
    assert place.list_odds()[6] > 0.9


def test_of_visits_that_went_unseen_many_are_less_likely_than_few() -> None:
    weights = []
    for number in (2, 3, 4):
        place, route = at_first_visit()
        place.add(stop(number), route)
        weights.append(weigh(place, number))
    assert weights == pytest.approx([13.0, 12.0, 11.0])


def test_the_first_visit_at_a_place_is_the_one_that_a_program_begins_with() -> None:
    """Told to begin, the axis came from anywhere: not with the second run while the first is to be read."""
    anywhere = Route(SETTINGS.tolerance)
    first, second = (PlaceInProgram(PLANNED, SETTINGS, 0) for _ in range(2))
    first.add(stop(1), anywhere)
    second.add(stop(2), anywhere)
    odds = first.list_odds()
    assert odds[10] < 1e-3 * odds[0]
    assert weigh(first, 1) == pytest.approx(13.0)
    assert weigh(second, 2) == pytest.approx(-2.0)  # the way that it came would be no way of the program


@pytest.mark.parametrize(("silence", "weight"), [(4.0, 5.0 - 0.5 - 2 * 0.3), (3.9, 5.0 - 2.0 - 6.0)])
def test_a_program_may_have_begun_in_a_silence_of_half_the_time_that_it_needs(
    silence: float, weight: float
) -> None:
    """From the first visit to the third it needs 8 s."""
    place, route = PlaceInProgram(PLANNED, SETTINGS, 0), Route(SETTINGS.tolerance)
    route.lose(silence)
    place.add(stop(3), route)
    assert weigh(place, 3) == pytest.approx(weight)


@pytest.mark.parametrize(
    ("number", "turns", "weight"),
    [(1, (), 13.0), (6, (0.405,), 13.0 - 5.0 + 3.0)],
    ids=["first", "behind a turn, five unseen"],
)
def test_the_way_from_the_start_with_its_turns_speaks_for_a_visit(
    number: int, turns: tuple[float, ...], weight: float
) -> None:
    place = PlaceInProgram(PLANNED, SETTINGS, 0)
    place.add(stop(number, DOWN if turns else UP), from_start(*turns))
    assert weigh(place, number) == pytest.approx(weight)


@pytest.mark.parametrize(
    ("seconds", "left_out"),
    [
        (4.0 * exp(-0.3), 1.0),  # 30 % too early, in logarithms: one standard deviation
        (3.9, 1.0),  # one rest at the least
        (1.2, 1.0),
        (0.9, 3.1 / 3.0),
    ],
)
def test_a_time_is_as_likely_as_its_distance_from_the_plan_and_the_rests_that_were_left_out(
    seconds: float, left_out: float
) -> None:
    place, route = at_first_visit(is_seen=False)
    place.add(stop(2, time=seconds), route)
    likely = NormalDist(0, 0.3).pdf(log(seconds / 4.0)) + exp(-3.0 - 1.5 * left_out)
    assert weigh(place, 2) == pytest.approx(13.0 + log(likely))


@pytest.mark.parametrize("seconds", [0.0, 0.4])
def test_a_time_that_no_axis_goes_so_fast_in_speaks_for_no_visit(seconds: float) -> None:
    """What is left is that the program began anew, in the one run as well as in the other."""
    place, route = at_first_visit(is_seen=False)
    place.add(stop(2, time=seconds), route)
    assert weigh(place, 2) == pytest.approx(weigh(place, 12))


def test_an_axis_goes_on_to_the_same_target_and_only_a_little() -> None:
    for distance, odds_of_none in ((1e-3, 0.0), (50e-3, exp(-13.0 + 4.0))):
        place, route = at_first_visit()
        place.add(replace(stop(1), position=stop(1).position + distance), route)
        odds = place.list_odds()
        assert odds.get(None, 0.0) / odds[0] == pytest.approx(odds_of_none)


def test_a_program_that_ran_on_unwatched_did_so_from_the_last_visit_that_was_read() -> None:
    """Either the operator began it anew and three visits went unseen, or it ran on for their time."""
    told, ran_on = (PlaceInProgram(PLANNED, SETTINGS, 1, last) for last in (None, 5.0))
    for each in (told, ran_on):
        each.add(stop(5, time=5.0 + 4 * 4.0), Route(SETTINGS.tolerance))
    began = -3.0 - 6.0
    unwatched = -7.0 - 0.5 - 3 * 0.05 + log(NormalDist(0, 0.3).pdf(0.0) + exp(-3.0 - 1.5))
    assert weigh(told, 5) == pytest.approx(5.0 + began)
    assert weigh(ran_on, 5) == pytest.approx(5.0 + log(exp(began) + exp(unwatched)), abs=1e-5)


@pytest.mark.parametrize(
    ("before", "after", "time", "indices"),
    [
        (UP, DOWN, 4.0, [1, 1]),  # it was seen how the axis came
        (None, UP, 4.0, [None, 1]),
        (None, DOWN, 4.0, [None, None]),  # the other way round: no stop of the program
        (None, DOWN, 8 * 4.0, [None]),  # or the ninth visit: it is asked about
    ],
)
def test_an_axis_that_goes_on_shows_how_it_came(
    before: Approach | None, after: Approach | None, time: float, indices: list[int | None]
) -> None:
    place, route = at_first_visit(is_seen=False)
    for heading in (before, after):
        place.add(stop(2, heading, time), route)
    assert [index for _, index, _ in place.settle_stops()] == indices


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
