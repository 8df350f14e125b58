"""Numbers that the explanations state without an example are right."""

from __future__ import annotations

import math
import re
from statistics import NormalDist

import pytest

from documents.pages import DOCS

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
