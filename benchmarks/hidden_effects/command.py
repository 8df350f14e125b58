"""The command line of the benchmark of truth."""

from __future__ import annotations

import argparse
import math
import os
from collections.abc import Sequence
from pathlib import Path

from hidden_effects import records
from hidden_effects.cases import Kind, cases
from hidden_effects.run import run
from hidden_effects.tables import report

_SECONDS_PER_MINUTE = 60
_FIRST_DRAW = 1000


def main(arguments: Sequence[str]) -> None:
    """Judge what is left to judge, and print the tables."""
    asked = _parser().parse_args(arguments)
    seconds = math.inf if asked.minutes is None else _SECONDS_PER_MINUTE * asked.minutes
    drawn = cases(asked.draws, asked.first)
    listed = (case for case in drawn if asked.only in (None, case.kind))
    run(listed, asked.results, asked.processes, seconds)
    state = records.state_of_code()
    print(report(records.of_state(records.read(asked.results), state), state))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="./run benchmark hidden-effects",
        description="Hide effects in simulated tests, diagnose these, and compare. A stopped run is resumed.",
    )
    parser.add_argument(
        "--draws", type=int, default=100, help="draws for each cell of the tables (%(default)s)"
    )
    parser.add_argument(
        "--first",
        type=int,
        default=_FIRST_DRAW,
        metavar="DRAW",
        help="number of the first draw (%(default)s): those before it are for trying things out",
    )
    parser.add_argument("--only", type=Kind, choices=tuple(Kind), help="judge only tests that hide this")
    parser.add_argument("--minutes", type=float, help="begin no more cases after so many minutes")
    parser.add_argument(
        "--processes", type=int, default=os.cpu_count() or 1, help="that work at the same time (%(default)s)"
    )
    parser.add_argument(
        "--results",
        type=Path,
        default=Path("out/hidden-effects.jsonl"),
        metavar="FILE",
        help="where the results are kept (%(default)s); those of another state of the code do not count",
    )
    return parser
