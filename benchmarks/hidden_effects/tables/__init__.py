"""The tables, in Markdown, from whatever results there are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence

from hidden_effects.records import Record
from hidden_effects.tables import named, targets, unnamed, worth

_TABLES: Sequence[tuple[str, Callable[[Sequence[Record]], Iterator[str]]]] = (
    ("Targets", targets.targets),
    ("All effects", named.all_effects),
    ("Without offset, scale-error, cosine-error and gauge-misalignment", named.effects_that_vary),
    ("By positioning method", named.by_method),
    ("By effect", named.by_effect),
    ("By what the test can tell apart", named.by_distance),
    ("Stated probabilities", named.probabilities),
    ("Two hidden effects", named.pairs),
    ("False alarms", unnamed.false_alarms),
    ("Strangers", unnamed.strangers),
    ("By stranger", unnamed.by_stranger),
    ("Error on a second test", worth.second_test),
    ("Beside generic ways", worth.generic_ways),
    ("Time of a diagnosis", worth.time),
)


def report(records: Sequence[Record], state: str) -> str:
    """Return all tables.

    Parameters
    ----------
    records
        Results of one state of the code.
    state
        Its fingerprint.
    """
    outcomes = Counter(record["outcome"] for record in records)
    counts = ", ".join(f"{count} {outcome}" for outcome, count in outcomes.most_common())
    lines = [f"{len(records)} cases of code {state}: {counts}."]
    refused = Counter(record["message"] for record in records if record["outcome"] == "refused")
    lines += [f"{count} times refused: {message}" for message, count in refused.most_common()]
    for title, table in _TABLES:
        lines += ["", f"### {title}", "", *table(records)]
    return "\n".join(lines)
