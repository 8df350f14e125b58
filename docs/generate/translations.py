"""Gathers the phrases of the code, and writes the catalogues of their translations.

Called as ``python docs/generate/translations.py``: each language's ``zlmreport.po`` gets the phrases that are
new, loses those that nobody says any more and keeps its translations; ``zlmreport.mo``, which a run reads, is
made from it. A new language begins as a member of `Language`, and an empty ``LC_MESSAGES/zlmreport.po``.
"""

from __future__ import annotations

import ast
import datetime as dt
import io
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, is_dataclass
from pathlib import Path
from typing import Any

from babel.messages.catalog import Catalog
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po, write_po
from pydantic import BaseModel

from zlmreport.job.effect_catalogue import read_catalogue, read_measurements
from zlmreport.language import Language, Words

ROOT = Path(__file__).resolve().parents[2]
TRANSLATIONS = ROOT / "src/zlmreport/language/translations"
_CODE = ("src/zlmreport", "plugins/zlmreport_plugins", "plugins/zlmreport_step_gauge")
_CATALOGUES = "plugins/zlmreport_plugins/effects"
_MEASUREMENTS = "measurements.yaml"
#: What no translation changes: places, and the signs between them that are written alike everywhere.
_ALIKE = re.compile(r"(\{[^}]*\}|[^\w“”:;%!?])*")
#: The head of a catalogue has dates; the same phrases give the same bytes.
_DATED = dt.datetime(2026, 1, 1, tzinfo=dt.UTC)
_WIDTH = 110


@dataclass(frozen=True)
class Phrase:
    """A phrase of the code that is to be translated."""

    english: str
    context: str
    plural: str
    file: str  #: In which it stands.

    @property
    def identifier(self) -> str | tuple[str, str]:
        """By what a catalogue knows it."""
        return (self.english, self.plural) if self.plural else self.english


def phrases() -> Iterator[Phrase]:
    """Yield every phrase of the program and of the plugins that come with it, file by file."""
    for folder in _CODE:
        for path in sorted((ROOT / folder).rglob("*.py")):
            yield from phrases_of_code(path.read_text(encoding="utf-8"), str(path.relative_to(ROOT)))
    for path in sorted((ROOT / _CATALOGUES).glob("*.yaml")):
        read = read_measurements if path.name == _MEASUREMENTS else read_catalogue
        entries = read(path.read_bytes(), path.name, lambda name: (ROOT / _CATALOGUES / name).read_bytes())
        for words in _words_in(entries):
            if _is_translated(words.en) and words.de is None:
                yield Phrase(words.en, words.context, words.plural, str(path.relative_to(ROOT)))


def phrases_of_code(source: str, file: str) -> Iterator[Phrase]:
    """Yield the phrases of a module: the first argument of each `Words`, where it brings no translation."""
    for call in ast.walk(ast.parse(source)):
        if not (isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id == "Words"):
            continue
        stated = {each.arg: _text_of(each.value) for each in call.keywords}
        english = _text_of(call.args[0]) if call.args else stated.get("en")
        if english and len(call.args) < 2 and "de" not in stated and _is_translated(english):
            yield Phrase(english, stated.get("context") or "", stated.get("plural") or "", file)


def template() -> Catalog:
    """Return a catalogue of all phrases, without translations."""
    catalogue = _catalogue(None)
    for each in phrases():
        catalogue.add(
            each.identifier,
            locations=[(each.file, None)],
            context=each.context or None,
            flags=["python-brace-format"] if "{" in each.english else [],
        )
    return catalogue


def updated(content: bytes, language: str, asked: Catalog) -> Catalog:
    """Return what a catalogue comes to be: the phrases that are asked for, with the translations it has."""
    catalogue = _catalogue(language)
    known = read_po(io.BytesIO(content), locale=language)
    for message in asked:
        if message.id:
            had = known.get(message.id, message.context)
            catalogue.add(
                message.id,
                had.string if had else message.string,
                locations=message.locations,
                flags=message.flags,
                auto_comments=message.auto_comments,
                user_comments=had.user_comments if had else (),
                context=message.context,
            )
    return catalogue


def files_of(catalogue: Catalog) -> Mapping[str, bytes]:
    """Return the two files of a catalogue by their names."""
    po, mo = io.BytesIO(), io.BytesIO()
    write_po(po, catalogue, width=_WIDTH, include_lineno=False)
    write_mo(mo, catalogue)
    return {"zlmreport.po": po.getvalue(), "zlmreport.mo": mo.getvalue()}


def folder_of(language: Language) -> Path:
    """Return where the files of a language lie."""
    return TRANSLATIONS / language.value / "LC_MESSAGES"


def _catalogue(language: str | None) -> Catalog:
    return Catalog(
        language,
        project="zlmreport",
        version="1",
        header_comment="# Translations of zlmreport.",
        creation_date=_DATED,
        revision_date=_DATED,
        last_translator="the authors of zlmreport",
        language_team="none",
        msgid_bugs_address="none",
        fuzzy=False,
    )


def _is_translated(english: str) -> bool:
    return not _ALIKE.fullmatch(english)


def _text_of(node: ast.expr) -> str | None:
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, str) else None


def _words_in(value: Any) -> Iterator[Words]:
    """Yield all words within entries of a catalogue of effects, in their order."""
    if isinstance(value, Words):
        yield value
    elif isinstance(value, Mapping):
        for each in value.values():
            yield from _words_in(each)
    elif isinstance(value, tuple | list):
        for each in value:
            yield from _words_in(each)
    elif isinstance(value, BaseModel):
        for name in type(value).model_fields:
            yield from _words_in(getattr(value, name))
    elif is_dataclass(value):
        for each in fields(value):
            yield from _words_in(getattr(value, each.name))


def main() -> None:
    """Write the catalogues of all languages but English."""
    asked = template()
    for language in Language:
        if language is Language.ENGLISH:
            continue
        folder = folder_of(language)
        kept = (folder / "zlmreport.po").read_bytes()
        catalogue = updated(kept, language.value, asked)
        for name, content in files_of(catalogue).items():
            (folder / name).write_bytes(content)


if __name__ == "__main__":
    main()
