"""Writing in the list ``model.effects`` of a file: its text with an item more, an item less, or a new list.

Nothing else of the text changes: comments, order, quotes, indentation and line ends stay as they are. What
is added follows its neighbours: a line of its own where they have one, in brackets where they stand in
brackets, in quotes where they are quoted.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence

from zlmreport.job.extents import Extent, Form, Written
from zlmreport.job.tree import Items, Keys, Node, Scalar

_MODEL, _EFFECTS = "model", "effects"
_INDENT = 2
#: Text that means nothing but itself without quotes, wherever it stands.
_PLAIN = re.compile(r"[A-Za-z][\w./-]*(:[\w./-]+)*", re.ASCII)
_NUMBER = re.compile(r"[-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d+)?", re.ASCII)
_SPACES = re.compile(r" +")
_BLANKS = re.compile(r"[ \t]*+")
_LINE_BREAK = re.compile(r"[\r\n]")
_BLANKS_AND_COMMENT = re.compile(r"[ \t]*+(#[^\r\n]*+)?")
_COMMA = re.compile(r"(?:\s|#[^\r\n]*+)*+(,)")
_END_OF_DOCUMENT = re.compile(r"^\.\.\.", re.MULTILINE)


class UneditableError(Exception):
    """A list that is written in a way in which nothing can be changed without changing more."""


def own_list(written: Written) -> Extent | None:
    """Return the list of effects that a file holds itself; None if it holds none."""
    model = written.root.entry(_MODEL)
    effects = model[1].entry(_EFFECTS) if model else None
    is_list = effects is not None and effects[1].form in {Form.LINES, Form.BRACKETS}
    return effects[1] if effects and is_list else None


def with_item(text: str, item: Node) -> str:
    """Return a text that has a list of effects, with one more at its end."""
    written = Written.of(text)
    listed = _listed(written)
    quote = _quote_of(text, listed.parts[-1]) if listed.parts else _quote_of(text, written.root.parts[0])
    if listed.form is Form.BRACKETS:
        return _in_brackets(written, listed, _members(listed.parts), as_text(item, quote))
    last = listed.parts[-1]
    end = written.line_end(last.end)
    indent = " " * written.column(written.dash_of(last))
    return _inserted(text, end, f"{written.break_at(end)}{indent}- {as_text(item, quote, in_lines=True)}")


def without_item(text: str, index: int) -> str:
    """Return a text that has a list of effects, without one of them."""
    written = Written.of(text)
    listed = _listed(written)
    if listed.form is Form.BRACKETS:
        return _without_bracketed(written, listed, index)
    item = listed.parts[index]
    dash = written.dash_of(item)
    start = written.line_start(dash)
    if text[start:dash].strip():  # ``: - item``, after a key that is marked by ``?``
        raise UneditableError
    end = written.line_end(item.end)
    if end == len(text):
        start -= len(written.break_at(start - 1)) if start else 0
    else:
        end += len(written.break_at(end))
    shortened = text[:start] + text[end:]
    if len(listed.parts) > 1:
        return shortened
    model = written.root.entry(_MODEL)
    effects = model[1].entry(_EFFECTS) if model else None
    if effects is None or text.startswith("&", listed.start):
        raise UneditableError
    return _inserted(shortened, written.after_colon_of(effects[0]), " []")


def with_list(text: str, items: Sequence[Node]) -> str:
    """Return a text that has no list of effects, with one."""
    written = Written.of(text)
    root = written.root
    quote = _quote_of(text, root.parts[0])
    bracketed = f"[{', '.join(as_text(item, quote) for item in items)}]"
    in_braces = f"{{{_quoted(_EFFECTS, quote)}: {bracketed}}}"
    model = root.entry(_MODEL)
    if model is None:
        if root.form is Form.BRACES:
            return _in_brackets(
                written, root, _members(root.parts, 2), f"{_quoted(_MODEL, quote)}: {in_braces}"
            )
        return _with_last_key(written, items, quote)
    key, value = model
    effects = value.entry(_EFFECTS)
    if value.form is Form.BRACES and effects is None:
        return _in_brackets(written, value, (), f"{_quoted(_EFFECTS, quote)}: {bracketed}")
    if effects is not None:
        key, value = effects
        in_braces = bracketed
    if value.form is not Form.SCALAR:
        raise UneditableError
    if value.start < value.end:
        is_spelt = text[value.start : value.end] in {"~", "null"}
        return text[: value.start if is_spelt else value.end] + (
            f"{'' if is_spelt else ' '}{in_braces}{text[value.end :]}"
        )
    if root.form is Form.BRACES or (effects is not None and model[1].form is Form.BRACES):
        return _inserted(text, written.after_colon_of(key), f" {in_braces}")
    lines = _lines(items, written.column(key.start) + _INDENT, quote, is_of_model=effects is None)
    end = written.line_end(written.after_colon_of(key))
    line_break = written.break_at(end)
    return _inserted(text, end, "".join(line_break + line for line in lines))


def as_text(node: Node, quote: str = "", *, in_lines: bool = False) -> str:
    """Return a value as it is written within a line.

    Parameters
    ----------
    node
        The value.
    quote
        The quotation mark of text; empty for none where none is needed.
    in_lines
        Whether a single key needs no braces.
    """
    if isinstance(node, Scalar):
        if node.is_nothing:
            return "null"
        return node.text if node.plain and _NUMBER.fullmatch(node.text) else _quoted(node.text, quote)
    if isinstance(node, Items):
        return f"[{', '.join(as_text(item, quote) for item in node.items)}]"
    pairs = ", ".join(
        f"{_quoted(key, quote)}: {as_text(entry.value, quote)}" for key, entry in node.entries.items()
    )
    return pairs if in_lines and len(node.entries) == 1 else f"{{{pairs}}}"


def _quoted(text: str, quote: str) -> str:
    if quote == "'" and "'" not in text and "\n" not in text:
        return f"'{text}'"
    if not quote and _PLAIN.fullmatch(text) and text != "null":
        return text
    return json.dumps(text, ensure_ascii=False)


def _quote_of(text: str, neighbour: Extent) -> str:
    """Return the quotation mark that a value, or its first key, begins with; empty for none."""
    while neighbour.parts:
        neighbour = neighbour.parts[0]
    mark = text[neighbour.start : neighbour.start + 1]
    return mark if neighbour.form is Form.SCALAR and mark in {"'", '"'} else ""


def _listed(written: Written) -> Extent:
    listed = own_list(written)
    if listed is None:
        raise UneditableError
    return listed


def _inserted(text: str, index: int, piece: str) -> str:
    return text[:index] + piece + text[index:]


def _members(parts: Sequence[Extent], step: int = 1) -> list[tuple[int, int]]:
    """Return where members begin and end: items, or (in steps of 2) pairs of key and value."""
    return [
        (first.start, last.end) for first, last in zip(parts[::step], parts[step - 1 :: step], strict=True)
    ]


def _in_brackets(written: Written, outer: Extent, members: Sequence[tuple[int, int]], piece: str) -> str:
    """Return the text with a member more in the brackets or braces of `outer`."""
    text, closing = written.text, outer.end - 1
    if not members:
        opening = text.index("[" if outer.form is Form.BRACKETS else "{", outer.start)
        inner = text[opening + 1 : closing]
        return _inserted(text, closing, piece + (inner if _SPACES.fullmatch(inner) else ""))
    start, end = members[-1]
    before = members[-2][1] if len(members) > 1 else outer.start
    if not _LINE_BREAK.search(text, before, start):
        return _inserted(text, end, f", {piece}")
    comma = _comma_after(text, end, closing)
    line_end = written.line_end(end if comma is None else comma)
    own_line = written.break_at(line_end) + " " * written.column(start) + piece
    if line_end > closing:  # the bracket closes in the line of the last member
        return _inserted(text, end, f",{own_line}")
    if comma is None:
        return _inserted(_inserted(text, line_end, own_line), end, ",")
    return _inserted(text, line_end, f"{own_line},")


def _without_bracketed(written: Written, listed: Extent, index: int) -> str:
    """Return the text without an item of a list in brackets."""
    text, items, closing = written.text, listed.parts, listed.end - 1
    item = items[index]
    comma = _comma_after(text, item.end, closing)
    end = item.end if comma is None else comma + 1
    behind = _BLANKS_AND_COMMENT.match(text, end, closing)
    line = written.line_start(item.start)
    is_last = index + 1 == len(items)
    if behind and behind.end() < closing and _LINE_BREAK.match(text, behind.end()):
        if text[line : item.start].isspace() or line == item.start:
            after = behind.end() + len(written.break_at(behind.end()))
            shortened = text[:line] + text[after:]
            if not is_last or comma is not None or index == 0:
                return shortened
            comma_before = _comma_after(text, items[index - 1].end, item.start)
            return shortened if comma_before is None else _without(shortened, comma_before, comma_before + 1)
        end = behind.end()
    if not is_last:
        return _without(text, item.start, _BLANKS.match(text, end).end())
    if index == 0:
        inner = text[end:closing]
        return _without(text, item.start, closing if _SPACES.fullmatch(inner) else end)
    before = items[index - 1].end
    if "#" in text[before : item.start]:
        return _without(text, item.start, end)
    return _without(text, before, item.end)


def _without(text: str, start: int, end: int) -> str:
    return text[:start] + text[end:]


def _comma_after(text: str, start: int, end: int) -> int | None:
    """Return where a comma stands among blanks and comments; None if none does."""
    found = _COMMA.match(text, start, end)
    return found.start(1) if found else None


def _with_last_key(written: Written, items: Sequence[Node], quote: str) -> str:
    """Return the text with the key ``model`` after all others."""
    text = written.text
    column = written.column(written.root.parts[0].start)
    line_break = written.break_at(len(text))
    block = line_break.join(
        [
            f"{' ' * column}{_quoted(_MODEL, quote)}:",
            *_lines(items, column + _INDENT, quote, is_of_model=True),
        ]
    )
    marker = _END_OF_DOCUMENT.search(text, written.root.end)
    end = marker.start() if marker else len(text)
    if text[:end].endswith(("\n", "\r")):
        return _inserted(text, end, block + line_break)
    return _inserted(text, end, line_break + block)


def _lines(items: Sequence[Node], column: int, quote: str, *, is_of_model: bool) -> list[str]:
    """Return the list an item a line, below its key where the key is not there yet."""
    heading = []
    if is_of_model:
        heading = [f"{' ' * column}{_quoted(_EFFECTS, quote)}:{'' if items else ' []'}"]
        column += _INDENT
    return heading + [f"{' ' * column}- {as_text(item, quote, in_lines=True)}" for item in items]
