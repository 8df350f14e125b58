"""Judges cases in several processes until all are done, or until the time is up."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from itertools import islice
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from hidden_effects import records
from hidden_effects.cases import Case, Kind
from hidden_effects.generic import is_tried_on
from hidden_effects.records import Record

#: One process, one core: two that share cores through a library's threads are slower than each by itself.
_SINGLE_THREADED = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
#: Of the cases on which generic ways are tried, the slow ones are tried on every so many, up to a number.
_SLOW_EVERY, _MOST_SLOW = 10, 18
_AHEAD = 4


def run(
    cases: Iterable[tuple[Any, ...]],
    judge: Callable[..., Record],
    file: Path,
    processes: int,
    seconds: float,
) -> int:
    """Judge every case that has no result yet; return how many were judged.

    Parameters
    ----------
    cases
        In the order in which they are judged, each with what else the judge takes.
    judge
        A function of a module.
    file
        Results are appended to it.
    processes
        That work at the same time.
    seconds
        After which no case is begun any more.
    """
    state = records.state_of_code()
    records.mend(file)
    done = {record["key"] for record in records.of_state(records.read(file), state)}
    open_cases = (case for case in cases if case[0].key not in done)
    count = 0
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("a", encoding="utf-8") as lines:
        for line in _judged(open_cases, judge, state, processes, time.monotonic() + seconds):
            lines.write(line)
            lines.flush()
            count += 1
    return count


def with_slow_ways(cases: Iterable[Case]) -> Iterator[tuple[Case, bool]]:
    """Yield each case, and whether the slow ways are tried on it."""
    tried = 0
    for case in cases:
        is_tried = case.kind is Kind.EFFECT and is_tried_on(case)
        yield case, is_tried and tried % _SLOW_EVERY == 0 and tried < _SLOW_EVERY * _MOST_SLOW
        tried += is_tried


def _judged(
    cases: Iterator[tuple[Any, ...]], judge: Callable[..., Record], state: str, processes: int, end: float
) -> Iterator[str]:
    for name in _SINGLE_THREADED:
        os.environ[name] = "1"
    with ProcessPoolExecutor(processes, get_context("spawn")) as pool:
        running = {pool.submit(judge, *case) for case in islice(cases, _AHEAD * processes)}
        while running:
            finished, running = wait(running, return_when=FIRST_COMPLETED)
            for future in finished:
                yield records.line_of(future.result(), state)
            if time.monotonic() < end:
                following = list(islice(cases, len(finished)))
                running |= {pool.submit(judge, *case) for case in following}
