"""From a test and a standard to an evaluation."""

from __future__ import annotations

import numpy as np
import pytest

from plugins.standards.installed import STANDARDS
from zlmreport.evaluation.decision import make_decision_rule, with_decisions
from zlmreport.evaluation.evaluate import find_doubts
from zlmreport.evaluation.evaluation import judge_together
from zlmreport.plugin import Approach, Axis, Evaluation, Language, Options
from zlmreport.plugin.standard import evaluate, position_statistics
from zlmreport.testing import simulated_test

ISO = STANDARDS["iso230-2:2014"]


def of_one_direction(tolerances: dict[str, float]) -> Evaluation:
    return evaluate(ISO, simulated_test(approaches=[Approach.POSITIVE]), Options(), tolerances)


def test_parameters_that_the_test_does_not_define_are_left_out_and_not_zero() -> None:
    found = of_one_direction({})

    assert [each.quantity.symbol for each in found.parameters] == ["A_fwd", "E_fwd", "R_fwd"]
    assert found.value("A") is None
    assert found.parameter("A") is None


def test_nothing_is_decided_on_a_limit_yet() -> None:
    found = evaluate(ISO, simulated_test(), Options(), {"A": 1.0}).parameter("A")

    assert (found.limit, found.decision, found.conforms) == (1.0, None, None)


def test_parameters_keep_the_order_of_the_standard() -> None:
    found = evaluate(ISO, simulated_test(), Options(), {})

    assert [each.quantity for each in found.parameters] == list(ISO.quantities)


def test_a_limit_on_a_parameter_that_the_test_does_not_define_is_said() -> None:
    said = [
        finding
        for finding in of_one_direction({"A": 20e-6}).findings
        if "limit" in finding.requirement.in_language(Language.ENGLISH)
    ]

    assert [(each.requirement.in_language(Language.ENGLISH), each.met) for each in said] == [
        ("A test that defines A, for which a limit is stated", False)
    ]


def test_where_nothing_is_decided_on_one_limit_nobody_says_that_all_are_met() -> None:
    rule = make_decision_rule("simple")
    wide, with_undefined, narrow = (
        with_decisions(of_one_direction(limits), rule)
        for limits in ({"A_fwd": 1.0}, {"A_fwd": 1.0, "A": 20e-6}, {"A_fwd": 1e-12, "A": 20e-6})
    )

    assert [judge_together([each]) for each in (wide, with_undefined, narrow)] == [True, None, False]
    assert judge_together([wide, with_undefined]) is None
    assert judge_together([of_one_direction({})]) is None


def test_a_column_by_position_is_found_by_its_symbol() -> None:
    found = evaluate(ISO, simulated_test(targets=7), Options(), {})

    assert found.column("R").shape == (7,)
    assert not found.column("R").flags.writeable
    with pytest.raises(KeyError, match="no column 'U' by position"):
        found.column("U")


def test_the_printed_value_has_the_sign_of_the_edition() -> None:
    measurements = simulated_test()
    old = evaluate(STANDARDS["iso230-2:1988"], measurements, Options(), {}).parameter("B_mean")
    new = evaluate(ISO, measurements, Options(), {}).parameter("B_mean")

    assert old.value == new.value == new.printed_value == -old.printed_value


@pytest.mark.parametrize(
    ("symbol", "value", "sentence"),
    [
        (
            "R",
            -1e-6,
            "−1 µm: not plausible, R cannot be negative; the formulas of the plugin are in doubt",
        ),
        (
            "A",
            5.0,
            (
                "5000000 µm: not plausible, no reading deviates by more than 3 µm; "
                "the formulas of the plugin are in doubt"
            ),
        ),
    ],
)
def test_a_value_that_is_not_plausible_is_named_with_its_parameter(
    symbol: str, value: float, sentence: str
) -> None:
    quantity = next(each for each in ISO.quantities if each.symbol == symbol)
    statistics = position_statistics(np.array([[[1e-6, -3e-6]]]))
    (finding,) = find_doubts([(quantity, value)], statistics, Axis("X"))
    assert finding.found.in_language(Language.ENGLISH) == sentence


def test_notes_on_parameters_that_are_not_reported_are_left_out() -> None:
    def said(found: Evaluation) -> str:
        return " ".join(each.in_language(Language.ENGLISH) for each in found.notes)

    assert "R is the largest" not in said(of_one_direction({}))
    assert "B is its largest amount" not in said(of_one_direction({}))
    both = said(evaluate(ISO, simulated_test(), Options(), {}))
    assert "R is the largest" in both
    assert "B is its largest amount" in both
