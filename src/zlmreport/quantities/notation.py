"""Symbols as a standard prints them, written in one line and set by every renderer.

A notation is plain text in which ``_{…}`` marks a subscript: ``x̄_{i}↑ + 2s_{i}↑``. From it follow the
spans that a renderer sets, and the plain line for terminals and screen readers.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

_SUBSCRIPT = re.compile(r"_\{([^}]*)\}")
# Fractions count as word characters, but they are numbers.
_LETTERS = re.compile(r"([^\W\d_¼½¾][\u0300-\u036f]*)+")
# A sum is an operator and π a constant: upright, as ISO 80000-2 sets them.
_ONE_LETTER = re.compile(r"[^\W\d_πΣ][\u0300-\u036f]*")
# A running index, alone, after the letter of a word, or before its number: i, ij, sj, i1.
_INDEX = re.compile(r"(?P<word>[^\W\d_ij]?)(?P<index>[ij]+)(?P<number>\d*)")


@dataclass(frozen=True, slots=True)
class Span:
    """A stretch of a symbol that is set alike.

    Attributes
    ----------
    text
        What is set.
    italic
        True for a quantity's letter and for a running index, as ISO 80000-1 sets them; words such as
        ``max`` and operators stay upright.
    subscript
        True below the line.
    """

    text: str
    italic: bool
    subscript: bool


def spans(notation: str) -> tuple[Span, ...]:
    """Return the spans of a notation, in reading order.

    Examples
    --------
    >>> [(span.text, span.italic, span.subscript) for span in spans("P_{s max}")]
    [('P', True, False), ('s max', False, True)]
    """
    found: list[Span] = []
    for position, part in enumerate(_SUBSCRIPT.split(notation)):
        if position % 2:
            found.extend(_subscript_spans(part))
        else:
            found.extend(_base_spans(part))
    return tuple(found)


def plain(notation: str) -> str:
    """Return a notation as a plain line: ``P_{s max}`` as ``Ps max``."""
    return _SUBSCRIPT.sub(r"\1", notation)


def _subscript_spans(text: str) -> list[Span]:
    match = _INDEX.fullmatch(text)
    if match is None:
        return [Span(text, italic=False, subscript=True)]
    return [
        Span(part, italic=name == "index", subscript=True) for name, part in match.groupdict().items() if part
    ]


def _base_spans(text: str) -> list[Span]:
    found: list[Span] = []
    end = 0
    for match in _LETTERS.finditer(text):
        if not _ONE_LETTER.fullmatch(match[0]):
            continue
        if match.start() > end:
            found.append(Span(text[end : match.start()], italic=False, subscript=False))
        found.append(Span(match[0], italic=True, subscript=False))
        end = match.end()
    if end < len(text):
        found.append(Span(text[end:], italic=False, subscript=False))
    return found
