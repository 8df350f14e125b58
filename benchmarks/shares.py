"""What the benchmarks of coverage share: how often intervals hold, as a table and as lines that are kept."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

#: Of parameters by their symbols, or whatever an interval is of: whether it holds the truth.
Held = Mapping[Any, bool]
#: Draws a test of a world, and says what its intervals hold.
Trial = Callable[[np.random.Generator], Held]
Shares = Mapping[Any, float]


def share_held(trial: Trial, trials: int, seed: int) -> dict[Any, float]:
    """Return the share of trials in which each interval holds, from 0 to 1."""
    generator = np.random.default_rng(seed)
    held: Counter[Any] = Counter()
    for _ in range(trials):
        held.update({symbol: int(holds) for symbol, holds in trial(generator).items()})
    return {symbol: count / trials for symbol, count in held.items()}


def print_table(title: str, symbols: Sequence[str], rows: Iterable[tuple[str, Shares]]) -> None:
    """Print a row for each world, as soon as it is there, and a column for each parameter, in percent."""
    print(f"| {title} |", *(f"{symbol} |" for symbol in symbols))
    print("|---|", *("--:|" for _ in symbols), sep="")
    for name, shares in rows:
        cells = (f"{100 * shares[symbol]:.1f} |" if symbol in shares else "– |" for symbol in symbols)
        print(f"| {name} |", *cells, flush=True)
    print()


def keep(file: Path | None, title: str, trials: int, name: str, shares: Shares) -> None:
    """Add a row to a file of lines of JSON; nothing without a file."""
    if file is None:
        return
    row = {"title": title, "world": name, "trials": trials, "held": shares}
    with file.open("a", encoding="utf-8") as lines:
        lines.write(json.dumps(row, ensure_ascii=False) + "\n")
