"""What the page on positioning methods says of its generated numbers holds for them."""

from __future__ import annotations

import pytest

from documents.pages import DOCS
from zlmreport.model.planning.methods import Method

_PAGE = (DOCS / "explanation" / "positioning-methods.md").read_text(encoding="utf-8")


def _table(part: str) -> dict[str, dict[str, float]]:
    """Return the numbers of a generated table, by its first column and its heading; dashes are left out."""
    text = _PAGE.partition(f"<!-- generated: {part} -->")[2].partition("<!-- end")[0]
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
    assert all(f"../images/sequence-{method.value}.svg" in _PAGE for method in Method)


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
