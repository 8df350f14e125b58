"""Texts for their places: where a word may be parted that is wider, for Typst itself never parts one."""

from __future__ import annotations

import re
from itertools import groupby
from typing import Any, TypeAlias

from zlmreport.plugin import FontFace, text_advance
from zlmreport_plugins.renderers.pdf_typst.symbols import has_marks, parted

#: A text, or its stretches, each with the way in which it is set.
Text: TypeAlias = str | list[tuple[Any, str]]

#: As it stands; parted anywhere, as a number, a path or a digest; by the rules of the language; with marks
#: placed one by one.
AS_WORDS, ANYWHERE, BY_SYLLABLES, MARKED = "words", "anywhere", "syllables", "marked"

_WORDS = re.compile(r"\S+|\s+")
#: Longer words, or those in narrower places, are no words of a language or do not fit by syllables either.
_LONGEST_WORD = 45
_LEAST_ROOM = 6.0
_WIDEST_LETTER = 1.0


def fitted(text: str, room: float, face: FontFace = FontFace.REGULAR) -> Text:
    """Return a text for a place of a width, in em: as it stands where every word fits and none has marks."""
    longest = max(map(len, text.split()), default=0)
    if _WIDEST_LETTER * longest <= room and not has_marks(text):
        return text
    ways = [(word, _way(word, room, face)) for word in _WORDS.findall(text)]
    if all(way == AS_WORDS for _, way in ways):
        return text
    return [
        (parted(stretch, face) if way == MARKED else stretch, way)
        for way, words in groupby(ways, lambda each: each[1])
        for stretch in (("".join(word for word, _ in words),) if way == AS_WORDS else [w for w, _ in words])
    ]


def _way(word: str, room: float, face: FontFace) -> str:
    if has_marks(word):
        return MARKED
    if _WIDEST_LETTER * len(word) <= room or text_advance(word, face) <= room:
        return AS_WORDS
    is_of_language = word.strip(".,;:!?()").replace("-", "").isalpha() and len(word) <= _LONGEST_WORD
    return BY_SYLLABLES if is_of_language and room >= _LEAST_ROOM else ANYWHERE
