"""The languages of a certificate, and `Words`: a phrase in English that is translated when it is written.

A sentence that reaches a page is written once, in English, at its place in the code: `Words`. What it is in
other languages stands in a catalogue of translations, a file for each language in `translations`: there
``zlmreport.po`` is for translators, and ``zlmreport.mo``, made from it by ``docs/generate/translations.py``,
is what a run reads. English needs none.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from enum import StrEnum
from functools import lru_cache
from gettext import NullTranslations, translation
from pathlib import Path
from typing import Protocol, runtime_checkable

from zlmreport.language.formatting import DecimalSign, write_general_number

#: The place of a phrase whose value chooses between singular and plural.
_COUNTED = "number"
#: A place of a phrase; after a low line it is an index of a symbol.
_PLACE = re.compile(r"(?<!_)\{([A-Za-z]\w*)\}")
_CATALOGUES = Path(__file__).parent / "translations"


class Language(StrEnum):
    """A language of the certificate, named by its ISO 639-1 code."""

    ENGLISH = "en"
    GERMAN = "de"
    FRENCH = "fr"
    ITALIAN = "it"
    SPANISH = "es"

    @property
    def decimal_sign(self) -> DecimalSign:
        """The decimal sign that readers of this language expect."""
        return DecimalSign.POINT if self is Language.ENGLISH else DecimalSign.COMMA


@runtime_checkable
class Said(Protocol):
    """What is written in the manner of a language: a phrase, or a number with its digits."""

    def in_language(self, language: Language) -> str:
        """Return it in one language."""
        ...


@dataclass(frozen=True, slots=True)
class Words:
    """One phrase in every language.

    Attributes
    ----------
    en
        The phrase in English; ``{name}`` marks a place for a value given by `given`.
    de, fr, it, es
        The phrase in these languages, where a plugin brings its own translation. What is not stated is looked
        up in the catalogues of this program, and is English where they do not have it.
    values
        What stands in the marked places. Numbers are written in the manner of the language, up to six
        significant digits; data of users belong here and never in the phrase itself.
    context
        Tells alike English phrases apart that other languages say differently.
    plural
        The phrase for more than one; the value of the place ``{number}`` chooses.
    """

    en: str
    de: str | None = None
    _: KW_ONLY
    fr: str | None = None
    it: str | None = None
    es: str | None = None
    values: Mapping[str, str | int | float | Said] = field(default_factory=dict)
    context: str = ""
    plural: str = ""

    @classmethod
    def of(cls, texts: Mapping[str, str]) -> Words:
        """Return a phrase from its texts by language, the English one among them."""
        return cls(texts["en"], texts.get("de"), fr=texts.get("fr"), it=texts.get("it"), es=texts.get("es"))

    def given(self, **values: str | float | Said) -> Words:
        """Return the phrase with values for its marked places."""
        return replace(self, values={**self.values, **values})

    def list_unfilled(self) -> tuple[str, ...]:
        """Return the names of its places, where it was given no values at all: they are printed so.

        A place that lacks a value beside others that have one is a `KeyError` when the phrase is written.

        >>> Words("from {low} to x̄_{i}").list_unfilled()
        ('low',)
        """
        return () if self.values else tuple(dict.fromkeys(_PLACE.findall(self.en)))

    def in_language(self, language: Language) -> str:
        """Return the phrase in one language, its places filled."""
        phrase = getattr(self, language.value) if language is not Language.ENGLISH else None
        if phrase is None:
            phrase = self._translate(language)
        if not self.values:
            return phrase
        return phrase.format_map({name: _write_in(value, language) for name, value in self.values.items()})

    def _translate(self, language: Language) -> str:
        """Return the phrase, its places unfilled, as the catalogue has it; in English where it does not."""
        catalogue = _load_catalogue(language.value)
        number = self.values.get(_COUNTED, 1)
        count = number if isinstance(number, int) else 2
        if self.plural and self.context:
            return catalogue.npgettext(self.context, self.en, self.plural, count)
        if self.plural:
            return catalogue.ngettext(self.en, self.plural, count)
        # An empty phrase would be answered with the head of the catalogue.
        if not self.en:
            return self.en
        return catalogue.pgettext(self.context, self.en) if self.context else catalogue.gettext(self.en)


@lru_cache
def _load_catalogue(language: str) -> NullTranslations:
    return translation("zlmreport", _CATALOGUES, languages=[language], fallback=True)


@dataclass(frozen=True, slots=True)
class PhraseRow:
    """Phrases one behind the other, parted by commas."""

    phrases: tuple[Words, ...]

    def in_language(self, language: Language) -> str:
        """Return the row in one language."""
        return ", ".join(each.in_language(language) for each in self.phrases)


def same(phrase: str | Said) -> Words:
    """Return a phrase that is alike in every language, or is written by itself: a name, a text."""
    return Words("{phrase}", values={"phrase": phrase})


_AND, _OR = Words("{one} and {other}"), Words("{one} or {other}")


def list_in_words(names: Sequence[str | Said], last: Words = _AND) -> Words:
    """Return names in a row: commas between them, and a word before the last."""
    *others, final = names
    if not others:
        return same(final)
    return last.given(one=PhraseRow(tuple(map(same, others))), other=final)


def list_alternatives(names: Sequence[str | Said]) -> Words:
    """Return names of which one is meant: the last after an "or"."""
    return list_in_words(names, _OR)


#: In French a space stands before colon and semicolon.
_NAMED = Words("{name}: {said}")
_BESIDE = Words("{first}; {second}")


def named(name: str | Said, said: str | Said) -> Words:
    """Return a name and what is said of it, parted as each language parts them."""
    return _NAMED.given(name=name, said=said)


def join_parts(parts: Iterable[str], language: Language) -> str:
    """Return what stands in a line, with semicolons between its parts as the language sets them."""
    return _BESIDE.given(first="", second="").in_language(language).join(parts)


@dataclass(frozen=True, slots=True)
class PartRow:
    """Parts of a line one behind the other, with semicolons between them as each language sets them."""

    parts: tuple[str | Said, ...]

    def in_language(self, language: Language) -> str:
        """Return the row in one language."""
        return join_parts((_write_in(each, language) for each in self.parts), language)


def _write_in(value: str | float | Said, language: Language) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, float):
        return write_general_number(value, language.decimal_sign)
    if isinstance(value, Said):
        return value.in_language(language)
    return str(value)


def find_accepted_language(asked: str) -> Language | None:
    """Return the first language of a row such as ``fr-CH, de;q=0.8`` that there is, or None."""
    wanted = [part.strip()[:2] for part in asked.split(",")]
    return next((Language(each) for each in wanted if each in set(Language)), None)
