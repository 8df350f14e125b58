"""The numbers of the page on the error model are those of the code."""

from __future__ import annotations

import re

import pytest

from documents.pages import DOCS
from zlmreport.model.diagnosis import (
    believing,
    candidate,
    diagnosis,
    families,
    finding,
    nameless,
    null_distribution,
    set_costs,
)
from zlmreport.model.fitting import blunders, noise, repeats

_PAGE = " ".join((DOCS / "explanation" / "error-model.md").read_text(encoding="utf-8").split())


@pytest.mark.parametrize(
    ("sentence", "value"),
    [
        (r"forms and curves are tried (\d+) times more", null_distribution.TRIALS),
        (r"that each exceeds by chance in (\d+) % of these tests", 100 * null_distribution.LEVEL),
        (r"if χ²/dof is above ([\d.]+) by more than chance", diagnosis.LARGEST_RATIO),
        (r"The first has a level of (\d+) %", 100 * repeats._LEVEL),
        (r"Each effect pays (\d+) units of 2·ln for being one of some thirty", families.PRICE),
        (r"for being one of some thirty, each form and each curve (\d+)", nameless.PRICE),
        (r"in one place within odds of 20 to 1 \((\d+) units\)", believing.TOLD_APART),
        (r"something without a name instead, and lacks less than (\d+) units", believing.TOLD_APART),
        (r"Of those within (\d+) units the one stands first", believing.MENTION),
        (r"A value beyond what is usual costs (\d+) units", set_costs.UNUSUAL),
        (
            r"a hundredth of the misfit, and ([\d.]+) % of what the model explains",
            100 * finding._INEXACT_MODEL,
        ),
        (r"beyond the noise floor by at least (\d+) %", 100 * candidate.EXPLAINS),
    ],
)
def test_a_number_on_the_page_is_that_of_the_code(sentence: str, value: float) -> None:
    found = re.search(sentence, _PAGE)
    assert found
    assert float(found[1]) == pytest.approx(value)


def test_shared_scatter_is_held_to_half_of_that_of_single_readings_and_of_runs_to_a_quarter() -> None:
    largest = {source: max(ratios) ** 0.5 for source, ratios in noise._RATIOS.items()}  # of variances
    assert largest.pop(noise.NoiseSource.RUN) == pytest.approx(0.25, abs=0.01)
    assert set(largest.values()) == {0.5}
    assert "half the scatter of a single reading, and a quarter of it where a whole run is displaced" in _PAGE


def test_a_blunder_stands_off_by_the_limit_of_the_code() -> None:
    found = re.search(r"by more than ([\d.]+) robust standard deviations", _PAGE)
    assert found
    assert float(found[1]) == blunders._LIMIT
