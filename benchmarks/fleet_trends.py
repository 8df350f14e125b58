"""How often a fleet's overview names steps and drifts that there are, and such that there are not.

``./run benchmark trends`` prints the tables of docs/explanation/drift.md. Every axis is simulated: a value of
half its limit, normal scatter between tests, quarterly tests. All numbers are in parts of the limit.
"""

from __future__ import annotations

import argparse
import itertools
import math
import random
import statistics
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from datetime import date, timedelta

from zlmreport.fleet.drifts import Trend, judge_trends
from zlmreport.fleet.records import LedgerEntry, RecordedParameter, State
from zlmreport.fleet.trend import Calibration, Series

LIMIT = 20.0
YEARS, A_YEAR = 5, 4
#: The step comes with this test, counted from zero: seven came before.
CHANGED_AT = 7
#: Of the fleet in which one parameter drifts.
_AXES, _PARAMETERS = 25, 12
_FIRST = date(2020, 1, 15)
_ENTRY = LedgerEntry(job="", night="", state=State.MADE)

#: How the axes of a fleet scatter, by what the table calls it.
SCATTERS: dict[str, Callable[[random.Random], float]] = {
    "1/60 or 1/15, half of them each": lambda rng: rng.choice((1 / 60, 1 / 15)),
    "1/30 or 1/10, half of them each": lambda rng: rng.choice((1 / 30, 1 / 10)),
    "1/15, all alike": lambda _: 1 / 15,
    "1/30, all alike": lambda _: 1 / 30,
    "from 1/60 to 1/15, evenly on a logarithmic scale": lambda rng: math.exp(rng.uniform(*_LOGARITHMS)),
    "1/60, and 1/15 of every tenth axis": lambda rng: 1 / 15 if rng.random() < 0.1 else 1 / 60,
    "1/40, and 1/10 of every tenth axis": lambda rng: 1 / 10 if rng.random() < 0.1 else 1 / 40,
    "1/40, and 1/8 of every fiftieth axis": lambda rng: 1 / 8 if rng.random() < 0.02 else 1 / 40,
}
_LOGARITHMS = math.log(1 / 60), math.log(1 / 15)
#: Up to this scatter a step of a third of the limit is to be seen at once.
_SCATTER_AT_MOST, _THIRD = 1 / 15, 1 / 3
#: Part of the largest such scatter of a fleet, from which on axes are counted.
_NEARLY = 0.75
#: Of how many axes one steps.
_STEPPING = 4
#: Tests before the one that is judged.
BEFORE = (4, 5, 7, 9)


def series(axis: object, values: Sequence[float], symbol: str = "A", *, limited: bool = True) -> Series:
    """Return the history of a parameter of an axis; the values are in parts of its limit."""
    limit = LIMIT if limited else None
    calibrations = (
        Calibration(
            _FIRST + timedelta(days=91 * quarter),
            _ENTRY,
            RecordedParameter("iso230-2:2014", symbol, LIMIT * value, "um", 1.0, limit),
        )
        for quarter, value in enumerate(values)
    )
    return Series("", str(axis), "iso230-2:2014", symbol, "um", tuple(calibrations))


def histories(
    rng: random.Random, scatters: Sequence[float], tests: int, course: Callable[[int], float] = lambda _: 0.0
) -> list[list[float]]:
    """Return the values of axes that all have the same course, each with its scatter."""
    return [[0.5 + course(test) + rng.gauss(0, scatter) for test in range(tests)] for scatter in scatters]


def nights(values: Sequence[Sequence[float]]) -> Iterator[tuple[int, tuple[Trend, ...]]]:
    """Yield what is named after each test, with the number of the test, counted from zero."""
    for test in range(1, len(values[0])):
        yield test, judge_trends(series(axis, each[: test + 1]) for axis, each in enumerate(values))


def is_alarm(trend: Trend) -> bool:
    """Return whether somebody would look at the axis."""
    return trend.step is not None or trend.is_wilder or trend.drifts


@dataclass(frozen=True, slots=True)
class Share:
    """A mean, and its standard deviation as a mean."""

    mean: float
    deviation: float

    @classmethod
    def of(cls, counts: Sequence[float]) -> Share:
        """Return it of what was counted in each of several fleets, or of each of several axes."""
        return cls(statistics.mean(counts), statistics.stdev(counts) / math.sqrt(len(counts)))

    def __str__(self) -> str:
        """Return both as the tables have them."""
        return f"{self.mean:.1f} ± {self.deviation:.1f}"

    def percent(self) -> str:
        """Return both as parts of a hundred."""
        return f"{Share(100 * self.mean, 100 * self.deviation)} %"


@dataclass(frozen=True, slots=True)
class Night:
    """What is named in a night in which all axes of a fleet were tested.

    Attributes
    ----------
    alarms
        Axes that are named where none changed.
    seen
        Part of the steps of a third of the limit that is seen, of axes that scatter as much as any does for
        which that is wanted; every fourth axis steps.
    promised
        Part of the steps that is seen that are as large as the smallest one printed for the axis.
    """

    alarms: Share
    seen: Share
    promised: Share


def night(name: str, before: int, fleets: int, axes: int, seed: int) -> Night:
    """Return what is named in fleets that scatter in one way, after so many tests and one."""
    rng = random.Random(seed)
    named: list[float] = []
    seen: list[float] = []
    promised: list[float] = []
    for _ in range(fleets):
        scatters = [SCATTERS[name](rng) for _ in range(axes)]
        values = histories(rng, scatters, before + 1)
        calm = judge_trends(series(axis, each) for axis, each in enumerate(values))
        named.append(sum(map(is_alarm, calm)))
        most = max(each for each in scatters if each <= _SCATTER_AT_MOST)
        printed = judge_trends(series(axis, each[:-1]) for axis, each in enumerate(values))
        third = _stepped(values, [_THIRD] * axes)
        seen += [
            third[axis] for axis in range(0, axes, _STEPPING) if _NEARLY * most <= scatters[axis] <= most
        ]
        smallest = _stepped(values, [(each.smallest or math.inf) / LIMIT for each in printed])
        promised += [smallest[axis] for axis in range(0, axes, _STEPPING)]
    return Night(Share.of(named), Share.of(seen), Share.of(promised))


#: Of the table of nights: what is said of each.
_NIGHTS = (
    "Scatter between tests",
    "Tests before",
    "False alarms a night",
    "Steps of 1/3 seen at once",
    "Steps as large as is printed seen at once",
)


def _nights(fleets: int, seed: int) -> Iterator[tuple[str, ...]]:
    """Yield each night as soon as it is simulated: that takes long, and may be stopped."""
    for name, before in itertools.product(SCATTERS, BEFORE):
        found = night(name, before, fleets, 300, seed + before)
        yield name, str(before), str(found.alarms), found.seen.percent(), found.promised.percent()


def _stepped(values: Sequence[Sequence[float]], steps: Sequence[float]) -> list[bool]:
    """Return which axes are named for a step where every fourth steps with its latest test."""
    changed = [
        [*each[:-1], each[-1] + (0.0 if axis % _STEPPING else step)]
        for axis, (each, step) in enumerate(zip(values, steps, strict=True))
    ]
    return [
        each.step is not None
        for each in judge_trends(series(axis, each) for axis, each in enumerate(changed))
    ]


@dataclass(slots=True)
class Unchanged:
    """How often an axis that does not change is named in a year."""

    steps: float
    drifts: float


def unchanged(scatter: float, fleets: int, axes: int, seed: int) -> Unchanged:
    """Return it for fleets that are judged after each test, five years long."""
    rng = random.Random(seed)
    steps: set[tuple[int, int, int]] = set()
    drifts: set[tuple[int, int]] = set()
    for fleet in range(fleets):
        for test, found in nights(histories(rng, [scatter] * axes, YEARS * A_YEAR)):
            steps |= {(fleet, axis, test) for axis, each in enumerate(found) if each.step}
            drifts |= {(fleet, axis) for axis, each in enumerate(found) if each.drifts}
    years = fleets * axes * YEARS
    return Unchanged(len(steps) / years, len(drifts) / years)


def seen(step: float, scatter: float, fleets: int, axes: int, seed: int) -> tuple[float, float]:
    """Return which part of the steps is seen at once, and within a year; one axis in ten steps."""
    rng = random.Random(seed)
    at_once = within = 0
    stepping = axes // 10
    for _ in range(fleets):
        values = histories(rng, [scatter] * (axes - stepping), CHANGED_AT + A_YEAR)
        values += histories(
            rng, [scatter] * stepping, CHANGED_AT + A_YEAR, lambda test: step if test >= CHANGED_AT else 0.0
        )
        named: list[set[int]] = []
        for test, found in nights(values):
            if test >= CHANGED_AT:
                named.append({axis for axis in range(axes - stepping, axes) if is_alarm(found[axis])})
        at_once += len(named[0])
        within += len(set().union(*named))
    return at_once / (fleets * stepping), within / (fleets * stepping)


def quarters_to_name(drift: float, scatter: float, fleets: int, axes: int, seed: int) -> float:
    """Return after how many tests half of the drifts are named; one axis in ten drifts."""
    rng = random.Random(seed)
    drifting = axes // 10
    needed: list[float] = []
    for _ in range(fleets):
        values = histories(rng, [scatter] * (axes - drifting), YEARS * A_YEAR)
        values += histories(rng, [scatter] * drifting, YEARS * A_YEAR, lambda test: drift * test)
        first = dict.fromkeys(range(axes - drifting, axes), math.inf)
        for test, found in nights(values):
            for axis in first:
                if found[axis].drifts:
                    first[axis] = min(first[axis], test + 1)
        needed += first.values()
    return statistics.median(needed)


def found(drift: float, tests: int, fleets: int, seed: int) -> float:
    """Return how often one drifting parameter is named among all of a fleet, by its drift in scatters."""
    rng = random.Random(seed)
    named = 0
    for _ in range(fleets):
        fleet = [
            series(axis, each, f"P{symbol}", limited=False)
            for axis in range(_AXES)
            for symbol, each in enumerate(histories(rng, [0.02] * _PARAMETERS, tests))
        ]
        drifting = histories(rng, [0.02], tests, lambda test: 0.02 * drift * test)[0]
        fleet[1] = series(0, drifting, "P1", limited=False)
        named += judge_trends(fleet)[1].drifts
    return named / fleets


def _percent(part: float) -> str:
    return f"{100 * part:.0f} %"


def _rows(fleets: int, axes: int, seed: int) -> Iterator[tuple[str, ...]]:
    scatters = (1 / 15, 1 / 30)
    calm = [unchanged(each, fleets, axes, seed) for each in scatters]
    yield "False steps named in a year of an axis", *(f"{each.steps:.3f}" for each in calm)
    yield "False drifts named in a year of an axis", *(f"{each.drifts:.3f}" for each in calm)
    for step in (5, 3):
        parts = [seen(1 / step, each, fleets, axes, seed) for each in scatters]
        yield (
            f"A step of 1/{step} is seen at once; within a year",
            *(f"{_percent(at_once)}; {_percent(within)}" for at_once, within in parts),
        )
    for drift in (60, 30, 15):
        needed = [quarters_to_name(1 / drift, each, fleets, axes, seed) for each in scatters]
        yield f"A drift of 1/{drift} a quarter is named after", *(f"{each:.0f} quarters" for each in needed)


def _print(head: Sequence[str], rows: Iterable[Iterable[str]]) -> None:
    """Print a table, each row as it comes."""
    print(f"| {' | '.join(head)} |\n|{'---|' * len(head)}", flush=True)
    for row in rows:
        print(f"| {' | '.join(row)} |", flush=True)
    print(flush=True)


def main(words: Sequence[str]) -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(prog="./run benchmark trends", description=__doc__)
    parser.add_argument("--fleets", type=int, default=20, help="simulated for each number")
    parser.add_argument("--seed", type=int, default=20261120)
    options = parser.parse_args(words)
    _print(("", "Scatter 1/15", "Scatter 1/30"), _rows(max(1, options.fleets // 4), 100, options.seed))
    drifts = (0.5, 1, 2, 4)
    rows = (
        (str(tests), *(_percent(found(each, tests, 2 * options.fleets, options.seed)) for each in drifts))
        for tests in (5, 6, 8, 12)
    )
    _print(("Calibrations", *(f"{each:g} s each" for each in drifts)), rows)
    _print(_NIGHTS, _nights(2 * options.fleets, options.seed))
