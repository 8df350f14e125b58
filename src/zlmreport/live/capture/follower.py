"""Follows an axis along its visit list, reading by reading, and gives events; no port, no clock, no file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from zlmreport.live.capture.ahead import WayAhead
from zlmreport.live.capture.display import FreezeWatch, JumpWatch, Offsets
from zlmreport.live.capture.events import (
    HALTING,
    BeamHeld,
    Closed,
    Commented,
    DatumTaken,
    Event,
    Finished,
    Frozen,
    Mean,
    Missed,
    MovedBeforeDatum,
    Moving,
    Order,
    Passed,
    Placed,
    Presumed,
    Recorded,
    Repeated,
    Retake,
    ScaleChanged,
    Skipped,
    TooSlow,
    TrackLost,
    Unclear,
    WrongDirection,
    ZeroLost,
)
from zlmreport.live.capture.motion import PlannedRoute, Route
from zlmreport.live.capture.place import WORTH_SAYING, PlaceInProgram, TargetStandstill
from zlmreport.live.capture.progress import Progress
from zlmreport.live.capture.standstill import Pace, Track, Window, expect_deviation
from zlmreport.live.capture.stops import (
    Stay,
    check_datum,
    find_target_around,
    is_plausible,
    is_worse,
    name_elsewhere,
    name_out_of_turn,
)
from zlmreport.live.capture.visits import FASTEST, ListedVisit, Settings
from zlmreport.live.ports.reading import Fault, LiveReading
from zlmreport.measurement.approach import Approach

#: Of a standstill, the share after which an axis is at rest.
_AT_REST = 4
_LEAPED = "what the display shows jumped while the axis stood still: it lost counts, or was set anew"
#: A later standstill takes the place of an earlier one of the same visit if it differs by so much of the
#: stability range: 0.1 µm for 1 µm. By less, it is the same.
_FINEST = 0.1


@dataclass(frozen=True, slots=True)
class Status:
    """What a display shows of the present moment."""

    position: float | None  #: Of the axis, m or rad; None as long as it is not known.
    range: float  #: Of the readings that keep within the stability range, m or rad.
    still: float  #: How long they have, s.


class Follower:
    """Follows an axis along its visit list.

    It takes a reading when the axis came to a target from its side, all readings over the dwell keep within
    the stability range and inside the tolerance, and it is clear which visit of the list that is. Whatever
    else happens it names, and takes nothing.

    `progress`: Where to begin: `Progress.begin`, or that of a journal.
    `is_watched`: Whether an operator answers questions while the axis goes on; if not, a question halts.
    `last`: When the last visit was, s, by the clock of the readings; None if the program cannot have run on
        since then.
    """

    def __init__(
        self,
        progress: Progress,
        settings: Settings,
        *,
        is_watched: bool = False,
        last: float | None = None,
    ) -> None:
        self.progress = progress  #: How far the capture has come.
        self._is_watched = is_watched
        self._planned = PlannedRoute(progress.visits, settings)
        #: Whether nothing more is taken: it is over, or an operator must see to something. Another follower
        #: goes on, from ``progress``.
        self.is_halted = progress.is_over
        self._settings = settings
        self._window = Window(settings.stability, settings.still, settings.averaged)
        self._track = Track(settings.motion)
        self._targets = sorted({(visit.position, visit.target) for visit in progress.visits})
        self._latest: LiveReading | None = None
        self._lost = 0
        self._unchanging = FreezeWatch(2 * settings.stay)
        self._doubted: tuple[TargetStandstill, int] | None = None
        self._pace = Pace()
        self._stood_at: float | None = None
        self._stay: Stay | None = None
        self._standing: Mean | None = None
        self._broken: LiveReading | None = None
        self._ahead = WayAhead(settings)
        self._jumps = JumpWatch(settings)
        self._offsets = Offsets(progress.visits, settings.motion)
        self._begin_here(last)
        if progress.question is not None:
            asked = progress.question
            stop = TargetStandstill(asked.target, asked.approach, asked.approach, asked.position, asked.mean)
            doubted = asked.candidates[0][0] if asked.expected is not None else None
            if doubted is None:
                self._place.undecided.append(stop)
            else:
                self._doubted = (stop, doubted.number - 1)

    @property
    def status(self) -> Status:
        """What a display shows of the present moment."""
        zero, latest = self.progress.zero, self._latest
        position = None if latest is None or zero is None else latest.value + zero
        return Status(position, self._window.range, self._window.duration)

    def feed(self, reading: LiveReading) -> list[Event]:
        """Return what happens with a reading, in order; mostly nothing."""
        return self._live_through(() if self.is_halted else self._see(reading))

    def take_answer(self, visit: ListedVisit | None, late: float | None = None) -> list[Event]:
        """Return what happens when the operator says which visit an unclear stop is; None for none.

        `late`: How long ago the stop was, s; without it, it was seen by this follower.
        """
        return self._live_through(self._obey_answer(visit, late))

    def take_order(self, order: Order) -> list[Event]:
        """Return what happens when the operator orders something while the axis is followed."""
        return self._live_through(() if self.is_halted else self._obey(order))

    def _obey(self, order: Order) -> Iterator[Event]:
        if not isinstance(order, Commented):
            yield from self._let_doubted_go()
            self._stay = None  # the axis has another visit ahead: no later standstill is of the last one
        yield order
        if isinstance(order, Retake):
            self._begin_here()
        elif isinstance(order, Skipped):
            self._place.let_begin(self.progress.taken, self._route)
        self._place.left_out = self.progress.skipped

    def _begin_here(self, last: float | None = None) -> None:
        """Begin with the visit that is next, from wherever the axis is: the program starts there."""
        self._route = Route(self._settings.tolerance)
        self._place = PlaceInProgram(self._planned, self._settings, self.progress.taken, last)
        self._place.left_out = self.progress.skipped
        self._ahead.begin()

    def _live_through(self, happening: Iterable[Event]) -> list[Event]:
        events: list[Event] = []
        for event in happening:
            events.append(event)
            self.progress = self.progress.take_event(event)
            if isinstance(event, HALTING) or (isinstance(event, Unclear) and not self._is_watched):
                self.is_halted = True
                break
        return events

    def _see(self, reading: LiveReading) -> Iterator[Event]:
        if reading.loses_zero and not self._may_still_hold(reading):
            yield from self._lose_zero(self._broken or reading)
            return
        self._lost += reading.skipped
        if not reading.is_usable:
            self._lost += 1
            if reading.loses_zero and self._broken is None:
                self._broken = reading
            return
        if self._latest is not None:
            yield from self._look_at_display(self._latest, reading)
            if self.is_halted:
                return
        self._window.add(reading, self._lost)
        before, self._latest, self._lost = self._latest, reading, 0
        zero = self.progress.zero
        if zero is None:
            yield from self._take_datum(reading)
            return
        self._track.add(reading.value + zero)
        if before is not None and self._track.position is not None:
            self._follow_turns(before, reading, zero, self._track.position)
        yield from self._follow_way(reading.time)
        yield from self._notice_freeze(before, reading)
        yield from self._finish_at_end(reading, zero)
        if self._window.is_still and (self._stood_at is None or self._has_come_to_stand_anew(zero)):
            yield from self._name_standstill(zero)
        elif self._stay is not None and self._stood_at is not None and self._window.is_still:
            self._stay.keep(self._window, reading.time, self._settings.averaged)
        yield from self._ask_when_doubted(reading, zero)

    def _look_at_display(self, latest: LiveReading, reading: LiveReading) -> Iterator[Event]:
        """Look at what the display did since the last reading: an interruption, a gap, a jump."""
        if self._broken is not None:
            yield from self._mend(self._broken, latest, reading)
            if self.is_halted:
                return
        yield from self._look_at_gap(latest, reading)
        failed = self._find_failure_of_display(latest, reading)
        if failed is not None:
            yield failed

    def _notice_freeze(self, before: LiveReading | None, reading: LiveReading) -> Iterator[Event]:
        """Notice a display that shows the same to its last digit for longer than an axis rests."""
        seconds = self._unchanging.add(before, reading, is_followed=self.progress.taken > 0)
        if seconds is not None:
            self._route.lose(seconds)
            yield Frozen(seconds)

    def _may_still_hold(self, reading: LiveReading) -> bool:
        """Tell whether an interruption may turn out to have lost no counts.

        It is shorter than a standstill, and the axis had stood still for as long as it lasts: then what the
        display shows afterwards says whether it has.
        """
        if reading.faults & Fault.RESTARTED or self._latest is None or self.progress.zero is None:
            return False
        seconds = reading.time - self._latest.time
        return seconds < self._settings.still and self._window.duration >= seconds

    def _mend(self, broken: LiveReading, latest: LiveReading, reading: LiveReading) -> Iterator[Event]:
        """Say after an interruption whether the display shows what it showed before."""
        self._broken = None
        seconds = reading.time - latest.time
        if seconds < self._settings.still and self._window.holds(reading.value):
            yield BeamHeld(broken.message, seconds)
        else:
            yield from self._lose_zero(broken)

    def _lose_zero(self, reading: LiveReading) -> Iterator[Event]:
        """Lose the zero; before a datum is taken there is none to lose."""
        self._broken = self._stay = None
        self._window.clear()
        self._track.forget()
        self._route.lose()
        if self.progress.zero is not None:
            yield ZeroLost(reading.message, self.progress.rest_of_part)

    def _look_at_gap(self, latest: LiveReading, reading: LiveReading) -> Iterator[Event]:
        """Look at how long nothing came: what may have gone unseen is not relied on."""
        settings, zero = self._settings, self.progress.zero
        gap = self._pace.measure_gap(latest.time, reading.time, self._lost)
        if self._pace.shortest > settings.largest_gap:
            yield TooSlow(self._pace.shortest, settings.largest_gap)
        ends = None if zero is None else (latest.value + zero, reading.value + zero)
        is_followed = ends is None or not self._may_have_turned(*ends, gap)
        is_pause = gap <= settings.largest_pause
        if is_followed and is_pause:
            return
        has_stayed = self._has_stayed(latest, reading)
        is_same = has_stayed and gap < settings.still and self._window.holds(reading.value)
        if not (is_pause or is_same):
            self._window.clear()
        self._unchanging.forget()
        if gap >= settings.stay:
            yield TrackLost(gap)
        if not is_followed and not has_stayed:
            self._stay = None
            self._track.forget()
            self._route.lose(gap)
            self._ahead.forget()

    def _may_have_turned(self, here: float, there: float, gap: float) -> bool:
        """Tell whether the axis may have come to where it is from the other side than it seems, unseen.

        For that it must have gone over it, turned round at the overrun of a target, and come back.

        `here`, `there`: Where it was seen before and after a gap, m or rad.
        `gap`: How long nobody saw it, s.
        """
        settings = self._settings
        if gap >= settings.stay:
            return True
        if gap <= settings.beyond:
            return False
        if gap > settings.turn or not settings.feed:
            return True
        ways = (
            [(target - end) * side + settings.overrun for end in (here, there)]
            for side in Approach
            if (there - here) * side >= -settings.tolerance
            for target, _ in self._targets
        )
        reach = FASTEST * settings.feed * gap
        return any(min(way) >= 0 and sum(way) <= reach for way in ways)

    def _has_stayed(self, latest: LiveReading, reading: LiveReading) -> bool:
        """Tell whether the axis, seen to arrive, cannot have left and come back from elsewhere since."""
        since = self._ahead.inside_since if self._stay is None else self._stay.since
        return (
            since is not None
            and reading.time - since < self._settings.stay
            and abs(reading.value - latest.value) <= self._settings.stability
        )

    def _take_datum(self, reading: LiveReading) -> Iterator[Event]:
        """Take the reading at the datum, from an axis that has stood there ever since it was watched."""
        datum = self.progress.datum
        if datum is None:
            return
        self._track.add(reading.value)
        if self._track.direction is not None:
            spacing, largest = self._pace.least, self._settings.largest_gap
            yield TooSlow(spacing, largest) if spacing > largest else MovedBeforeDatum(datum)
        elif self._window.is_still:
            self._track.forget()
            self._stood_at = datum
            yield DatumTaken(datum, self._window.compute_mean())

    def _follow_turns(self, before: LiveReading, reading: LiveReading, zero: float, seen: float) -> None:
        """Follow where the axis turns round.

        Beyond its target one reading alone may have seen it: too little to say from which side it came back,
        and too much to hold a stop there for the one before.
        """
        turns = len(self._route.turns)
        self._route.follow(before, reading, zero, seen, self._settings)
        has_turned = len(self._route.turns) > turns
        if has_turned and self._stay is not None and self._is_seen_beyond_once(self._stay, seen):
            self._stay = self._stood_at = None
            self._track.forget()
            self._ahead.forget()

    def _is_seen_beyond_once(self, stay: Stay, seen: float) -> bool:
        """Tell whether the axis turned round beyond its target, not at it to leave, and was seen so once."""
        target = self.progress.visits[stay.index].position
        is_beyond = abs(self._route.turns[-1] - target) > self._settings.tolerance
        return is_beyond and not self._has_left(stay, seen)

    def _follow_way(self, time: float) -> Iterator[Event]:
        """Follow the axis away from where it stood, into the tolerance of what is next, and through it."""
        position = self._track.position
        if position is None:
            return
        if self._stood_at is not None and abs(position - self._stood_at) > self._settings.motion:
            self._stood_at = None
            yield from self._take_last_standstill()
            yield Moving(self.progress.next)
        if self._stay is not None and self._has_left(self._stay, position):
            self._stay = None
        yield from self._ahead.follow(time, self._track, self.progress, self._window.duration)

    def _has_come_to_stand_anew(self, zero: float) -> bool:
        """Tell whether the axis, where it stays after a reading, has come to stand a little elsewhere."""
        if self._stay is None or self._stood_at is None:
            return False
        lowest, highest = self._window.bounds
        return abs((lowest + highest) / 2 + zero - self._stay.middle) > self._settings.stability

    def _has_left(self, stay: Stay, position: float) -> bool:
        target = self.progress.visits[stay.index].position
        return abs(position - target) > self._settings.tolerance + self._settings.motion

    def _take_last_standstill(self) -> Iterator[Event]:
        """Let the last standstill before the axis goes on take the place of the first, where they differ."""
        stay, zero = self._stay, self.progress.zero
        if stay is None or stay.last is None or zero is None:
            return
        position = stay.last.value + zero
        if abs(position - stay.position) > _FINEST * self._settings.stability:
            yield from self._take_later_standstill(stay, stay.last, zero)

    def _take_later_standstill(self, stay: Stay, mean: Mean, zero: float) -> Iterator[Event]:
        """Take a later standstill of a visit in, which the axis has not left since the one before."""
        visit = self.progress.visits[stay.index]
        stop = TargetStandstill(visit.target, visit.approach, visit.approach, mean.value + zero, mean)
        yield from self._take(stay.index, stop, None)
        stay.stand(self._window, mean, zero)

    def _name_standstill(self, zero: float) -> Iterator[Event]:
        lowest, highest = (bound + zero for bound in self._window.bounds)
        target = find_target_around(lowest, highest, self._targets, self._settings.tolerance)
        approach = self._track.direction
        if target is None and approach is None:  # it waits for its program
            return
        mean = self._standing = self._window.compute_mean()
        self._stood_at = mean.value + zero
        if self._stay is not None and target == self.progress.visits[self._stay.index].target:
            yield from self._take_later_standstill(self._stay, mean, zero)
        elif target is None:
            if not self._is_turning_place(self._stood_at):
                yield name_elsewhere(mean, zero, self.progress, self._settings, self._offsets)
        else:
            yield from self._place_at_target(target, approach, mean, zero)

    def _is_turning_place(self, position: float) -> bool:
        """Tell whether it is where the axis turns round beyond its outermost targets: it may rest there."""
        targets = [target for target, _ in self._targets]
        places = (min(targets) - self._settings.overrun, max(targets) + self._settings.overrun)
        return any(abs(position - place) <= self._settings.tolerance for place in places)

    def _find_failure_of_display(self, latest: LiveReading, reading: LiveReading) -> Event | None:
        """Return what a jump of the display is; None without one."""
        is_at_rest = self._window.duration >= self._settings.still / _AT_REST
        jump = self._jumps.add(latest, reading, is_at_rest=is_at_rest)
        if jump is None or self.progress.zero is None:
            return None
        if jump.factor is None:
            return ZeroLost(_LEAPED, self.progress.rest_of_part)
        return ScaleChanged(jump.factor, None)

    def _place_at_target(
        self, target: int, approach: Approach | None, mean: Mean, zero: float
    ) -> Iterator[Event]:
        """Say what a standstill at a target is, and take the reading if it is clear which visit that is."""
        progress = self.progress
        heading = self._route.heading or approach
        is_unseen = heading is None and not self._route.breaks
        if is_unseen or (progress.must_check and approach is None):
            visit = progress.check or progress.next
            if target == visit.target and not progress.has_all:
                yield WrongDirection(visit, None)
            return
        stop = TargetStandstill(target, heading, approach, mean.value + zero, mean)
        if progress.must_check and approach is not None:
            yield check_datum(target, approach, stop.position, progress, self._settings)
            following = self.progress.next
            if self.progress.must_check or (following.target, following.approach) != (target, approach):
                return
        self._place.add(stop, self._route)
        yield from self._say_what_is_decided()
        if self._place.undecided and self.progress.question is None:
            yield self._make_question()

    def _say_what_is_decided(self) -> Iterator[Event]:
        """Say of each stop what it is, once that is clear."""
        for stop, index, share in self._place.settle_stops():
            if self.progress.question is not None:
                yield Placed(None if index is None else self.progress.visits[index])
            elif index is not None and index + 1 not in self.progress.skipped and 1 - share > WORTH_SAYING:
                yield Presumed(self.progress.visits[index], share)
            yield from self._file(stop, index)

    def _file(self, stop: TargetStandstill, index: int | None, late: float | None = None) -> Iterator[Event]:
        if index is None:
            yield name_out_of_turn(stop, self.progress)
        elif self.progress.visits[index].number in self.progress.skipped:
            yield Passed(self.progress.visits[index], stop.mean.duration)
        elif stop.approach is not self.progress.visits[index].approach:
            yield WrongDirection(self.progress.visits[index], stop.approach)
        elif late is None and not self._may_be_taken(stop, index):
            yield from self._let_doubted_go()
            self._doubted = (stop, index)
        else:
            if self._doubted is not None and self._doubted[1] == index:
                yield from self._let_doubted_go()
            yield from self._take(index, stop, late)

    def _may_be_taken(self, stop: TargetStandstill, index: int) -> bool:
        """Tell whether no question is to be asked of a reading: it is near enough, or another stands."""
        of = (stop, index, self.progress, self._settings)
        return is_plausible(*of) or is_worse(*of)

    def _let_doubted_go(self) -> Iterator[Event]:
        """Let a doubted reading go: another stop takes its place."""
        if self._doubted is None:
            return
        (stop, index), self._doubted = self._doubted, None
        if self.progress.question is not None:
            yield Placed(None)
        yield Repeated(self.progress.visits[index], stop.position, stop.mean)

    def _ask_when_doubted(self, reading: LiveReading, zero: float) -> Iterator[Event]:
        """Ask about a doubted reading once no better one follows: the axis leaves, or stays where it is."""
        if self._doubted is None or self.progress.question is not None:
            return
        stop, index = self._doubted
        visit = self.progress.visits[index]
        far = self._settings.tolerance + self._settings.motion
        has_left = abs(reading.value + zero - visit.position) > far
        stood = reading.time - stop.mean.time
        is_last = index == len(self.progress.visits) - 1
        if self._is_watched or has_left or (is_last and stood >= 2 * self._settings.stay):
            expected, _ = expect_deviation(visit, self.progress.read, self._settings)
            candidates = ((visit, 0.5), (None, 0.5))
            yield Unclear(
                stop.target, visit.approach, candidates, stop.position, stop.mean, visit.position + expected
            )

    def _obey_answer(self, visit: ListedVisit | None, late: float | None) -> Iterator[Event]:
        index = None if visit is None else visit.number - 1
        yield Placed(visit)
        if self._doubted is not None:
            (stop, doubted), self._doubted = self._doubted, None
            if index is None:
                yield Repeated(self.progress.visits[doubted], stop.position, stop.mean)
                return
        else:
            stop = self._place.take_word(index)
        if late is None:
            late = self._latest.time - stop.mean.time if self._latest else 0.0
        yield from self._file(stop, index, late)
        yield from self._say_what_is_decided()
        if self._place.undecided:
            yield self._make_question()

    def _make_question(self) -> Unclear:
        stop = self._place.undecided[0]
        odds = sorted(self._place.list_odds().items(), key=lambda each: -each[1])
        visits = self.progress.visits
        candidates = tuple((None if index is None else visits[index], share) for index, share in odds)
        return Unclear(stop.target, stop.heading or visits[0].approach, candidates, stop.position, stop.mean)

    def _take(self, index: int, stop: TargetStandstill, late: float | None) -> Iterator[Event]:
        progress = self.progress
        since = self._ahead.inside_since
        self._ahead.begin()
        visit = progress.visits[index]
        if is_worse(stop, index, progress, self._settings):
            yield Repeated(visit, stop.position, stop.mean)
            return
        for missed in progress.visits[progress.taken : index]:
            if missed.number not in progress.filed | progress.skipped:
                yield Missed(missed, progress.attempts.get(missed.part, 1))
        if late is None:
            late = self._latest.time - stop.mean.time if self._latest else 0.0
        if stop.mean is self._standing and self._stay is None:
            self._stay = Stay.at(index, since, self._window, stop)
        yield Recorded(visit, progress.attempts.get(visit.part, 1), stop.position, stop.mean, late)
        if progress.again is not None and self.progress.again is None:
            self._begin_here()

    def _finish_at_end(self, reading: LiveReading, zero: float) -> Iterator[Event]:
        """Finish when the axis has left the last visit, and has come back to the datum if it goes there.

        A program that ends where it stands, and an axis that goes elsewhere, are not waited for.
        """
        progress, settings = self.progress, self._settings
        if not progress.has_all or progress.question is not None or self._doubted:
            return
        visit = progress.visits[-1]
        last = progress.read.get((visit.target, visit.approach))
        position = reading.value + zero
        has_left = abs(position - visit.position) > settings.tolerance
        if last is None or (has_left and progress.datum is None):
            yield Finished()
        elif not has_left or progress.datum is None:
            if reading.time - (last.mean.time if self._stay is None else self._stay.taken) >= settings.stay:
                yield from self._take_last_standstill()
                yield Finished()
        elif self._window.is_still:
            difference = self._window.compute_mean().value + zero - progress.datum
            if abs(difference) <= settings.tolerance:
                yield Closed(difference, abs(difference) <= settings.motion)
            yield Finished()
