"""The runs of a test: deviations by target number, direction by the progression of the targets."""

from __future__ import annotations

import itertools
import math
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from zlmreport.plugin import Approach, Place, Problem, parse_number, quoted
from zlmreport_plugins.sources.renishaw_rtl.sections import Line, Section

_NUMBER = re.compile(r"[0-9]{1,9}")
_TITLE = re.compile(r"run\s+target\s+data\s*:?", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Deviation:
    """A deviation line.

    Attributes
    ----------
    place
        Of the deviation.
    run
        Number of the single-direction run.
    target
        Number of the target.
    value
        The deviation, in the file's unit; NaN where it is none, which is a problem noted.
    """

    place: Place
    run: int
    target: int
    value: float


@dataclass(frozen=True, slots=True)
class Pass:
    """A run in one direction.

    Attributes
    ----------
    approach
        Its direction.
    cycle
        Its number among the runs of that direction, from 1.
    deviations
        By the number of the target.
    """

    approach: Approach
    cycle: int
    deviations: Mapping[int, Sequence[Deviation]]

    @property
    def place(self) -> Place:
        """Where the run begins."""
        return next(iter(self.deviations.values()))[0].place


def deviations(section: Section, targets: Sequence[float], problems: list[Problem]) -> list[Deviation]:
    """Return the deviation lines of a section; what is wrong with a line is added to the problems."""
    found = (
        _deviation(line, len(targets), problems)
        for line in section.lines
        if not _TITLE.fullmatch(line.text.strip())
    )
    return [deviation for deviation in found if deviation is not None]


def passes(found: Sequence[Deviation], targets: Sequence[float], problems: list[Problem]) -> Iterator[Pass]:
    """Yield the runs in the order of their numbers; what is wrong with a run is added to the problems.

    A run's direction is the sign of its progression from target to target; its cycle, the number of runs
    in that direction so far.
    """
    by_run: Mapping[int, list[Deviation]] = defaultdict(list)
    for deviation in found:
        by_run[deviation.run].append(deviation)
    cycles = dict.fromkeys(Approach, 0)
    for run, of_run in sorted(by_run.items()):
        steps = _steps([targets[deviation.target - 1] for deviation in of_run])
        wrong = _wrong_with(run, of_run, steps)
        if wrong:
            problems.append(Problem(of_run[0].place, wrong))
            continue
        approach = Approach(steps.pop())
        cycles[approach] += 1
        by_target: dict[int, list[Deviation]] = defaultdict(list)
        for deviation in of_run:
            by_target[deviation.target].append(deviation)
        yield Pass(approach, cycles[approach], by_target)


def _deviation(line: Line, targets: int, problems: list[Problem]) -> Deviation | None:
    words = line.words()
    if len(words) != 3:
        shown = quoted(line.text.strip())
        message = f"{shown} is no deviation line, which has a run, a target and a deviation"
        problems.append(Problem(line.place, message))
        return None
    numbers = []
    for (place, word), what in zip(words, ("run", "target"), strict=False):
        if not _NUMBER.fullmatch(word) or int(word) == 0:
            problems.append(Problem(place, f"{quoted(word)} is no number of a {what}; they count from 1"))
            return None
        numbers.append(int(word))
    run, target = numbers
    if target > targets:
        message = f"there is no target {target}; the file lists {targets} targets"
        problems.append(Problem(words[1][0], message))
        return None
    place, word = words[2]
    try:
        value = parse_number(word)
    except ValueError as error:
        problems.append(Problem(place, f"deviation: {error}"))
        value = math.nan
    return Deviation(place, run, target, value)


def _steps(positions: Sequence[float]) -> set[int]:
    """Return the signs of the steps from target to target; a target that is repeated is no step."""
    pairs = itertools.pairwise(positions)
    return {1 if after > before else -1 for before, after in pairs if after != before}


def _wrong_with(run: int, of_run: Sequence[Deviation], steps: set[int]) -> str | None:
    if len(of_run) > 1 and not any(deviation.value for deviation in of_run):
        return (
            f"run {run}: all {len(of_run)} deviations are exactly zero; some programs pad the reverse runs "
            "that a unidirectional test does not have. Remove the lines of this run, and correct 'Run-count'"
        )
    if not steps:
        return f"run {run} has readings at one target only; its direction cannot be told"
    if len(steps) > 1:
        return (
            f"run {run} goes from target to target in both directions; a run goes in one, and which of them "
            "cannot be told"
        )
    return None
