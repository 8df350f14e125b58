"""The command lines of the benchmarks that hide effects: of truth, of experiments, of learned priors."""

from __future__ import annotations

import argparse
import math
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from hidden_effects import experiments, learned, records
from hidden_effects.cases import Case, Kind, cases
from hidden_effects.judge import judged
from hidden_effects.records import Record
from hidden_effects.run import run, with_slow_ways
from hidden_effects.tables import report
from hidden_effects.tables.experiments import report as of_experiments

_SECONDS_PER_MINUTE = 60
_FIRST_DRAW = 1000


@dataclass(frozen=True, slots=True)
class _Benchmark:
    """What is done with the cases, and what is printed of it."""

    name: str
    description: str
    judge: Callable[..., Record]
    report: Callable[[Sequence[Record], str], str]
    chosen: Callable[[Iterable[Case]], Iterator[tuple[object, ...]]]


_OF_TRUTH = _Benchmark(
    "hidden-effects",
    "Hide effects in simulated tests, diagnose these, and compare.",
    judged,
    report,
    with_slow_ways,
)
_OF_EXPERIMENTS = _Benchmark(
    "experiments",
    "Hide effects in small tests; where a diagnosis names several, follow its advice, and diagnose again.",
    experiments.judged,
    of_experiments,
    experiments.chosen,
)
_OF_PRIORS = _Benchmark(
    "priors",
    "Diagnose simulated tests with and without what ten earlier tests of the type of machine teach.",
    learned.judged,
    learned.report,
    learned.chosen,
)


def main(arguments: Sequence[str]) -> None:
    """Run the benchmark of truth."""
    _main(_OF_TRUTH, arguments)


def main_of_experiments(arguments: Sequence[str]) -> None:
    """Run the benchmark of the next experiment."""
    _main(_OF_EXPERIMENTS, arguments)


def main_of_priors(arguments: Sequence[str]) -> None:
    """Run the benchmark of learned priors."""
    _main(_OF_PRIORS, arguments)


def _main(benchmark: _Benchmark, arguments: Sequence[str]) -> None:
    """Judge what is left to judge, and print the tables."""
    asked = _parser(benchmark).parse_args(arguments)
    seconds = math.inf if asked.minutes is None else _SECONDS_PER_MINUTE * asked.minutes
    drawn = cases(asked.draws, asked.first)
    listed = (case for case in drawn if asked.only in (None, case.kind))
    run(benchmark.chosen(listed), benchmark.judge, asked.results, asked.processes, seconds)
    state = records.state_of_code()
    print(benchmark.report(records.of_state(records.read(asked.results), state), state))


def _parser(benchmark: _Benchmark) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog=f"./run benchmark {benchmark.name}",
        description=f"{benchmark.description} A stopped run is resumed.",
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
        default=Path(f"out/{benchmark.name}.jsonl"),
        metavar="FILE",
        help="where the results are kept (%(default)s); those of another state of the code do not count",
    )
    return parser
