"""The comparison: its numbers against plain fits, what leaves them alone, and what chance gives."""

from __future__ import annotations

import numpy as np
import pytest

from model.axis_tests import (
    EFFECTS,
    INSTALLED,
    USUAL,
    hidden,
    known,
    linear_test,
    model_of,
    noise,
    observations,
    realistic_noise,
)
from zlmreport.language import Language
from zlmreport.model.candidates import effects_to_try
from zlmreport.model.comparison import Comparison, Scores
from zlmreport.model.contrasts import contrasts_of
from zlmreport.model.evidence import Evidence, evidence_of
from zlmreport.model.fit import fit
from zlmreport.model.noise import noise_parts
from zlmreport.model.null_distribution import TRIALS, simulate_null
from zlmreport.model.steps import compared
from zlmreport.quantities.arrays import FloatArray

DESIGN = linear_test(targets=9, runs=3)
BASE = np.concatenate([term.effect.columns(DESIGN, np.empty(0)) for term in USUAL.terms], axis=1)
ONES = np.ones(len(DESIGN.position))
READINGS = known(DESIGN) + realistic_noise(DESIGN) + hidden(DESIGN, "backlash-bow", size=0.5)
NAMES = ("backlash-gradient", "backlash-bow", "screw-pitch", "thermal-drift", "scale-expansion")


def _contest(base: FloatArray = BASE, names: tuple[str, ...] = NAMES) -> Comparison:
    return Comparison.of(DESIGN, base, [EFFECTS[name] for name in names], ONES)


def _names(comparison: Comparison) -> list[str]:
    bases = comparison.bases
    return [bases.families[forms[0]].effect.identifier for forms in bases.by_effect]


def _evidence(comparison: Comparison, readings: FloatArray) -> Evidence:
    return evidence_of(comparison, DESIGN, readings, 1e-6)


COMPARISON = _contest()
SCORES = COMPARISON.scores(READINGS[:, np.newaxis])


@pytest.fixture(scope="module")
def covariances() -> list[tuple[FloatArray, float]]:
    """For each φ the inverse of V, and the determinants of the restricted likelihood."""
    found = []
    for ratios in COMPARISON.grid:
        parts = zip(ratios, noise_parts(DESIGN), strict=True)
        covariance = np.eye(len(BASE)) + sum(ratio * part.factor @ part.factor.T for ratio, part in parts)
        inverse = np.linalg.inv(covariance)
        inner = BASE.T @ inverse @ BASE
        found.append((inverse, float(np.linalg.slogdet(covariance)[1] + np.linalg.slogdet(inner)[1])))
    return found


@pytest.mark.parametrize("name", NAMES)
def test_likelihood_ratio_is_that_of_plain_fits(
    name: str, covariances: list[tuple[FloatArray, float]]
) -> None:
    effect = EFFECTS[name]

    def least(columns: FloatArray) -> float:
        """Return the least −2 ln(restricted likelihood) of the base model with columns fitted beside it."""
        both = np.concatenate([BASE, columns], axis=1)
        criteria = []
        for inverse, determinants in covariances:
            weighted = both.T @ inverse
            left = READINGS - both @ np.linalg.solve(weighted @ both, weighted @ READINGS)
            criteria.append((len(BASE) - 5) * np.log(left @ inverse @ left) + determinants)
        return float(min(criteria))

    best = min(least(effect.columns(DESIGN, theta)) for theta in effect.grid(DESIGN))
    found = SCORES.ratios[_names(COMPARISON).index(name), 0]
    assert found == pytest.approx(least(BASE[:, :0]) - best, abs=1e-5)


def test_what_the_base_model_describes_changes_nothing() -> None:
    more = READINGS + BASE @ np.array([3e-6, -20e-6, 7e-6, 1e-6, 4e-6])
    found = COMPARISON.scores(more[:, np.newaxis])
    assert found.ratios == pytest.approx(SCORES.ratios, abs=1e-6)
    assert found.nameless_ratios == pytest.approx(SCORES.nameless_ratios, abs=1e-6)


def test_another_basis_of_the_same_model_changes_nothing() -> None:
    turned = BASE @ np.random.default_rng(1).standard_normal((5, 5))
    assert _contest(turned).scores(READINGS[:, np.newaxis]).ratios == pytest.approx(SCORES.ratios, abs=1e-5)


def test_the_unit_of_the_deviations_changes_nothing() -> None:
    found = COMPARISON.scores(1e6 * READINGS[:, np.newaxis])
    assert found.ratios == pytest.approx(SCORES.ratios, abs=1e-6)
    evidence, in_micrometres = _evidence(COMPARISON, READINGS), _evidence(COMPARISON, 1e6 * READINGS)
    assert in_micrometres.effects == pytest.approx(evidence.effects, abs=1e-6)


def test_the_order_of_the_effects_changes_nothing() -> None:
    other = _contest(names=NAMES[::-1])
    found = dict(zip(_names(other), other.scores(READINGS[:, np.newaxis]).ratios[:, 0], strict=True))
    assert found == pytest.approx(dict(zip(_names(COMPARISON), SCORES.ratios[:, 0], strict=True)), abs=1e-6)


def test_sets_of_deviations_are_judged_each_by_itself() -> None:
    together = COMPARISON.scores(np.column_stack([noise(DESIGN), READINGS]))
    assert together.ratios[:, 1] == pytest.approx(SCORES.ratios[:, 0], abs=1e-8)


def test_an_effect_that_the_model_contains_is_not_visible() -> None:
    comparison = _contest(names=("scale-error", "backlash", "backlash-bow"))
    assert [effect.identifier for effect in comparison.bases.invisible] == ["scale-error", "backlash"]


def test_the_best_value_of_a_searched_parameter_is_the_one_that_was_hidden() -> None:
    constants = EFFECTS["thermal-drift"].grid(DESIGN)[:, 0]
    place = len(constants) // 2
    readings = known(DESIGN) + noise(DESIGN) + hidden(DESIGN, "thermal-drift", [constants[place]], size=5.0)
    effect, theta = _evidence(COMPARISON, readings).best[_names(COMPARISON).index("thermal-drift")]
    assert effect.identifier == "thermal-drift"
    # Between the values of the grid as well: nearer than the next of them.
    assert constants[place - 1] < theta[0] < constants[place + 1]


def test_evidence_of_a_single_column_is_its_likelihood_ratio_less_the_price_of_a_parameter() -> None:
    plain = Comparison.of(DESIGN, BASE, [EFFECTS["backlash-bow"]], ONES)
    ratio, degrees = float(plain.scores(READINGS[:, np.newaxis]).ratios[0, 0]), len(BASE) - 5
    found = float(_evidence(plain, READINGS).effects[0])
    # Averaged over the noise instead of at its best, the two differ by a little more.
    assert found == pytest.approx(ratio - np.log(1 + degrees), abs=2.0)


def test_what_a_search_finds_in_noise_is_no_evidence() -> None:
    comparison = _contest(names=("periodic",))
    sets = [known(DESIGN) + noise(DESIGN, seed) for seed in range(10)]
    # Tables of χ² with the two degrees of freedom of a wave would give a mean ratio of 2.
    assert np.mean(comparison.scores(np.column_stack(sets)).ratios) > 3
    assert np.mean([_evidence(comparison, readings).effects[0] for readings in sets]) < 0


class TestNullDistribution:
    """What chance gives, on the plan of the test and in the noise that was found."""

    null = simulate_null(COMPARISON, DESIGN, np.zeros(COMPARISON.grid.shape[1]))

    def test_a_single_column_reaches_what_the_table_says(self) -> None:
        usual = self.null.usual[_names(COMPARISON).index("backlash-gradient")]
        # χ² of one degree: 3.84; the noise is fitted as well, and 400 trials know the point to 0.5.
        assert usual == pytest.approx(3.84, abs=1.3)

    def test_a_search_reaches_more(self) -> None:
        comparison = _contest(names=("periodic", "backlash-bow"))
        found = simulate_null(comparison, DESIGN, np.zeros(comparison.grid.shape[1]))
        periodic, bow = (found.usual[_names(comparison).index(name)] for name in ("periodic", "backlash-bow"))
        assert periodic > bow + 4

    def test_the_threshold_is_exceeded_by_chance_as_often_as_is_stated(self) -> None:
        excess = self.null.excess(Scores(self.null.ratios, self.null.nameless_ratios))
        assert np.mean(excess > self.null.threshold) == pytest.approx(0.05, abs=0.01)

    def test_the_same_test_gives_the_same_digits(self) -> None:
        again = simulate_null(_contest(), DESIGN, np.zeros(COMPARISON.grid.shape[1]))
        assert np.array_equal(again.ratios, self.null.ratios)

    def test_a_p_value_is_counted_where_it_can_be(self) -> None:
        ratio = float(np.quantile(self.null.ratios[0], 0.9))
        found = self.null.p_value_of_effect(0, ratio)
        assert not found.is_extrapolated
        assert found.value == pytest.approx(0.1, abs=2 / TRIALS)

    def test_beyond_the_trials_a_p_value_is_extrapolated_and_says_so(self) -> None:
        found = self.null.p_value_of_effect(0, 60.0)
        assert found.is_extrapolated
        assert 0 < found.value < 1e-6

    def test_false_alarms_are_as_rare_as_is_stated(self) -> None:
        tests = noise_parts(DESIGN)
        space = contrasts_of(BASE, tests, ONES)
        assert space.degrees == len(BASE) - 5
        fresh = np.random.default_rng(99).standard_normal((len(BASE), 400))
        alarms = self.null.excess(COMPARISON.scores(fresh)) > self.null.threshold
        # 400 tests know 5 % to 1.1 %, and 400 trials the threshold to as much.
        assert np.mean(alarms) == pytest.approx(0.05, abs=0.04)


def test_entrants_are_the_forms_that_the_test_can_show() -> None:
    found = effects_to_try(USUAL, DESIGN, INSTALLED)
    orders = [len(form.linear) - 1 for form in found.forms if form.identifier == "polynomial"]
    assert orders == [4, 5]
    reasons = {each.effect: each.reason.in_language(Language.ENGLISH) for each in found.not_testable}
    assert reasons["eccentricity"] == "it belongs to rotary axes"
    assert reasons["scale-error"] == "at these targets polynomial imitates it entirely"
    assert "backlash" not in reasons  # it is in the model


def test_what_is_imitated_entirely_comes_with_what_would_show_it() -> None:
    (found,) = effects_to_try(model_of("scale-error"), DESIGN, [EFFECTS["cosine-error"]]).not_testable
    assert found.reason.in_language(Language.ENGLISH) == (
        "at these targets scale-error imitates it entirely; what would show it: align the beam anew until it "
        "returns to the same spot along the whole travel, and repeat"
    )


def test_a_contest_without_contestants_finds_nothing() -> None:
    observed = observations(DESIGN, known(DESIGN) + noise(DESIGN))
    step = compared(fit(USUAL, observed.design, observed.deviation), [])
    assert step.best is None
    assert step.visible == ()
