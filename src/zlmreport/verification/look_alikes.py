"""Letters that look like others (Unicode), and invisible ones, in texts of a certificate.

UTS #39 (Unicode Security Mechanisms) lists letters that look alike, and UAX #24 the script of each.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from functools import cache

from zlmreport.errors import describe_character
from zlmreport.job.parse import list_invisible
from zlmreport.language import Words

_WORD = re.compile(r"[^\W\d_]+")
#: What looks like a number and has letters among its digits: ``l,O`` and ``1O``.
_AMONG_DIGITS = re.compile(
    r"(?<![^\W_])(?=[\d.,]*[lIO|o])(?:[lIO|o]*\d[\dlIO|o]*(?:[.,][\dlIO|o]+)*|[lIO|o]+[.,][\dlIO|o]+)(?![^\W_])"
)
_AS_DIGITS = str.maketrans("lI|Oo", "11100")
_MICRO = str.maketrans("µμ", "uu")
#: What stands for a sign of a number, whatever its length.
_DASHES = str.maketrans(dict.fromkeys("‐‑‒–—−﹣－", "-"))
#: Scripts that one word may have together (UTS #39, highly restrictive).
_TOGETHER = (
    {"HAN", "HIRAGANA", "KATAKANA", "LATIN"},
    {"HAN", "HANGUL", "LATIN"},
    {"HAN", "BOPOMOFO", "LATIN"},
)
_OF_ALL = frozenset({"COMMON", "INHERITED"})
_MIXED = Words("'{word}' mixes letters of {scripts}")
_WHOLLY = Words("'{word}' is written in {scripts} letters that look like '{like}'")
_DIGITS = Words("'{word}' has letters where digits belong")
_OTHER_DIGITS = Words("'{word}' has digits of another script: {like}")
_UNSEEN = Words("has an {character}")


def read_as(text: str) -> str:
    """Return what a reader takes a text for: Latin letters, ASCII digits, and nothing that is not seen.

    Letters that look like digits, among digits, are digits.

    >>> read_as("\N{CYRILLIC CAPITAL LETTER A} = 1,0"), read_as("l,O \N{MICRO SIGN}m"), read_as("10⁻³")
    ('A = 1,0', '1,0 um', '10-3')
    """
    seen = "".join(each for each in text if not list_invisible(each))
    plain = unicodedata.normalize("NFKC", seen).translate(_DASHES).translate(_MICRO)
    latin = "".join(map(_find_latin, plain))
    return _AMONG_DIGITS.sub(lambda found: found[0].translate(_AS_DIGITS), latin)


@cache
def _find_latin(letter: str) -> str:
    """Return the ASCII letter or digit that a letter looks like; itself where it looks like none."""
    if letter.isascii():
        return letter
    digit = unicodedata.decimal(letter, None)
    if digit is not None:
        return str(digit)
    from confusable_homoglyphs import confusables  # noqa: PLC0415 - slow to load

    alike = (each["c"] for each in confusables.confusables_data.get(letter, ()))
    return next((each for each in alike if len(each) == 1 and each.isascii() and each.isalnum()), letter)


def find_oddities(text: str) -> Iterator[Words]:
    """Yield what nobody can tell by looking: mixed scripts, look-alikes, invisible characters."""
    for character in dict.fromkeys(list_invisible(text)):
        yield _UNSEEN.given(character=describe_character(character))
    for word in dict.fromkeys(_WORD.findall(text)):
        yield from _find_in_word(word)
    for number in dict.fromkeys(re.findall(r"[\w.,]+", text)):
        if _AMONG_DIGITS.fullmatch(number):
            yield _DIGITS.given(word=number)
        elif any(each.isdecimal() and not each.isascii() for each in number):
            yield _OTHER_DIGITS.given(word=number, like=read_as(number))


def _find_in_word(word: str) -> Iterator[Words]:
    from confusable_homoglyphs import categories  # noqa: PLC0415 - slow to load

    if word.translate(_MICRO).isascii():  # a micro sign is written in two ways
        return
    scripts = set(map(str, categories.unique_aliases(word))) - _OF_ALL
    named = ", ".join(sorted(each.title() for each in scripts))
    if len(scripts) > 1 and not any(scripts <= allowed for allowed in _TOGETHER):
        yield _MIXED.given(word=word, scripts=named)
    elif "LATIN" not in scripts and (like := "".join(map(_find_latin, word))).isascii():
        yield _WHOLLY.given(word=word, scripts=named, like=like)
