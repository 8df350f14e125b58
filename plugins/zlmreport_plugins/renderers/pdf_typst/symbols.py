"""Symbols and words whose letters carry a mark: letter and mark one after the other, each with its place.

Set as one piece of text they look the same; but then a PDF says of the glyph ``x`` that it means x̄, and a
program that reads text glyph by glyph finds x̄ wherever an x stands.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from itertools import groupby
from typing import Any, TypeAlias
from unicodedata import combining, normalize

from zlmreport.plugin import FontFace, mark_offset, notation_spans, text_advance

#: A text; or a mark with its place, right of and above the pen, in em.
Stretch: TypeAlias = tuple[str] | tuple[str, float, float]


@lru_cache(maxsize=1024)
def symbol_data(notation: str) -> dict[str, Any]:
    """Return a symbol or a formula, word by word, for lines may part between words only.

    Each word is a list of spans: whether it is italic, whether it is a subscript, and a stretch.
    """
    words: list[list[Any]] = [[]]
    for span in notation_spans(notation):
        face = FontFace.ITALIC if span.italic else FontFace.REGULAR
        for number, text in enumerate(span.text.split(" ")):
            if number:
                words.append([])
            words[-1] += [[span.italic, span.subscript, *stretch] for stretch in parted(text, face)]
    return {"kind": "symbol", "words": words}


@lru_cache(maxsize=4096)
def parted(text: str, face: FontFace) -> tuple[Stretch, ...]:
    """Return the stretches of a text; the whole of it where the typeface has no place for a mark."""
    whole = normalize("NFC", text)
    try:
        return tuple(_parted(whole, face))
    except LookupError:
        return ((whole,),)


def has_marks(text: str) -> bool:
    """Return whether a letter of a text carries a mark with which it is no letter of its own."""
    return not text.isascii() and any(map(combining, normalize("NFC", text)))


def _parted(text: str, face: FontFace) -> Iterator[Stretch]:
    before = ""
    for is_mark, letters in groupby(text, lambda letter: bool(combining(letter))):
        stretch = "".join(letters)
        if is_mark and before:
            for mark in stretch:
                right, above = mark_offset(before, mark, face)
                yield mark, right - text_advance(before, face), above
        else:
            yield (stretch,)
            before = stretch[-1]
