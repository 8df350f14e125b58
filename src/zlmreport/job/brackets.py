"""Members of a list in brackets, or of keys in braces: one more, or one less, and nothing else changed."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from zlmreport.job.extents import Extent, Form, Written

_SPACES = re.compile(r" +")
_LINE_BREAK = re.compile(r"[\r\n]")
_COMMENT = re.compile(r"\A[ \t]*+(#[^\r\n]*+)?")
_COMMA = re.compile(r"(?:\s|#[^\r\n]*+)*+(,)")


class Member(NamedTuple):
    """Where a member begins and ends: an item, or a key with its value."""

    start: int
    end: int


def members(parts: Sequence[Extent], step: int = 1) -> tuple[Member, ...]:
    """Return where members begin and end: items, or (in steps of 2) pairs of key and value."""
    return tuple(
        Member(first.start, last.end)
        for first, last in zip(parts[::step], parts[step - 1 :: step], strict=True)
    )


def with_member(written: Written, outer: Extent, listed: Sequence[Member], piece: str) -> str:
    """Return the text with a member more in the brackets or braces of `outer`."""
    text, closing = written.text, outer.end - 1
    if not listed:
        opening = text.index("[" if outer.form is Form.BRACKETS else "{", outer.start)
        inner = text[opening + 1 : closing]
        return inserted(text, closing, piece + (inner if _SPACES.fullmatch(inner) else ""))
    start, end = listed[-1]
    before = listed[-2].end if len(listed) > 1 else outer.start
    if not _LINE_BREAK.search(text, before, start):
        return inserted(text, end, f", {piece}")
    comma = _comma_after(text, end, closing)
    line_end = written.line_end(end if comma is None else comma)
    own_line = written.break_at(line_end) + " " * written.column(start) + piece
    if line_end > closing:  # the bracket closes in the line of the last member
        return inserted(text, end, f",{own_line}")
    if comma is None:
        return inserted(inserted(text, line_end, own_line), end, ",")
    return inserted(text, line_end, f"{own_line},")


def without_member(written: Written, outer: Extent, listed: Sequence[Member], index: int) -> str:
    """Return the text without one of the members in the brackets or braces of `outer`.

    A comment in the line of a member goes with it, if that line holds nothing else.
    """
    text, closing = written.text, outer.end - 1
    start, stop = listed[index]
    comma = _comma_after(text, stop, closing)
    end = stop if comma is None else comma + 1
    is_last = index + 1 == len(listed)
    rest = text[end:closing]
    behind = end + len(rest) - len(_COMMENT.sub("", rest, count=1))
    if _LINE_BREAK.match(text, behind, closing):
        line = written.line_start(start)
        if not text[line:start].strip():
            shortened = _without(text, line, behind + len(written.break_at(behind)))
            before = _comma_after(text, listed[index - 1].end, start) if is_last and index else None
            return (
                shortened if comma is not None or before is None else _without(shortened, before, before + 1)
            )
        end = behind
    if not is_last:
        rest = text[end : listed[index + 1].start]
        return _without(text, start, end + len(rest) - len(rest.lstrip(" \t")))
    if index == 0:
        return _without(text, start, closing if _SPACES.fullmatch(text, end, closing) else end)
    before_it = listed[index - 1].end
    return _without(text, start, end) if "#" in text[before_it:start] else _without(text, before_it, stop)


def _without(text: str, start: int, end: int) -> str:
    return text[:start] + text[end:]


def _comma_after(text: str, start: int, end: int) -> int | None:
    """Return where a comma stands among blanks and comments; None if none does."""
    found = _COMMA.match(text, start, end)
    return found.start(1) if found else None


def inserted(text: str, index: int, piece: str) -> str:
    """Return a text with a piece more."""
    return text[:index] + piece + text[index:]
