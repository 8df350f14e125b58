"""Numbers inside sentences, with the decimal sign of the sentence's language."""

from __future__ import annotations

from dataclasses import dataclass
from math import floor, isfinite, log10

from zlmreport.language import Language, Words, same
from zlmreport.language.formatting import DecimalSign, round_pair, write_fixed_number, write_percentage

_SIGNIFICANT_DIGITS = 3
_NUMBER, _BELOW = Words("{number}"), Words("< {least}")
#: Of an uncertainty: a smaller part of it says no more than that it is small.
_LEAST_PART = 1e-3


@dataclass(frozen=True, slots=True)
class RoundedNumber:
    """A number with the digits that it has for good: two that print alike are alike."""

    english: str

    def in_language(self, language: Language) -> str:
        """Return it with the decimal sign of a language."""
        return self.english.replace(DecimalSign.POINT, language.decimal_sign)


def number_words(value: float, decimals: int) -> Words:
    """Return a number with fixed decimals."""
    return _NUMBER.given(number=RoundedNumber(write_fixed_number(value, decimals)))


def write_share(share: float) -> Words:
    """Return a share in whole per cent, without the sign %, as `write_percentage` does."""
    return _NUMBER.given(number=RoundedNumber(write_percentage(share)))


def write_significant(value: float, digits: int = _SIGNIFICANT_DIGITS) -> Words:
    """Return a number with so many significant digits; large ones keep more."""
    if value == 0 or not isfinite(value):
        return number_words(0.0, 0) if value == 0 else same(str(value))
    # The exponent of the rounded value: 9.9999 is 10.0 with three digits.
    exponent = int(f"{value:.{digits - 1}e}".partition("e")[2])
    return number_words(value, max(0, digits - 1 - exponent))


def write_part(value: float, whole: float) -> Words:
    """Return a part of an uncertainty with two significant digits.

    One below a thousandth of the whole says so: it is small, and not nothing.
    """
    if value == 0:
        return same("0")
    least = 10.0 ** floor(log10(_LEAST_PART * whole)) if whole else 0.0
    return _BELOW.given(least=write_significant(least, 1)) if value < least else write_pair(value, value)[1]


def write_pair(value: float, expanded_uncertainty: float) -> tuple[Words, Words]:
    """Return a value and its uncertainty, rounded together as `round_pair` does."""
    number, u = (
        _NUMBER.given(number=RoundedNumber(each)) for each in round_pair(value, expanded_uncertainty)
    )
    return number, u
