"""The glossary has the words that certificates and pages print, and no others."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from documents.pages import DOCS

_ROOT = DOCS.parent
_ROW = re.compile(r"^\| (?P<en>[^|]+) \| (?P<de>[^|]+) \| [^|]+ \|$", re.MULTILINE)
_TERMS = [
    (row["en"], row["de"])
    for row in _ROW.finditer((DOCS / "reference" / "glossary.md").read_text(encoding="utf-8"))
    if row["en"] != "English"
]


@cache
def _printed() -> tuple[str, str]:
    """Return the phrases that exist in both languages: all English ones, and all German ones."""
    pairs = [
        pair
        for folder in ("src", "plugins")
        for path in (_ROOT / folder).rglob("*.py")
        for pair in _pairs(path)
    ]
    return tuple("\n".join(phrases).casefold() for phrases in zip(*pairs, strict=True))  # type: ignore[return-value]


def _pairs(path: Path) -> Iterator[tuple[str, str]]:
    for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(call, ast.Call) and getattr(call.func, "id", "") in {"Words", "fact"}:
            named = {keyword.arg: keyword.value for keyword in call.keywords}
            texts = [*call.args, *(named[name] for name in ("en", "de") if name in named)][:2]
            values = [text.value for text in texts if isinstance(text, ast.Constant)]
            if len(values) == 2:
                yield str(values[0]), str(values[1])


@pytest.mark.parametrize(("english", "german"), _TERMS)
def test_both_words_of_a_row_are_printed(english: str, german: str) -> None:
    in_english, in_german = _printed()
    assert english.casefold() in in_english
    assert german.casefold() in in_german
