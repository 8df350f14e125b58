"""A plan reads the same in both languages: the same sections, blocks and numbers, and no word left over."""

from __future__ import annotations

import math
import re
from itertools import pairwise

import pytest

from document.certificate.documents import lines_of
from model.planning.planned import WHOLE_PITCHES, plan_of_test, planned_job
from zlmreport.document.subjects.plan import plan_sections, say_size_of_plan
from zlmreport.plugin import Language

CHANGES = (("plan: {}", WHOLE_PITCHES),), (("method: linear", "method: pendulum"),)
#: What no German sentence has; names of effects, columns and methods are English in both.
_ENGLISH = re.compile(r"\b(the|and|for|cannot|beside|readings?|targets?|visible|assumed|once|times)\b")


def _said(changes: tuple[tuple[str, str], ...], language: Language) -> list[tuple[str, list[str]]]:
    sections = plan_sections(planned_job(*changes), plan_of_test(*changes), language)
    return [(each.title, [line for block in each.blocks for line in lines_of(block)]) for each in sections]


@pytest.mark.parametrize("changes", CHANGES, ids=["whole pitches", "pendulum"])
def test_both_languages_say_the_same(changes: tuple[tuple[str, str], ...]) -> None:
    english, german = (_said(changes, language) for language in (Language.ENGLISH, Language.GERMAN))
    assert [len(lines) for _, lines in english] == [len(lines) for _, lines in german]
    for (title, lines), (titel, zeilen) in zip(english, german, strict=True):
        assert title != titel
        left = [line for line in zeilen if _ENGLISH.search(line)]
        assert not left
        for one, other in zip(lines, zeilen, strict=True):
            assert re.findall(r"\d+", one.replace(".", "")) == re.findall(
                r"\d+", other.replace(",", "").replace(".", "")
            )


def test_a_plan_says_how_large_it_is() -> None:
    planned = plan_of_test()
    assert say_size_of_plan(planned).in_language(Language.ENGLISH) == (
        f"{len(planned.proposal.plan.targets)} targets, {len(planned.visits)} readings"
    )


def test_the_targets_are_listed_in_order() -> None:
    (_, lines), *_ = _said((), Language.ENGLISH)
    targets = [float(line.split(": ")[1]) for line in lines if re.fullmatch(r" *\d+: [−\d.]+", line)]
    assert len(targets) == len(plan_of_test().proposal.plan.targets)
    assert all(one < other for one, other in pairwise(targets))


def test_angles_of_a_plan_are_written_as_they_are() -> None:
    """Steps of a turn are no round numbers of radians, and a sign of an angle touches its number."""
    of_a_turn = (
        (
            "axis: {name: X, travel: [0, 600], screw_pitch: 10}",
            "axis: {name: C, kind: rotary, travel: [0, 360]}",
        ),
        ("feed: 3000", "feed: 2000"),
    )
    planned = plan_of_test(*of_a_turn)
    lines = [line for _, lines in _said(of_a_turn, Language.ENGLISH) for line in lines]
    assert math.degrees(planned.travelled) == pytest.approx(3700)
    assert any(line.startswith("3700° of travel") for line in lines)
    assert not [line for line in lines if re.search(r"\d ″", line)]
