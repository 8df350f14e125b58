"""Decision rules: what is stated of a value, its uncertainty and its limit."""

from __future__ import annotations

import math
from dataclasses import replace
from statistics import NormalDist

import numpy as np
import pytest

from plugins.standards.installed import STANDARDS
from zlmreport.plugin import Language, Options
from zlmreport.plugin.renderer import Decision, EvaluatedParameter
from zlmreport.plugin.standard import Conformity, decided, decision_rule, evaluate
from zlmreport.testing import bidirectional_test, simulated_test

ISO = STANDARDS["iso230-2:2014"]
A = next(quantity for quantity in ISO.quantities if quantity.symbol == "A")

#: Limit of all examples, and U = 2·u.
LIMIT, EXPANDED = 20e-6, 4e-6

MET, IF_MET = Conformity.MET, Conformity.CONDITIONALLY_MET
FAILED, IF_FAILED = Conformity.FAILED, Conformity.CONDITIONALLY_FAILED
OPEN = Conformity.UNDECIDED


def decision(rule: str, value: float, expanded: float | None = EXPANDED, factor: float = 1.0) -> Decision:
    found = decision_rule(rule, factor).decide(
        EvaluatedParameter(A, value, LIMIT, expanded, None if expanded is None else 2.0)
    )
    assert found is not None
    return found


@pytest.mark.parametrize(
    ("rule", "value", "stated"),
    [
        ("simple", 19.9e-6, MET),
        ("simple", 20e-6, MET),
        ("simple", 20.1e-6, FAILED),
        ("guard-band", 16e-6, MET),
        ("guard-band", 16.1e-6, FAILED),
        ("guard-band", 19e-6, FAILED),
        ("iso14253-1", 16.7e-6, MET),
        ("iso14253-1", 16.8e-6, OPEN),
        ("iso14253-1", 23.3e-6, OPEN),
        ("iso14253-1", 23.4e-6, FAILED),
        ("non-binary", 16e-6, MET),
        ("non-binary", 16.1e-6, IF_MET),
        ("non-binary", 20e-6, IF_MET),
        ("non-binary", 20.1e-6, IF_FAILED),
        ("non-binary", 24e-6, IF_FAILED),
        ("non-binary", 24.1e-6, FAILED),
    ],
)
def test_what_each_rule_states(rule: str, value: float, stated: Conformity) -> None:
    assert decision(rule, value).conformity is stated


@pytest.mark.parametrize(
    ("rule", "accepted", "rejected"),
    [
        ("simple", 20e-6, 20e-6),
        ("guard-band", 16e-6, 16e-6),
        ("iso14253-1", 16.7e-6, 23.3e-6),
        ("non-binary", 16e-6, 24e-6),
    ],
)
def test_between_which_values_each_rule_states_what(rule: str, accepted: float, rejected: float) -> None:
    found = decision(rule, 10e-6)

    assert (found.acceptance_limit, found.rejection_limit) == pytest.approx((accepted, rejected), rel=1e-12)


def test_a_guard_band_is_as_wide_as_its_factor_says() -> None:
    assert decision("guard-band", 17e-6, factor=0.5).acceptance_limit == pytest.approx(18e-6, rel=1e-12)
    assert decision("guard-band", 17e-6, factor=0.5).conformity is MET


def test_a_guard_band_is_as_wide_as_u_if_no_factor_is_stated() -> None:
    assert decision_rule("guard-band") == decision_rule("guard-band", 1.0)


@pytest.mark.parametrize("rule", ["simple", "guard-band", "iso14253-1", "non-binary"])
def test_a_rule_is_called_as_jobs_name_it(rule: str) -> None:
    assert decision_rule(rule).identifier == rule


def test_the_guard_band_of_iso_14253_is_counted_in_standard_uncertainties() -> None:
    rule = decision_rule("iso14253-1")
    assert (rule.factor, rule.guard.value) == (1.65, "u")


@pytest.mark.parametrize("rule", ["guard-band", "iso14253-1", "non-binary"])
def test_an_uncertainty_that_is_not_complete_decides_nothing(rule: str) -> None:
    known = EvaluatedParameter(A, 1e-6, LIMIT, EXPANDED, 2.0)

    found = decision_rule(rule).decide(known, uncertainty_is_complete=False)
    assert found == Decision(OPEN, None, None, None)


def test_an_evaluation_says_whether_its_uncertainty_is_complete() -> None:
    known = (EvaluatedParameter(A, 1e-6, LIMIT, EXPANDED, 2.0),)
    evaluation = replace(evaluate(ISO, simulated_test(), Options(), {}), parameters=known)
    found = decided(replace(evaluation, uncertainty_is_complete=False), decision_rule("guard-band"))

    assert found.parameters[0].conforms is None


@pytest.mark.parametrize("rule", ["guard-band", "iso14253-1", "non-binary"])
def test_a_value_that_is_known_exactly_needs_no_guard_band(rule: str) -> None:
    assert decision(rule, 1e-6, expanded=0.0).acceptance_limit == LIMIT


@pytest.mark.parametrize("rule", ["guard-band", "iso14253-1", "non-binary"])
def test_a_rule_that_needs_the_uncertainty_decides_nothing_without_it(rule: str) -> None:
    assert decision(rule, 1e-6, expanded=None) == Decision(OPEN, None, None, None)


def test_simple_acceptance_needs_no_uncertainty_but_knows_no_risk_without_it() -> None:
    found = decision("simple", 1e-6, expanded=None)

    assert (found.conformity, found.risk) == (MET, None)


def test_a_parameter_without_limit_has_no_decision() -> None:
    assert decision_rule("simple").decide(EvaluatedParameter(A, 1e-6)) is None


def test_a_limit_is_held_against_the_unrounded_value() -> None:
    assert decision("simple", LIMIT * (1 + 1e-8)).conformity is FAILED


def test_a_range_of_exactly_the_limit_conforms_in_spite_of_binary_rounding() -> None:
    assert 3e-6 - 1e-6 > 2e-6  # what a bare comparison would stumble over
    first, second = [1.0, 1.0], [3.0, 3.0]
    measurements = bidirectional_test([0, 100], [first, second], [first, second])
    evaluation = decided(evaluate(ISO, measurements, Options(), {"E": 2e-6}), decision_rule("simple"))
    found = evaluation.parameter("E")

    assert found.conforms is True


def test_a_signed_value_is_held_against_its_limit_by_its_amount() -> None:
    assert decision("simple", -19e-6).conformity is MET
    assert decision("simple", -21e-6).conformity is FAILED


class TestRisk:
    """The specific risk against the normal distribution of Python's own library."""

    def test_of_a_wrong_acceptance(self) -> None:
        truth = NormalDist(19e-6, EXPANDED / 2)
        beyond = 1 - truth.cdf(LIMIT) + truth.cdf(-LIMIT)

        assert decision("simple", 19e-6).risk == pytest.approx(beyond, rel=1e-9)

    def test_of_a_wrong_rejection(self) -> None:
        truth = NormalDist(-21e-6, EXPANDED / 2)
        within = truth.cdf(LIMIT) - truth.cdf(-LIMIT)

        assert decision("simple", -21e-6).risk == pytest.approx(within, rel=1e-9)

    def test_at_the_limit_is_one_half(self) -> None:
        assert decision("simple", LIMIT).risk == pytest.approx(0.5, abs=1e-12)

    def test_of_acceptance_behind_a_full_guard_band_is_less_than_two_and_a_half_percent(self) -> None:
        risk = decision("guard-band", LIMIT - EXPANDED).risk

        assert risk == pytest.approx(1 - NormalDist().cdf(2), rel=1e-9)

    def test_behind_the_guard_band_of_iso_14253_is_at_most_five_percent(self) -> None:
        risk = decision("iso14253-1", LIMIT - 1.65 * EXPANDED / 2).risk

        assert risk == pytest.approx(1 - NormalDist().cdf(1.65), rel=1e-9)
        assert risk is not None
        assert risk < 0.05

    def test_is_the_share_of_wrong_statements_among_many_values(self) -> None:
        random = np.random.default_rng(4)
        value, uncertainty = 18.5e-6, EXPANDED / 2
        truths = random.normal(value, uncertainty, 200_000)
        wrong = np.mean(np.abs(truths) > LIMIT)
        risk = decision("simple", value).risk
        four_sigma = 4 * math.sqrt(risk * (1 - risk) / len(truths))

        assert wrong == pytest.approx(risk, abs=four_sigma)

    def test_of_no_statement_is_none(self) -> None:
        assert decision("iso14253-1", LIMIT).risk is None

    @pytest.mark.parametrize(
        "share", [0.5, 1 + 5e-10, 1.5]
    )  # the second is beyond by the rounding of doubles
    def test_of_a_value_without_uncertainty_is_nothing(self, share: float) -> None:
        assert decision("simple", share * LIMIT, expanded=0.0).risk == 0.0


def test_a_guard_band_wider_than_the_limit_is_a_finding_and_no_crash() -> None:
    measurements = simulated_test()
    evaluation = evaluate(ISO, measurements, Options(), {"A": 1e-6})
    uncertain = tuple(
        EvaluatedParameter(each.quantity, each.value, each.limit, EXPANDED, 2.0)
        for each in evaluation.parameters
    )
    found = decided(replace(evaluation, parameters=uncertain), decision_rule("guard-band"))

    said = [each.found.in_language(Language.ENGLISH) for each in found.findings if each.met is False]
    assert said[-1] == "the guard band is as wide as the limit: no value of A could conform"
    asked = found.findings[-1].requirement.in_language(Language.ENGLISH)
    assert asked == "A measurement uncertainty that leaves room for conformity with the limit of A"
    parameter = found.parameter("A")
    assert parameter.conforms is False


@pytest.mark.parametrize("expanded", [EXPANDED, LIMIT])
def test_a_guard_band_up_to_the_limit_is_no_finding(expanded: float) -> None:
    """As wide as the limit, it leaves one value that conforms: 0."""
    evaluation = evaluate(ISO, simulated_test(), Options(), {})
    evaluation = replace(evaluation, parameters=(EvaluatedParameter(A, 0.0, LIMIT, expanded, 2.0),))

    assert decided(evaluation, decision_rule("guard-band")).findings == evaluation.findings


@pytest.mark.parametrize("rule", ["simple", "guard-band", "non-binary"])
@pytest.mark.parametrize(("value", "known_error"), [(4e-6, 60e-6), (30e-6, -26e-6)])
def test_a_known_error_that_would_turn_a_statement_leaves_it_open(
    rule: str, value: float, known_error: float
) -> None:
    """4 µm of which 60 µm are known to be missing exceed 20 µm, and 30 µm with 26 µm too many do not."""
    uncertain = EvaluatedParameter(A, value, LIMIT, EXPANDED + abs(known_error), 2.0, known_error=known_error)
    found = decision_rule(rule).decide(uncertain)

    # Of 4 µm guarded acceptance says no, as it would of 64 µm.
    agrees = rule == "guard-band" and known_error > 0
    assert found.conformity is (FAILED if agrees else OPEN)


def test_a_known_error_that_turns_nothing_leaves_the_statement() -> None:
    small = EvaluatedParameter(A, 10e-6, LIMIT, EXPANDED + 2e-6, 2.0, known_error=2e-6)

    for rule in ("simple", "guard-band", "non-binary", "iso14253-1"):
        found = decision_rule(rule).decide(small)
        assert found.conformity is MET


@pytest.mark.parametrize(
    ("rule", "accepted"), [("guard-band", 14e-6), ("non-binary", 14e-6), ("iso14253-1", 14.7e-6)]
)
def test_a_known_error_is_whole_in_the_guard_band_however_that_is_counted(rule: str, accepted: float) -> None:
    """Of u = 2 µm: 2·u or 1.65·u, and the 2 µm that are known."""
    of_known = EvaluatedParameter(A, 1e-6, LIMIT, EXPANDED + 2e-6, 2.0, known_error=2e-6)
    found = decision_rule(rule).decide(of_known)
    assert found is not None
    assert found.acceptance_limit == pytest.approx(accepted)
