"""By how much parameters changed between two tests."""

from __future__ import annotations

from dataclasses import replace

import pytest

from plugins.standards.installed import STANDARDS
from zlmreport.plugin import Evaluation, Options
from zlmreport.plugin.renderer import EvaluatedParameter, changes, report_changes
from zlmreport.plugin.standard import Change, evaluate
from zlmreport.testing import simulated_test

ISO = STANDARDS["iso230-2:2014"]
A, E, R = (next(each for each in ISO.quantities if each.symbol == symbol) for symbol in "AER")


def of(*parameters: EvaluatedParameter) -> Evaluation:
    return replace(evaluate(ISO, simulated_test(), Options(), {}), parameters=parameters)


BEFORE = of(EvaluatedParameter(A, 10e-6, None, 1e-6, 2.0), EvaluatedParameter(R, 4e-6))
AFTER = of(EvaluatedParameter(E, 3e-6), EvaluatedParameter(A, 7e-6, None, 2e-6, 2.0))


def test_a_parameter_of_one_test_stands_beside_nothing() -> None:
    assert changes(BEFORE, AFTER) == (
        Change(None, AFTER.parameters[0]),
        Change(BEFORE.parameters[0], AFTER.parameters[1]),
        Change(BEFORE.parameters[1], None),
    )


def test_a_change_is_reported_of_what_both_define_with_the_sum_of_both_uncertainties() -> None:
    found = report_changes(BEFORE, AFTER)

    assert found["standard"] == "iso230-2:2014"
    (change,) = found["parameters"]
    assert change == {
        "symbol": "A",
        "value": pytest.approx(-3.0),
        "unit": "um",
        "expanded_uncertainty": pytest.approx(3.0),
    }
