"""How numbers are written: where a result gets its digits, with its expanded uncertainty or without.

A notation is plain text in which ``_{…}`` marks a subscript: ``x̄_{i}↑ + 2s_{i}↑``. From it follow the
spans that a renderer sets, and the plain line for terminals and screen readers.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from decimal import ROUND_HALF_EVEN, Context, Decimal
from enum import StrEnum
from math import floor, isfinite, log10

#: The minus sign, U+2212.
MINUS = "\N{MINUS SIGN}"
#: A blank at which no line ends.
HELD = "\N{NO-BREAK SPACE}"
#: No sign and no width: no line ends where it stands.
WORD_JOINER = "\N{WORD JOINER}"
#: Nobody knows the tails of real scatter better: below, a smaller chance is no stronger evidence.
LEAST_P = 1e-6
#: Of an expanded uncertainty.
_DIGITS = 2
#: Of a value that is given exactly, or whose uncertainty is unknown.
_DECIMALS = 3
#: Of a number that somebody states: all that a double keeps of it, but for what a conversion from SI adds.
_STATED_DIGITS = 12
#: Room for every double, the largest too.
_ANY_DOUBLE = Context(prec=800, rounding=ROUND_HALF_EVEN)

#: A blank between a number and its unit, within a coverage factor in brackets, and within n − 1.
_TOGETHER = re.compile(
    r"(?<=\d) (?=(?:[µmn]?m|s|min|K|hPa|°C|%)(?!\w))|(?<=\(k) (?== )|(?<=\(k =) (?=\d)"
    r"|(?<=[≤≥≈<>]) (?=\d)|(?<=\b[A-Za-z]) (?=− \d)|(?<=\b[A-Za-z] −) (?=\d)"
)
#: Where a line could end within a name or a number and must not: after the slash between two bodies of one
#: standard or two units, before the number of a standard, after a hyphen of a number such as 4711-D-K-2026.
_WITHIN_A_NAME = re.compile(
    r"(?<=\bVDI/|\bISO/)(?=(?:VDE|DGQ|IEC|TR|TS)\b)|(?<=[µmn°″]/)(?=(?:m|min|s|K)\b|\()"
    r"|(?:(?<=\bISO)|(?<=\b(?:VDI|VDE|DGQ|IEC|DIN))|(?<=\b(?:EN|TR|TS))|(?<=\bJCGM))(?= \d)"
    r"|(?<=[A-Z0-9][-/])(?=[A-Z0-9])|(?<=-)(?=/[A-Z0-9])"
)

_SUBSCRIPT = re.compile(r"_\{([^}]*)\}")
# Fractions count as word characters, but they are numbers.
_LETTERS = re.compile(r"([^\W\d_¼½¾][\u0300-\u036f]*)+")
# A sum is an operator and π a constant: upright, as ISO 80000-2 sets them.
_ONE_LETTER = re.compile(r"[^\W\d_πΣ][\u0300-\u036f]*")
# A running index, alone, after the letter of a word, or before its number: i, ij, sj, i1.
_INDEX = re.compile(r"(?P<word>[^\W\d_ij]?)(?P<index>[ij]+)(?P<number>\d*)")


class DecimalSign(StrEnum):
    """The sign between whole and decimal digits."""

    POINT = "."
    COMMA = ","


def write_fixed_number(value: float, decimals: int, sign: DecimalSign = DecimalSign.POINT) -> str:
    """Write a value with a fixed number of decimals; negative ones round to tens, hundreds.

    Half to even on the decimal value of the double (JCGM 100 leaves the rule open; this one has no
    bias); a result that rounds to zero carries no minus sign.

    >>> write_fixed_number(-0.25, 1), write_fixed_number(-0.04, 1)
    ('−0.2', '0.0')
    >>> write_fixed_number(1234.5, 2, DecimalSign.COMMA)
    '1234,50'
    >>> write_fixed_number(5678.9, -1)
    '5680'
    """
    rounded = Decimal(repr(float(value))).quantize(Decimal(1).scaleb(-decimals), context=_ANY_DOUBLE)
    text = f"{abs(rounded):.{max(decimals, 0)}f}".replace(".", sign)
    return f"{MINUS}{text}" if rounded < 0 else text


def write_general_number(value: float, sign: DecimalSign = DecimalSign.POINT, digits: int = 6) -> str:
    """Write a value with up to so many significant digits and no trailing zeros.

    >>> write_general_number(250.0), write_general_number(-0.0315), write_general_number(-0.0)
    ('250', '−0.0315', '0')
    >>> write_general_number(2.5, DecimalSign.COMMA)
    '2,5'
    """
    text = f"{value + 0.0:.{digits}g}"  # a zero has no sign
    if "e" in text:
        text = f"{Decimal(text):f}"
    return text.replace("-", MINUS).replace(".", sign)


def write_stated_number(value: float, sign: DecimalSign = DecimalSign.POINT) -> str:
    """Write a number that somebody states, or a difference of such: to its last digit, and with none added.

    >>> write_stated_number(2543.1875), write_stated_number(0.1 + 0.2)
    ('2543.1875', '0.3')
    """
    return write_general_number(value, sign, _STATED_DIGITS)


def hold_together(text: str) -> str:
    r"""Return a text of a page of which no line parts a number from its unit or sign, or a name in itself.

    Within names and numbers stand word joiners, before a blank too: whoever sets the text takes them out and
    keeps the word on a line, so that who copies a number gets it to the letter.

    >>> hold_together("2 °C below, 11.5 µm/K, U = 2 µm (k = 2)").replace(WORD_JOINER, "|")
    '2\xa0°C below, 11.5\xa0µm/|K, U = 2\xa0µm (k\xa0=\xa02)'
    >>> hold_together("EBY ≤ 6 µm")
    'EBY ≤\xa06\xa0µm'
    >>> hold_together("VDI/VDE 2617: ÷ (n − 1), No. 4711-D-K").replace(WORD_JOINER, "|")
    'VDI/|VDE| 2617: ÷ (n\xa0−\xa01), No. 4711-|D-|K'
    """
    return _WITHIN_A_NAME.sub(WORD_JOINER, _TOGETHER.sub(HELD, text))


def write_percentage(share: float, sign: DecimalSign = DecimalSign.POINT, decimals: int = 0) -> str:
    """Write a share or a probability in per cent, without the sign %.

    One that is smaller than the last digit says so: it is small, and not nothing.

    >>> write_percentage(0.984), write_percentage(0.004), write_percentage(0.0)
    ('98', '< 1', '0')
    >>> write_percentage(0.0004, decimals=1)
    '< 0.1'
    """
    if 0 < share < 0.01 * 10.0**-decimals:
        return f"< {write_fixed_number(10.0**-decimals, decimals, sign)}"
    return write_fixed_number(100 * share, decimals, sign)


def write_p_value(
    value: float,
    sign: DecimalSign = DecimalSign.POINT,
    *,
    least: float = LEAST_P,
    is_extrapolated: bool = False,
) -> str:
    r"""Write the p-value of a test with as many digits as it is known to; no line ends within it.

    `value`: A probability.
    `least`: A power of ten: below it, a smaller chance is no stronger evidence.
    `is_extrapolated`: Whether no simulated test came near it: then it has one digit.

    >>> write_p_value(0.0123), write_p_value(3.21e-5, DecimalSign.COMMA), write_p_value(1e-9)
    ('p\xa0=\xa00.012', 'p\xa0=\xa00,000032', 'p\xa0<\xa00.000001')
    >>> write_p_value(3.21e-5, is_extrapolated=True)
    'p\xa0≈\xa00.00003'
    """
    # Written out: the typeface of the documents has no raised minus.
    if value < least:
        return HELD.join(("p", "<", write_fixed_number(least, -round(log10(least)), sign)))
    relation, digits = ("≈", 1) if is_extrapolated else ("=", 2)
    rounded = float(f"{value:.{digits - 1}e}")
    places = max(3, digits - 1 - floor(log10(rounded)))
    return HELD.join(("p", relation, write_fixed_number(value, places, sign)))


def round_pair(
    value: float,
    expanded_uncertainty: float,
    sign: DecimalSign = DecimalSign.POINT,
) -> tuple[str, str]:
    """Write a value and its uncertainty: the uncertainty with two significant digits, the value as far.

    `value`, `expanded_uncertainty`: In the unit that is printed.

    >>> round_pair(-4.01187, 0.1319), round_pair(12.3456, 0.0996), round_pair(5678.9, 432.1)
    (('−4.01', '0.13'), ('12.35', '0.10'), ('5680', '430'))
    """
    decimals = _DECIMALS
    if isfinite(expanded_uncertainty) and expanded_uncertainty > 0:
        decimals = _count_decimals(expanded_uncertainty)
        # 0.0996 is 0.10 with two digits: rounding may have made one digit more of it.
        decimals = _count_decimals(round(expanded_uncertainty, decimals))
    if not isfinite(expanded_uncertainty):
        return write_fixed_number(value, decimals, sign), "∞"
    # Two digits lose less than the 5 % from which on it must be rounded up (EA-4/02 M:2022, 6.3).
    return write_fixed_number(value, decimals, sign), write_fixed_number(expanded_uncertainty, decimals, sign)


def _count_decimals(value: float) -> int:
    return _DIGITS - 1 - floor(log10(value))


@dataclass(frozen=True, slots=True)
class Span:
    """A stretch of a symbol that is set alike."""

    text: str  #: What is set.
    #: True for a quantity's letter and for a running index, as ISO 80000-1 sets them; words such as ``max``
    #: and operators stay upright.
    italic: bool
    subscript: bool  #: True below the line.


def split_spans(notation: str) -> tuple[Span, ...]:
    """Return the spans of a notation, in reading order.

    Examples
    --------
    >>> [(span.text, span.italic, span.subscript) for span in split_spans("P_{s max}")]
    [('P', True, False), ('s max', False, True)]
    """
    found: list[Span] = []
    for position, part in enumerate(_SUBSCRIPT.split(notation)):
        if position % 2:
            found.extend(_split_subscripts(part))
        else:
            found.extend(_split_base(part))
    return tuple(found)


def write_plain(notation: str) -> str:
    """Return a notation as a plain line: ``P_{s max}`` as ``Ps max``."""
    return _SUBSCRIPT.sub(r"\1", notation)


def _split_subscripts(text: str) -> list[Span]:
    match = _INDEX.fullmatch(text)
    if match is None:
        return [Span(text, italic=False, subscript=True)]
    return [
        Span(part, italic=name == "index", subscript=True) for name, part in match.groupdict().items() if part
    ]


def _split_base(text: str) -> list[Span]:
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
