"""HA-1 against its worked example, and against what every standard must do."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import pytest

from zlmreport.plugin import MeasurementSet, same_in_all_languages
from zlmreport.plugin.extension import Acts, Contribution, Distribution, with_uncertainty
from zlmreport.plugin.renderer import Budget
from zlmreport.plugin.standard import decided, decision_rule, evaluate
from zlmreport.testing import STANDARD_CHECKS, WorkedExample, bidirectional_test
from zlmreport_house_standard.ha1 import HouseAcceptance, HouseAcceptanceOptions

#: The worked example of the rule: mm, and µm in a row for each target.
TARGETS = [0, 100, 200, 300, 400]
POSITIVE = [[0, 1, 2], [3, 4, 5], [6, 6, 9], [8, 9, 10], [10, 12, 11]]
NEGATIVE = [[-3, -2, -4], [0, 1, -1], [2, 1, 0], [5, 4, 3], [7, 9, 5]]
#: symbol, weight, value in µm
RESULTS = [("D", 0.5, 11.0), ("H", 0.5, 6.0), ("W", 0.5, 4.0), ("T", 0.5, 12.0), ("T", 1.0, 13.0)]
#: The parameters with the key as it is preset.
PRESET = {symbol: value for symbol, weight, value in RESULTS if weight == 0.5}
#: One unit of the sixth decimal of a micrometre: the example's numbers are whole, only doubles are rounded.
TOLERANCE = 1e-6


@pytest.fixture
def example() -> MeasurementSet:
    return bidirectional_test(TARGETS, POSITIVE, NEGATIVE)


@pytest.mark.parametrize("check", STANDARD_CHECKS)
def test_conforms_to_what_every_standard_must_do(check: Callable[..., None], example: MeasurementSet) -> None:
    check(HouseAcceptance(), HouseAcceptanceOptions(), [WorkedExample(example, PRESET)])


@pytest.mark.parametrize(("symbol", "weight", "expected"), RESULTS)
def test_worked_example(example: MeasurementSet, symbol: str, weight: float, expected: float) -> None:
    evaluation = evaluate(HouseAcceptance(), example, HouseAcceptanceOptions(weight=weight), {})
    value = evaluation.value(symbol)
    assert value is not None
    assert value * 1e6 == pytest.approx(expected, abs=TOLERANCE)


def test_a_limit_is_held_against_the_value(example: MeasurementSet) -> None:
    bare = evaluate(HouseAcceptance(), example, HouseAcceptanceOptions(), {"D": 10e-6, "W": 5e-6})
    evaluation = decided(bare, decision_rule("simple"))
    conforms = {parameter.quantity.symbol: parameter.conforms for parameter in evaluation.parameters}
    assert conforms == {"D": False, "H": None, "W": True, "T": None}


def test_the_uncertainty_of_its_parameters_takes_no_work_of_its_own(example: MeasurementSet) -> None:
    options = HouseAcceptanceOptions()
    evaluation = evaluate(HouseAcceptance(), example, options, {})
    error = Contribution(
        same_in_all_languages("noise"),
        0.1e-6,
        Acts.AT_EACH_READING,
        Distribution.NORMAL,
        same_in_all_languages("u = 0.1 µm"),
        same_in_all_languages(""),
    )

    (found,) = with_uncertainty(
        [(evaluation, partial(HouseAcceptance().arithmetic, options=options))], Budget((error,))
    )

    largest = found.parameter("D")
    assert largest is not None
    assert largest.expanded_uncertainty is not None
    # D is a mean of three readings: U = 2·0.1 µm/√3, and 10,000 trials know it to within 4 %.
    assert largest.expanded_uncertainty * 1e6 == pytest.approx(0.2 / math.sqrt(3), rel=0.04)
