"""Names in a row are said one way: commas between them, and a word before the last."""

import pytest

from zlmreport.language import list_alternatives, list_in_words
from zlmreport.plugin import Language, Words, listed

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
