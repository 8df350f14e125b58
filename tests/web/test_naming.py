"""A page in German calls effects by what they are, not by identifiers, which are English words."""

from __future__ import annotations

import pytest
from starlette.testclient import TestClient

from installed import registry
from processes import awaited
from zlmreport.plugin import Language
from zlmreport.web.naming import Naming


@pytest.fixture
def german() -> Naming:
    return Naming.of(registry().effects, Language.GERMAN)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("offset", "Nullpunktverschiebung"),
        (
            "Fehlender Einfluss: backlash; er erklärt den Rest.",
            "Fehlender Einfluss: Umkehrspanne; er erklärt den Rest.",
        ),
        ("scale-joint-2", "Stoß zweier Teilmaßstäbe 2"),
        ("backlash.lost_motion festgehalten", "Umkehrspanne: Umkehrspanne der ganzen Achse festgehalten"),
        ("backlash-bow-like", "backlash-bow-like"),
        ("Offsetdruck", "Offsetdruck"),
    ],
)
def test_identifiers_are_replaced_by_titles_and_other_words_stay(
    german: Naming, text: str, named: str
) -> None:
    titles = {each.identifier: each.title.in_language(Language.GERMAN) for each in registry().effects}
    assert german.name_in(text) == named.replace("Stoß zweier Teilmaßstäbe", titles["scale-joint"])


def test_a_page_in_english_has_the_words_of_the_job() -> None:
    assert Naming.of(registry().effects, Language.ENGLISH).name_in("scale-error") == "scale-error"


@pytest.mark.long
def test_no_identifier_is_read_on_the_german_page(browser: TestClient) -> None:
    found = awaited(lambda: browser.get("/api/diagnosis?lang=de").json().get("diagnosis"))
    job = browser.get("/api/job?lang=de").json()
    fall = browser.get("/api/results?lang=de").json()["fall"]
    read = [
        found["statement"],
        *found["remarks"],
        *found["notExcludedNames"],
        *(name for each in found["hidden"] for name in (*each["names"], each["reason"])),
        *(each[key] for each in found["candidates"] for key in ("name", "explains", "tell", "remedy")),
        *(each["name"] for each in (*job["effects"], *job["others"], *fall["rows"])),
    ]
    named = Naming.of(registry().effects, Language.GERMAN)
    assert [text for text in read if named.name_in(text) != text] == []
    assert "Periodischer Steigungsfehler der Spindel" in found["statement"]
