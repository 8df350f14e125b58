"""Where each value of a YAML file begins and ends in its text, for changes in place.

A tree of values says what a file means; this says how it is written, so that one value can be changed while
everything around it stays as its writer left it.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any

import yaml


class ValueForm(Enum):
    """How a value is written."""

    SCALAR = "scalar"
    ALIAS = "alias"
    LINES = "list, an item a line"
    BRACKETS = "list in brackets"
    INDENTED = "keys, one a line"
    BRACES = "keys in braces"


@dataclass(frozen=True, slots=True)
class WrittenValue:
    """A value as it is written."""

    form: ValueForm  #: How.
    #: start and end: Its first character, and the one after its last; comments and blanks behind it do not
    #: belong to it.
    start: int
    end: int
    parts: tuple[WrittenValue, ...] = ()  #: Of a list its items, of keys each key and its value in turn.
    text: str = ""  #: Of a single value, quotes resolved.

    def find_entry(self, name: str) -> tuple[WrittenValue, WrittenValue] | None:
        """Return a key and its value, if these are keys and it is among them."""
        if self.form not in {ValueForm.INDENTED, ValueForm.BRACES}:
            return None
        for key, value in zip(self.parts[::2], self.parts[1::2], strict=True):
            if key.text == name:
                return key, value
        return None


@dataclass(frozen=True, slots=True)
class Written:
    """A file's text, and where in it everything stands."""

    text: str  #: Of the file, without a byte order mark.
    root: WrittenValue  #: Its value.
    _dashes: tuple[int, ...]
    _colons: tuple[int, ...]

    @classmethod
    def of(cls, text: str) -> Written:
        """Return a text that has been read as YAML before, with the places of its values."""
        dashes, colons = [], []
        for token in yaml.scan(text, Loader=yaml.SafeLoader):
            if isinstance(token, yaml.BlockEntryToken):
                dashes.append(_find_index(token.start_mark))
            elif isinstance(token, yaml.ValueToken):
                colons.append(_find_index(token.start_mark))
        events = yaml.parse(text, Loader=yaml.SafeLoader)
        starts = (yaml.StreamStartEvent, yaml.DocumentStartEvent)
        first = next(event for event in events if not isinstance(event, starts))
        return cls(text, _find_extent(first, events, text), tuple(dashes), tuple(colons))

    def find_dash_of(self, item: WrittenValue) -> int:
        """Return where the dash of an item stands."""
        return self._dashes[bisect_right(self._dashes, item.start) - 1]

    def find_after_colon_of(self, key: WrittenValue) -> int:
        """Return the character after the colon of a key."""
        return self._colons[bisect_left(self._colons, key.end)] + 1

    def line_start(self, index: int) -> int:
        """Return where the line of a character begins."""
        return max(self.text.rfind("\n", 0, index), self.text.rfind("\r", 0, index)) + 1

    def line_end(self, index: int) -> int:
        """Return where the line of a character ends, before its line break."""
        ends = [end for mark in "\r\n" if (end := self.text.find(mark, index)) >= 0]
        return min(ends, default=len(self.text))

    def break_at(self, index: int) -> str:
        """Return the line break that stands at an index; the first of the file where none does."""
        for mark in ("\r\n", "\n", "\r"):
            if self.text.startswith(mark, index):
                return mark
        first = self.line_end(0)
        return self.break_at(first) if 0 < first < len(self.text) else "\n"

    def find_break_before(self, index: int) -> int:
        """Return where the line break begins that ends before an index; the index if none does."""
        before = self.text[:index]
        for mark in ("\r\n", "\n", "\r"):
            if before.endswith(mark):
                return index - len(mark)
        return index

    def find_column(self, index: int) -> int:
        """Return the column of a character, from 0."""
        return index - self.line_start(index)


def _find_index(mark: Any) -> int:
    """Return the index of a parser's mark, which its types allow to be missing."""
    return int(mark.index)


def _find_extent(event: Any, events: Iterator[Any], text: str) -> WrittenValue:
    start = _find_index(event.start_mark)
    if isinstance(event, yaml.AliasEvent):
        return WrittenValue(ValueForm.ALIAS, start, _find_index(event.end_mark))
    if isinstance(event, yaml.ScalarEvent):
        end = _find_index(event.end_mark)
        if event.style in {"|", ">"}:  # the mark stands where the next value begins
            end = start + len(text[start:end].rstrip())
        return WrittenValue(ValueForm.SCALAR, start, end, text=event.value)
    is_list = isinstance(event, yaml.SequenceStartEvent)
    parts = []
    while not isinstance(after := next(events), yaml.SequenceEndEvent | yaml.MappingEndEvent):
        parts.append(_find_extent(after, events, text))
    if event.flow_style:
        # A single pair stands in the brackets of a list without braces of its own.
        has_braces = (
            text.startswith(("[", "{"), _find_index(event.end_mark) - 1)
            and _find_index(event.end_mark) > start
        )
        end = _find_index(after.end_mark) if has_braces else _end(parts, start)
        return WrittenValue(ValueForm.BRACKETS if is_list else ValueForm.BRACES, start, end, tuple(parts))
    return WrittenValue(
        ValueForm.LINES if is_list else ValueForm.INDENTED, start, _end(parts, start), tuple(parts)
    )


def _end(parts: Sequence[WrittenValue], start: int) -> int:
    return max((part.end for part in parts), default=start)
