"""Translations by gettext: one catalogue a language, in `translations`, made by the tools of Babel.

The files ``zlmreport.po`` are for translators; ``zlmreport.mo`` is what a run reads, made from them by
``docs/generate/translations.py``. English needs no catalogue: it stands in the code.
"""

from __future__ import annotations

from functools import lru_cache
from gettext import NullTranslations, translation
from pathlib import Path

_DOMAIN = "zlmreport"
_FOLDER = Path(__file__).parent / "translations"


def translate(phrase: str, language: str, context: str = "", *, plural: str = "", number: object = 1) -> str:
    """Return a phrase in a language, or in English where its catalogue does not have it.

    Parameters
    ----------
    phrase
        The English one, its places unfilled.
    language
        ISO 639-1 code.
    context
        Which of the meanings of an English phrase.
    plural, number
        The English phrase for more than one, or ``""``; and how many there are.
    """
    catalogue = _load_catalogue(language)
    count = number if isinstance(number, int) else 2
    if plural and context:
        return catalogue.npgettext(context, phrase, plural, count)
    if plural:
        return catalogue.ngettext(phrase, plural, count)
    # An empty phrase would be answered with the head of the catalogue.
    if not phrase:
        return phrase
    return catalogue.pgettext(context, phrase) if context else catalogue.gettext(phrase)


@lru_cache
def _load_catalogue(language: str) -> NullTranslations:
    return translation(_DOMAIN, _FOLDER, languages=[language], fallback=True)
