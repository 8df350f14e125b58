"""Two results files, value by value."""

from __future__ import annotations

from typing import Any

import pytest

from zlmreport.verification.findings import VerificationVerdict
from zlmreport.verification.values import compare


def results(value: Any = 22.0, **model: Any) -> dict[str, Any]:
    parameters = [{"symbol": "A", "name": "accuracy", "value": value}, {"symbol": "R", "value": 3.0}]
    return {
        "evaluations": [
            {"standard": "iso", "parameters": parameters, "positions": [{"target": 0.0, "mean": 1.0}]}
        ],
        "model": model,
    }


def differing(stated: Any, recomputed: Any, *, same_programs: bool = True) -> dict[str, tuple[Any, Any]]:
    return {
        "/".join(value.path): (value.stated, value.recomputed)
        for value in compare(stated, recomputed, same_programs=same_programs)
        if value.verdict is VerificationVerdict.DIFFERS
    }


A = "evaluations/iso/parameters/A"


def test_equal_files_agree_in_every_value() -> None:
    found = compare(results(), results(), same_programs=True)
    assert len(found) == 8
    assert {value.verdict for value in found} == {VerificationVerdict.HOLDS}


@pytest.mark.parametrize("value", [22.0 * (1 + 5e-10), 22, 22.0 - 1e-10])
def test_the_last_digits_of_another_processor_are_no_difference(value: float) -> None:
    assert differing(results(value), results()) == {}


@pytest.mark.parametrize("value", [22.0 * (1 + 2e-9), 22.1, -22.0, "22.0", True, None])
def test_any_other_value_differs(value: Any) -> None:
    assert differing(results(value), results()) == {f"{A}/value": (value, 22.0)}


def test_fitted_parameters_agree_within_what_an_iteration_does() -> None:
    assert differing(results(value_of_fit=1.0 + 5e-7), results(value_of_fit=1.0)) == {}
    assert differing(results(value_of_fit=1.0 + 2e-6), results(value_of_fit=1.0)) != {}


def test_what_is_not_a_number_never_agrees() -> None:
    assert differing(results(float("nan")), results()).keys() == {f"{A}/value"}


def test_items_that_are_taken_out_or_put_in_are_named_by_what_they_are() -> None:
    fewer = results()
    taken = fewer["evaluations"][0]["parameters"].pop(0)
    expected = {f"{A}/{key}": value for key, value in taken.items()}
    assert differing(fewer, results()) == {path: (None, value) for path, value in expected.items()}
    assert differing(results(), fewer) == {path: (value, None) for path, value in expected.items()}


def test_an_item_that_is_there_twice_differs() -> None:
    more = results()
    more["evaluations"][0]["parameters"].append({"symbol": "A", "value": 1.0})
    assert differing(more, results()) == {f"{A} (3)/symbol": ("A", None), f"{A} (3)/value": (1.0, None)}


def test_an_item_without_a_name_is_named_by_its_number() -> None:
    assert differing({"x": [1.0, 2.0]}, {"x": [1.0]}) == {"x/2": (2.0, None)}


def test_a_group_in_the_place_of_a_value_differs() -> None:
    assert f"{A}/value/limit" in differing(results({"limit": 20.0}), results())


def test_words_of_another_release_are_left_open() -> None:
    other = results()
    other["evaluations"][0]["parameters"][0]["name"] = "Accuracy"
    assert differing(other, results()).keys() == {f"{A}/name"}
    assert differing(other, results(), same_programs=False) == {}


def test_what_only_this_release_states_is_left_open() -> None:
    newer = results()
    newer["evaluations"][0]["parameters"][0]["expanded_uncertainty"] = 1.4
    assert differing(results(), newer).keys() == {f"{A}/expanded_uncertainty"}
    assert differing(results(), newer, same_programs=False) == {}
    (left_open,) = (
        each
        for each in compare(results(), newer, same_programs=False)
        if each.verdict is VerificationVerdict.OPEN
    )
    assert "/".join(left_open.path) == f"{A}/expanded_uncertainty"


@pytest.mark.parametrize("within", [(), ("parts", "x"), ("tests", "y"), ("parts", "x", "tests", "y")])
def test_readings_of_another_release_are_the_same_numbers(within: tuple[str, ...]) -> None:
    """How readings are counted and read is no release's own; what it says of them is."""

    def nested(**keys: Any) -> Any:
        found: Any = keys
        for each in reversed(within):
            found = {each: found}
        return found

    path = "/".join((*within, "measurements", "runs"))
    fewer, more = ({"runs": runs, "axis": axis} for runs, axis in ((4, "X"), (5, "Y")))
    found = differing(nested(measurements=fewer), nested(measurements=more), same_programs=False)
    assert found == {path: (4, 5)}
    assert differing(nested(model={"rms": 4.0}), nested(model={"rms": 5.0}), same_programs=False) == {}


def test_a_number_of_another_release_that_is_not_recomputed_differs() -> None:
    older = results()
    older["evaluations"][0]["parameters"][0]["limit"] = 20.0
    assert differing(older, results(), same_programs=False) == {f"{A}/limit": (20.0, None)}
