"""The benchmark of hidden effects of machines: what it hides, and how it counts what was said."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from machines_hidden import Case, run, simulated


def test_a_hidden_lag_is_named_and_measured_within_its_uncertainty() -> None:
    found = run(Case("both senses", "servo-mismatch", 2.0, seed=0))
    assert (found.outcome, found.named) == ("right", ["servo-mismatch"])
    assert abs(found.misses["T_X-T_Y"]) < 2.0


def test_no_two_cases_share_their_noise() -> None:
    circles = [
        simulated(Case("both senses", "squareness", rho, seed))[0].deviation
        for rho, seed in ((1.0, 0), (1.0, 1), (2.0, 0))
    ]
    assert all(
        abs(np.corrcoef(np.diff(one), np.diff(other))[0, 1]) < 0.5 for one, other in combinations(circles, 2)
    )


def test_what_one_of_two_could_do_as_well_is_named_by_neither() -> None:
    """In one sense two lateral plays are nearly unequal scales: whichever the readings favour by a hair."""
    found = run(Case("one sense", "scale-mismatch", 1.0, seed=2))
    assert (found.outcome, found.named) == ("tied", [])
    assert {found.first, *found.equals} == {"scale-mismatch", "lateral-play"}


@pytest.mark.long
def test_an_ideal_observer_is_asked_where_nothing_was_named() -> None:
    """Of a twentieth of the noise nobody sees anything; of a spike that got no name somebody would."""
    assert run(Case("both senses", "reversal-spikes", 0.05, 0)).ideal == ""
    assert run(Case("both senses", "reversal-spikes", 2.0, 4)).ideal == "truth"


def test_beside_a_stranger_what_the_model_has_is_estimated_within_its_uncertainty() -> None:
    found = run(Case("beside a stranger", "servo-mismatch", 1.0, 0))
    assert (found.outcome, found.ideal) == ("nameless", None)
    assert abs(found.misses["T_X-T_Y"]) < 2.0


@pytest.mark.parametrize(
    ("cause", "said", "outcome"),
    [
        ("squareness", {"verdict": "missing", "named": ["squareness"]}, "right"),
        ("squareness", {"verdict": "missing", "named": ["scale-mismatch"]}, "wrong name"),
        ("squareness", {"verdict": "missing", "first": "squareness", "equals": ["servo-mismatch"]}, "tied"),
        ("squareness", {"verdict": "missing", "first": "bow", "equals": ["cyclic-error"]}, "wrong tie"),
        ("squareness", {"verdict": "unexplained"}, "nameless"),
        ("squareness", {"verdict": "adequate"}, "nothing"),
        ("bow + squareness", {"verdict": "missing", "named": ["bow"]}, "in part"),
        ("nothing", {"verdict": "adequate"}, "right"),
        ("nothing", {"verdict": "unexplained"}, "alarm"),
        ("stranger", {"verdict": "unexplained"}, "nameless"),
        ("stranger", {"verdict": "missing", "named": ["bow"]}, "wrong name"),
    ],
)
def test_what_was_said_is_counted_by_what_was_hidden(
    cause: str, said: dict[str, object], outcome: str
) -> None:
    assert Case("both senses", cause, 1.0, 0, **said).outcome == outcome
