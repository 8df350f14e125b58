"""The target positions of a test."""

from __future__ import annotations

import re

from zlmreport.plugin import InputError, Problem, parse_number
from zlmreport_plugins.sources.renishaw_rtl.sections import Line, Section, as_entry

_COUNT = re.compile(r"[0-9]{1,9}")


def target_positions(section: Section) -> tuple[float, ...]:
    """Return the target positions in the order of their numbers, as the file gives them (mm or degrees).

    They begin behind ``Targets :`` and wrap; the next key ends them.

    Raises
    ------
    InputError
        If there are none, if one is no number, or if their number is not the one that the file states.
    """
    lines = iter(section.lines)
    begin = next((line for line in lines if (entry := as_entry(line)) and entry.key == "targets"), None)
    if begin is None:
        raise InputError.at(section.head.place, "this section has no key 'Targets :', so no target positions")
    colon = begin.text.index(":") + 1
    words = [(place, word) for place, word in begin.words() if place.column > colon]
    for line in lines:
        if ":" in line.text:
            break
        words.extend(line.words())
    positions: list[float] = []
    problems: list[Problem] = []
    for place, word in words:
        try:
            positions.append(parse_number(word))
        except ValueError as error:
            problems.append(Problem(place, f"target position: {error}"))
    if not problems:
        problems.extend(_miscounted(section, begin, len(positions)))
    if problems:
        raise InputError(problems)
    return tuple(positions)


def stated_count(section: Section, key: str) -> tuple[int, Line] | None:
    """Return a number of things that a section states, and where; None if it states none.

    Raises
    ------
    InputError
        If what it states is no number.
    """
    entry = section.value(key)
    if entry is None or not entry.value:
        return None
    if not _COUNT.fullmatch(entry.value):
        raise InputError.at(entry.line.place, f"{entry.name} is {entry.value[:40]!r}; a number belongs there")
    return int(entry.value), entry.line


def _miscounted(section: Section, begin: Line, found: int) -> list[Problem]:
    stated = stated_count(section, "targetcount")
    if stated and stated[0] != found:
        message = f"the file announces {stated[0]} targets and lists {found}; was it cut off?"
        return [Problem(stated[1].place, message)]
    if not found:
        return [Problem(begin.place, "no target positions follow")]
    return []
