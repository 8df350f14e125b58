"""Text for Typst: where long words part, letters with marks (x̄), letters that no font has.

Typst itself never parts a word, so a word that is wider than its place is told where it may be. And a letter
and its mark are set one after the other, each with its place: set as one piece of text they look the same,
but then a PDF says of the glyph ``x`` that it means x̄, and a program that reads glyph by glyph finds x̄
wherever an x stands.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import lru_cache
from itertools import groupby
from typing import Any, TypeAlias
from unicodedata import combining, normalize

from zlmreport.plugin import held_together
from zlmreport.plugin.page import (
    FontFace,
    has_letter,
    mark_offset,
    text_advance,
)
from zlmreport.plugin.renderer import Certificate, Symbol, notation_spans, with_symbols
from zlmreport_plugins.letters import refuse_letters

#: A text, or its stretches, each with the way in which it is set.
Text: TypeAlias = str | list[tuple[Any, str]]

#: As it stands; parted anywhere, as a number, a path or a digest; by the rules of the language; with marks
#: placed one by one; as a symbol.
AS_WORDS, ANYWHERE, BY_SYLLABLES, MARKED, SYMBOL = "words", "anywhere", "syllables", "marked", "symbol"
#: In one piece and in smaller type, in parts of the usual size, as the document's template has it.
SMALLER, _SMALLER = "smaller", 0.765

#: A blank behind a joiner belongs to its word: ISO 230-2.
_WORDS = re.compile(r"\S+(?:(?<=\u2060) \S+)*|\s+")
#: Longer words, or those in narrower places, are no words of a language or do not fit by syllables either.
_LONGEST_WORD = 45
_LEAST_ROOM = 6.0
_WIDEST_LETTER = 1.0
_JOINER = "\N{WORD JOINER}"


def fit_text(
    text: str, room: float, face: FontFace = FontFace.REGULAR, *, may_be_smaller: bool = False
) -> Text:
    """Return a text for a place of a width, in em: as it stands where every word fits and none has marks.

    `may_be_smaller`: Whether a number that is wider than the place is set in smaller type.
    """
    text = held_together(text)
    longest = max(map(len, text.split()), default=0)
    if _WIDEST_LETTER * longest <= room and _JOINER not in text and not _has_marks(text):
        return text
    most = room / _SMALLER if may_be_smaller else room
    ways = [
        (word.replace(_JOINER, ""), _measure_way(word, room, face, most)) for word in _WORDS.findall(text)
    ]
    if all(way == AS_WORDS for _, way in ways):
        return text
    return [
        (part_text(stretch, face) if way == MARKED else stretch, way)
        for way, words in groupby(ways, lambda each: each[1])
        for stretch in (("".join(word for word, _ in words),) if way == AS_WORDS else [w for w, _ in words])
    ]


def fit_text_with_symbols(text: str, notations: Iterable[str], room: float) -> Text:
    """Return a text for a place of a width, in em, in which symbols of these notations are set as such."""
    parts = [
        [(collect_symbol(part.notation)["words"], SYMBOL)]
        if isinstance(part, Symbol)
        else fit_text(part, room)
        for part in with_symbols(text, notations)
    ]
    if len(parts) == 1:
        return parts[0]
    return [stretch for part in parts for stretch in ([(part, AS_WORDS)] if isinstance(part, str) else part)]


def _measure_way(word: str, room: float, face: FontFace, most: float) -> str:
    """Return the way of a word in a place of a width; `most`: Em that a number may have, in smaller type."""
    if _has_marks(word):
        return MARKED
    if _JOINER in word:  # whole, and without the sign: a reader of the document would find it in the text
        width = text_advance(word.replace(_JOINER, ""), face)
        if width <= room:
            return MARKED
        return SMALLER if width <= most else ANYWHERE
    if _WIDEST_LETTER * len(word) <= room or text_advance(word, face) <= room:
        return AS_WORDS
    is_of_language = word.strip(".,;:!?()").replace("-", "").isalpha() and len(word) <= _LONGEST_WORD
    return BY_SYLLABLES if is_of_language and room >= _LEAST_ROOM else ANYWHERE


#: A text; or a mark with its place, right of and above the pen, in em.
Stretch: TypeAlias = tuple[str] | tuple[str, float, float]


@lru_cache(maxsize=1024)
def collect_symbol(notation: str) -> dict[str, Any]:
    """Return a symbol or a formula, word by word, for lines may part between words only.

    Each word is a list of spans: whether it is italic, whether it is a subscript, and a stretch.
    """
    words: list[list[Any]] = [[]]
    for span in notation_spans(notation):
        face = FontFace.ITALIC if span.italic else FontFace.REGULAR
        for number, text in enumerate(span.text.split(" ")):
            if number:
                words.append([])
            words[-1] += [[span.italic, span.subscript, *stretch] for stretch in part_text(text, face)]
    return {"kind": "symbol", "words": words}


@lru_cache(maxsize=4096)
def part_text(text: str, face: FontFace) -> tuple[Stretch, ...]:
    """Return the stretches of a text; the whole of it where the typeface has no place for a mark."""
    whole = normalize("NFC", text)
    try:
        return tuple(_part_word(whole, face))
    except LookupError:
        return ((whole,),)


def _has_marks(text: str) -> bool:
    """Return whether a letter of a text carries a mark with which it is no letter of its own."""
    return not text.isascii() and any(map(combining, normalize("NFC", text)))


def _part_word(text: str, face: FontFace) -> Iterator[Stretch]:
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


_ESCAPED = re.compile(r"\\(?:u(?P<code>[0-9a-f]{4})|.)")


def demand_letters(document: str, certificate: Certificate) -> None:
    """Refuse a certificate, as a text of JSON, that has letters without a shape in the bundled typeface.

    Raises `InputError` with such letters, each where it stands.
    """
    letters = set(document) | {
        chr(int(each["code"], 16)) for each in _ESCAPED.finditer(document) if each["code"]
    }
    refuse_letters(
        (letter for letter in letters if not has_letter(letter, FontFace.REGULAR)),
        certificate,
        "the typeface of the format pdf-typst has no",
        "write it otherwise, or ask for the format pdf, which takes letters from the system's typefaces",
    )
