"""The entries of a log: ``KEY=VALUE``, keys in any order."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeAlias

from zlmreport.plugin import Place, Problem, TextFile, did_you_mean, quoted

UNIT, CYCLES, POSITIONS = "UNIT", "CYCLES", "POSITIONS"
TARGET, FORWARD, BACKWARD = "TGT_DATA", "REF_DATA_FWD", "REF_DATA_BWD"
#: Names of signals, and the decimals of a printed report: nothing of the readings.
_NOT_READ = ("REF_PV", "TEST_PV", "TGT_SET_PV", "DEC")
_KNOWN = (UNIT, CYCLES, POSITIONS, TARGET, FORWARD, BACKWARD, *_NOT_READ)
_INDICES = {
    TARGET: ("position",),
    FORWARD: ("position", "cycle"),
    BACKWARD: ("position", "cycle"),
}

_KEY = re.compile(r"([^\[\]]*)(?:\[([^\[\]]*)\])?")
_INDEX = re.compile(r"[0-9]{1,6}")

#: A key with its indices.
Key: TypeAlias = tuple[str, tuple[int, ...]]


@dataclass(frozen=True, slots=True)
class Entry:
    """What stands behind a key, and where."""

    place: Place
    value: str


def entries(text: TextFile, problems: list[Problem]) -> Mapping[Key, Entry]:
    """Return the entries of a log that are read; what is wrong with a line is added to the problems."""
    found: dict[Key, Entry] = {}
    for number, line in enumerate(text.lines, 1):
        content = line.partition("#")[0]
        if not content.strip() or (number == 1 and _is_glued(line)):
            continue
        begin = text.place(number, len(line) - len(line.lstrip()) + 1)
        name, equals, value = content.partition("=")
        try:
            key = _key(name.strip(), stands_alone=not equals)
        except ValueError as error:
            problems.append(Problem(begin, str(error)))
            continue
        if key in found:
            first = found[key].place.line
            problems.append(
                Problem(begin, f"{written(key)} stands in line {first} already; keep one of them")
            )
        elif key[0] not in _NOT_READ:
            column = len(name) + 1 + len(value) - len(value.lstrip()) + 1
            found[key] = Entry(text.place(number, column), value.strip())
    return found


def written(key: Key) -> str:
    """Return a key as logs write it.

    >>> written((FORWARD, (3, 1)))
    'REF_DATA_FWD[3,1]'
    """
    name, indices = key
    return f"{name}[{','.join(map(str, indices))}]" if indices else name


def is_count(value: str) -> bool:
    """Whether a value is a number of things."""
    return _INDEX.fullmatch(value) is not None and int(value) > 0


def _is_glued(line: str) -> bool:
    """Whether a line is a comment to whose front another text is glued, as happens to the first one."""
    before, equals, after = line.partition("=")
    return bool(equals) and after.lstrip().startswith("#") and before.strip() not in _KNOWN


def _key(text: str, *, stands_alone: bool) -> Key:
    if stands_alone:
        raise ValueError(f"{quoted(text)} is not of the form KEY=VALUE")
    match = _KEY.fullmatch(text)
    name, indices = (match[1].rstrip(), match[2]) if match else (text, None)
    if name not in _KNOWN:
        raise ValueError(f"{quoted(name)} is no key of a log; {did_you_mean(name[:40], _KNOWN)}")
    if name in _NOT_READ:
        return name, ()
    expected = _INDICES.get(name, ())
    found = [index.strip() for index in indices.split(",")] if indices is not None else []
    if len(found) != len(expected) or not all(map(is_count, found)):
        form = f"{name}[{','.join(expected)}], counted from 1" if expected else name
        raise ValueError(f"{quoted(text)} is not of the form {form}")
    return name, tuple(map(int, found))
