"""The benchmark of hidden effects of machines: what it hides, and how it counts what was said."""

from __future__ import annotations

import pytest

from machines_hidden import Case, run


def test_a_hidden_lag_is_named_and_measured_within_its_uncertainty() -> None:
    found = run(Case("both senses", "servo-mismatch", 2.0, seed=0))
    assert (found.outcome, found.named) == ("right", ["servo-mismatch"])
    assert found.miss is not None
    assert abs(found.miss) < 2.0


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
