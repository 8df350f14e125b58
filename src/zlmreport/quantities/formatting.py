"""How numbers are written: the only place where a printed value is rounded."""

from __future__ import annotations

from decimal import ROUND_HALF_EVEN, Decimal
from enum import StrEnum

MINUS = "\N{MINUS SIGN}"


class DecimalSign(StrEnum):
    """The sign between whole and decimal digits."""

    POINT = "."
    COMMA = ","


def fixed_number(value: float, decimals: int, sign: DecimalSign = DecimalSign.POINT) -> str:
    """Write a value with a fixed number of decimals.

    Half to even on the decimal value of the double (JCGM 100 leaves the rule open; this one has no
    bias); a result that rounds to zero carries no minus sign.

    >>> fixed_number(-0.25, 1), fixed_number(-0.04, 1), fixed_number(1234.5, 2, DecimalSign.COMMA)
    ('−0.2', '0.0', '1234,50')
    """
    rounded = Decimal(repr(float(value))).quantize(Decimal(1).scaleb(-decimals), ROUND_HALF_EVEN)
    text = f"{abs(rounded):f}".replace(".", sign)
    return f"{MINUS}{text}" if rounded < 0 else text


def general_number(value: float, sign: DecimalSign = DecimalSign.POINT) -> str:
    """Write a value with up to six significant digits and no trailing zeros.

    >>> general_number(250.0), general_number(-0.0315), general_number(2.5, DecimalSign.COMMA)
    ('250', '−0.0315', '2,5')
    """
    text = f"{value:.6g}"
    if "e" in text:
        text = f"{Decimal(text):f}"
    return text.replace("-", MINUS).replace(".", sign)
