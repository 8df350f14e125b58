"""Numbers for sentences, written in the manner of whatever language the sentence is said in."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

from zlmreport.language import Language, Words, same
from zlmreport.language.formatting import fixed_number, rounded_pair

_SIGNIFICANT_DIGITS = 3
_NUMBER = Words("{number}")


@dataclass(frozen=True, slots=True)
class _Fixed:
    """A number with fixed decimals."""

    value: float
    decimals: int

    def in_language(self, language: Language) -> str:
        return fixed_number(self.value, self.decimals, language.decimal_sign)


@dataclass(frozen=True, slots=True)
class _OfPair:
    """A value, or its expanded uncertainty, rounded together with the other."""

    value: float
    expanded_uncertainty: float
    which: int

    def in_language(self, language: Language) -> str:
        return rounded_pair(self.value, self.expanded_uncertainty, language.decimal_sign)[self.which]


def number_words(value: float, decimals: int) -> Words:
    """Return a number with fixed decimals."""
    return _NUMBER.given(number=_Fixed(value, decimals))


def significant_words(value: float, digits: int = _SIGNIFICANT_DIGITS) -> Words:
    """Return a number with so many significant digits; large ones keep more."""
    if value == 0 or not isfinite(value):
        return number_words(0.0, 0) if value == 0 else same(str(value))
    # The exponent of the rounded value: 9.9999 is 10.0 with three digits.
    exponent = int(f"{value:.{digits - 1}e}".partition("e")[2])
    return number_words(value, max(0, digits - 1 - exponent))


def pair_words(value: float, expanded_uncertainty: float) -> tuple[Words, Words]:
    """Return a value and its uncertainty, rounded together as `rounded_pair` does."""
    number, u = (_NUMBER.given(number=_OfPair(value, expanded_uncertainty, which)) for which in (0, 1))
    return number, u
