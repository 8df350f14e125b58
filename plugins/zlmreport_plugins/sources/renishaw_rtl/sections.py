"""The sections of a file, and the keys in a section."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from zlmreport.plugin import InputError, Place, Problem, TextFile, did_you_mean, quoted

_HEAD = re.compile(r"([A-Z][A-Z0-9 -]*)::")


@dataclass(frozen=True, slots=True)
class Line:
    """A line of a file.

    Attributes
    ----------
    place
        Of its first character.
    text
        The line.
    """

    place: Place
    text: str

    def at(self, column: int) -> Place:
        """Return the place of a character, counted from 0."""
        return Place(self.place.file, self.place.line, column + 1)

    def words(self) -> list[tuple[Place, str]]:
        """Return what blanks part, each with its place."""
        return [(self.at(match.start()), match[0]) for match in re.finditer(r"\S+", self.text)]


@dataclass(frozen=True, slots=True)
class Entry:
    """A key of a section with what stands behind it.

    Attributes
    ----------
    name
        As the file writes it.
    key
        The name without case, blanks and hyphens.
    value
        The rest of the line.
    line
        The line.
    """

    name: str
    key: str
    value: str
    line: Line


@dataclass(frozen=True, slots=True)
class Section:
    """A section: its head, and its lines that are not blank."""

    head: Line
    lines: tuple[Line, ...]

    def entries(self) -> Iterator[Entry]:
        """Yield the lines of the form ``key : value``."""
        for line in self.lines:
            entry = as_entry(line)
            if entry:
                yield entry

    def value(self, key: str) -> Entry | None:
        """Return the entry of a key, written so; None if there is none."""
        return next((entry for entry in self.entries() if entry.key == key), None)


def as_entry(line: Line) -> Entry | None:
    """Return a line of the form ``key : value`` taken apart; None if it is of another form."""
    name, colon, value = line.text.partition(":")
    if not colon:
        return None
    return Entry(name.strip(), re.sub(r"[\s-]+", "", name).casefold(), value.strip(), line)


def sections(text: TextFile, demanded: tuple[str, ...]) -> Mapping[str, Section]:
    """Return the sections of a file by the words of their heads.

    Raises
    ------
    InputError
        If it has no sections, a section twice, or lacks one that is demanded.
    """
    heads: dict[str, Line] = {}
    lines: dict[str, list[Line]] = {}
    name = None
    for number, content in enumerate(text.lines, 1):
        line = Line(text.place(number, 1), content)
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
    return {name: Section(head, tuple(lines[name])) for name, head in heads.items()}
