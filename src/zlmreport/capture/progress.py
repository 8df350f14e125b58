"""How far a capture has come: the same whether it was lived through, or is read from its journal."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

from zlmreport.capture.events import (
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
    Unclear,
    ZeroLost,
)
from zlmreport.capture.visits import ListedVisit
from zlmreport.measurement.approach import Approach


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a capture has come.

    Attributes
    ----------
    visits
        All that are to be.
    datum
        Where the axis stands when the datum is taken, m or rad; None where the instrument's own zero counts.
    taken
        How many visits, from the first, are taken or missed for good: the index of the next.
    attempts
        How often a part of the test was begun, where that is more than once.
    zero
        The position at which the instrument reads 0, m or rad; None as long as the datum is not taken.
    read
        What was read under this datum: the latest reading of each target from each side.
    must_check
        Whether the datum may have moved: it is held against an earlier reading before anything is taken.
    filed
        The numbers of the visits that have a reading: of the attempt that goes on, and of earlier parts.
    question
        A stop of which the operator is to say which visit it is; None for none.
    is_over
        Whether the test is over.
    """

    visits: tuple[ListedVisit, ...]
    datum: float | None = None
    taken: int = 0
    attempts: Mapping[int, int] = field(default_factory=lambda: MappingProxyType({}))
    zero: float | None = None
    read: Mapping[tuple[int, Approach], Recorded] = field(default_factory=lambda: MappingProxyType({}))
    must_check: bool = False
    filed: frozenset[int] = frozenset()
    question: Unclear | None = None
    is_over: bool = False

    @classmethod
    def begin(cls, visits: Sequence[ListedVisit], datum: float | None) -> Progress:
        """Return the progress of a capture that is about to begin."""
        return cls(tuple(visits), datum, zero=0.0 if datum is None else None)

    @property
    def next(self) -> ListedVisit:
        """The visit that is next; of a test that is over, the last."""
        return self.visits[min(self.taken, len(self.visits) - 1)]

    @property
    def attempt(self) -> int:
        """The number of the attempt at the part of the test that is next, from 1."""
        return self.attempts.get(self.next.part, 1)

    @property
    def rest_of_part(self) -> tuple[ListedVisit, ...]:
        """What is still to be taken of the part of the test that is next."""
        return tuple(visit for visit in self.visits[self.taken :] if visit.part == self.next.part)

    def after(self, event: Event) -> Progress:
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
                changes = {"taken": visit.number, "read": MappingProxyType(read), "filed": filed}
            case Missed(visit=visit):
                changes = {"taken": visit.number}
            case Unclear():
                changes = {"question": event}
            case Placed():
                changes = {"question": None}
            case ZeroLost() | DatumMoved():
                changes = self._begun_again()
            case Resumed():
                changes = self._unwatched()
            case Finished() | Ended():
                changes = {"is_over": True}
        return replace(self, **changes)

    def _unwatched(self) -> dict[str, Any]:
        """Return what changes by a time in which nobody watched the instrument.

        What was read under the datum can be read again, and shows whether it still holds. Where nothing was,
        the datum is taken anew.
        """
        if self.read:
            return {"must_check": True, "question": None}
        return {"zero": self._zero_before_datum, "question": None}

    def _begun_again(self) -> dict[str, Any]:
        """Return what changes when the datum is gone: its part of the test begins anew, if it had begun."""
        part = self.next.part
        first = next(index for index, visit in enumerate(self.visits) if visit.part == part)
        again = self.attempt + 1 if self.taken > first else self.attempt
        return {
            "taken": first,
            "attempts": MappingProxyType({**self.attempts, part: again}),
            "zero": self._zero_before_datum,
            "read": MappingProxyType({}),
            "must_check": False,
            "filed": frozenset(number for number in self.filed if self.visits[number - 1].part != part),
            "question": None,
        }

    @property
    def _zero_before_datum(self) -> float | None:
        return 0.0 if self.datum is None else None
