"""Clocks, medians, and processes of their own."""

from __future__ import annotations

import gc
import os
import resource
import statistics
import subprocess
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from typing import TypeVar

_T = TypeVar("_T")

_KIBIBYTES_OF_MEGABYTE = 1024


@dataclass(frozen=True, slots=True)
class Sizes:
    """How much is measured.

    Attributes
    ----------
    rounds
        Repetitions: the median of all but the first one is given.
    tests
        Stacked tests of one evaluation.
    certificates
        Certificates that one process makes while its memory is watched.
    """

    rounds: int
    tests: int
    certificates: int


@dataclass(frozen=True, slots=True)
class Measured:
    """One line of the results.

    Attributes
    ----------
    name
        What was measured.
    value, unit
        The median; the unit is empty for a ratio.
    target
        What the value must not exceed; None for a value that only informs.
    """

    name: str
    value: float
    unit: str = ""
    target: float | None = None


@dataclass(frozen=True, slots=True)
class Cost:
    """Seconds of one repetition: on the clock, and of processors (user and system)."""

    wall: float
    cpu: float


def timed(action: Callable[[], _T]) -> tuple[Cost, _T]:
    """Measure an action in this process, and return what it returns.

    The collector of garbage runs when Python sees fit, as in any program.
    """
    begin, used = time.perf_counter(), _processor_seconds(resource.RUSAGE_SELF)
    result = action()
    cost = Cost(time.perf_counter() - begin, _processor_seconds(resource.RUSAGE_SELF) - used)
    return cost, result


def cost_of_command(command: Sequence[str | Path]) -> Cost:
    """Measure a whole process, from its start to its end; modules that it compiles it keeps, as usual."""
    usual = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    begin, used = time.perf_counter(), _processor_seconds(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, env=usual)
    return Cost(time.perf_counter() - begin, _processor_seconds(resource.RUSAGE_CHILDREN) - used)


def alternately(actions: Mapping[str, Callable[[], Cost]], rounds: int) -> dict[str, Sequence[Cost]]:
    """Measure actions in turn, A B A B, so that a machine that slows down slows all of them."""
    costs: dict[str, list[Cost]] = {name: [] for name in actions}
    for _ in range(rounds):
        for name, action in actions.items():
            costs[name].append(action())
    return {name: that_count(of_name) for name, of_name in costs.items()}


def that_count(rounds: Sequence[_T]) -> Sequence[_T]:
    """Return the rounds without the first, which warms caches; the first if it is the only one."""
    return rounds[1:] or rounds


def wall(costs: Iterable[Cost]) -> list[float]:
    """Return the seconds on the clock."""
    return [each.wall for each in costs]


def cpu(costs: Iterable[Cost]) -> list[float]:
    """Return the seconds of processors."""
    return [each.cpu for each in costs]


def median(values: Iterable[float]) -> float:
    """Return the median."""
    return statistics.median(values)


def ratio(values: Iterable[float], others: Iterable[float]) -> float:
    """Return the median of the ratios round by round."""
    return median(value / other for value, other in zip(values, others, strict=True))


def resident_megabytes() -> float:
    """Return the memory of this process that is in use, after a collection of garbage."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / _KIBIBYTES_OF_MEGABYTE**2


def peak_megabytes() -> float:
    """Return the most memory that this process ever had in use."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / _KIBIBYTES_OF_MEGABYTE


def own_process() -> ProcessPoolExecutor:
    """Return a fresh process that makes one call after the other."""
    return ProcessPoolExecutor(1, get_context("spawn"))


def _processor_seconds(whose: int) -> float:
    usage = resource.getrusage(whose)
    return usage.ru_utime + usage.ru_stime
