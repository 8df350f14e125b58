"""What came of advice that was followed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from hidden_effects.records import Record
from hidden_effects.tables.markdown import table
from hidden_effects.tables.shares import Share

_PROMISED = (0.95, 0.8, 0.5)
_WAYS = ("right", "undecided", "wrong")


def report(records: Sequence[Record], state: str) -> str:
    """Return the table, and what the advice costs; arguments as of all tables."""
    ties = [each for each in records if each["outcome"] == "judged"]
    lines = [f"{len(records)} cases of code {state}: {len(ties)} ties.", "", *_table(ties)]
    if ties:
        lines += ["", _cost([each["experiment"] / each["diagnosis"] for each in ties])]
    return "\n".join(lines)


def _table(ties: Sequence[Record]) -> Iterator[str]:
    rows: list[tuple[object, ...]] = []
    most = np.inf
    for least in _PROMISED:
        own = [each for each in ties if each["followed"] and least <= each["decides"] < most]
        rows.append((f"≥ {least}", *_row(own)))
        if least == _PROMISED[0]:
            rows.append(("of these, by a second session", *_row(each for each in own if each["session"])))
        most = least
    rows.append(("no plan is worth it", sum(not each["followed"] for each in ties), *4 * ("–",)))
    yield from table(
        ("promised", "ties", "promised on average, %", "decided rightly, %", "undecided, %", "wrong, %"), rows
    )


def _row(ties: Iterable[Record]) -> tuple[object, ...]:
    listed = list(ties)
    came = [each["followed"]["decision"] for each in listed]
    stated = f"{100 * float(np.mean([each['decides'] for each in listed])):.0f}" if listed else "–"
    return len(listed), stated, *(Share.of(each == way for each in came) for way in _WAYS)


def _cost(ratios: Sequence[float]) -> str:
    median, most = np.quantile(ratios, [0.5, 0.95])
    return (
        f"Of CPU the experiment takes {median:.2f} times what the diagnosis took in the median, and within "
        f"{most:.2f} times in 95 % of the ties."
    )
