"""Errors of the set-up carried to parameters: against closed forms where there are any."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

import numpy as np
import pytest

from evaluation.uncertainty.budgets import (
    BY_CHANCE,
    ISO,
    MICROMETRE,
    budget,
    contribution,
    expanded,
    uncertainties,
)
from plugins.standards.installed import STANDARDS
from processes import PYTHON, run
from zlmreport.evaluation.uncertainty.monte_carlo import propagate
from zlmreport.plugin import MeasurementSet, Options
from zlmreport.plugin.extension import Acts, Distribution
from zlmreport.plugin.renderer import Budget
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import bidirectional_test, simulated_test
from zlmreport.testing.measurements import poor_tests

LENGTH, POSITION, READING = Acts.ALONG_THE_LENGTH, Acts.AT_EACH_POSITION, Acts.AT_EACH_READING
RUNS = 5
#: What rounding to the middles of 10,000 equally probable parts leaves of an exact quantile.
STRATIFIED = 1e-3


def axis_with(means: Sequence[float], reversal: float = 0.0) -> MeasurementSet:
    """Return a test without scatter, µm at targets 100 mm apart."""
    targets = 100.0 * np.arange(len(means))
    readings = np.repeat(np.array(means)[:, np.newaxis], RUNS, axis=1)
    return bidirectional_test(targets, readings + reversal / 2, readings - reversal / 2)


def one_position(scatter: Sequence[float]) -> MeasurementSet:
    """Return a test of a single target, the readings of both directions far apart."""
    readings = np.array([scatter])
    return bidirectional_test([0.0], readings + 100.0, readings - 100.0)


@pytest.mark.parametrize(("first", "last"), [(0, 4), (1, 3), (2, 3)])
def test_a_scale_error_enters_a_range_by_the_length_between_its_extremes(first: int, last: int) -> None:
    means = [0.0] * 5
    means[first], means[last] = -50.0, 50.0

    found = uncertainties(budget(0.5, LENGTH), axis_with(means))

    for symbol in ("E", "E_fwd", "E_bwd", "M", "A"):
        assert found[symbol] == pytest.approx(2 * 0.5 * (last - first) / 4, rel=STRATIFIED)


def test_a_scale_error_does_not_reach_what_is_compared_at_one_place() -> None:
    found = uncertainties(budget(0.5, LENGTH), simulated_test())

    assert {symbol: found[symbol] for symbol in ("B", "B_mean", "R", "R_fwd", "R_bwd")} == dict.fromkeys(
        ("B", "B_mean", "R", "R_fwd", "R_bwd"), 0.0
    )


def test_an_error_of_position_enters_a_range_twice() -> None:
    found = uncertainties(budget(0.5, POSITION), axis_with([-50.0, 0.0, 50.0]))

    assert found["E"] == pytest.approx(2 * 0.5 * math.sqrt(2), rel=BY_CHANCE)
    assert found["B"] == 0.0


def test_errors_of_single_readings_shrink_with_the_runs() -> None:
    found = uncertainties(budget(0.5, READING), axis_with([-50.0, 50.0], reversal=20.0))

    assert found["E_fwd"] == pytest.approx(2 * 0.5 * math.sqrt(2 / RUNS), rel=BY_CHANCE)
    assert found["M"] == pytest.approx(2 * 0.5 * math.sqrt(1 / RUNS), rel=BY_CHANCE)
    assert found["B_mean"] == pytest.approx(2 * 0.5 * math.sqrt(2 / RUNS / 2), rel=BY_CHANCE)


def test_errors_of_single_readings_enter_a_reversal_by_both_means() -> None:
    found = uncertainties(budget(0.5, READING), one_position([-1.0, 1.0, 0.0, 2.0, -2.0]))

    assert found["B"] == pytest.approx(2 * 0.5 * math.sqrt(2 / RUNS), rel=BY_CHANCE)


def test_errors_of_single_readings_enter_a_large_spread_by_its_derivative() -> None:
    # R = 4s and ∂s/∂x_j = (x_j − x̄)/((n − 1)s), whose squares add up to 1/(n − 1): u(R) = 4u/√(n − 1).
    found = uncertainties(budget(0.01, READING), one_position([-1.0, 1.0, 0.0, 2.0, -2.0]))

    assert found["R_fwd"] == pytest.approx(2 * 4 * 0.01 / math.sqrt(RUNS - 1), rel=BY_CHANCE)


def test_shared_and_own_errors_add_by_their_squares() -> None:
    both = Budget((contribution(0.5, LENGTH), contribution(0.5, READING)))

    found = uncertainties(both, axis_with([-50.0, 50.0]))

    assert found["E_fwd"] == pytest.approx(2 * 0.5 * math.sqrt(1 + 2 / RUNS), rel=BY_CHANCE)


@pytest.mark.parametrize(
    ("distribution", "width", "factor"),
    [
        # 95.45 % of the range, and that over the root mean square.
        (Distribution.NORMAL, 2.0, 2.0),
        (Distribution.RECTANGULAR, 0.9545 * math.sqrt(3), 0.9545 * math.sqrt(3)),
        (Distribution.ONE_SIDED, 0.9545 * math.sqrt(3), 0.9545 * math.sqrt(3)),
        # The tails beyond ± d of a triangle over ± a hold (1 − d/a)².
        (
            Distribution.TRIANGULAR,
            (1 - math.sqrt(1 - 0.9545)) * math.sqrt(6),
            (1 - math.sqrt(1 - 0.9545)) * math.sqrt(6),
        ),
    ],
)
def test_the_distribution_of_the_error_is_that_of_the_interval(
    distribution: Distribution, width: float, factor: float
) -> None:
    found = expanded(budget(0.5, LENGTH, distribution), axis_with([-50.0, 50.0]))["E"]

    assert found.uncertainty / MICROMETRE == pytest.approx(0.5 * width, rel=STRATIFIED)
    assert found.coverage_factor == pytest.approx(factor, rel=STRATIFIED)


def test_a_parameter_that_follows_the_zero_point_follows_a_scale_error_from_the_datum() -> None:
    nmtba = STANDARDS["nmtba"]

    found = uncertainties(budget(0.5, LENGTH), axis_with([-50.0, 50.0]), nmtba)

    # O is the middle of the band: half of it stands at the datum, which has no error.
    assert found["O"] == pytest.approx(2 * 0.5 / 2, rel=STRATIFIED)


@pytest.mark.parametrize("name", poor_tests())
@pytest.mark.parametrize("identifier", STANDARDS)
def test_every_parameter_that_a_test_defines_has_an_uncertainty(name: str, identifier: str) -> None:
    measurements = poor_tests()[name]
    all_ways = Budget(tuple(contribution(0.5, acts) for acts in Acts))

    found = expanded(all_ways, measurements, STANDARDS[identifier], trials=50)

    evaluation = evaluate(STANDARDS[identifier], measurements, Options(), {})
    assert list(found) == [each.quantity.symbol for each in evaluation.parameters]
    # The range of the means over a single target is zero whatever the errors.
    least = 0.0 if len(measurements.target_positions) == 1 else math.ulp(0.0)
    assert all(least <= each.uncertainty < math.inf for each in found.values())
    assert all(1.0 < each.coverage_factor < 4.0 for each in found.values())


def test_standards_are_evaluated_on_the_same_simulated_tests() -> None:
    measurements = simulated_test()
    evaluations = [
        (evaluate(standard, measurements, Options(), {}), partial(standard.arithmetic, options=Options()))
        for standard in STANDARDS.values()
    ]

    found = dict(zip(STANDARDS, propagate(budget(0.5, READING), evaluations, 500), strict=True))

    # M and Pa are the same quantity by two names.
    assert found["iso230-2:2014"]["M"] == found["vdi-dgq-3441"]["Pa"]
    assert found["iso230-2:2014"] == expanded(budget(0.5, READING), measurements, ISO, 500)


def test_other_readings_are_given_other_errors() -> None:
    of_one, of_other = (
        uncertainties(budget(0.5, READING), one_position(scatter), trials=500)["B"]
        for scatter in ([0.0, 1.0, 2.0, 3.0, 4.0], [4.0, 3.0, 2.0, 1.0, 0.0])
    )

    assert of_one != of_other


_AGAIN = """
from evaluation.uncertainty.budgets import budget, uncertainties
from zlmreport.testing import simulated_test
from zlmreport.evaluation.uncertainty.budget import Acts, Distribution
of = budget(0.5, Acts.AT_EACH_READING, Distribution.RECTANGULAR)
print(repr(uncertainties(of, simulated_test(), trials=500)))
"""


def test_another_process_finds_the_same(request: pytest.FixtureRequest) -> None:
    here = uncertainties(budget(0.5, READING, Distribution.RECTANGULAR), simulated_test(), trials=500)

    elsewhere = run(PYTHON, "-c", _AGAIN, check=True, cwd=request.config.rootpath / "tests").stdout

    assert elsewhere.strip() == repr(here)
