"""Numbers in all languages at once, for sentences."""

from __future__ import annotations

from math import isfinite

from zlmreport.language import Language, Words, same
from zlmreport.language.formatting import fixed_number, rounded_pair

_SIGNIFICANT_DIGITS = 3


def number_words(value: float, decimals: int) -> Words:
    """Return a number with fixed decimals in all languages."""
    return Words(
        en=fixed_number(value, decimals, Language.ENGLISH.decimal_sign),
        de=fixed_number(value, decimals, Language.GERMAN.decimal_sign),
    )


def significant_words(value: float, digits: int = _SIGNIFICANT_DIGITS) -> Words:
    """Return a number with so many significant digits in all languages; large ones keep more."""
    if value == 0 or not isfinite(value):
        return number_words(0.0, 0) if value == 0 else same(str(value))
    # The exponent of the rounded value: 9.9999 is 10.0 with three digits.
    exponent = int(f"{value:.{digits - 1}e}".partition("e")[2])
    return number_words(value, max(0, digits - 1 - exponent))


def pair_words(value: float, expanded_uncertainty: float) -> tuple[Words, Words]:
    """Return a value and its uncertainty in all languages, rounded together as `rounded_pair` does."""
    in_english, in_german = (
        rounded_pair(value, expanded_uncertainty, language.decimal_sign)
        for language in (Language.ENGLISH, Language.GERMAN)
    )
    number, u = (Words(en=en, de=de) for en, de in zip(in_english, in_german, strict=True))
    return number, u
