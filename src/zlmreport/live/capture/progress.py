"""How far a capture has come, and what each event makes of it; the same live or read from its journal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

from zlmreport.errors import InputError, Place
from zlmreport.live.capture.events import (
    DatumHolds,
    DatumMoved,
    DatumTaken,
    Ended,
    Event,
    Finished,
    Missed,
    Placed,
    Recorded,
    Resumed,
    Retake,
    ScaleChanged,
    Skipped,
    Unclear,
    ZeroLost,
)
from zlmreport.live.capture.visits import ListedVisit
from zlmreport.measurement.approach import Approach


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a capture has come."""

    visits: tuple[ListedVisit, ...]  #: All that are to be.
    #: Where the axis stands when the datum is taken, m or rad; None where the instrument's own zero counts.
    datum: float | None = None
    taken: int = 0  #: How many visits, from the first, are taken or missed for good: the index of the next.
    #: How often a part of the test was begun, where that is more than once.
    attempts: Mapping[int, int] = field(default_factory=lambda: MappingProxyType({}))
    #: The position at which the instrument reads 0, m or rad; None as long as the datum is not taken.
    zero: float | None = None
    #: What was read under this datum: the latest reading of each target from each side.
    read: Mapping[tuple[int, Approach], Recorded] = field(default_factory=lambda: MappingProxyType({}))
    #: Whether the datum may have moved: it is held against an earlier reading before anything is taken.
    must_check: bool = False
    #: The numbers of the visits that have a reading: of the attempt that goes on, and of earlier parts.
    filed: frozenset[int] = frozenset()
    #: A stop of which the operator is to say which visit it is; None for none.
    question: Unclear | None = None
    is_over: bool = False  #: Whether the test is over.
    #: Where visits are taken again: the index after the last of them, and what is `taken` after that.
    again: tuple[int, int] | None = None
    skipped: frozenset[int] = frozenset()  #: The numbers of the visits that the operator leaves out.
    #: The numbers of the visits that were read under an earlier datum.
    before_datum: frozenset[int] = frozenset()

    @classmethod
    def begin(cls, visits: Sequence[ListedVisit], datum: float | None) -> Progress:
        """Return the progress of a capture that is about to begin."""
        return cls(tuple(visits), datum, zero=0.0 if datum is None else None)

    @property
    def next(self) -> ListedVisit:
        """The visit that is next; of a test that is over, the last."""
        return self.visits[min(self.taken, len(self.visits) - 1)]

    @property
    def has_all(self) -> bool:
        """Whether no visit is next: each is taken, or missed for good."""
        return self.taken >= len(self.visits)

    @property
    def check(self) -> ListedVisit | None:
        """The visit to which the axis is to come once more, to check the datum; None where it is not."""
        if not self.must_check or (self.has_all and self.datum is not None):
            return None
        return max((each.visit for each in self.read.values()), key=lambda visit: visit.number)

    @property
    def destination(self) -> float:
        """Where the axis goes next, m or rad: to a visit, and after the last to the datum, if it has one."""
        if self.has_all and self.datum is not None:
            return self.datum
        return (self.check or self.next).position

    @property
    def attempt(self) -> int:
        """The number of the attempt at the part of the test that is next, from 1."""
        return self.attempts.get(self.next.part, 1)

    @property
    def rest_of_part(self) -> tuple[ListedVisit, ...]:
        """What is still to be taken of the part of the test that is next; of what is taken again, nothing."""
        rest = self.visits[self._reached :]
        return tuple(visit for visit in rest if visit.part == rest[0].part)

    def take_event(self, event: Event) -> Progress:
        """Return the progress after something has happened."""
        changes: dict[str, Any] = {}
        match event:
            case DatumTaken(position=position, mean=mean):
                changes = {"zero": position - mean.value}
            case DatumHolds():
                changes = {"must_check": False}
            case Recorded(visit=visit):
                read = {**self.read, (visit.target, visit.approach): event}
                filed = self.filed | {visit.number}
                changes = {**self._go_beyond(visit), "read": MappingProxyType(read), "filed": filed}
            case Missed(visit=visit):
                changes = self._go_beyond(visit)
            case ZeroLost() | DatumMoved():
                changes = self._begin_again()
            case ScaleChanged(visit=ListedVisit() as visit):
                changes = self._take_again(visit, visit)
            case Resumed():
                changes = self._change_unwatched()
            case Finished() | Ended():
                changes = {"is_over": True}
            case _:
                changes = self._change_by_operator(event)
        return replace(self, **changes)

    def _change_by_operator(self, event: Event) -> dict[str, Any]:
        """Return what changes by what the operator is asked, answers and orders."""
        match event:
            case Unclear():
                return {"question": event}
            case Placed():
                return {"question": None}
            case Skipped(visit=visit):
                return {**self._go_beyond(visit), "skipped": self.skipped | {visit.number}}
            case Retake(first=first, last=last):
                return self._take_again(first, last)
            case _:
                return {}

    def _change_unwatched(self) -> dict[str, Any]:
        """Return what changes by a time in which nobody watched the instrument.

        What was read under the datum can be read again, and shows whether it still holds. Where nothing was,
        the datum is taken anew.
        """
        if self.read:
            return {"must_check": True, "question": None}
        return {"zero": self._zero_before_datum, "question": None, "before_datum": self.filed}

    def _begin_again(self) -> dict[str, Any]:
        """Return what changes when the datum is gone: its part of the test begins anew, if it had begun.

        What was to be taken again is given up: under another datum it would not compare with the rest of its
        part. Of a test that has all its visits nothing begins anew.
        """
        taken, part = self._reached, 0
        if taken < len(self.visits):
            part = self.visits[taken].part
            taken = next(index for index, visit in enumerate(self.visits) if visit.part == part)
        filed = frozenset(number for number in self.filed if self.visits[number - 1].part != part)
        return {
            "taken": taken,
            "again": None,
            "attempts": self._count_attempt(part) if taken < self._reached else self.attempts,
            "zero": self._zero_before_datum,
            "read": MappingProxyType({}),
            "must_check": False,
            "filed": filed,
            "before_datum": filed,
            "question": None,
            "is_over": not part,
        }

    def _take_again(self, first: ListedVisit, last: ListedVisit) -> dict[str, Any]:
        """Return what changes when visits are taken again; under another datum it is another attempt."""
        ordered, reached = frozenset(range(first.number, last.number + 1)), self._reached
        changes: dict[str, Any] = {
            "taken": first.number - 1,
            "again": (last.number, reached) if last.number < reached else None,
            "skipped": self.skipped - ordered,
            "is_over": False,
        }
        if ordered & self.before_datum:
            changes |= {
                "attempts": self._count_attempt(first.part),
                "filed": self.filed - ordered,
                "before_datum": self.before_datum - ordered,
            }
        return changes

    def _count_attempt(self, part: int) -> Mapping[int, int]:
        return MappingProxyType({**self.attempts, part: self.attempts.get(part, 1) + 1})

    def _go_beyond(self, visit: ListedVisit) -> dict[str, Any]:
        """Return what changes when a visit is taken, or will not be."""
        if self.again is None or visit.number < self.again[0]:
            return {"taken": visit.number}
        return {"taken": max(visit.number, self._reached), "again": None}

    @property
    def _reached(self) -> int:
        """What was taken before visits were taken again."""
        return self.taken if self.again is None else self.again[1]

    def make_retake(self, text: str, place: Place) -> Retake:
        """Return what takes visits again.

        `text`: The number of a visit, or ``run`` and that of a run.

        Raises `InputError` if there is no such visit or run, the capture has not come so far, or a datum is
        gone without which a part of the test would be read under two.
        """
        text = text.strip()
        word, _, number = text.rpartition("run")
        is_run = "run" in text
        numbers = [
            visit.number
            for visit in self.visits
            if number.strip() == str(visit.run if is_run else visit.number)
        ]
        if word.strip() or not numbers:
            raise InputError.at(
                place,
                f"{text[:60]!r} is nothing to take again: state a visit, 1 to {len(self.visits)}, or a run, "
                f"'run 1' to 'run {max(visit.run for visit in self.visits)}'",
            )
        if numbers[-1] - numbers[0] != len(numbers) - 1:
            raise InputError.at(place, f"{text}: this method mixes the runs; state single visits")
        if numbers[0] > self._reached:
            message = f"{text}: the capture has not come so far; next is visit {self._reached + 1}"
            raise InputError.at(place, message)
        parts = {self.visits[each - 1].part for each in numbers}
        others = {visit.number for visit in self.visits if visit.part in parts}.difference(numbers)
        if others & self.before_datum:
            raise InputError.at(
                place,
                f"{text}: the datum is gone under which it was read, and another one would not compare; take "
                "all again that shares its datum: its run, or the test, in another journal",
            )
        return Retake(self.visits[numbers[0] - 1], self.visits[min(numbers[-1], self._reached) - 1])

    @property
    def _zero_before_datum(self) -> float | None:
        return 0.0 if self.datum is None else None
