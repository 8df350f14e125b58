"""Counts and names in a row are said one way in every language."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest

from environments import ROOT
from language.test_catalogues import OTHERS, tool
from zlmreport.evaluation.checks import readings_in_words
from zlmreport.fleet import notices, overview_words
from zlmreport.language import list_alternatives, list_in_words
from zlmreport.plugin import Language, Words, listed
from zlmreport.plugin.standard import positions_in_words, runs_in_words

#: Names of what is counted.
_THINGS = (
    "axes|calibrations|certificates|cycles|faces|files|intervals|jobs|lines|machines|measurements|minutes|"
    "moments|pages|parts|points|positions|readings|runs|slices|targets|tests|turns|values|visits"
)
_COUNTED = re.compile(r"\{\w+\} (?:\w+ )?(?:" + _THINGS + r")\b")
_MESSAGE_COUNTS = re.compile(r"\{.+\} (?:" + _THINGS + r")\b")
#: How phrases begin that are never said of one, or have another for one.
_NEVER_OF_ONE = (
    "At least {number} positions on each line",
    "At least {number} readings on each line",
    "Path of the probe over {faces} faces",
    "The budget below was propagated",
    "The model is held against {kept} of the {all}",
    "The {count} readings that are evaluated are not printed",
    "the ledger knows none of the certificates in {folder}",
    "{name}: not logged at the",  # six at least
    "{name}: the same in every digit over {hours} h, at {count} readings",
    "{column} stands still during the last {count} readings",
    "{count} readings one after another are the same, digit for digit",  # seven at least
    "{gone} of {before} jobs are gone since the last night; look whether that is meant",
    "{readings} readings were averaged",
    "at least {least} target positions are needed; there are {found}",
    "at least {least} runs are needed; there are {found}",
    "take {count} targets with random fractions",
    "measure {runs} runs",
    "{value} readings",
    "{n} positions per metre",
    "all {total} readings",
    "{count} readings chosen",
    "{count} readings were set aside and did not enter the results",
    "{count} more readings lie as far from the others of their targets",
    "{count} measurements of {machine}",
    "{count} files; unless the job says otherwise",
    "{count} turns of radius {radius} mm",
    "{count} of {all} readings is missing; nothing was filled in",
    "{count} of {all} readings are missing; nothing was filled in",
    "line of {count} points",
    "{duration} {unit}, read at {count} moments",
    "{duration} {unit}, as averages over {count} intervals",
    "{count}, averages of {readings} readings",
)
#: How messages begin that are never said of one, have another for one, or count nothing.
_MESSAGES_NEVER_OF_ONE = (
    "{axis} runs beside",
    "{axis} turns",
    "{count} readings",
    "{count} targets with fractions",
    "{count} values from",
    "{found.keys.kind} axes",
    "{full} readings, and there are",
    "{jobs} jobs are",
    "{len(exclusions)} readings",
    "{len(lines)} lines",
    "{len(path.probings)} points",
    "{len(plane.lines)} lines",
    "{len(readings.deviation)} readings do not determine",
    "{motion.runs} runs",
    "{path.suffix} files",
    "{runs} runs would be",
    "{runs} runs; is the target",
    "{suffix} files",
)


@pytest.mark.parametrize(
    ("phrase", "one", "many"),
    [
        (runs_in_words, "1 run", "2 runs"),
        (positions_in_words, "1 position", "2 positions"),
        (readings_in_words, "1 reading", "2 readings"),
    ],
)
def test_what_is_counted_is_in_the_singular_for_one(phrase: object, one: str, many: str) -> None:
    assert callable(phrase)
    assert [phrase(number).in_language(Language.ENGLISH) for number in (1, 2)] == [one, many]


def _said(words: Words, number: int, language: Language = Language.ENGLISH, **values: str | int) -> str:
    return words.given(number=number, **values).in_language(language)


def test_an_overview_of_a_single_axis_says_axis() -> None:
    assert _said(overview_words.FOUND, 1, shown=1) == "1 of 1 axis"
    assert _said(overview_words.FOUND, 3, shown=1) == "1 of 3 axes"
    assert _said(overview_words.FOUND, 1, Language.GERMAN, shown=1) == "1 von 1 Achse"
    assert _said(overview_words.AT_WORK, 1, began="2026-11-20") == "2026-11-20, at work: 1 job so far"
    assert _said(overview_words.AS_DRAFTS, 1) == "1 as a draft"
    one = {"symbol": "A", "first": "2026-11-20", "last": "2026-11-20", "value": "4.2 µm"}
    assert _said(overview_words.ALTERNATIVE, 1, **one) == "1 value of A, of 2026-11-20: 4.2 µm."


@pytest.mark.parametrize(
    ("left", "due", "said"),
    [
        (1, 1, "before its only job; it is for the next night"),
        (1, 3, "before 1 of 3 jobs; it is for the next night"),
        (2, 3, "before 2 of 3 jobs; they are for the next night"),
    ],
)
def test_a_night_says_of_a_single_job_that_it_is_left(left: int, due: int, said: str) -> None:
    (notice,) = notices.say_left(left, due)
    assert notice.text.in_language(Language.ENGLISH).endswith(said)


def test_every_phrase_that_counts_has_words_for_one() -> None:
    counted = {each.english for each in tool().phrases() if not each.plural and _COUNTED.search(each.english)}
    assert {each for each in counted if not each.startswith(_NEVER_OF_ONE)} == set()


def _messages(path: Path) -> Iterator[str]:
    """Yield what stands in the f-strings of a module from each computed number on."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.JoinedStr):
            for value, behind in pairwise(node.values):
                if not isinstance(value, ast.FormattedValue) or not isinstance(behind, ast.Constant):
                    continue
                said = ast.unparse(value.value)
                if not said.rpartition(".")[2].isupper():
                    yield f"{{{said}}}{behind.value}"


@pytest.mark.parametrize(
    "folder", ["src/zlmreport", "plugins/zlmreport_plugins", "plugins/zlmreport_step_gauge"]
)
def test_every_message_that_counts_has_words_for_one(folder: str) -> None:
    """A message is English alone: `count_in_words`, at the door `counted`, says one thing and two things."""
    found = {
        message
        for path in (ROOT / folder).rglob("*.py")
        for message in _messages(path)
        if _MESSAGE_COUNTS.match(message)
    }
    assert {each for each in found if not each.startswith(_MESSAGES_NEVER_OF_ONE)} == set()


@pytest.mark.parametrize("language", OTHERS)
def test_a_counted_phrase_has_all_its_forms(language: Language) -> None:
    of_one = _said(Words("{number} run", plural="{number} runs"), 1, language)
    assert of_one != _said(Words("{number} run", plural="{number} runs"), 2, language)


EFFECTS = [Words("Backlash"), Words("Squareness"), Words("Vibration")]


@pytest.mark.parametrize(
    ("language", "all_of_them", "one_of_them"),
    [
        (Language.ENGLISH, "Backlash, Squareness and Vibration", "Backlash, Squareness or Vibration"),
        (
            Language.GERMAN,
            "Umkehrspiel, Rechtwinkligkeit und Schwingung",
            "Umkehrspiel, Rechtwinkligkeit oder Schwingung",
        ),
        (
            Language.FRENCH,
            "Jeu à l’inversion, Perpendicularité et Vibration",
            "Jeu à l’inversion, Perpendicularité ou Vibration",
        ),
    ],
)
def test_three_names_have_one_and(language: Language, all_of_them: str, one_of_them: str) -> None:
    assert list_in_words(EFFECTS).in_language(language) == all_of_them
    assert list_alternatives(EFFECTS).in_language(language) == one_of_them


def test_two_names_have_no_comma_and_one_is_said_alone() -> None:
    assert list_in_words(EFFECTS[:2]).in_language(Language.ENGLISH) == "Backlash and Squareness"
    assert list_in_words(["A"]).in_language(Language.GERMAN) == "A"


def test_names_that_are_the_same_in_all_languages_stand_in_a_row() -> None:
    assert list_in_words(["A", "B", "C"]).in_language(Language.GERMAN) == "A, B und C"


@pytest.mark.parametrize(
    ("names", "said"), [([], ""), (["X"], "X"), (["X", "Y"], "X and Y"), (["X", "Y", "Z"], "X, Y and Z")]
)
def test_a_message_lists_names_alike(names: list[str], said: str) -> None:
    assert listed(names) == said
