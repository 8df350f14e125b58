"""The contest: its numbers against plain fits, what leaves them alone, and what chance gives."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from model.axis_tests import (
    EFFECTS,
    INSTALLED,
    SIGMA,
    USUAL,
    hidden,
    known,
    linear_test,
    model_of,
    noise,
    realistic_noise,
)
from zlmreport.model.diagnosis.contest import Contest
from zlmreport.model.diagnosis.effects_to_try import list_effects_to_try
from zlmreport.model.diagnosis.families import PRICE
from zlmreport.model.diagnosis.forms import list_unnamed_forms
from zlmreport.model.diagnosis.null_distribution import TRIALS, NullDistribution, Scores, simulate_null
from zlmreport.model.diagnosis.random_curves import Course
from zlmreport.model.diagnosis.trials import Trials, average_evidence
from zlmreport.model.fitting.contrasts import describe_single_readings
from zlmreport.model.fitting.noise import NoiseSource
from zlmreport.model.fitting.observations import select_readings
from zlmreport.plugin import FloatArray, Language

DESIGN = linear_test(targets=9, runs=3)
BASE = np.concatenate([term.effect.columns(DESIGN, np.empty(0)) for term in USUAL.terms], axis=1)
READINGS = known(DESIGN) + realistic_noise(DESIGN) + hidden(DESIGN, "backlash-bow", size=0.5)
NAMES = ("backlash-gradient", "backlash-bow", "screw-pitch", "thermal-drift", "scale-expansion")


def _contest(
    base: FloatArray = BASE, names: tuple[str, ...] = NAMES, readings: FloatArray = READINGS
) -> Contest:
    return Contest.of(DESIGN, base, [EFFECTS[name] for name in names], readings)


CONTEST = _contest()
#: A little of every source of noise, and two random curves.
AMPLITUDES = tuple(1 if part.source else 3 * (number % 4 == 0) for number, part in enumerate(CONTEST.parts))


def _covariance(contest: Contest, amplitudes: tuple[int, ...]) -> FloatArray:
    factors = list(contest.list_factors(amplitudes))
    return np.asarray(np.eye(len(BASE)) + sum(each @ each.T for each in factors))


def _restricted(covariance: FloatArray, columns: FloatArray, readings: FloatArray = READINGS) -> float:
    """Return −2 ln(restricted likelihood) of the base model, further columns fitted beside it."""
    both = np.concatenate([BASE, columns], axis=1)
    both = both / np.linalg.norm(both, axis=0)
    inverse = np.linalg.inv(covariance)
    left = readings - both @ np.linalg.solve(both.T @ inverse @ both, both.T @ inverse @ readings)
    base = BASE / np.linalg.norm(BASE, axis=0)
    determinants = np.linalg.slogdet(covariance)[1] + np.linalg.slogdet(base.T @ inverse @ base)[1]
    return float((len(BASE) - 5) * np.log(left @ inverse @ left) + determinants)


def _family(contest: Contest, name: str) -> int:
    return [each.identifier for each in contest.families].index(name)


@pytest.mark.parametrize("amplitudes", [CONTEST.quiet, AMPLITUDES])
@pytest.mark.parametrize("names", [(), ("backlash-bow",), ("backlash-bow", "scale-expansion")])
def test_the_criterion_of_a_set_is_that_of_a_plain_restricted_likelihood(
    amplitudes: tuple[int, ...], names: tuple[str, ...]
) -> None:
    columns = [EFFECTS[name].columns(DESIGN, np.empty(0)) for name in names]
    beside = np.concatenate([BASE[:, :0], *columns], axis=1)
    covariance = _covariance(CONTEST, amplitudes)
    members = [CONTEST.families[_family(CONTEST, name)].blocks[0] for name in names]
    costs = sum(part.costs[level] for part, level in zip(CONTEST.parts, amplitudes, strict=True))
    rise = (
        CONTEST.compute_criterion(amplitudes, members) - CONTEST.compute_criterion(CONTEST.quiet, []) - costs
    )
    plain = _restricted(covariance, beside) - _restricted(np.eye(len(BASE)), BASE[:, :0])
    assert rise == pytest.approx(plain, abs=1e-6)


@pytest.mark.parametrize("name", NAMES)
def test_the_likelihood_ratio_of_an_effect_is_that_of_plain_fits(name: str) -> None:
    effect, covariance = EFFECTS[name], _covariance(CONTEST, AMPLITUDES)
    best = min(_restricted(covariance, effect.columns(DESIGN, theta)) for theta in effect.grid(DESIGN))
    found = Trials(CONTEST, AMPLITUDES, [], READINGS[:, np.newaxis]).ratios
    assert found[CONTEST.identifiers.index(name), 0] == pytest.approx(
        _restricted(covariance, BASE[:, :0]) - best, abs=1e-6
    )


def test_all_levels_of_a_part_are_looked_at_as_each_by_itself() -> None:
    members = [CONTEST.families[0].blocks[0]]
    for number, part in enumerate(CONTEST.parts):
        if part.irregular is None:
            (found,) = CONTEST.by_level(AMPLITUDES, members, [number])
            moved = [
                (*AMPLITUDES[:number], level, *AMPLITUDES[number + 1 :]) for level in range(len(part.levels))
            ]
            assert found == pytest.approx(
                [CONTEST.compute_criterion(each, members) for each in moved], abs=1e-6
            )


def test_columns_that_depend_on_each_other_count_once() -> None:
    block = CONTEST.families[0].blocks[0]
    once, twice = (CONTEST.compute_criterion(AMPLITUDES, each) for each in ([block], [block, block]))
    assert twice == pytest.approx(once, abs=1e-6)


def test_evidence_in_independent_noise_is_that_of_a_prior_worth_one_reading() -> None:
    few = np.flatnonzero((DESIGN.run == 1) & (DESIGN.target % 2 == 0))[:11]  # too few for shared parts
    design = select_readings(DESIGN, few)
    effect = EFFECTS["backlash-gradient"]
    deviation = noise(design) + 2e-6 * design.direction * design.position
    base = np.concatenate([term.effect.columns(design, np.empty(0)) for term in USUAL.terms], axis=1)
    contest = Contest.of(design, base, [effect], deviation, with_nameless=False)
    found = Trials(contest, contest.quiet, [], deviation[:, np.newaxis]).evidence[0, 0]
    degrees = len(deviation) - np.linalg.matrix_rank(base / np.linalg.norm(base, axis=0))

    def squares(columns: FloatArray) -> float:
        scaled = columns / np.linalg.norm(columns, axis=0)
        return float(np.sum((deviation - scaled @ np.linalg.lstsq(scaled, deviation, rcond=1e-10)[0]) ** 2))

    alone = squares(base)
    explained = alone - squares(np.column_stack([base, effect.columns(design, np.empty(0))]))
    # One reading's worth, or rarely more: a mixture of priors, each with its own Bayes factor.
    factor = 0.0
    for worth, weight in ((1, 0.9), (1e2, 0.05), (1e4, 0.03), (1e6, 0.02)):
        prior = worth * degrees
        left = alone - explained * prior / (1 + prior)
        factor += weight * (alone / left) ** (degrees / 2) / math.sqrt(1 + prior)
    assert found == pytest.approx(2 * math.log(factor), rel=1e-6)


def test_a_scan_has_the_evidence_and_the_price_of_an_effect() -> None:
    scan = CONTEST.scan(AMPLITUDES, [])
    evidence = Trials(CONTEST, AMPLITUDES, [], READINGS[:, np.newaxis]).evidence[:, 0]
    for name in ("backlash-bow", "thermal-drift"):
        place = CONTEST.identifiers.index(name)
        assert scan.criterion[_family(CONTEST, name)] == pytest.approx(PRICE - evidence[place], abs=1e-6)


def test_what_the_base_model_describes_changes_nothing() -> None:
    more = READINGS + BASE @ np.array([3e-6, -20e-6, 7e-6, 1e-6, 4e-6])
    one, other = (Trials(CONTEST, AMPLITUDES, [], each[:, np.newaxis]) for each in (READINGS, more))
    assert other.ratios == pytest.approx(one.ratios, abs=1e-6)
    assert other.nameless == pytest.approx(one.nameless, abs=1e-6)


def test_another_basis_of_the_same_model_changes_nothing() -> None:
    turned = _contest(BASE @ np.random.default_rng(1).standard_normal((5, 5)))
    scans = [each.scan(AMPLITUDES, []).criterion for each in (CONTEST, turned)]
    assert scans[1] == pytest.approx(scans[0], abs=1e-5)


def test_the_unit_of_the_deviations_changes_nothing() -> None:
    other = _contest(readings=1e6 * READINGS)
    assert other.scan(AMPLITUDES, []).criterion == pytest.approx(
        CONTEST.scan(AMPLITUDES, []).criterion, abs=1e-6
    )


def test_the_order_of_the_effects_changes_nothing() -> None:
    other = _contest(names=NAMES[::-1])
    one, two = (
        dict(
            zip(
                (family.identifier for family in each.families),
                each.scan(AMPLITUDES, []).criterion,
                strict=True,
            )
        )
        for each in (CONTEST, other)
    )
    assert two == pytest.approx(one, abs=1e-6)


def test_sets_of_deviations_are_judged_each_by_itself() -> None:
    alone = Trials(CONTEST, AMPLITUDES, [], READINGS[:, np.newaxis])
    together = Trials(CONTEST, AMPLITUDES, [], np.column_stack([noise(DESIGN), READINGS]))
    assert together.ratios[:, 1] == pytest.approx(alone.ratios[:, 0], abs=1e-8)
    assert together.evidence[:, 1] == pytest.approx(alone.evidence[:, 0], abs=1e-8)


def test_evidence_that_is_averaged_over_one_noise_is_that_of_this_noise() -> None:
    found = Trials(CONTEST, AMPLITUDES, [], READINGS[:, np.newaxis])
    evidence, nameless = average_evidence([found])
    assert evidence == pytest.approx(found.evidence, abs=1e-9)
    assert nameless == pytest.approx(found.nameless, abs=1e-9)


def test_an_effect_that_the_model_contains_is_not_visible() -> None:
    contest = _contest(names=("scale-error", "backlash", "backlash-bow"))
    assert [effect.identifier for effect in contest.invisible] == ["scale-error", "backlash"]


def test_a_form_that_an_installed_effect_has_is_no_rival_of_it() -> None:
    design = linear_test(11, 3)
    base = np.ones((len(design.position), 1))
    kinds = []
    for names in (("scale-kink", "periodic"), ()):
        contest = Contest.of(
            design, base, [EFFECTS[name] for name in names], forms=list_unnamed_forms(design)
        )
        kinds.append({each.identifier for each in contest.families if not each.is_named})
    assert kinds[1] - kinds[0] == {"kink", "wave"}
    assert {"bump", "step-up", "saw"} <= kinds[0]


def test_a_wave_in_time_that_comes_back_with_every_run_is_a_coincidence() -> None:
    contest = _contest(names=("time-periodic",))
    (family,) = contest.families
    run = float(np.diff(DESIGN.time[np.flatnonzero(np.diff(DESIGN.run)) + 1]).mean())
    of_run = int(np.argmin(np.abs(family.thetas[:, 0] - run)))
    assert family.log_weights[of_run] < np.log(0.35 / len(family.thetas))
    assert np.exp(family.log_weights).sum() == pytest.approx(1.0)


def test_single_readings_that_resemble_those_before_them_are_made_independent() -> None:
    memory = 2.0 * float(np.diff(DESIGN.time).mean())
    weights = np.linspace(0.5, 1.5, len(BASE))
    single = describe_single_readings(DESIGN, weights, memory)
    apart = np.abs(DESIGN.time[:, np.newaxis] - DESIGN.time)
    covariance = np.sqrt(np.outer(weights, weights)) * np.exp(-apart / memory)
    root = single.whiten(np.eye(len(BASE)))
    np.testing.assert_allclose(root @ covariance @ root.T, np.eye(len(BASE)), atol=1e-9)
    np.testing.assert_allclose(single.undo_whitening(root), np.eye(len(BASE)), atol=1e-9)
    np.testing.assert_allclose(single.apply_transposed(np.eye(len(BASE))), root.T, atol=1e-12)
    expected = np.linalg.slogdet(covariance)[1] - np.log(weights).sum()
    assert single.log_determinant == pytest.approx(expected, abs=1e-9)


def test_amplitudes_are_read_from_the_noise_of_a_fit() -> None:
    ratios = {NoiseSource.POSITION: 0.11, NoiseSource.TIME: 0.02}
    found = CONTEST.list_noise_ratios(CONTEST.find_nearest_amplitudes(ratios))
    assert found[NoiseSource.POSITION] == 0.1
    assert found[NoiseSource.TIME] == 0.03


class TestNullDistribution:
    """What chance gives, on the plan of the test and in the noise that was found."""

    null: NullDistribution = simulate_null(CONTEST, CONTEST.quiet)

    def test_a_single_column_reaches_what_the_table_says(self) -> None:
        usual = self.null.usual[CONTEST.identifiers.index("backlash-gradient")]
        # χ² of one degree: 3.84; 400 trials know the point to 0.5.
        assert usual == pytest.approx(3.84, abs=1.0)

    def test_a_search_reaches_more(self) -> None:
        contest = _contest(names=("periodic", "backlash-bow"))
        found = simulate_null(contest, contest.quiet)
        usual = dict(zip(contest.identifiers, found.usual.tolist(), strict=True))
        assert usual["periodic"] > usual["backlash-bow"] + 4

    def test_the_threshold_is_exceeded_by_chance_as_often_as_is_stated(self) -> None:
        excess = self.null.compute_excess(Scores(self.null.ratios, self.null.nameless_ratios))
        assert np.mean(excess > self.null.threshold) == pytest.approx(0.05, abs=0.01)

    def test_the_same_test_gives_the_same_digits(self) -> None:
        contest = _contest()
        again = simulate_null(contest, contest.quiet)
        assert np.array_equal(again.ratios, self.null.ratios)

    def test_a_p_value_is_counted_where_it_can_be(self) -> None:
        ratio = float(np.quantile(self.null.ratios[0], 0.9))
        found = self.null.compute_p_value_of_effect(0, ratio)
        assert not found.is_extrapolated
        assert found.value == pytest.approx(0.1, abs=2 / TRIALS)

    def test_beyond_the_trials_a_p_value_is_extrapolated_and_says_so(self) -> None:
        found = self.null.compute_p_value_of_effect(0, 60.0)
        assert found.is_extrapolated
        assert 0 < found.value < 1e-6

    def test_false_alarms_are_as_rare_as_is_stated(self) -> None:
        fresh = SIGMA * np.random.default_rng(99).standard_normal((len(BASE), 400))
        trials = Trials(CONTEST, CONTEST.quiet, [], fresh)
        alarms = self.null.compute_excess(Scores(trials.ratios, trials.nameless)) > self.null.threshold
        # 400 tests know 5 % to 1.1 %, and 400 trials the threshold to as much.
        assert np.mean(alarms) == pytest.approx(0.05, abs=0.04)


def test_entrants_are_the_forms_that_the_test_can_show() -> None:
    found = list_effects_to_try(USUAL, DESIGN, INSTALLED)
    orders = [len(form.linear) - 1 for form in found.forms if form.identifier == "polynomial"]
    assert orders == [4, 5]
    reasons = {each.effect: each.reason.in_language(Language.ENGLISH) for each in found.not_testable}
    assert reasons["eccentricity"] == "for rotary axes only"
    assert reasons["scale-error"] == "at these targets polynomial imitates it entirely"
    assert "backlash" not in reasons  # it is in the model


def test_what_imitates_an_effect_is_that_of_the_model_which_does_so_by_itself() -> None:
    """A slope is taken for growth while warming up, and is not it; growth that falls back in a pause is."""
    growth = EFFECTS["growth-after-pause"]
    design = linear_test()
    still = replace(design, time=design.time + np.where(design.cycle > 3, 3600.0, 0.0))
    listed = list_effects_to_try(
        model_of("offset", "scale-error", growth), still, [EFFECTS["thermal-growth"]]
    ).not_testable
    (reason,) = [each.reason.in_language(Language.ENGLISH) for each in listed]
    assert reason.startswith("at these targets growth-after-pause imitates it entirely")


def test_what_is_imitated_entirely_comes_with_what_would_show_it() -> None:
    (found,) = list_effects_to_try(model_of("scale-error"), DESIGN, [EFFECTS["cosine-error"]]).not_testable
    assert found.reason.in_language(Language.ENGLISH) == (
        "at these targets scale-error imitates it entirely; what would show it: align the beam anew until it "
        "returns to the same spot along the whole travel, and repeat"
    )


def test_a_curve_without_a_name_varies_about_nothing() -> None:
    # Its mean has a name: a constant gap is lost motion, whatever the gap does beside it.
    design = linear_test()
    base = np.ones((len(design.position), 1))
    contest = Contest.of(design, base, [EFFECTS["scale-error"]], noise(design))
    gap = contest.space.of(design.direction[:, np.newaxis])[:, 0]
    curves = [each for each in contest.parts if each.course is Course.REVERSAL and each.source is None]
    assert curves
    for each in curves:
        columns = contest.columns.select_columns(each.columns)
        assert np.abs(gap @ columns).max() < 1e-9 * np.linalg.norm(gap) * np.linalg.norm(columns)


def test_a_curve_of_the_reversal_without_a_name_has_no_lost_motion_in_it() -> None:
    contest = _contest(EFFECTS["offset"].columns(DESIGN, np.empty(0)))
    gap = contest.space.of(DESIGN.direction[:, np.newaxis] / len(DESIGN.direction) ** 0.5)
    curves = [each for each in contest.parts if each.course in (Course.REVERSAL, Course.REVERSAL_IN_TIME)]
    assert len(curves) == 4
    for each in curves:
        # Each has a mean square of one at the readings.
        shared = gap.T @ contest.columns.select_columns(each.columns)
        assert np.abs(shared).max() < 0.01 * len(DESIGN.direction) ** 0.5


def test_noise_that_readings_share_is_the_rarer_the_larger_it_is_but_not_that_of_positions() -> None:
    costs = {part.source: part.costs[: part.noise_levels] for part in CONTEST.parts if part.source}
    assert set(costs.pop(NoiseSource.POSITION)) == {0.0}
    assert set(costs) == {NoiseSource.DIRECTION, NoiseSource.RUN, NoiseSource.TIME}
    for each in costs.values():
        np.testing.assert_allclose(np.diff(each), 1.0)
