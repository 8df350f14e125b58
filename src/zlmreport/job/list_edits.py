"""Writes into a list of a YAML text: an item more, less or changed, or a new list.

Nothing else of the text changes: comments, order, quotes, indentation and line ends stay as they are. What
is added follows its neighbours: a line of its own where they have one, in brackets where they stand in
brackets, in quotes where they are quoted.

No library does this. ruamel.yaml (0.19) writes all 169 YAML files of this repository back as they were, if
it is told their indents, but not what people type: it loses comments in a list in brackets over several
lines (``[offset,  # zero``) and joins the lines, moves values out of their columns, drops carriage returns,
blanks at line ends, the line ``...``, blanks within brackets and last commas, and knows one indent a file. Of
300 generated layouts (``tests/job/layouts.py``) none came back whole.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from zlmreport.job.extents import ValueForm, Written, WrittenValue
from zlmreport.job.tree import Node
from zlmreport.job.yaml_text import quote_text, write_as_text

_SPACES = re.compile(r" +")
_LINE_BREAK = re.compile(r"[\r\n]")
_COMMENT = re.compile(r"\A[ \t]*+(#[^\r\n]*+)?")
_COMMA = re.compile(r"(?:\s|#[^\r\n]*+)*+(,)")


class ListMember(NamedTuple):
    """Where a member begins and ends: an item, or a key with its value."""

    start: int
    end: int


def find_members(parts: Sequence[WrittenValue], step: int = 1) -> tuple[ListMember, ...]:
    """Return where members begin and end: items, or (in steps of 2) pairs of key and value."""
    return tuple(
        ListMember(first.start, last.end)
        for first, last in zip(parts[::step], parts[step - 1 :: step], strict=True)
    )


def add_member(written: Written, outer: WrittenValue, listed: Sequence[ListMember], piece: str) -> str:
    """Return the text with a member more in the brackets or braces of `outer`."""
    text, closing = written.text, outer.end - 1
    if not listed:
        opening = text.index("[" if outer.form is ValueForm.BRACKETS else "{", outer.start)
        inner = text[opening + 1 : closing]
        return insert(text, closing, piece + (inner if _SPACES.fullmatch(inner) else ""))
    start, end = listed[-1]
    before = listed[-2].end if len(listed) > 1 else outer.start
    if not _LINE_BREAK.search(text, before, start):
        return insert(text, end, f", {piece}")
    comma = _find_comma_after(text, end, closing)
    line_end = written.line_end(end if comma is None else comma)
    own_line = written.break_at(line_end) + " " * written.find_column(start) + piece
    if line_end > closing:  # the bracket closes in the line of the last member
        return insert(text, end, f",{own_line}")
    if comma is None:
        return insert(insert(text, line_end, own_line), end, ",")
    return insert(text, line_end, f"{own_line},")


def _drop_member(written: Written, outer: WrittenValue, listed: Sequence[ListMember], index: int) -> str:
    """Return the text without one of the members in the brackets or braces of `outer`.

    A comment in the line of a member goes with it, if that line holds nothing else.
    """
    text, closing = written.text, outer.end - 1
    start, stop = listed[index]
    comma = _find_comma_after(text, stop, closing)
    end = stop if comma is None else comma + 1
    is_last = index + 1 == len(listed)
    rest = text[end:closing]
    behind = end + len(rest) - len(_COMMENT.sub("", rest, count=1))
    if _LINE_BREAK.match(text, behind, closing):
        line = written.line_start(start)
        if not text[line:start].strip():
            shortened = _cut_out(text, line, behind + len(written.break_at(behind)))
            before = _find_comma_after(text, listed[index - 1].end, start) if is_last and index else None
            return (
                shortened if comma is not None or before is None else _cut_out(shortened, before, before + 1)
            )
        end = behind
    if not is_last:
        rest = text[end : listed[index + 1].start]
        return _cut_out(text, start, end + len(rest) - len(rest.lstrip(" \t")))
    if index == 0:
        return _cut_out(text, start, closing if _SPACES.fullmatch(text, end, closing) else end)
    before_it = listed[index - 1].end
    return _cut_out(text, start, end) if "#" in text[before_it:start] else _cut_out(text, before_it, stop)


def _cut_out(text: str, start: int, end: int) -> str:
    return text[:start] + text[end:]


def _find_comma_after(text: str, start: int, end: int) -> int | None:
    """Return where a comma stands among blanks and comments; None if none does."""
    found = _COMMA.match(text, start, end)
    return found.start(1) if found else None


def insert(text: str, index: int, piece: str) -> str:
    """Return a text with a piece more."""
    return text[:index] + piece + text[index:]


_INDENT = 2
_END_OF_DOCUMENT = re.compile(r"^\.\.\.", re.MULTILINE)


class UneditableError(Exception):
    """A list that is written in a way in which nothing can be changed without changing more."""


@dataclass(frozen=True, slots=True)
class ListKey:
    """Where a list stands: the group of keys, and its key in it."""

    group: str
    key: str

    @property
    def path(self) -> tuple[str, str]:
        """The keys that lead to it."""
        return self.group, self.key

    def __str__(self) -> str:
        """Return the dotted name: ``model.effects``."""
        return f"{self.group}.{self.key}"


def find_own_list(written: Written, where: ListKey) -> WrittenValue | None:
    """Return the list that a file holds itself; None if it holds none."""
    group = written.root.find_entry(where.group)
    listed = group[1].find_entry(where.key) if group else None
    is_list = listed is not None and listed[1].form in {ValueForm.LINES, ValueForm.BRACKETS}
    return listed[1] if listed and is_list else None


def add_item(text: str, where: ListKey, item: Node) -> str:
    """Return a text that has a list, with one item more at its end."""
    written = Written.of(text)
    listed = _take_own_list(written, where)
    quote = _quote_of(text, listed.parts[-1]) if listed.parts else _quote_of(text, written.root.parts[0])
    if listed.form is ValueForm.BRACKETS:
        return add_member(written, listed, find_members(listed.parts), write_as_text(item, quote))
    last = listed.parts[-1]
    end = written.line_end(last.end)
    indent = " " * written.find_column(written.find_dash_of(last))
    return insert(text, end, f"{written.break_at(end)}{indent}- {write_as_text(item, quote, in_lines=True)}")


def change_item(text: str, where: ListKey, index: int, item: Node) -> str:
    """Return a text that has a list, with one of its items written anew; comments within it forbid that."""
    written = Written.of(text)
    listed = _take_own_list(written, where)
    old = listed.parts[index]
    if "#" in text[old.start : old.end] or text.startswith(("&", "*"), old.start):
        raise UneditableError
    in_lines = listed.form is ValueForm.LINES
    return text[: old.start] + write_as_text(item, _quote_of(text, old), in_lines=in_lines) + text[old.end :]


def drop_item(text: str, where: ListKey, index: int) -> str:
    """Return a text that has a list, without one of its items."""
    written = Written.of(text)
    listed = _take_own_list(written, where)
    if listed.form is ValueForm.BRACKETS:
        return _drop_member(written, listed, find_members(listed.parts), index)
    item = listed.parts[index]
    dash = written.find_dash_of(item)
    start = written.line_start(dash)
    if text[start:dash].strip():  # ``: - item``, after a key that is marked by ``?``
        raise UneditableError
    end = written.line_end(item.end)
    if end == len(text):
        start = written.find_break_before(start)
    else:
        end += len(written.break_at(end))
    shortened = text[:start] + text[end:]
    if len(listed.parts) > 1:
        return shortened
    group = written.root.find_entry(where.group)
    own = group[1].find_entry(where.key) if group else None
    if own is None or text.startswith("&", listed.start):
        raise UneditableError
    return insert(shortened, written.find_after_colon_of(own[0]), " []")


def add_list(text: str, where: ListKey, items: Sequence[Node]) -> str:
    """Return a text that has no such list, with one."""
    written = Written.of(text)
    root = written.root
    quote = _quote_of(text, root.parts[0])
    bracketed = f"[{', '.join(write_as_text(item, quote) for item in items)}]"
    pair = f"{quote_text(where.key, quote)}: {bracketed}"
    group = root.find_entry(where.group)
    if group is None:
        if root.form is ValueForm.BRACES:
            pair = f"{quote_text(where.group, quote)}: {{{pair}}}"
            return add_member(written, root, find_members(root.parts, 2), pair)
        return _add_last_key(written, where, items, quote)
    listed = group[1].find_entry(where.key)
    if listed is None and group[1].form is ValueForm.BRACES:
        return add_member(written, group[1], find_members(group[1].parts, 2), pair)
    if listed is None and group[1].form is ValueForm.INDENTED:
        return _add_last_key_of(written, group[1], where, items)
    in_braces = ValueForm.BRACES in {root.form, group[1].form}
    key, value = listed or group
    indent = written.find_column(key.start) + _INDENT
    lines = [] if in_braces else _write_lines(items, indent, quote, key="" if listed else where.key)
    return _add_value(written, key, value, bracketed if listed else f"{{{pair}}}", lines)


def _add_value(
    written: Written, key: WrittenValue, value: WrittenValue, in_line: str, lines: Sequence[str]
) -> str:
    """Return the text with a value for a key that has none: in lines of its own, if there are any."""
    text = written.text
    if value.form is not ValueForm.SCALAR:
        raise UneditableError
    spelt = text[value.start : value.end]
    if spelt in {"~", "null"}:
        return text[: value.start] + in_line + text[value.end :]
    if spelt:  # an anchor, to which the value belongs
        return insert(text, value.end, f" {in_line}")
    colon = written.find_after_colon_of(key)
    if not lines:
        return insert(text, colon, f" {in_line}")
    end = written.line_end(colon)
    line_break = written.break_at(end)
    return insert(text, end, "".join(line_break + line for line in lines))


def _quote_of(text: str, neighbour: WrittenValue) -> str:
    """Return the quotation mark that a value, or its first key, begins with; empty for none."""
    while neighbour.parts:
        neighbour = neighbour.parts[0]
    mark = text[neighbour.start : neighbour.start + 1]
    return mark if neighbour.form is ValueForm.SCALAR and mark in {"'", '"'} else ""


def _take_own_list(written: Written, where: ListKey) -> WrittenValue:
    listed = find_own_list(written, where)
    if listed is None:
        raise UneditableError
    return listed


def _add_last_key_of(written: Written, group: WrittenValue, where: ListKey, items: Sequence[Node]) -> str:
    """Return the text with the list after all other keys of its group, which stand one a line."""
    text, last = written.text, group.parts[-1]
    if last.form is ValueForm.ALIAS:
        raise UneditableError
    end = written.line_end(last.end)
    lines = _write_lines(
        items, written.find_column(group.parts[0].start), _quote_of(text, group.parts[0]), key=where.key
    )
    return insert(text, end, "".join(f"{written.break_at(end)}{line}" for line in lines))


def _add_last_key(written: Written, where: ListKey, items: Sequence[Node], quote: str) -> str:
    """Return the text with the group of the list after all others."""
    text = written.text
    column = written.find_column(written.root.parts[0].start)
    line_break = written.break_at(len(text))
    block = line_break.join(
        [
            f"{' ' * column}{quote_text(where.group, quote)}:",
            *_write_lines(items, column + _INDENT, quote, key=where.key),
        ]
    )
    marker = _END_OF_DOCUMENT.search(text, written.root.end)
    end = marker.start() if marker else len(text)
    if text[:end].endswith(("\n", "\r")):
        return insert(text, end, block + line_break)
    return insert(text, end, line_break + block)


def _write_lines(items: Sequence[Node], column: int, quote: str, *, key: str) -> list[str]:
    """Return the list an item a line, below its key if that is not there yet."""
    heading = []
    if key:
        heading = [f"{' ' * column}{quote_text(key, quote)}:{'' if items else ' []'}"]
        column += _INDENT
    return heading + [f"{' ' * column}- {write_as_text(item, quote, in_lines=True)}" for item in items]
