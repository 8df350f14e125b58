"""A display that is switched or loses counts: named before anything more is filed, and told from an axis."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import chain, pairwise

import pytest

from live.capture.moves import MM, SETTINGS, UM, Axis, following, happened, kinds, listed
from zlmreport.live.capture.display import JumpWatch, Offsets
from zlmreport.live.capture.events import Elsewhere, Event, Recorded, Resumed, Unclear
from zlmreport.live.capture.follower import Follower
from zlmreport.plugin.instrument import DatumHolds, LiveReading, ScaleChanged

INCH = 25.4
#: The actual position at each target, mm off.
TRUE = 0.00625
#: At ten readings a second the axis needs longer to be seen to turn.
SLOW = replace(SETTINGS, turn=0.5)


def course(step: float = 0.01) -> Iterator[LiveReading]:
    """Go over three targets up and down; a visit every 4 s, the first from 102.05 s on."""
    axis = Axis(step=step, error=dict.fromkeys((0, 100, 200), TRUE))
    yield from axis.stand(2)
    yield from axis.go(0, 100, 200)
    yield from axis.turn(205)
    yield from axis.go(200, 100, 0, -5)


def shown(change: Callable[[float], float], since: float, step: float = 0.01) -> Iterator[LiveReading]:
    """Return what a display shows that does something else from a time on, s from the start."""
    for reading in course(step):
        yield replace(reading, value=change(reading.value)) if reading.time - 100 >= since else reading


def filed(events: list[Event]) -> dict[int, float]:
    """Return the readings that stand, in µm off their target, by visit."""
    return {each.visit.number: each.deviation / UM for each in events if isinstance(each, Recorded)}


@pytest.mark.parametrize("since", [2.02, 3.5, 5.0, 5.5, 6.5, 8.6, 9.5, 11.6, 14.0, 15.5, 18.0, 20.5])
def test_a_display_that_is_switched_to_inches_is_named_and_no_wrong_reading_stands(since: float) -> None:
    follower = following(listed())
    events = happened(shown(lambda value: value / INCH, since), follower)
    (changed,) = (event for event in events if isinstance(event, ScaleChanged))
    assert changed.factor == pytest.approx(INCH)
    stand = {number: value for number, value in filed(events).items() if number <= follower.progress.taken}
    assert stand == pytest.approx(dict.fromkeys(stand, 6.25))
    assert follower.is_halted


@pytest.mark.parametrize("factor", [1 / INCH, 1000.0, 1 / 1000.0])
@pytest.mark.parametrize("since", [6.5, 9.5, 12.0])
def test_other_units_are_named_or_asked_about(factor: float, since: float) -> None:
    events = happened(shown(lambda value: value / factor, since), following(listed()))
    assert filed(events) == pytest.approx(dict.fromkeys(filed(events), 6.25))
    *_, last = events
    assert isinstance(last, Unclear) or (
        isinstance(last, ScaleChanged) and last.factor == pytest.approx(factor)
    )


@pytest.mark.parametrize("since", [5.0, 7.0, 9.5])
def test_ten_readings_a_second_are_enough(since: float) -> None:
    follower = following(listed(), settings=SLOW)
    events = happened(shown(lambda value: value / INCH, since, step=0.1), follower)
    assert any(isinstance(event, ScaleChanged) for event in events)
    assert filed(events)[1] == pytest.approx(6.25)


def test_a_pause_not_quite_where_a_target_would_be_in_inches_is_a_pause() -> None:
    axis = Axis()
    events = happened(chain(axis.stand(), axis.go(0, 100.6 / INCH, 100)), following(listed()))
    assert kinds(events) == ["visit 1", "Elsewhere", "visit 2"]


def test_when_it_is_set_back_the_test_goes_on_where_it_was() -> None:
    """The reading near the display's own zero may have been by the other unit: it is taken again."""
    first = following(listed())
    happened(shown(lambda value: value / INCH, 3.5), first)
    assert first.progress.taken == 0
    second = Follower(first.progress.take_event(Resumed()), SETTINGS)
    events = happened(course(), second)
    assert any(isinstance(event, DatumHolds) for event in events)
    assert filed(events) == pytest.approx(dict.fromkeys(range(1, 7), 6.25))


@pytest.mark.parametrize("counts", [5, -5, 1.58])
@pytest.mark.parametrize("since", [6.5, 9.5, 14.0])
def test_lost_counts_are_no_other_unit(counts: float, since: float) -> None:
    events = happened(shown(lambda value: value + counts * MM, since), following(listed(), datum=-5 * MM))
    assert kinds(events)[-1] == "ZeroLost"
    assert not any(isinstance(event, ScaleChanged) for event in events)
    assert filed(events) == pytest.approx(dict.fromkeys(filed(events), 6.25))


def test_a_display_in_inches_from_the_beginning_has_lost_no_counts() -> None:
    axis, datum = Axis(), -5 * MM
    motion = chain(axis.stand(2), axis.go(0, 20), axis.turn(25), axis.go(20, 0, -5))
    shown = (replace(each, value=(each.value - datum) / INCH) for each in motion)
    events = happened(shown, following(listed(targets=(0, 20)), datum=datum))
    factors = [each.factor for each in events if isinstance(each, Elsewhere)]
    assert factors[:4] == [pytest.approx(INCH)] * 4
    assert "ZeroLost" not in kinds(events)


def test_a_jump_from_rest_to_rest_loses_the_zero_at_once() -> None:
    events = happened(shown(lambda value: value + 5 * MM, 8.0), following(listed()))
    assert kinds(events) == ["visit 1", "visit 2", "ZeroLost"]
    assert "jumped while the axis stood still" in events[-1].message


def test_an_axis_that_does_what_it_should_is_no_display_that_fails() -> None:
    expected = [*(f"visit {each}" for each in range(1, 7)), "Finished"]
    assert kinds(happened(course(), following(listed()))) == expected


def test_a_single_damaged_reading_is_no_other_unit() -> None:
    """Its point is lost, so it is a thousand times as large, and the next is a thousandth of it."""
    readings = [
        replace(reading, value=reading.value * 1000) if index in {560, 900, 901} else reading
        for index, reading in enumerate(course())
    ]
    events = happened(readings, following(listed()))
    assert not any(isinstance(event, ScaleChanged) for event in events)
    assert filed(events) == pytest.approx(dict.fromkeys(range(1, 7), 6.25))


def test_two_stops_that_are_off_by_the_same_have_lost_counts_and_others_have_not() -> None:
    visits = listed(targets=(0, 100, 200))
    lost, other, read = (Offsets(visits, 10 * UM) for _ in range(3))
    assert [lost.is_lost(position, 1) for position in (0.105, 0.205)] == [False, True]
    assert [other.is_lost(position, 1) for position in (0.105, 0.199)] == [False, False]
    assert [read.is_lost(position, taken) for position, taken in ((0.105, 1), (0.205, 2))] == [False, False]


def test_an_answer_that_waited_for_a_busy_computer_is_no_jump() -> None:
    """It was taken up to a second before its time, and the axis has gone on meanwhile."""
    axis, watch = Axis(position=100.0), JumpWatch(SETTINGS)
    readings = [*axis.stand(0.5)]
    late = replace(readings[-1], time=readings[-1].time + 1.0, within=1.0)
    axis.unseen(1.0, position=100 / INCH)
    found = []
    for before, reading in pairwise([*readings, late, *axis.stand(0.1)]):
        found.append(watch.add(before, reading, is_at_rest=True))
    assert set(found) == {None}
