"""Letters that no typeface of a document has: it is refused, for it would show boxes in their place."""

from __future__ import annotations

from collections.abc import Iterable
from unicodedata import category, name

from zlmreport.plugin import InputError, Place

#: What is seen only by what it does: line ends, joiners, direction marks.
_UNSEEN = frozenset({"Cf", "Zl", "Zp"})
_MOST_TOLD = 10


def refuse_letters(letters: Iterable[str], number: str, lack: str, remedy: str) -> None:
    """Refuse the certificate of a number for letters that have no shape, if any of them would be seen.

    `lack`: The beginning of the sentence that names them: what has none of them.
    `remedy`: What would be right, as its end.
    """
    lacking = sorted({letter for letter in letters if category(letter) not in _UNSEEN})
    if lacking:
        told = ", ".join(map(_tell_letter, lacking[:_MOST_TOLD]))
        more = f" and {len(lacking) - _MOST_TOLD} more" if len(lacking) > _MOST_TOLD else ""
        raise InputError.at(Place(number), f"{lack} {told}{more}; {remedy}")


def _tell_letter(letter: str) -> str:
    shown = f"{letter!r} " if letter.isprintable() else ""
    return f"{shown}(U+{ord(letter):04X} {name(letter, 'a control character')})"
