"""The parts of a ``.rtl`` or ``.rta`` file: sections, keys, target positions, runs."""

from __future__ import annotations

import itertools
import math
import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from zlmreport.plugin import Approach, InputError, Place, Problem, counted, did_you_mean, quoted
from zlmreport.plugin.source import TextFile, cap_problems, parse_number

_HEAD = re.compile(r"([A-Z][A-Z0-9 -]*)::")


@dataclass(frozen=True, slots=True)
class RtlLine:
    """A line of a file."""

    place: Place  #: Of its first character.
    text: str  #: The line.

    def place_character(self, column: int) -> Place:
        """Return the place of a character, counted from 0."""
        return Place(self.place.file, self.place.line, column + 1)

    def split_words(self) -> list[tuple[Place, str]]:
        """Return what blanks part, each with its place."""
        return [(self.place_character(match.start()), match[0]) for match in re.finditer(r"\S+", self.text)]


@dataclass(frozen=True, slots=True)
class RtlEntry:
    """A key of a section with what stands behind it."""

    name: str  #: As the file writes it.
    key: str  #: The name without case, blanks and hyphens.
    value: str  #: The rest of the line.
    line: RtlLine


@dataclass(frozen=True, slots=True)
class RtlSection:
    """A section: its head, and its lines that are not blank."""

    head: RtlLine
    lines: tuple[RtlLine, ...]

    def list_entries(self) -> Iterator[RtlEntry]:
        """Yield the lines of the form ``key : value``."""
        for line in self.lines:
            entry = _read_as_entry(line)
            if entry:
                yield entry

    def find_entry(self, key: str) -> RtlEntry | None:
        """Return the entry of a key, written so; None if there is none."""
        return next((entry for entry in self.list_entries() if entry.key == key), None)


def _read_as_entry(line: RtlLine) -> RtlEntry | None:
    """Return a line of the form ``key : value`` taken apart; None if it is of another form."""
    name, colon, value = line.text.partition(":")
    if not colon:
        return None
    return RtlEntry(name.strip(), re.sub(r"[\s-]+", "", name).casefold(), value.strip(), line)


def split_sections(text: TextFile, demanded: tuple[str, ...]) -> Mapping[str, RtlSection]:
    """Return the sections of a file by the words of their heads.

    Raises `InputError` if it has no sections, a section twice, or lacks one that is demanded.
    """
    heads: dict[str, RtlLine] = {}
    lines: dict[str, list[RtlLine]] = {}
    name = None
    for number, content in enumerate(text.lines, 1):
        line = RtlLine(text.place(number, 1), content)
        head = _HEAD.fullmatch(content.strip())
        if head:
            name = head[1].strip()
            if name in heads:
                first = heads[name].place.line
                raise InputError.at(line.place, f"the section {name}:: begins in line {first} already")
            heads[name], lines[name] = line, []
        elif name is not None and content.strip():
            lines[name].append(line)
        elif content.strip():
            raise InputError.at(
                line.place,
                f"{quoted(content.strip())} stands before the first section; a test file begins 'HEADER::'",
            )
    missing = [section for section in demanded if section not in heads]
    if missing:
        raise InputError(
            Problem(text.place(), f"has no section {section}::; {did_you_mean(section, sorted(heads))}")
            for section in missing
        )
    return {name: RtlSection(head, tuple(lines[name])) for name, head in heads.items()}


_COUNT = re.compile(r"[0-9]{1,9}")


def read_target_positions(section: RtlSection) -> tuple[float, ...]:
    """Return the target positions in the order of their numbers, as the file gives them (mm or degrees).

    They begin behind ``Targets :`` and wrap; the next key ends them.

    Raises `InputError` if there are none, if one is no number, or if their number is not the one that the
    file states.
    """
    lines = iter(section.lines)
    begin = next((line for line in lines if (entry := _read_as_entry(line)) and entry.key == "targets"), None)
    if begin is None:
        raise InputError.at(section.head.place, "this section has no key 'Targets :', so no target positions")
    colon = begin.text.index(":") + 1
    words = [(place, word) for place, word in begin.split_words() if place.column > colon]
    for line in lines:
        if ":" in line.text:
            break
        words.extend(line.split_words())
    positions: list[float] = []
    problems: list[Problem] = []
    for place, word in words:
        try:
            positions.append(parse_number(word))
        except ValueError as error:
            problems.append(Problem(place, f"target position: {error}"))
    if not problems:
        problems.extend(_find_miscounted(section, begin, len(positions)))
    if problems:
        raise InputError(cap_problems(problems))
    return tuple(positions)


def read_stated_count(section: RtlSection, key: str) -> tuple[int, RtlLine] | None:
    """Return a number of things that a section states, and where; None if it states none.

    Raises `InputError` if what it states is no number.
    """
    entry = section.find_entry(key)
    if entry is None or not entry.value:
        return None
    if not _COUNT.fullmatch(entry.value):
        raise InputError.at(entry.line.place, f"{entry.name} is {entry.value[:40]!r}; a number belongs there")
    return int(entry.value), entry.line


def _find_miscounted(section: RtlSection, begin: RtlLine, found: int) -> list[Problem]:
    stated = read_stated_count(section, "targetcount")
    if stated and stated[0] != found:
        message = f"the file announces {counted(stated[0], 'target')} and lists {found}; was it cut off?"
        return [Problem(stated[1].place, message)]
    if not found:
        return [Problem(begin.place, "no target positions follow")]
    return []


_NUMBER = re.compile(r"[0-9]{1,9}")
_TITLE = re.compile(r"run\s+target\s+data\s*:?", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Deviation:
    """A deviation line."""

    place: Place  #: Of the deviation.
    run: int  #: Number of the single-direction run.
    target: int  #: Number of the target.
    value: float  #: The deviation, in the file's unit; NaN where it is none, which is a problem noted.


@dataclass(frozen=True, slots=True)
class Pass:
    """A run in one direction."""

    approach: Approach  #: Its direction.
    cycle: int  #: Its number among the runs of that direction, from 1.
    deviations: Mapping[int, Sequence[Deviation]]  #: By the number of the target.

    @property
    def place(self) -> Place:
        """Where the run begins."""
        return next(iter(self.deviations.values()))[0].place


def read_deviations(
    section: RtlSection, targets: Sequence[float], problems: list[Problem]
) -> list[Deviation]:
    """Return the deviation lines of a section; what is wrong with a line is added to the problems."""
    found = (
        _read_deviation(line, len(targets), problems)
        for line in section.lines
        if not _TITLE.fullmatch(line.text.strip())
    )
    return [deviation for deviation in found if deviation is not None]


def list_passes(
    found: Sequence[Deviation], targets: Sequence[float], problems: list[Problem]
) -> Iterator[Pass]:
    """Yield the runs in the order of their numbers; what is wrong with a run is added to the problems.

    A run's direction is the sign of its progression from target to target; its cycle, the number of runs
    in that direction so far.
    """
    by_run: Mapping[int, list[Deviation]] = defaultdict(list)
    for deviation in found:
        by_run[deviation.run].append(deviation)
    cycles = dict.fromkeys(Approach, 0)
    for run, of_run in sorted(by_run.items()):
        steps = _find_steps([targets[deviation.target - 1] for deviation in of_run])
        wrong = _say_wrong_with(run, of_run, steps)
        if wrong:
            problems.append(Problem(of_run[0].place, wrong))
            continue
        approach = Approach(steps.pop())
        cycles[approach] += 1
        by_target: dict[int, list[Deviation]] = defaultdict(list)
        for deviation in of_run:
            by_target[deviation.target].append(deviation)
        yield Pass(approach, cycles[approach], by_target)


def _read_deviation(line: RtlLine, targets: int, problems: list[Problem]) -> Deviation | None:
    words = line.split_words()
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
        message = f"there is no target {target}; the file lists {counted(targets, 'target')}"
        problems.append(Problem(words[1][0], message))
        return None
    place, word = words[2]
    try:
        value = parse_number(word)
    except ValueError as error:
        problems.append(Problem(place, f"deviation: {error}"))
        value = math.nan
    return Deviation(place, run, target, value)


def _find_steps(positions: Sequence[float]) -> set[int]:
    """Return the signs of the steps from target to target; a target that is repeated is no step."""
    pairs = itertools.pairwise(positions)
    return {1 if after > before else -1 for before, after in pairs if after != before}


def _say_wrong_with(run: int, of_run: Sequence[Deviation], steps: set[int]) -> str | None:
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
