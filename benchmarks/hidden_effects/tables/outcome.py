"""What a result means: right, right among equals, wrong, nothing, or left without a name."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from hidden_effects.records import Record


@dataclass(frozen=True, slots=True)
class Outcome:
    """A judged diagnosis of a test that hides one effect.

    Attributes
    ----------
    is_first
        It is missing, and the hidden effect (or its twin) is the first candidate.
    is_named
        It is missing, and the hidden effect is the first candidate or one of its named equals.
    is_wrong
        It is missing, and the hidden effect is neither.
    is_silent
        The model is said to be adequate.
    is_unexplained
        Something is said to be left that no effect explains.
    leads_anyway
        The hidden effect is the first candidate, whatever the verdict.
    group
        How many effects are named as possible, twins counted as one; 0 where none is named.
    """

    is_first: bool
    is_named: bool
    is_wrong: bool
    is_silent: bool
    is_unexplained: bool
    leads_anyway: bool
    group: int


def outcome(record: Record) -> Outcome:
    """Return what a result means."""
    twins = set(record["twins"])
    candidates = record["candidates"]
    names = [candidates[0]["effect"], *candidates[0]["equals"]] if candidates else []
    is_missing = record["verdict"] == "missing"
    is_named = is_missing and bool(twins.intersection(names))
    leads = bool(names) and names[0] in twins
    return Outcome(
        is_first=is_missing and leads,
        is_named=is_named,
        is_wrong=is_missing and not is_named,
        is_silent=record["verdict"] == "adequate",
        is_unexplained=record["verdict"] == "unexplained",
        leads_anyway=leads,
        group=len(set(names) - twins) + is_named if is_missing else 0,
    )


def judged(records: Iterable[Record], **having: object) -> list[Record]:
    """Return the results with a diagnosis, with these values: ``kind="effect"``, ``size=1.0``."""
    return [
        record
        for record in records
        if record["outcome"] == "judged" and all(record[key] == value for key, value in having.items())
    ]
