"""Ends lines before what no line parts: a number or a symbol that follows a text and a blank.

WeasyPrint 70 takes a text that fits into its line but for the blank at its end to be too long for it, and
puts its first word alone on the line, however many more would fit.
"""

from __future__ import annotations

from typing import Any

from weasyprint.layout import inline
from weasyprint.text.line_break import split_first_line

#: Em that a letter of a text has at least, in the mean: a text of more letters fits into no such line.
_NARROWEST = 0.25


def settle() -> None:
    """Make WeasyPrint leave a blank at the end of a line out of its width in this process."""
    inline.split_first_line = _split_first_line


def _split_first_line(
    text: str, style: Any, context: Any, max_width: float | None, *others: Any, **named: Any
) -> Any:
    """Return the first line of a text as WeasyPrint does: all of it if only its last blank is too much."""
    found = split_first_line(text, style, context, max_width, *others, **named)
    _, _, resume_index, *_ = found
    words = text.rstrip(" ")
    if (
        resume_index is None
        or words == text
        or max_width is None
        or len(words) * style["font_size"] * _NARROWEST > max_width
    ):
        return found
    _, _, rest, width, *_ = split_first_line(words, style, context, max_width, *others, **named)
    if rest is None and width <= max_width:
        return split_first_line(text, style, context, None, *others, **named)
    return found
