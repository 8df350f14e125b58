"""Tests that hide nothing, or what no effect is like, and whether a name is given nevertheless."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import product

from hidden_effects.cases import SIZES, Scatter
from hidden_effects.records import Record
from hidden_effects.tables.markdown import table
from hidden_effects.tables.outcome import judged
from hidden_effects.tables.shares import Share
from zlmreport.model.planning.methods import Method

#: A shape of which every effect imitates less than this share, R², is like none of them.
_UNLIKE = 0.8
_HEAD = ("tests", "falsely named", "the same where R² < 0.8", "unexplained", "adequate")


def false_alarms(records: Sequence[Record]) -> Iterator[str]:
    """Yield the table of tests without a hidden effect."""
    rows = []
    for scatter in Scatter:
        chosen = judged(records, kind="nothing", scatter=scatter)
        by_method = ([each for each in chosen if each["method"] == method] for method in Method)
        alarms = [_alarms(each).short for each in by_method]
        rows.append((scatter, len(chosen), _alarms(chosen), _names(chosen), *alarms))
    return table(("noise", "tests", "false alarms", "with a name", *Method), rows)


def strangers(records: Sequence[Record]) -> Iterator[str]:
    """Yield the table of shapes from outside the catalogue, by noise and size."""
    rows = [
        (f"{scatter}, ρ = {size:g}", *_said(judged(records, kind="stranger", scatter=scatter, size=size)))
        for scatter, size in product(Scatter, SIZES)
    ]
    return table(("noise", *_HEAD), rows)


def by_stranger(records: Sequence[Record]) -> Iterator[str]:
    """Yield the table of single shapes, and the names that they were given."""
    rows = []
    for name in sorted({each["hidden"][0] for each in judged(records, kind="stranger")}):
        chosen = judged(records, kind="stranger", hidden=[name])
        given = Counter(each["candidates"][0]["effect"] for each in chosen if each["verdict"] == "missing")
        names = ", ".join(f"{effect} {count}" for effect, count in given.most_common(3))
        rows.append(
            (name, *(cell.short if isinstance(cell, Share) else cell for cell in _said(chosen)), names)
        )
    return table(("shape", *_HEAD, "named (times)"), rows)


def _said(chosen: Sequence[Record]) -> tuple[object, ...]:
    return (
        len(chosen),
        _names(chosen),
        _names([each for each in chosen if each["imitated"] < _UNLIKE]),
        Share.of(each["verdict"] == "unexplained" for each in chosen),
        Share.of(each["verdict"] == "adequate" for each in chosen),
    )


def _alarms(chosen: Sequence[Record]) -> Share:
    return Share.of(each["verdict"] != "adequate" for each in chosen)


def _names(chosen: Sequence[Record]) -> Share:
    return Share.of(each["verdict"] == "missing" for each in chosen)
