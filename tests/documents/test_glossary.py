"""The glossary has the words that certificates and pages print, in English and by the German catalogue."""

from __future__ import annotations

import re
from functools import cache
from gettext import GNUTranslations

import pytest

from documents.pages import DOCS

_TRANSLATIONS = DOCS.parent / "src/zlmreport/language/translations"
_ROW = re.compile(r"^\| (?P<en>[^|]+) \| (?P<de>[^|]+) \| [^|]+ \|$", re.MULTILINE)
#: The first table; those of the other languages have terms of the field beside the words of the program.
_GLOSSARY = (DOCS / "reference" / "glossary.md").read_text(encoding="utf-8").partition("\n## ")[0]
_TERMS = [(row["en"], row["de"]) for row in _ROW.finditer(_GLOSSARY) if row["en"] != "English"]


@cache
def _printed() -> tuple[str, str]:
    """Return the phrases of the German catalogue: all English ones, and all German ones."""
    with (_TRANSLATIONS / "de/LC_MESSAGES/zlmreport.mo").open("rb") as file:
        catalogue: dict[object, str] = vars(GNUTranslations(file))["_catalog"]
    english = (each[0] if isinstance(each, tuple) else str(each) for each in catalogue)
    return "\n".join(english).casefold(), "\n".join(catalogue.values()).casefold()


@pytest.mark.parametrize(("english", "german"), _TERMS)
def test_both_words_of_a_row_are_printed(english: str, german: str) -> None:
    in_english, in_german = _printed()
    assert english.casefold() in in_english
    assert german.casefold() in in_german
