"""Follows an axis along its visit list and says what happens; it knows no port, no clock and no file."""

from __future__ import annotations

from bisect import bisect
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from zlmreport.live.capture.display import UNITS, JumpWatch, Offsets, find_misread_factor
from zlmreport.live.capture.events import (
    HALTING,
    BeamHeld,
    Closed,
    Commented,
    DatumHolds,
    DatumMoved,
    DatumTaken,
    Elsewhere,
    Event,
    Finished,
    Frozen,
    Mean,
    Missed,
    MovedBeforeDatum,
    Moving,
    NotChecked,
    NotNext,
    Order,
    Passed,
    Placed,
    Presumed,
    Recorded,
    Repeated,
    Retake,
    ScaleChanged,
    Settling,
    TooSlow,
    TrackLost,
    Unclear,
    WrongDirection,
    ZeroLost,
)
from zlmreport.live.capture.motion import Programme, Route
from zlmreport.live.capture.place import WORTH_SAYING, PlaceInProgram, TargetStandstill
from zlmreport.live.capture.progress import Progress
from zlmreport.live.capture.standstill import FROM_RUN, Pace, Track, Window, expect_deviation
from zlmreport.live.capture.visits import FASTEST, ListedVisit, Settings
from zlmreport.live.ports.reading import Fault, LiveReading
from zlmreport.measurement.approach import Approach

#: Faster than any axis, m/s or rad/s: who is elsewhere sooner was not seen to go there.
_RAPID = 1.0


#: Of a standstill, the share after which an axis is at rest.
_AT_REST = 4
_SHIFTED = "what the display shows is off by the same at two stops in a row: counts are lost, or a zero moved"
_LEAPED = "what the display shows jumped while the axis stood still: it lost counts, or was set anew"
#: A later standstill takes the place of an earlier one of the same visit if it differs by so much of the
#: stability range: 0.1 µm for 1 µm. By less, it is the same.
_FINEST = 0.1


@dataclass(slots=True)
class Stay:
    """How the axis stays where a reading was taken: until it leaves, a later one may replace that."""

    index: int  #: Of the visit.
    since: float | None  #: When it came there, s; None if nobody saw.
    taken: float  #: When the first reading was, s.
    position: float  #: Which reading stands, m or rad.
    middle: float  #: Between the smallest and the largest of what it was made of, m or rad.
    looked: float  #: When the standstill was looked at last, s.
    #: last, ahead: The latest standstill after which the axis still stood, and after which it may have gone.
    last: Mean | None = None
    ahead: Mean | None = None

    @classmethod
    def at(cls, index: int, since: float | None, window: Window, stop: TargetStandstill) -> Stay:
        """Begin with the reading that was taken."""
        stay = cls(index, since, stop.mean.time, 0.0, 0.0, 0.0)
        stay.stand(window, stop.mean, stop.position - stop.mean.value)
        return stay

    def stand(self, window: Window, mean: Mean, zero: float) -> None:
        """Take note of the reading that stands now."""
        lowest, highest = window.bounds
        self.position, self.middle = mean.value + zero, (lowest + highest) / 2 + zero
        self.looked, self.last, self.ahead = mean.time, None, None

    def keep(self, window: Window, time: float, every: float) -> None:
        """Keep the mean of a standstill that goes on; of the last one the axis may have begun to leave."""
        if time - self.looked >= every:
            self.looked, self.last, self.ahead = time, self.ahead, window.mean()


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
        self._programme = Programme(progress.visits, settings)
        #: Whether nothing more is taken: it is over, or an operator must see to something. Another follower
        #: goes on, from ``progress``.
        self.is_halted = progress.is_over
        self._settings = settings
        self._window = Window(settings.stability, settings.still, settings.averaged)
        self._track = Track(settings.motion)
        by_position = {visit.position: visit.target for visit in progress.visits}
        self._positions = sorted(by_position)
        self._targets = [by_position[position] for position in self._positions]
        self._latest: LiveReading | None = None
        self._lost = 0
        self._unchanged_since: float | None = None
        self._is_frozen = False
        self._doubted: tuple[TargetStandstill, int] | None = None
        self._crept: tuple[float, float] | None = None
        self._crept_last = (0.0, 0.0)
        self._pace = Pace()
        self._stood_at: float | None = None
        self._stay: Stay | None = None
        self._standing: Mean | None = None
        self._broken: LiveReading | None = None
        self._inside_since: float | None = None
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
        return self._lived_through(() if self.is_halted else self._seen(reading))

    def told(self, visit: ListedVisit | None, late: float | None = None) -> list[Event]:
        """Return what happens when the operator says which visit an unclear stop is; None for none.

        `late`: How long ago the stop was, s; without it, it was seen by this follower.
        """
        return self._lived_through(self._answered(visit, late))

    def ordered(self, order: Order) -> list[Event]:
        """Return what happens when the operator orders something while the axis is followed."""
        return self._lived_through(() if self.is_halted else self._obeyed(order))

    def _obeyed(self, order: Order) -> Iterator[Event]:
        if not isinstance(order, Commented):
            yield from self._not_taken()
        yield order
        if isinstance(order, Retake):
            self._begin_here()
        self._place.left_out = self.progress.skipped

    def _begin_here(self, last: float | None = None) -> None:
        """Begin with the visit that is next, from wherever the axis is: the program starts there."""
        self._route = Route(self._settings.tolerance)
        self._place = PlaceInProgram(self._programme, self._settings, self.progress.taken, last)
        self._place.left_out = self.progress.skipped
        self._passed = 0
        self._look_ahead()

    def _lived_through(self, happening: Iterable[Event]) -> list[Event]:
        events: list[Event] = []
        for event in happening:
            events.append(event)
            self.progress = self.progress.after(event)
            if isinstance(event, HALTING) or (isinstance(event, Unclear) and not self._is_watched):
                self.is_halted = True
                break
        return events

    def _seen(self, reading: LiveReading) -> Iterator[Event]:
        if reading.loses_zero and not self._may_still_hold(reading):
            yield from self._without_zero(self._broken or reading)
            return
        self._lost += reading.skipped
        if not reading.is_usable:
            self._lost += 1
            if reading.loses_zero and self._broken is None:
                self._broken = reading
            return
        if self._latest is not None:
            yield from self._since(self._latest, reading)
            if self.is_halted:
                return
        self._window.add(reading, self._lost)
        before, self._latest, self._lost = self._latest, reading, 0
        zero = self.progress.zero
        if zero is None:
            yield from self._at_the_datum(reading)
            return
        self._track.add(reading.value + zero)
        self._follow_route(before, reading, zero)
        yield from self._on_the_way(reading.time)
        yield from self._unchanged(before, reading)
        yield from self._at_the_end(reading, zero)
        if self._window.is_still and (self._stood_at is None or self._stands_anew(zero)):
            yield from self._at_a_standstill(zero)
        elif self._stay is not None and self._stood_at is not None and self._window.is_still:
            self._stay.keep(self._window, reading.time, self._settings.averaged)
        yield from self._when_doubted(reading, zero)

    def _since(self, latest: LiveReading, reading: LiveReading) -> Iterator[Event]:
        """Look at what the display did since the last reading: an interruption, a gap, a jump."""
        if self._broken is not None:
            yield from self._mended(self._broken, latest, reading)
            if self.is_halted:
                return
        yield from self._after_a_gap(latest, reading)
        failed = self._display_failed(latest, reading)
        if failed is not None:
            yield failed

    def _follow_route(self, before: LiveReading | None, reading: LiveReading, zero: float) -> None:
        """Follow where the axis turns round: of readings that come seldom each counts that can be true."""
        if before is None or self._track.position is None:
            return
        elapsed = reading.time - before.time
        reach = FASTEST * self._settings.feed * elapsed + self._settings.motion
        can_be = abs(reading.value - before.value) <= reach
        position = reading.value + zero if can_be else self._track.position
        if self._route.last is not None:
            furthest = _RAPID * (elapsed + self._settings.largest_gap) + self._settings.tolerance
            if abs(position - self._route.last) > furthest:
                self._route.lose()
        self._route.add(position)

    def _unchanged(self, before: LiveReading | None, reading: LiveReading) -> Iterator[Event]:
        """Notice a display that shows the same to its last digit for longer than an axis rests."""
        if before is None or before.value != reading.value or self._unchanged_since is None:
            self._unchanged_since, self._is_frozen = reading.time, False
        seconds = reading.time - self._unchanged_since
        if self.progress.taken and seconds >= 2 * self._settings.stay and not self._is_frozen:
            self._is_frozen = True
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

    def _mended(self, broken: LiveReading, latest: LiveReading, reading: LiveReading) -> Iterator[Event]:
        """Say after an interruption whether the display shows what it showed before."""
        self._broken = None
        seconds = reading.time - latest.time
        if seconds < self._settings.still and self._window.holds(reading.value):
            yield BeamHeld(broken.message, seconds)
        else:
            yield from self._without_zero(broken)

    def _without_zero(self, reading: LiveReading) -> Iterator[Event]:
        """Lose the zero; before a datum is taken there is none to lose."""
        self._broken = self._stay = None
        self._window.clear()
        self._track.forget()
        self._route.lose()
        if self.progress.zero is not None:
            yield ZeroLost(reading.message, self.progress.rest_of_part)

    def _after_a_gap(self, latest: LiveReading, reading: LiveReading) -> Iterator[Event]:
        """Look at how long nothing came: what may have gone unseen is not relied on."""
        largest = self._settings.largest_gap
        gap = self._pace.gap(latest.time, reading.time, self._lost)
        if self._pace.shortest > largest:
            yield TooSlow(self._pace.shortest, largest)
        if gap <= largest:
            return
        has_stayed = self._has_stayed(latest, reading)
        if not (has_stayed and gap < self._settings.still and self._window.holds(reading.value)):
            self._window.clear()
        self._unchanged_since = None
        if gap >= self._settings.stay:
            yield TrackLost(gap)
        if self.progress.zero is not None and not has_stayed:
            self._stay = None
            self._track.forget()
            self._route.lose(gap)
            self._look_ahead()

    def _has_stayed(self, latest: LiveReading, reading: LiveReading) -> bool:
        """Tell whether the axis, seen to arrive, cannot have left and come back from elsewhere since."""
        since = self._inside_since if self._stay is None else self._stay.since
        return (
            since is not None
            and reading.time - since < self._settings.stay
            and abs(reading.value - latest.value) <= self._settings.stability
        )

    def _at_the_datum(self, reading: LiveReading) -> Iterator[Event]:
        """Take the reading at the datum, from an axis that has stood there ever since it was watched."""
        datum = self.progress.datum
        if datum is None:
            return
        self._track.add(reading.value)
        if self._track.direction is not None:
            yield MovedBeforeDatum(datum)
        elif self._window.is_still:
            self._track.forget()
            self._stood_at = datum
            yield DatumTaken(datum, self._window.mean())

    def _on_the_way(self, time: float) -> Iterator[Event]:
        """Follow the axis away from where it stood, into the tolerance of what is next, and through it."""
        position = self._track.position
        if position is None:
            return
        if self._stood_at is not None and abs(position - self._stood_at) > self._settings.motion:
            self._stood_at = None
            yield from self._stood_last()
            yield Moving(self.progress.next)
        if self._stay is not None and self._has_left(self._stay, position):
            self._stay = None
        while (visit := self._ahead) is not None:
            if self._inside_since is None:
                self._comes_from_its_side |= self._is_before(visit, position)
                if not (self._comes_from_its_side and self._is_at_or_beyond(visit, position)):
                    return
                self._inside_since = time
                self._crept = None
                yield Settling(visit)
            if abs(position - visit.position) <= self._settings.tolerance + self._settings.motion:
                self._watch_creeping(time, position)
                return
            yield Passed(visit, time - self._inside_since, self._drift)
            self._passed += 1
            self._look_ahead()

    def _watch_creeping(self, time: float, position: float) -> None:
        """Note where the axis is that nearly stands, first and last."""
        if self._window.duration < self._settings.still / 4:
            return
        if self._crept is None:
            self._crept = self._crept_last = (time, position)
        self._crept_last = (time, position)

    @property
    def _drift(self) -> float | None:
        """How fast the readings went on at a target, too slow for a motion; None if they did not."""
        if self._crept is None:
            return None
        (begin, first), (end, last) = self._crept, self._crept_last
        is_long = end - begin >= self._settings.still / 2
        return (
            (last - first) / (end - begin)
            if is_long and abs(last - first) >= 3 * self._settings.stability
            else None
        )

    @property
    def _ahead(self) -> ListedVisit | None:
        """The first visit that is neither taken nor passed."""
        index = self.progress.taken + self._passed
        return self.progress.visits[index] if index < len(self.progress.visits) else None

    def _look_ahead(self) -> None:
        """Forget how the axis came to the visit ahead: it is another one now, or nobody saw."""
        self._comes_from_its_side = False
        self._inside_since = None

    def _is_before(self, visit: ListedVisit, position: float) -> bool:
        """Tell whether the axis is, or just was, on the side of a target from which it is to come."""
        seen = (position, position if self._track.before is None else self._track.before)
        way_to_go = max((visit.position - each) * visit.approach for each in seen)
        return way_to_go > self._settings.tolerance and not self.progress.must_check

    def _is_at_or_beyond(self, visit: ListedVisit, position: float) -> bool:
        """Tell whether the axis goes towards a target and is inside its tolerance, or has run over it."""
        is_there = (visit.position - position) * visit.approach <= self._settings.tolerance
        return is_there and self._track.direction is visit.approach

    def _stands_anew(self, zero: float) -> bool:
        """Tell whether the axis, where it stays after a reading, has come to stand a little elsewhere."""
        if self._stay is None or self._stood_at is None:
            return False
        lowest, highest = self._window.bounds
        return abs((lowest + highest) / 2 + zero - self._stay.middle) > self._settings.stability

    def _has_left(self, stay: Stay, position: float) -> bool:
        target = self.progress.visits[stay.index].position
        return abs(position - target) > self._settings.tolerance + self._settings.motion

    def _stood_last(self) -> Iterator[Event]:
        """Let the last standstill before the axis goes on take the place of the first, where they differ."""
        stay, zero = self._stay, self.progress.zero
        if stay is None or stay.last is None or zero is None:
            return
        position = stay.last.value + zero
        if abs(position - stay.position) > _FINEST * self._settings.stability:
            yield from self._stood_later(stay, stay.last, zero)

    def _stood_later(self, stay: Stay, mean: Mean, zero: float) -> Iterator[Event]:
        """Take a later standstill of a visit in, which the axis has not left since the one before."""
        visit = self.progress.visits[stay.index]
        stop = TargetStandstill(visit.target, visit.approach, visit.approach, mean.value + zero, mean)
        yield from self._taken(stay.index, stop, None)
        stay.stand(self._window, mean, zero)

    def _at_a_standstill(self, zero: float) -> Iterator[Event]:
        target, approach = self._target_around(zero), self._track.direction
        if target is None and approach is None:  # it waits for its program
            return
        mean = self._standing = self._window.mean()
        self._stood_at = mean.value + zero
        if self._stay is not None and target == self.progress.visits[self._stay.index].target:
            yield from self._stood_later(self._stay, mean, zero)
        elif target is None:
            yield self._elsewhere(mean, zero)
        else:
            yield from self._at_target(target, approach, mean, zero)

    def _elsewhere(self, mean: Mean, zero: float) -> Event:
        """Say what a standstill at no target is: a display that was switched, or lost counts; or neither."""
        progress, position = self.progress, mean.value + zero
        following = progress.visits[progress.taken :]
        near = self._settings.tolerance
        right = zero if progress.datum is None else progress.datum
        unit = find_misread_factor(mean.value, zero, right, following, near, UNITS)
        if unit is not None and progress.read:
            return ScaleChanged(unit, self._by_either_unit(zero))
        if self._offsets.is_lost(position, progress.taken):
            return ZeroLost(_SHIFTED, progress.rest_of_part)
        return Elsewhere(position, find_misread_factor(mean.value, zero, right, following, near))

    def _by_either_unit(self, zero: float) -> ListedVisit | None:
        """Return the visit before, if its reading would be at its target by another unit, too."""
        last = max(self.progress.read.values(), key=lambda each: each.mean.time, default=None)
        if last is None or abs(last.position - zero) > self._settings.tolerance:
            return None
        return last.visit

    def _display_failed(self, latest: LiveReading, reading: LiveReading) -> Event | None:
        """Return what a jump of the display is; None without one."""
        is_at_rest = self._window.duration >= self._settings.still / _AT_REST
        jump = self._jumps.add(latest, reading, is_at_rest=is_at_rest)
        if jump is None or self.progress.zero is None:
            return None
        if jump.factor is None:
            return ZeroLost(_LEAPED, self.progress.rest_of_part)
        return ScaleChanged(jump.factor, None)

    def _target_around(self, zero: float) -> int | None:
        """Return the target inside whose tolerance all readings are."""
        lowest, highest = (bound + zero for bound in self._window.bounds)
        after = bisect(self._positions, lowest)
        for index in (after - 1, after):
            if 0 <= index < len(self._positions):
                position = self._positions[index]
                if max(highest - position, position - lowest) <= self._settings.tolerance:
                    return self._targets[index]
        return None

    def _at_target(self, target: int, approach: Approach | None, mean: Mean, zero: float) -> Iterator[Event]:
        """Say what a standstill at a target is, and take the reading if it is clear which visit that is."""
        progress = self.progress
        heading = self._route.heading or approach
        if heading is None and (progress.must_check or not self._route.breaks):
            if target == progress.next.target:
                yield WrongDirection(progress.next, None)
            return
        stop = TargetStandstill(target, heading, approach, mean.value + zero, mean)
        if progress.must_check:
            if approach is None:
                return
            yield self._checked(target, approach, stop.position)
            if self.progress.must_check or not self._is_next(target, approach):
                return
        self._place.add(stop, self._route)
        yield from self._decided()
        if self._place.undecided and self.progress.question is None:
            yield self._question()

    def _decided(self) -> Iterator[Event]:
        """Say of each stop what it is, once that is clear."""
        for stop, index, share in self._place.decided():
            if self.progress.question is not None:
                yield Placed(None if index is None else self.progress.visits[index])
            elif index is not None and 1 - share > WORTH_SAYING:
                yield Presumed(self.progress.visits[index], share)
            yield from self._filed(stop, index)

    def _filed(self, stop: TargetStandstill, index: int | None, late: float | None = None) -> Iterator[Event]:
        if index is None:
            yield self._out_of_turn(stop)
        elif self.progress.visits[index].number in self.progress.skipped:
            yield Passed(self.progress.visits[index], stop.mean.duration)
        elif stop.approach is not self.progress.visits[index].approach:
            yield WrongDirection(self.progress.visits[index], stop.approach)
        elif late is None and not self._is_worse(index, stop) and not self._is_plausible(index, stop):
            yield from self._not_taken()
            self._doubted = (stop, index)
        else:
            if self._doubted is not None and self._doubted[1] == index:
                yield from self._not_taken()
            yield from self._taken(index, stop, late)

    def _is_plausible(self, index: int, stop: TargetStandstill) -> bool:
        """Tell whether a reading is near enough to those before, and to the plan."""
        visit = self.progress.visits[index]
        expected, limit = expect_deviation(visit, self.progress.read, self._settings)
        return abs(stop.position - visit.position - expected) <= limit

    def _not_taken(self) -> Iterator[Event]:
        """Let a doubted reading go: another stop takes its place."""
        if self._doubted is None:
            return
        (stop, index), self._doubted = self._doubted, None
        if self.progress.question is not None:
            yield Placed(None)
        yield Repeated(self.progress.visits[index], stop.position, stop.mean)

    def _when_doubted(self, reading: LiveReading, zero: float) -> Iterator[Event]:
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

    def _answered(self, visit: ListedVisit | None, late: float | None) -> Iterator[Event]:
        index = None if visit is None else visit.number - 1
        yield Placed(visit)
        if self._doubted is not None:
            (stop, doubted), self._doubted = self._doubted, None
            if index is None:
                yield Repeated(self.progress.visits[doubted], stop.position, stop.mean)
                return
        else:
            stop = self._place.told(index)
        if late is None:
            late = self._latest.time - stop.mean.time if self._latest else 0.0
        yield from self._filed(stop, index, late)
        yield from self._decided()
        if self._place.undecided:
            yield self._question()

    def _question(self) -> Unclear:
        stop = self._place.undecided[0]
        odds = sorted(self._place.odds().items(), key=lambda each: -each[1])
        visits = self.progress.visits
        candidates = tuple((None if index is None else visits[index], share) for index, share in odds)
        return Unclear(stop.target, stop.heading or visits[0].approach, candidates, stop.position, stop.mean)

    def _is_next(self, target: int, approach: Approach) -> bool:
        visit = self.progress.next
        return (visit.target, visit.approach) == (target, approach)

    def _checked(self, target: int, approach: Approach, position: float) -> Event:
        """Hold the datum against an earlier reading of the same target from the same side."""
        earlier = self.progress.read.get((target, approach))
        if earlier is None:
            return NotChecked(target, approach)
        difference = position - earlier.position
        if abs(difference) > self._settings.motion:
            return DatumMoved(earlier.visit, difference, self.progress.rest_of_part)
        return DatumHolds(earlier.visit, difference)

    def _taken(self, index: int, stop: TargetStandstill, late: float | None) -> Iterator[Event]:
        progress = self.progress
        self._passed = 0
        since = self._inside_since
        self._look_ahead()
        visit = progress.visits[index]
        if self._is_worse(index, stop):
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

    def _at_the_end(self, reading: LiveReading, zero: float) -> Iterator[Event]:
        """Finish when the axis has left the last visit, and has come back to the datum if it goes there.

        A program that ends where it stands, and an axis that goes elsewhere, are not waited for.
        """
        progress, settings = self.progress, self._settings
        if progress.taken < len(progress.visits) or progress.question is not None or self._doubted:
            return
        visit = progress.visits[-1]
        last = progress.read.get((visit.target, visit.approach))
        position = reading.value + zero
        has_left = abs(position - visit.position) > settings.tolerance
        if last is None or (has_left and progress.datum is None):
            yield Finished()
        elif not has_left or progress.datum is None:
            if reading.time - (last.mean.time if self._stay is None else self._stay.taken) >= settings.stay:
                yield from self._stood_last()
                yield Finished()
        elif self._window.is_still:
            difference = self._window.mean().value + zero - progress.datum
            if abs(difference) <= settings.tolerance:
                yield Closed(difference, abs(difference) <= settings.motion)
            yield Finished()

    def _is_worse(self, index: int, stop: TargetStandstill) -> bool:
        """Tell whether a visit has a reading that is better than a later one.

        A control that corrects its position goes less far, in either direction. Who goes further has left: a
        feed hold beyond the target.
        """
        visit = self.progress.visits[index]
        earlier = self.progress.read.get((visit.target, visit.approach))
        is_ordered = self.progress.again is not None and index >= self.progress.taken
        if earlier is None or visit.number not in self.progress.filed or is_ordered:
            return False
        expected, _ = expect_deviation(visit, self.progress.read, self._settings)
        further = abs(stop.position - visit.position - expected) - abs(earlier.deviation - expected)
        return further > 0 and abs(stop.position - earlier.position) > FROM_RUN * self._settings.stability

    def _out_of_turn(self, stop: TargetStandstill) -> Event:
        """Name a standstill at which nothing may be taken."""
        following = self.progress.next
        if stop.target == following.target or stop.heading is None:
            return WrongDirection(following, stop.approach)
        return NotNext(stop.target, stop.heading, following)
