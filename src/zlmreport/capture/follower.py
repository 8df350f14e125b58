"""Follows an axis along its visit list and says what happens; it knows no port, no clock and no file."""

from __future__ import annotations

from bisect import bisect
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from zlmreport.capture.events import (
    HALTING,
    DatumHolds,
    DatumMoved,
    DatumTaken,
    Elsewhere,
    Event,
    Finished,
    Mean,
    Missed,
    MovedBeforeDatum,
    Moving,
    NotChecked,
    NotNext,
    Passed,
    Recorded,
    Repeated,
    Settling,
    TooSlow,
    TrackLost,
    WrongDirection,
    ZeroLost,
)
from zlmreport.capture.matching import matching
from zlmreport.capture.pace import Pace
from zlmreport.capture.progress import Progress
from zlmreport.capture.settings import Settings
from zlmreport.capture.track import Track
from zlmreport.capture.visit_list import ListedVisit
from zlmreport.capture.window import Window
from zlmreport.live.reading import Fault, LiveReading
from zlmreport.measurement.approach import Approach


@dataclass(frozen=True, slots=True)
class Status:
    """What a display shows of the present moment.

    Attributes
    ----------
    position
        Of the axis, m or rad; None as long as it is not known.
    range
        Of the readings that keep within the stability range, m or rad.
    still
        How long they have, s.
    """

    position: float | None
    range: float
    still: float


class Follower:
    """Follows an axis along its visit list.

    It takes a reading when the axis came to the target that is next from its side, and all readings over the
    dwell keep within the stability range and inside the tolerance. Whatever else happens it names, and takes
    nothing.

    Attributes
    ----------
    progress
        How far the capture has come.
    is_halted
        Whether nothing more is taken: it is over, or an operator must see to something. Another follower
        goes on, from ``progress``.

    Parameters
    ----------
    progress
        Where to begin: `Progress.begin`, or that of a journal.
    settings
        When a reading is taken.
    """

    def __init__(self, progress: Progress, settings: Settings) -> None:
        self.progress = progress
        self.is_halted = progress.is_over
        self._settings = settings
        self._window = Window(settings.stability, settings.dwell)
        self._track = Track(settings.motion)
        by_position = {visit.position: visit.target for visit in progress.visits}
        self._positions = sorted(by_position)
        self._targets = [by_position[position] for position in self._positions]
        self._latest: LiveReading | None = None
        self._lost = 0
        self._pace = Pace()
        self._stood_at: float | None = None
        self._passed = 0
        self._comes_from_its_side = False
        self._inside_since: float | None = None

    @property
    def status(self) -> Status:
        """What a display shows of the present moment."""
        zero, latest = self.progress.zero, self._latest
        position = None if latest is None or zero is None else latest.value + zero
        return Status(position, self._window.range, self._window.duration)

    def feed(self, reading: LiveReading) -> list[Event]:
        """Return what happens with a reading, in order; mostly nothing."""
        events: list[Event] = []
        for event in () if self.is_halted else self._seen(reading):
            events.append(event)
            self.progress = self.progress.after(event)
            if isinstance(event, HALTING):
                self.is_halted = True
                break
        return events

    def _seen(self, reading: LiveReading) -> Iterator[Event]:
        if reading.loses_zero:
            yield from self._without_zero(reading)
            return
        self._lost += reading.skipped
        if not reading.is_usable:
            self._lost += 1
            if reading.faults != Fault.UNREADABLE:
                self._window.clear()
            return
        if self._latest is not None:
            yield from self._after_a_gap(self._latest, reading)
        self._window.add(reading, self._lost)
        self._latest, self._lost = reading, 0
        zero = self.progress.zero
        if zero is None:
            yield from self._at_the_datum(reading)
            return
        self._track.add(reading.value + zero)
        yield from self._on_the_way(reading.time)
        if self._window.is_still and self._stood_at is None:
            yield from self._at_a_standstill(zero)

    def _without_zero(self, reading: LiveReading) -> Iterator[Event]:
        """Lose the zero; before a datum is taken there is none to lose."""
        self._window.clear()
        self._track.forget()
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
        self._window.clear()
        if gap >= self._settings.stay:
            yield TrackLost(gap)
        if self.progress.zero is not None and not self._has_stayed(latest, reading):
            self._track.forget()
            self._look_ahead()

    def _has_stayed(self, latest: LiveReading, reading: LiveReading) -> bool:
        """Tell whether the axis, seen to arrive, cannot have left and come back from elsewhere since."""
        return (
            self._inside_since is not None
            and reading.time - self._inside_since < self._settings.stay
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
            yield Moving(self.progress.next)
        while (visit := self._ahead) is not None:
            if self._inside_since is None:
                self._comes_from_its_side |= self._is_before(visit, position)
                if not (self._comes_from_its_side and self._is_at_or_beyond(visit, position)):
                    return
                self._inside_since = time
                yield Settling(visit)
            if abs(position - visit.position) <= self._settings.tolerance + self._settings.motion:
                return
            yield Passed(visit, time - self._inside_since)
            self._passed += 1
            self._look_ahead()

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

    def _at_a_standstill(self, zero: float) -> Iterator[Event]:
        target, approach = self._target_around(zero), self._track.direction
        if target is None and approach is None:  # it waits for its program
            return
        mean = self._window.mean()
        self._stood_at = mean.value + zero
        if target is None:
            yield Elsewhere(self._stood_at)
        else:
            yield from self._at_target(target, approach, mean, zero)

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
        """Say what a standstill at a target is, and take the reading if it is a visit that may be next."""
        progress = self.progress
        if approach is None:
            if target == progress.next.target:
                yield WrongDirection(progress.next, None)
            return
        was_checked = progress.must_check
        if was_checked:
            yield self._checked(target, approach, mean.value + zero)
            if self.progress.must_check:
                return
            index = progress.taken if self._is_next(target, approach) else None
        else:
            index = matching(progress.visits, progress.taken, self._passed, target, approach)
        if index is not None:
            yield from self._taken(index, mean, zero)
        elif not was_checked:
            yield self._out_of_turn(target, approach)

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

    def _taken(self, index: int, mean: Mean, zero: float) -> Iterator[Event]:
        progress = self.progress
        self._passed = 0
        self._look_ahead()
        for visit in progress.visits[progress.taken : index]:
            yield Missed(visit, progress.attempts.get(visit.part, 1))
        visit = progress.visits[index]
        yield Recorded(visit, progress.attempts.get(visit.part, 1), mean.value + zero, mean)
        if index == len(progress.visits) - 1:
            yield Finished()

    def _out_of_turn(self, target: int, approach: Approach) -> Event:
        """Name a standstill at which nothing may be taken."""
        progress = self.progress
        if progress.taken:
            last = progress.visits[progress.taken - 1]
            if (last.target, last.approach) == (target, approach):
                return Repeated(last)
        if target == progress.next.target:
            return WrongDirection(progress.next, approach)
        return NotNext(target, approach, progress.next)


def follow(readings: Iterable[LiveReading], progress: Progress, settings: Settings) -> Iterator[Event]:
    """Yield what happens while readings come, until nothing more is taken or they end."""
    follower = Follower(progress, settings)
    for reading in readings:
        yield from follower.feed(reading)
        if follower.is_halted:
            return
