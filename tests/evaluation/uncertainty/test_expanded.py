"""What an evaluation states of its uncertainty, with a budget and without one."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from evaluation.uncertainty.budgets import ISO, MICROMETRE, budget, contribution
from zlmreport.evaluation.evaluation import Least
from zlmreport.evaluation.uncertainty.budget import KnownError
from zlmreport.evaluation.uncertainty.drift import compute_mean_drift_variance, compute_reading_times
from zlmreport.evaluation.uncertainty.expanded import compute_mean_uncertainty
from zlmreport.plugin import Evaluation, Options, same_in_all_languages
from zlmreport.plugin.extension import Acts, Distribution, with_uncertainty
from zlmreport.plugin.renderer import Budget, EvaluatedParameter, NoBudget
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import simulated_test

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
    assert {each.raised_to for each in found.values()} == {Least.LABORATORY}


def test_only_what_compares_positions_has_the_uncertainty_of_the_instrument_at_least() -> None:
    found = parameters(replace(budget(0.01, Acts.AT_EACH_READING), of_the_instrument=3 * MICROMETRE))
    raised = {symbol for symbol, each in found.items() if each.raised_to is Least.INSTRUMENT}
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
