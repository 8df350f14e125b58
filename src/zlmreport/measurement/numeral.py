"""Numbers as files write them; nothing is guessed."""

from __future__ import annotations

import math
import re

from zlmreport.measurement.text_file import quoted
from zlmreport.quantities.formatting import MINUS, DecimalSign

#: Characters of a number; 20 digits occur.
_LONGEST = 64
#: What a message answers to a word that stands for a missing reading.
_EMPTY_CELL = "a missing reading is an empty cell"

_PLAIN = {
    sign: re.compile(rf"[+-]?([0-9]+{re.escape(sign)}?[0-9]*|{re.escape(sign)}[0-9]+)([eE][+-]?[0-9]+)?")
    for sign in DecimalSign
}
_GROUPED = re.compile(r"[+-]?[0-9]{1,3}([.,'’ \u00a0\u202f])[0-9]{3}(\1[0-9]{3})*([.,][0-9]*)?")
_INFINITE = re.compile(r"[+-]?(inf|infinity|∞|1\.#inf)", re.IGNORECASE)
_NO_NUMBER = frozenset({"nan", "-nan", "na", "n/a", "#n/a", "null", "none", "-", "--", "---", "?"})


def parse_number(text: str, sign: DecimalSign = DecimalSign.POINT) -> float:
    """Return the number that a text writes.

    Parameters
    ----------
    text
        Digits, one decimal sign at most, an exponent if need be; ``-.0033`` and ``-1e-05`` are numbers.
    sign
        The decimal sign of the file.

    Raises
    ------
    ValueError
        With a sentence on what is wrong and what would be right: no number, an infinite number, thousands
        separators, the other decimal sign.
    """
    written = text.replace(MINUS, "-")
    if len(written) <= _LONGEST and _PLAIN[sign].fullmatch(written):
        value = float(written.replace(sign, "."))
        if math.isinf(value):
            raise ValueError(f"{quoted(text)} is too large to be a reading")
        return value
    raise ValueError(_wrong(text, written, sign))


def _wrong(text: str, written: str, sign: DecimalSign) -> str:
    shown = quoted(text)
    if len(written) > _LONGEST:
        return f"{shown} is too long to be a number"
    if written.casefold() in _NO_NUMBER:
        return f"{shown} is no number; {_EMPTY_CELL}"
    if _INFINITE.fullmatch(written):
        return f"{shown} is infinite, and no reading is; {_EMPTY_CELL}"
    other = DecimalSign.COMMA if sign is DecimalSign.POINT else DecimalSign.POINT
    if _PLAIN[other].fullmatch(written):
        right = quoted(text.replace(other, sign))
        return f"{shown} is no number with a decimal {sign.name.lower()}; write {right} if that is meant"
    if _GROUPED.fullmatch(written):
        return f"{shown} has thousands separators; write the digits without them"
    return f"{shown} stands where a number belongs"
