"""What a diagnosis is worth: the error afterwards, beside other ways, and the time that it takes."""

from __future__ import annotations

import statistics
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from hidden_effects.cases import SIZES, Scatter
from hidden_effects.records import Record
from hidden_effects.tables.markdown import table
from hidden_effects.tables.outcome import judged, outcome
from hidden_effects.tables.shares import Share

_AS_GOOD_AS_THE_ORACLE = 1.05
_WORSE = 1 + 1e-9
#: More have the tests of linear axes in both directions, and those of rotary ones.
USUAL_READINGS = 190
_OWN = "zlmreport"


def second_test(records: Sequence[Record]) -> Iterator[str]:
    """Yield the table of errors on a second test of the same axis."""
    rows = []
    for scatter, size in product(Scatter, SIZES):
        chosen = judged(records, kind="effect", scatter=scatter, size=size)
        if not chosen:
            continue
        before, after, oracle = (
            np.array([each["second"][name] for each in chosen]) for name in ("before", "after", "oracle")
        )
        rows.append(
            (
                f"{scatter}, ρ = {size:g}",
                len(chosen),
                *(f"{np.median(errors):.2f}" for errors in (before, after, oracle)),
                f"{np.median(after / oracle):.2f}",
                f"{np.exp(np.mean(np.log(after / oracle))):.2f}",
                Share.of(after <= _AS_GOOD_AS_THE_ORACLE * oracle),
                Share.of(after > _WORSE * before),
            )
        )
    errors = ("before, σ", "after, σ", "oracle, σ", "after/oracle, median", "geometric mean", "≤ 1.05")
    return table(("noise", "tests", *errors, "after > before"), rows)


@dataclass(frozen=True, slots=True)
class _Tried:
    """How a way did on one test."""

    names: bool
    ratio: float
    seconds: float


def generic_ways(records: Sequence[Record]) -> Iterator[str]:
    """Yield the table of the same tests under other ways."""
    found: dict[tuple[str, str], list[_Tried]] = defaultdict(list)
    for record in judged(records, kind="effect"):
        if "ways" not in record:
            continue
        before = record["second"]["before"]
        own = _Tried(outcome(record).is_first, record["second"]["after"] / before, record["seconds"])
        found[record["scatter"], _OWN].append(own)
        for way, said in record["ways"].items():
            tried = _Tried(said["names"], said["after"] / before, said["seconds"])
            found[record["scatter"], way].append(tried)
    rows = [
        (
            f"{way}, {scatter}",
            len(tried),
            Share.of(each.names for each in tried),
            f"{statistics.median(each.ratio for each in tried):.2f}",
            Share.of(each.ratio > _WORSE for each in tried),
            f"{statistics.median(each.seconds for each in tried):.2g}",
        )
        for (scatter, way), tried in sorted(found.items(), key=lambda each: (each[0][0], each[0][1] != _OWN))
    ]
    head = ("tests", "names the effect", "error after/before, median", "after > before", "s, median")
    return table(("way, noise", *head), rows)


def time(records: Sequence[Record]) -> Iterator[str]:
    """Yield the table of the time that a diagnosis of some 210 readings takes of one core."""
    rows = []
    for verdict in ("adequate", "missing", "unexplained"):
        chosen = [each for each in judged(records, verdict=verdict) if each["readings"] > USUAL_READINGS]
        seconds = [each["seconds"] for each in chosen]
        if seconds:
            quantile = np.quantile(seconds, 0.95)
            rows.append((verdict, len(seconds), f"{statistics.median(seconds):.2f}", f"{quantile:.2f}"))
    return table(("verdict", "tests", "s, median", "s, 95 % of tests within"), rows)
