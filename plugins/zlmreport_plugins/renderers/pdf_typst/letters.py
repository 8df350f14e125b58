"""The letters of a document against those of the typeface: an archived document shows each of its letters."""

from __future__ import annotations

import re
from unicodedata import category, name

from zlmreport.plugin import FontFace, InputError, Place, has_letter

#: What is seen only by what it does: line ends, joiners, direction marks.
_UNSEEN = frozenset({"Cf", "Zl", "Zp"})
_ESCAPED = re.compile(r"\\(?:u(?P<code>[0-9a-f]{4})|.)")
_MOST_TOLD = 10


def demand_letters(document: str, number: str) -> None:
    """Refuse a document, a text of JSON, that has letters without a shape in the bundled typeface.

    Raises
    ------
    InputError
        With all such letters of the certificate of this number.
    """
    letters = set(document) | {
        chr(int(each["code"], 16)) for each in _ESCAPED.finditer(document) if each["code"]
    }
    seen = (letter for letter in letters if category(letter) not in _UNSEEN)
    lacking = sorted(letter for letter in seen if not has_letter(letter, FontFace.REGULAR))
    if lacking:
        told = ", ".join(map(_told, lacking[:_MOST_TOLD]))
        more = f" and {len(lacking) - _MOST_TOLD} more" if len(lacking) > _MOST_TOLD else ""
        raise InputError.at(
            Place(number),
            f"the typeface of the format pdf-typst has no {told}{more}; "
            "write it otherwise, or ask for the format pdf, which takes letters from the system's typefaces",
        )


def _told(letter: str) -> str:
    shown = f"{letter!r} " if letter.isprintable() else ""
    return f"{shown}(U+{ord(letter):04X} {name(letter, 'a control character')})"
