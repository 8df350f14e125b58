"""Phrases and numbers in one language: what all that write for a reader have alike."""

from __future__ import annotations

from dataclasses import dataclass

from zlmreport.language import Language, Said
from zlmreport.language.formatting import write_fixed_number, write_general_number, write_stated_number

_DECIMALS = 2


@dataclass(frozen=True, slots=True)
class LanguageWriter:
    """Writes in one language."""

    language: Language  #: Of the reader.

    def say(self, phrase: Said) -> str:
        """Return a phrase."""
        return phrase.in_language(self.language)

    def write_number(self, value: float, decimals: int = _DECIMALS) -> str:
        """Write a number with so many decimals."""
        return write_fixed_number(value, decimals, self.language.decimal_sign)

    def write_general(self, value: float) -> str:
        """Write a number with no needless digits."""
        return write_general_number(value, self.language.decimal_sign)

    def write_stated(self, value: float) -> str:
        """Write a number that somebody states, to its last digit."""
        return write_stated_number(value, self.language.decimal_sign)
