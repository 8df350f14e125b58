"""The benchmark of several causes: the axes that it draws, and how it counts."""

from __future__ import annotations

import numpy as np
import pytest

from hidden_effects.several import Outcome, drawn_axis, report


@pytest.mark.long
def test_the_same_number_draws_the_same_axis() -> None:
    one, other = (drawn_axis(3, with_stranger=True) for _ in range(2))
    assert one.causes == other.causes
    np.testing.assert_array_equal(one.observed.deviation, other.observed.deviation)


@pytest.mark.long
def test_an_axis_has_two_to_four_causes_of_the_size_that_is_stated() -> None:
    for number in range(6):
        drawn = drawn_axis(number, with_stranger=False)
        assert 2 <= len(drawn.causes) <= 4
        assert drawn.stranger is None
        assert np.std(drawn.observed.deviation) > 1.2 * drawn.sigma


def test_a_stranger_stands_beside_the_causes() -> None:
    assert drawn_axis(2, with_stranger=True).stranger is not None


def test_names_that_no_cause_has_are_wrong_and_the_whole_set_is_counted() -> None:
    drawn = drawn_axis(1, with_stranger=False)
    whole = Outcome(drawn, drawn.causes, {}, 1.0, remainder=False, is_placed=False, seconds=2.0)
    first, *_ = drawn.causes
    half = Outcome(drawn, (first, "no such effect"), {}, 3.0, remainder=True, is_placed=False, seconds=4.0)
    assert (half.found, half.wrong) == ((first,), ("no such effect",))
    causes = len(drawn.causes)
    last = report([whole, half]).splitlines()[-2]
    assert last.startswith(f"2 axes: {causes + 1} of {2 * causes} causes found, 1 wrong, the whole set in 1,")
    assert "down to 1.15 σ in 1, something left without a name in 1" in last
    assert "3.0 s of CPU" in last


def test_a_cause_that_is_named_as_an_equal_of_what_was_added_is_no_wrong_name_beyond_equals() -> None:
    drawn = drawn_axis(1, with_stranger=False)
    first, *others = drawn.causes
    equals = {"its twin": frozenset({first})}
    outcome = Outcome(
        drawn, ("its twin", *others), equals, 1.0, remainder=False, is_placed=False, seconds=2.0
    )
    assert outcome.wrong == ("its twin",)
    assert outcome.wrong_beyond_equals == ()
    assert outcome.as_equals == drawn.causes


def test_what_is_left_is_placed_where_the_stranger_is_largest() -> None:
    drawn = drawn_axis(2, with_stranger=True)
    assert drawn.beside is not None
    assert abs(drawn.beside.mean()) < 1e-9 * np.abs(drawn.beside).max()
    last = report([Outcome(drawn, (), {}, 2.0, remainder=True, is_placed=True, seconds=1.0)])
    assert "where the stranger is in 1 of 1" in last
