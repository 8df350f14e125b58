"""The numbers of the page on the error model are those of the code."""

from __future__ import annotations

import re

import pytest

from documents.pages import DOCS
from zlmreport.model.diagnosis import diagnosis, evidence, null_distribution, steps
from zlmreport.model.fitting import noise, repeats

_PAGE = " ".join((DOCS / "explanation" / "error-model.md").read_text(encoding="utf-8").split())


@pytest.mark.parametrize(
    ("sentence", "value"),
    [
        (r"the whole contest is held (\d+) times more", null_distribution.TRIALS),
        (r"exceeds by chance in (\d+) % of these tests", 100 * null_distribution.LEVEL),
        (r"by more than ([\d.]+) robust standard deviations", repeats._LIMIT),
        (r"The first has a level of (\d+) %", 100 * repeats._LEVEL),
        (r"must surpass them by (\d+) units", evidence.NAMED),
        (r"A difference of less than (\d+) units", evidence.MENTION),
        (r"each further name must bring (\d+) units more", evidence.FURTHER),
        (r"beyond the noise floor by at least (\d+) %", 100 * diagnosis.EXPLAINS),
    ],
)
def test_a_number_on_the_page_is_that_of_the_code(sentence: str, value: float) -> None:
    found = re.search(sentence, _PAGE)
    assert found
    assert float(found[1]) == pytest.approx(value)


def test_shared_scatter_is_held_to_half_of_that_of_single_readings() -> None:
    assert {max(ratios) for ratios in noise._RATIOS.values()} == {0.25}  # variances
    assert "half the scatter of a single reading" in _PAGE


def test_the_names_together_hold_three_quarters_of_the_evidence() -> None:
    assert evidence.EXPLAINED == 0.75
    assert "at least three quarters of all evidence" in _PAGE


def test_the_number_of_steps_is_that_of_the_code() -> None:
    assert steps._MOST_STEPS == 3
    assert "up to three times" in _PAGE
