"""The uncertainty of mean deviations: of the whole, by position, and by direction."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from evaluation.uncertainty.budgets import BY_CHANCE, ISO, MICROMETRE, budget, contribution, uncertainties
from zlmreport.evaluation.uncertainty.budget import KnownError
from zlmreport.evaluation.uncertainty.drift import compute_mean_drift_variance, compute_reading_times
from zlmreport.evaluation.uncertainty.expanded import compute_mean_uncertainty
from zlmreport.plugin import Approach, Evaluation, Options, same_in_all_languages
from zlmreport.plugin.extension import Acts, Distribution, with_uncertainty
from zlmreport.plugin.renderer import Budget, EvaluatedParameter, NoBudget
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import bidirectional_test, simulated_test

TEST = simulated_test()


def stated(of: Budget | NoBudget) -> Evaluation:
    options = Options()
    evaluation = evaluate(ISO, TEST, options, {})
    (found,) = with_uncertainty([(evaluation, partial(ISO.arithmetic, options=options))], of)
    return found


def parameters(of: Budget | NoBudget) -> dict[str, EvaluatedParameter]:
    return {each.quantity.symbol: each for each in stated(of).parameters}


def test_without_a_test_there_is_nothing_to_state() -> None:
    assert with_uncertainty([], budget(0.5, Acts.AT_EACH_READING)) == ()


def test_without_a_budget_there_is_the_interval_of_the_next_test_and_no_uncertainty() -> None:
    found = stated(NoBudget(same_in_all_languages("nothing is stated")))
    assert found.mean_uncertainty is None
    assert {each.expanded_uncertainty for each in found.parameters} == {None}
    assert all(each.axis_interval for each in found.parameters)


def test_with_a_budget_each_parameter_has_its_uncertainty_and_factor() -> None:
    found = stated(budget(0.5, Acts.AT_EACH_READING))
    assert found.uncertainty_is_complete
    assert found.mean_uncertainty is not None
    assert all(each.expanded_uncertainty > 0 and 1 < each.coverage_factor < 4 for each in found.parameters)
    assert all(each.axis_interval and each.raised_to is None for each in found.parameters)


def test_a_budget_that_lacks_a_contributor_is_not_complete() -> None:
    assert not stated(
        replace(budget(0.5, Acts.AT_EACH_READING), missing=("alignment",))
    ).uncertainty_is_complete


def test_no_uncertainty_is_less_than_the_laboratory_may_state() -> None:
    found = parameters(replace(budget(0.01, Acts.AT_EACH_READING), least=3 * MICROMETRE))
    assert {(each.expanded_uncertainty, each.coverage_factor) for each in found.values()} == {(3e-6, 2.0)}
    assert {each.raised_to.value for each in found.values()} == {"cmc"}


def test_only_what_compares_positions_has_the_uncertainty_of_the_instrument_at_least() -> None:
    found = parameters(replace(budget(0.01, Acts.AT_EACH_READING), of_the_instrument=3 * MICROMETRE))
    raised = {
        symbol for symbol, each in found.items() if each.raised_to and each.raised_to.value == "instrument"
    }
    assert raised == {"A", "A_fwd", "A_bwd", "E", "E_fwd", "E_bwd", "M"}
    assert found["E"].expanded_uncertainty == 3e-6
    assert found["B"].expanded_uncertainty < 0.1e-6


def test_what_drifts_adds_to_each_mean_by_the_worst_of_its_kinds() -> None:
    drifting = Budget((contribution(0.5, Acts.IN_TIME, Distribution.RECTANGULAR),))
    found = compute_mean_uncertainty(stated(drifting), drifting)
    by_approach, both = compute_mean_drift_variance(compute_reading_times(TEST))
    width = 2 * 0.5e-6 * 12**0.5
    assert found.by_approach[0] == pytest.approx(width * by_approach**0.5)
    assert found.bidirectional == pytest.approx(width * both**0.5)


def test_a_known_error_adds_whole_to_the_uncertainty_of_a_mean() -> None:
    targets = TEST.target_positions
    correction = -0.5e-6 * ((targets - targets[0]) / np.ptp(targets))[TEST.target]
    known = KnownError(
        same_in_all_languages("any"), correction, same_in_all_languages(""), same_in_all_languages("")
    )
    found = compute_mean_uncertainty(
        stated(NoBudget(same_in_all_languages(""))), Budget((), known_errors=(known,))
    )
    assert found.bidirectional[-1] == pytest.approx(0.5e-6)
    assert found.bidirectional[0] == 0.0


def test_what_drifts_disturbs_each_parameter_and_no_more_than_its_range_allows() -> None:
    found = parameters(budget(0.5, Acts.IN_TIME, Distribution.RECTANGULAR))
    full_range = 0.5e-6 * 12**0.5
    assert all(0 < found[symbol].expanded_uncertainty <= 1.001 * full_range for symbol in ("M", "B_mean"))


ALL_WAYS = Budget(
    (
        contribution(0.5, Acts.ALONG_THE_LENGTH),
        contribution(0.3, Acts.AT_EACH_POSITION),
        contribution(0.4, Acts.AT_EACH_READING),
    )
)


def evaluation_with_a_gap() -> Evaluation:
    """Return an evaluation of three targets and four runs, where one reading downwards is missing."""
    positive, negative = np.zeros((3, 4)), np.zeros((3, 4))
    negative[1, 2] = np.nan
    return evaluate(ISO, bidirectional_test([0.0, 100.0, 400.0], positive, negative), Options(), {})


def test_each_way_of_acting_has_its_part() -> None:
    found = compute_mean_uncertainty(evaluation_with_a_gap(), ALL_WAYS)

    share = np.array([0.0, 0.25, 1.0])
    readings = np.array([[4, 4, 4], [4, 3, 4]])
    expected = 2 * np.sqrt((0.5 * share) ** 2 + 0.3**2 + 0.4**2 / readings)
    assert found.by_approach / MICROMETRE == pytest.approx(expected, rel=1e-12)
    assert found.coverage_factor == 2.0


def test_the_mean_of_both_directions_has_the_readings_of_both() -> None:
    found = compute_mean_uncertainty(evaluation_with_a_gap(), ALL_WAYS)

    share = np.array([0.0, 0.25, 1.0])
    of_readings = (1 / np.array([4, 4, 4]) + 1 / np.array([4, 3, 4])) / 4
    expected = 2 * np.sqrt((0.5 * share) ** 2 + 0.3**2 + 0.4**2 * of_readings)
    assert found.bidirectional / MICROMETRE == pytest.approx(expected, rel=1e-12)


def test_where_there_is_no_mean_there_is_no_uncertainty_of_it() -> None:
    one_way = evaluate(ISO, simulated_test(approaches=[Approach.NEGATIVE]), Options(), {})

    found = compute_mean_uncertainty(one_way, ALL_WAYS)

    assert np.isnan(found.by_approach[Approach.POSITIVE.index]).all()
    assert np.isfinite(found.by_approach[Approach.NEGATIVE.index]).all()
    assert np.isnan(found.bidirectional).all()


#: Two targets, 100 µm apart in their means, three runs without scatter.
TWO_TARGETS = bidirectional_test(
    [0.0, 100.0],
    np.array([[0.0] * 3, [100.0] * 3]),
    np.array([[-20.0] * 3, [80.0] * 3]),
)


def test_what_parts_the_directions_reaches_the_reversal_in_full() -> None:
    found = uncertainties(budget(0.5, Acts.BETWEEN_DIRECTIONS), TWO_TARGETS)
    assert found["B_mean"] == pytest.approx(2 * 0.5, rel=BY_CHANCE)
    assert found["B"] == pytest.approx(2 * 0.5, rel=BY_CHANCE)


def test_what_parts_the_directions_reaches_no_parameter_of_a_single_one() -> None:
    found = uncertainties(budget(0.5, Acts.BETWEEN_DIRECTIONS), TWO_TARGETS)
    assert [found[symbol] for symbol in ("E_fwd", "E_bwd", "M", "R_fwd")] == [0.0] * 4


def test_an_error_of_the_datum_reaches_no_range() -> None:
    found = uncertainties(budget(0.5, Acts.AT_THE_DATUM), TWO_TARGETS)
    assert set(found.values()) == {0.0}


def test_an_error_of_each_approach_reaches_ranges_and_reversal_by_two_of_them() -> None:
    found = uncertainties(budget(0.5, Acts.AT_EACH_APPROACH), TWO_TARGETS)
    assert found["E_fwd"] == pytest.approx(2 * 0.5 * math.sqrt(2), rel=BY_CHANCE)
    # the mean over two targets of a difference of two
    assert found["B_mean"] == pytest.approx(2 * 0.5, rel=BY_CHANCE)


@pytest.mark.parametrize(
    ("acts", "positive", "negative", "both"),
    [
        (Acts.BETWEEN_DIRECTIONS, 0.0, 0.5, 0.25),
        (Acts.AT_THE_DATUM, 0.5, 0.5, 0.5),
        (Acts.AT_EACH_APPROACH, 0.5, 0.5, 0.5 / math.sqrt(2)),
    ],
)
def test_the_mean_deviations_have_their_part(
    acts: Acts, positive: float, negative: float, both: float
) -> None:
    evaluation = evaluate(ISO, TWO_TARGETS, Options(), {})
    found = compute_mean_uncertainty(evaluation, Budget((contribution(0.5, acts),)))
    assert found.by_approach[:, 1] / MICROMETRE == pytest.approx([2 * positive, 2 * negative])
    assert found.bidirectional[1] / MICROMETRE == pytest.approx(2 * both)
