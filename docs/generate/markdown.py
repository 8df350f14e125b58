"""Tables and symbols in Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from zlmreport.language.formatting import split_spans


def table(heading: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table; a bar in a cell stays a bar."""
    lines = [heading, ["---"] * len(heading), *rows]
    return "\n".join(f"| {' | '.join(cell.replace('|', '&#124;') for cell in line)} |" for line in lines)


def symbol(notation: str) -> str:
    """Return a symbol or a formula, its letters in italics and its indices below the line."""
    return "".join(
        f"<sub>{_set(span.text, italic=span.italic)}</sub>"
        if span.subscript
        else _set(span.text, italic=span.italic)
        for span in split_spans(notation)
    )


def code(text: str) -> str:
    """Return a text as it is typed."""
    return f"`{text}`"


def _set(text: str, *, italic: bool) -> str:
    return f"<i>{text}</i>" if italic else text
