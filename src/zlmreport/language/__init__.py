"""The languages a certificate is written in, and text that exists in each of them.

Every sentence that reaches a page is written once, as `Words`, in all languages side by side; so a
missing translation is a type error and not a surprise on a customer's certificate.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum

from zlmreport.language.formatting import DecimalSign, general_number


class Language(StrEnum):
    """A language of the certificate, named by its ISO 639-1 code."""

    ENGLISH = "en"
    GERMAN = "de"

    @property
    def decimal_sign(self) -> DecimalSign:
        """The decimal sign that readers of this language expect."""
        return DecimalSign.COMMA if self is Language.GERMAN else DecimalSign.POINT


@dataclass(frozen=True, slots=True)
class Words:
    """One phrase in every language.

    Attributes
    ----------
    en, de
        The phrase; ``{name}`` marks a place for a value given by `given`.
    values
        What stands in the marked places. Numbers are written in the manner of the language, up to six
        significant digits; data of users belong here and never in the phrase itself.
    """

    en: str
    de: str
    values: Mapping[str, str | int | float | Words] = field(default_factory=dict)

    def given(self, **values: str | float | Words) -> Words:
        """Return the phrase with values for its marked places."""
        return replace(self, values={**self.values, **values})

    def in_language(self, language: Language) -> str:
        """Return the phrase in one language, its places filled."""
        phrase = self.de if language is Language.GERMAN else self.en
        if not self.values:
            return phrase
        return phrase.format_map({name: _written(value, language) for name, value in self.values.items()})


def same(phrase: str) -> Words:
    """Return a phrase that is alike in every language: a name, a symbol, a user's own text."""
    return Words("{phrase}", values={"phrase": phrase})


def _written(value: str | float | Words, language: Language) -> str:
    if isinstance(value, Words):
        return value.in_language(language)
    if isinstance(value, float):
        return general_number(value, language.decimal_sign)
    return str(value)
