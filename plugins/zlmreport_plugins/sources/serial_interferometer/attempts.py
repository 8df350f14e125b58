"""Which readings of a journal count, where a part of the test was taken more than once."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from zlmreport.plugin import JournalEntry, JournalHistory, ReadingRecorded


@dataclass(frozen=True, slots=True)
class Taken:
    """A reading that counts: its entry in the journal, and the event in it."""

    entry: JournalEntry
    event: ReadingRecorded


@dataclass(frozen=True, slots=True)
class Part:
    """A part of the test, which shares one datum.

    Attributes
    ----------
    number
        Of the part, from 1.
    attempt
        The attempt that counts, from 1.
    attempts
        How many there were.
    left_out
        How many readings the others have.
    """

    number: int
    attempt: int
    attempts: int
    left_out: int


def counted(history: JournalHistory) -> tuple[Mapping[int, Taken], tuple[Part, ...]]:
    """Return the readings that count, by the numbers of their visits, and what was left out.

    Readings of two attempts are not mixed, for each has a datum of its own. The attempt with the most
    readings counts, of equals the last: a rule that no reading's value has a part in.
    """
    by_part: dict[int, dict[int, list[Taken]]] = defaultdict(lambda: defaultdict(list))
    for taken in _taken(history.entries):
        by_part[taken.event.visit.part][taken.event.attempt].append(taken)
    readings: dict[int, Taken] = {}
    parts = []
    for number, attempts in sorted(by_part.items()):
        attempt = max(attempts, key=lambda each: (len(attempts[each]), each))
        readings |= {taken.event.visit.number: taken for taken in attempts[attempt]}
        left_out = sum(len(others) for each, others in attempts.items() if each != attempt)
        parts.append(Part(number, attempt, len(attempts), left_out))
    return readings, tuple(parts)


def _taken(entries: Iterable[JournalEntry]) -> Iterable[Taken]:
    return (Taken(entry, entry.event) for entry in entries if isinstance(entry.event, ReadingRecorded))
