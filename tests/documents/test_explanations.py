"""Numbers that the explanations state are right: of standards, of the error model and of the methods."""

from __future__ import annotations

import math
import re
from statistics import NormalDist

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
from zlmreport.model.planning.methods import Method

_PAGE = (DOCS / "explanation" / "what-the-standards-compute.md").read_text(encoding="utf-8")
_SHARES = re.findall(r"^\| (\d+) \| ([\d.]+) % \| ([\d.]+) % \|$", _PAGE, re.MULTILINE)


def _share_within(limit: float, degrees_of_freedom: int) -> float:
    """Return the probability of Student's distribution between ± limit, by Simpson's rule."""
    half = (degrees_of_freedom + 1) / 2
    density = math.exp(math.lgamma(half) - math.lgamma(degrees_of_freedom / 2)) / math.sqrt(
        degrees_of_freedom * math.pi
    )
    steps = 1000
    values = [(1 + (limit * step / steps) ** 2 / degrees_of_freedom) ** -half for step in range(steps + 1)]
    total = values[0] + values[-1] + 4 * sum(values[1:-1:2]) + 2 * sum(values[2:-1:2])
    return 2 * density * total * limit / steps / 3


@pytest.mark.parametrize(("readings", "two", "three"), _SHARES)
def test_the_share_of_further_readings_within_the_limits(readings: str, two: str, three: str) -> None:
    n = int(readings)
    for k, stated in ((2, two), (3, three)):
        share = _share_within(k / math.sqrt(1 + 1 / n), n - 1)
        assert f"{100 * share:.1f}" == stated


def test_the_shares_are_stated_for_common_numbers_of_readings() -> None:
    assert [readings for readings, _, _ in _SHARES] == ["5", "7", "10"]


def test_the_shares_of_a_known_normal_distribution() -> None:
    normal = NormalDist()
    assert f"{100 * (2 * normal.cdf(3) - 1):.2f} %" in _PAGE
    assert f"± {normal.inv_cdf(1 - 0.005 / 2):.3f}σ" in _PAGE.replace("\n", "")


_ON_ERROR_MODEL = " ".join((DOCS / "explanation" / "error-model.md").read_text(encoding="utf-8").split())


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
    found = re.search(sentence, _ON_ERROR_MODEL)
    assert found
    assert float(found[1]) == pytest.approx(value)


def test_shared_scatter_is_held_to_half_of_that_of_single_readings_and_of_runs_to_a_quarter() -> None:
    largest = {source: max(ratios) ** 0.5 for source, ratios in noise._RATIOS.items()}  # of variances
    assert largest.pop(noise.NoiseSource.RUN) == pytest.approx(0.25, abs=0.01)
    assert set(largest.values()) == {0.5}
    assert (
        "half the scatter of a single reading, and a quarter of it where a whole run is displaced"
        in _ON_ERROR_MODEL
    )


def test_a_blunder_stands_off_by_the_limit_of_the_code() -> None:
    found = re.search(r"by more than ([\d.]+) robust standard deviations", _ON_ERROR_MODEL)
    assert found
    assert float(found[1]) == blunders._LIMIT


_ON_METHODS = (DOCS / "explanation" / "positioning-methods.md").read_text(encoding="utf-8")


def _table(part: str) -> dict[str, dict[str, float]]:
    """Return the numbers of a generated table, by its first column and its heading; dashes are left out."""
    text = _ON_METHODS.partition(f"<!-- generated: {part} -->")[2].partition("<!-- end")[0]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.strip().splitlines()]
    heading, _, *lines = rows
    return {
        line[0]: {
            name: float(cell.replace("−", "-").removesuffix("%"))
            for name, cell in zip(heading[1:], line[1:], strict=True)
            if cell != "–"
        }
        for line in lines
    }


_DRIFT = _table("methods-drift")
_SIGHT = _table("methods-sight")


def test_every_method_is_compared_and_has_its_picture() -> None:
    assert set(_DRIFT) == set(Method)
    assert all(f"../images/sequence-{method.value}.svg" in _ON_METHODS for method in Method)


def test_linear_method_makes_scatter_of_drift() -> None:
    assert _DRIFT["linear"]["`R`, µm"] > 10 * _DRIFT["linear"]["`M`, µm"]


@pytest.mark.parametrize("method", ["pendulum", "quasi-pilgrim"])
def test_methods_target_by_target_make_a_systematic_deviation_of_drift(method: str) -> None:
    row = _DRIFT[method]
    assert row["`M`, µm"] > 4 * row["`R`, µm"]


def test_no_method_makes_drift_vanish() -> None:
    assert all(row["`A`, µm"] >= 10 for row in _DRIFT.values())


def test_pendulum_has_the_shortest_way_and_the_least_lost_motion_from_drift() -> None:
    assert min(_DRIFT, key=lambda method: _DRIFT[method]["Travel, m"]) == "pendulum"
    assert abs(_DRIFT["pendulum"]["`B_mean`, µm"]) < 0.2 < abs(_DRIFT["quasi-pilgrim"]["`B_mean`, µm"])


@pytest.mark.parametrize("effect", ["`thermal-growth`", "`thermal-drift`", "`scale-expansion`"])
def test_what_happens_in_time_wants_the_linear_method(effect: str) -> None:
    shares = _SIGHT[effect]
    assert shares["linear"] > 2 * max(shares["pendulum"], shares["quasi-pilgrim"])


def test_relaxation_on_the_way_wants_long_approaches() -> None:
    shares = _SIGHT["`reversal-relaxation`"]
    assert shares["pendulum"] < min(shares["linear"], shares["quasi-pilgrim"]) / 2


def test_what_depends_on_the_position_alone_is_seen_alike_by_all() -> None:
    assert len(set(_SIGHT["`screw-pitch`"].values())) == 1
