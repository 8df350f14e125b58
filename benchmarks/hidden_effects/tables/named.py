"""Tests that hide effects of the catalogue, and whether these are named."""

from __future__ import annotations

import statistics
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import pairwise, product

from hidden_effects.cases import SIZES, SIZES_OF_PAIRS, Scatter, effects
from hidden_effects.records import Record
from hidden_effects.tables.markdown import table
from hidden_effects.tables.outcome import Outcome, judged, outcome
from hidden_effects.tables.shares import Share
from zlmreport.model.planning.methods import Method

#: Distance of the nearest other effect from which on it is told apart: see `Trial.nearest`.
_SEPARATES = 16.0
#: Effects that are constant in a test, or a line over P: whatever has an absolute level looks like them.
_CONSTANT = frozenset({"offset", "scale-error", "cosine-error", "gauge-misalignment"})
_PROBABILITIES = (0.0, 0.5, 0.8, 0.95, 0.99, 1.0)
_NOISE = "noise"


def all_effects(records: Sequence[Record]) -> Iterator[str]:
    """Yield the table of all effects and methods together, by noise and size."""
    return _of_effects(judged(records, kind="effect"))


def effects_that_vary(records: Sequence[Record]) -> Iterator[str]:
    """Yield the same table without the effects that are constant in a test, or a straight line."""
    varying = [each for each in judged(records, kind="effect") if not _CONSTANT.intersection(each["hidden"])]
    return _of_effects(varying)


def _of_effects(records: Sequence[Record]) -> Iterator[str]:
    rows = []
    for scatter, size in product(Scatter, SIZES):
        found = _outcomes(judged(records, scatter=scatter, size=size))
        rows.append(
            (
                f"{scatter}, ρ = {size:g}",
                len(found),
                _first(found),
                _named(found),
                _group(found),
                Share.of(each.is_wrong for each in found),
                Share.of(each.is_unexplained for each in found),
                Share.of(each.is_silent for each in found),
            )
        )
    head = ("tests", "first", "first or equal", "group", "wrong name", "unexplained", "adequate")
    return table((_NOISE, *head), rows)


def by_method(records: Sequence[Record]) -> Iterator[str]:
    """Yield the table of all effects together, by positioning method."""
    rows = []
    for method, scatter in product(Method, Scatter):
        row: list[object] = [f"{method}, {scatter}"]
        for size in SIZES:
            chosen = judged(records, kind="effect", scatter=scatter, size=size, method=method)
            found = _outcomes(chosen)
            row += [len(found), _first(found), _named(found).short, _group(found)]
        rows.append(row)
    head = [
        f"{title}, ρ = {size:g}" for size in SIZES for title in ("tests", "first", "first or equal", "group")
    ]
    return table(["method, noise", *head], rows)


def by_effect(records: Sequence[Record]) -> Iterator[str]:
    """Yield the table of single effects, and what is said in their place."""
    rows = []
    for effect in effects():
        of_effect = judged(records, hidden=[effect])
        row: list[object] = [f"`{effect}`", len(of_effect)]
        row += [_both([each for each in of_effect if each["size"] == size]) for size in SIZES]
        large = [each for each in of_effect if each["size"] >= 1]
        row += [_both([each for each in large if each["method"] == method]) for method in Method]
        instead = Counter(_said(each) for each in large if not outcome(each).is_named)
        row.append(", ".join(f"{name} {count}" for name, count in instead.most_common(3)))
        rows.append(row)
    sizes = [f"ρ = {size:g}" for size in SIZES]
    methods = [f"{method}, ρ ≥ 1" for method in Method]
    return table(["effect", "tests", *sizes, *methods, "said instead at ρ ≥ 1 (times)"], rows)


def by_distance(records: Sequence[Record]) -> Iterator[str]:
    """Yield the table of tests that can tell the hidden effect from its nearest, and of those that cannot."""
    rows = []
    for scatter, size in product(Scatter, SIZES):
        row: list[object] = [f"{scatter}, ρ = {size:g}"]
        chosen = [
            each for each in judged(records, kind="effect", scatter=scatter, size=size) if "distance" in each
        ]
        for separates in (True, False):
            found = _outcomes([each for each in chosen if (each["distance"] >= _SEPARATES) is separates])
            row += [len(found), _first(found), _named(found), _group(found)]
        rows.append(row)
    titles = ("tests", "first", "first or equal", "group")
    head = [f"{which}: {title}" for which in ("≥ 16", "< 16") for title in titles]
    return table([_NOISE, *head], rows)


def probabilities(records: Sequence[Record]) -> Iterator[str]:
    """Yield the table of what the stated probability of the first candidate is worth."""
    chosen = [
        each
        for each in judged(records, kind="effect")
        if each["candidates"] and each["twins"] == each["hidden"]
    ]
    rows = []
    for low, high in pairwise(_PROBABILITIES):
        first = [each for each in chosen if low < each["candidates"][0]["probability"] <= high]
        stated = [100 * each["candidates"][0]["probability"] for each in first]
        right = Share.of([each["candidates"][0]["effect"]] == each["hidden"] for each in first)
        rows.append(
            (f"{low:g}–{high:g}", len(first), f"{statistics.mean(stated):.1f}" if stated else "–", right)
        )
    return table(("probability", "tests", "stated on average, %", "right, %"), rows)


def pairs(records: Sequence[Record]) -> Iterator[str]:
    """Yield the table of tests that hide two effects."""
    rows = []
    for scatter, size in product(Scatter, SIZES_OF_PAIRS):
        chosen = judged(records, kind="pair", scatter=scatter, size=size)
        false = [sum(not hidden & group for group in groups) for hidden, groups in map(_pair, chosen)]
        rows.append(
            (
                f"{scatter}, ρ = {size:g} each",
                len(chosen),
                Share.of(set(each["hidden"]) <= {group[0] for group in each["added"]} for each in chosen),
                Share.of(hidden <= set().union(*groups) for hidden, groups in map(_pair, chosen)),
                Share.of(bool(hidden & set().union(*groups)) for hidden, groups in map(_pair, chosen)),
                f"{statistics.mean(false):.2f}" if false else "–",
            )
        )
    head = ("tests", "both first", "both first or equal", "at least one", "false additions a test")
    return table((_NOISE, *head), rows)


def _pair(record: Record) -> tuple[set[str], list[set[str]]]:
    """Return what was hidden, and the groups that were named one after another."""
    return set(record["hidden"]), [set(group) for group in record["added"]]


def _outcomes(records: Sequence[Record]) -> list[Outcome]:
    return [outcome(each) for each in records]


def _first(found: Sequence[Outcome]) -> Share:
    return Share.of(each.is_first for each in found)


def _named(found: Sequence[Outcome]) -> Share:
    return Share.of(each.is_named for each in found)


def _group(found: Sequence[Outcome]) -> str:
    sizes = [each.group for each in found if each.group]
    return f"{statistics.mean(sizes):.2f}" if sizes else "–"


def _both(records: Sequence[Record]) -> str:
    """Write first, and first or equal, in whole per cent."""
    found = _outcomes(records)
    return f"{_first(found).short}/{_named(found).short}" if found else "–"


def _said(record: Record) -> str:
    verdict = str(record["verdict"])
    return str(record["candidates"][0]["effect"]) if verdict == "missing" else f"*{verdict}*"
