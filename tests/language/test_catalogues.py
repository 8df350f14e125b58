"""Every phrase of the program is in every catalogue, once, with the places of the English one."""

from __future__ import annotations

import ast
import importlib.util
import re
import sys
from collections.abc import Iterator
from functools import cache
from gettext import GNUTranslations
from itertools import pairwise
from pathlib import Path
from types import ModuleType

import pytest

from zlmreport.language import find_accepted_language
from zlmreport.plugin import Language, PartRow, Words, named, same_in_all_languages

_TOOL = Path(__file__).parents[2] / "docs/generate/translations.py"
OTHERS = [each for each in Language if each is not Language.ENGLISH]
_PLACE = re.compile(r"\{(\w*)\}")
_ROOT = Path(__file__).parents[2]
#: A sign before which French has a space; and one at the end of what stands before a place.
_PARTING, _PARTED = re.compile(r"[:;?!]"), re.compile(r"[:;] ?$")


@cache
def tool() -> ModuleType:
    """Return the program that makes the catalogues."""
    pytest.importorskip("babel")
    spec = importlib.util.spec_from_file_location("translations", _TOOL)
    assert spec is not None
    assert spec.loader is not None
    sys.modules["translations"] = module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@cache
def asked_for() -> set[tuple[str, str | tuple[str, str]]]:
    """Return context and English text of each phrase of the code."""
    return {(each.context or "", each.id) for each in tool().template() if each.id}


@cache
def kept(language: Language) -> bytes:
    return (tool().folder_of(language) / "zlmreport.po").read_bytes()


@cache
def messages(language: Language) -> list[tuple[str, tuple[str, ...], tuple[str, ...]]]:
    """Return context, English texts and translated texts of each message of a catalogue."""
    read = tool().read_po(kept(language).splitlines(keepends=True), locale=language.value)
    return [(each.context or "", _texts(each.id), _texts(each.string)) for each in read if each.id]


def _texts(value: str | tuple[str, ...]) -> tuple[str, ...]:
    return (value,) if isinstance(value, str) else tuple(value)


@pytest.mark.parametrize("language", OTHERS)
def test_a_catalogue_has_the_phrases_of_the_code_and_no_other(language: Language) -> None:
    asked = asked_for()
    known = {(context, ids[0] if len(ids) == 1 else ids) for context, ids, _ in messages(language)}
    assert known - asked == set(), "nobody says these any more: python docs/generate/translations.py"
    assert asked - known == set(), "these are new: python docs/generate/translations.py"


@pytest.mark.parametrize("language", OTHERS)
def test_every_phrase_is_translated(language: Language) -> None:
    assert [ids for _, ids, texts in messages(language) if not all(texts)] == []


@pytest.mark.parametrize("language", OTHERS)
def test_a_translation_has_no_place_that_the_phrase_has_not(language: Language) -> None:
    def places(texts: tuple[str, ...]) -> set[str]:
        return {place for text in texts for place in _PLACE.findall(text)}

    assert [ids for _, ids, texts in messages(language) if not places(texts) <= places(ids)] == []


@pytest.mark.parametrize("language", OTHERS)
def test_a_run_reads_what_translators_wrote(language: Language) -> None:
    with (tool().folder_of(language) / "zlmreport.mo").open("rb") as file:
        compiled = GNUTranslations(file)
    for context, phrases, texts in messages(language):
        if len(phrases) == 1:
            found = compiled.pgettext(context, *phrases) if context else compiled.gettext(*phrases)
        else:  # asked as the program asks: to the singular alone Python 3.11.2 has no answer
            found = compiled.npgettext(context, *phrases, 1) if context else compiled.ngettext(*phrases, 1)
        assert found == texts[0], "python docs/generate/translations.py"


def test_a_plugin_may_bring_its_own_translation() -> None:
    own = Words("Whirl", "Wirbel", fr="Tourbillon")
    assert [own.in_language(each) for each in Language] == ["Whirl", "Wirbel", "Tourbillon", "Whirl", "Whirl"]


def test_what_no_catalogue_has_is_said_in_english() -> None:
    assert Words("Flibbertigibbet {n}").given(n=2.5).in_language(Language.GERMAN) == "Flibbertigibbet 2,5"


def test_an_empty_phrase_stays_empty() -> None:
    assert Words("").in_language(Language.GERMAN) == ""


@pytest.mark.parametrize(("number", "text"), [(1, "1 Durchlauf"), (5, "5 Durchläufe"), (0, "0 Durchläufe")])
def test_a_number_chooses_between_one_and_more(number: int, text: str) -> None:
    runs = Words("{number} run", plural="{number} runs").given(number=number)
    assert runs.in_language(Language.GERMAN) == text


def test_alike_english_words_are_told_apart_by_their_context() -> None:
    found = [Words("met", context=context).in_language(Language.GERMAN) for context in ("", "limit")]
    assert found == ["erfüllt", "eingehalten"]


def test_a_users_text_is_never_translated() -> None:
    assert same_in_all_languages("Certificate").in_language(Language.GERMAN) == "Certificate"


@pytest.mark.parametrize(
    ("asked", "language"),
    [("fr-CH, de;q=0.8", Language.FRENCH), ("pl, it", Language.ITALIAN), ("pl", None), ("", None)],
)
def test_a_browser_is_answered_in_the_first_language_that_there_is(
    asked: str, language: Language | None
) -> None:
    assert find_accepted_language(asked) is language


def test_in_french_no_line_begins_with_a_sign_that_has_a_space_before_it() -> None:
    parted = re.compile(r" [:;?!»]|« ")
    found = [text for *_, texts in messages(Language.FRENCH) for text in texts if parted.search(text)]
    assert found == []


@pytest.mark.parametrize(
    ("language", "text"), [(Language.FRENCH, "A\N{NO-BREAK SPACE}: b"), (Language.GERMAN, "A: b")]
)
def test_a_name_is_parted_from_what_is_said_of_it_as_in_the_language(language: Language, text: str) -> None:
    assert named("A", same_in_all_languages("b")).in_language(language) == text


@pytest.mark.parametrize(
    ("language", "text"), [(Language.FRENCH, "a\N{NO-BREAK SPACE}; 2,5 b"), (Language.GERMAN, "a; 2,5 b")]
)
def test_parts_of_a_line_are_parted_as_in_the_language(language: Language, text: str) -> None:
    assert PartRow(("a", Words("{n} b").given(n=2.5))).in_language(language) == text


def _joined_by_hand(code: str) -> Iterator[str]:
    """Yield what is said in some language and has a sign beside it that stands in the code."""
    for each in ast.walk(ast.parse(code)):
        if not isinstance(each, ast.JoinedStr):
            continue
        text = ast.unparse(each)
        said = [_is_said(part) for part in each.values]
        for (first, is_first), (second, is_second) in pairwise(zip(each.values, said, strict=True)):
            behind = is_first and isinstance(second, ast.Constant) and _PARTING.match(str(second.value))
            before = is_second and isinstance(first, ast.Constant) and _PARTED.search(str(first.value))
            if behind or before:
                yield text


def _is_said(part: ast.expr) -> bool:
    """Whether a part of a text is said in a language that is not English alone."""
    calls = (each.func for each in ast.walk(part) if isinstance(each, ast.Call))
    names = {each.attr if isinstance(each, ast.Attribute) else getattr(each, "id", "") for each in calls}
    return bool(names & {"say", "in_language"}) and "ENGLISH" not in ast.unparse(part)


def test_no_sign_that_french_parts_is_joined_by_hand() -> None:
    found = {}
    for folder in ("src/zlmreport", "plugins"):
        for path in (_ROOT / folder).rglob("*.py"):
            # What else a terminal prints is English.
            if path.parent.name != "cli" or path.name == "verify.py":
                found[path.name] = list(_joined_by_hand(path.read_text(encoding="utf-8")))
    assert {name: texts for name, texts in found.items() if texts} == {}


def test_what_is_joined_by_hand_is_found() -> None:
    code = 'f"{say(title)}: {name}", f"{name}; {words.in_language(language)}", f"{name}: {say(title)}"'
    assert len(list(_joined_by_hand(code))) == 3
    assert list(_joined_by_hand('f"{words.in_language(Language.ENGLISH)}: {name}", f"{a}: {b}"')) == []
