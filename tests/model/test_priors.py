"""What earlier tests say, and how it is learned."""

from __future__ import annotations

import json

import numpy as np
import pytest

from model.axis_tests import AXIS, EFFECTS, SIGMA, linear_test, model_of, noise
from zlmreport.job.evaluation_keys import PriorsKeys
from zlmreport.model.comparison import Comparison
from zlmreport.model.design import Design
from zlmreport.model.evidence import evidence_of
from zlmreport.model.fit import Fit, fit
from zlmreport.model.nameless import SIZES
from zlmreport.model.noise import NoiseSource, noise_parts, ratio_grid
from zlmreport.model.priors import Expected, Lesson, as_text, learned
from zlmreport.quantities.arrays import FloatArray

_MODEL = model_of("offset", "scale-error", "backlash")
_DESIGN = linear_test(targets=11, runs=3, seed=4)


def _scattered(design: Design, seed: int, fixed: float) -> FloatArray:
    """Return independent noise, and a part of it that is fixed to the positions, in units of SIGMA."""
    random = np.random.default_rng(1000 + seed)
    return (
        noise(design, seed) + fixed * SIGMA * random.standard_normal(design.target.max() + 1)[design.target]
    )


def _learned(fits: list[Fit]) -> PriorsKeys:
    return learned([Lesson.of(each) for each in fits])


def _fits(fixed: float, tests: int) -> list[Fit]:
    designs = [linear_test(targets=15, runs=3, seed=seed) for seed in range(1, tests + 1)]
    lost = [-2e-6 * EFFECTS["backlash"].columns(each, np.empty(0))[:, 0] for each in designs]
    return [
        fit(_MODEL, design, own + _scattered(design, seed, fixed))
        for seed, (design, own) in enumerate(zip(designs, lost, strict=True), start=1)
    ]


def _comparison(design: Design, *effects: str) -> Comparison:
    base = np.concatenate([term.effect.columns(design, np.empty(0)) for term in _MODEL.terms], axis=1)
    return Comparison.of(design, base, [EFFECTS[each] for each in effects], np.ones(len(design.position)))


def test_one_who_expects_nothing_compares_as_before() -> None:
    readings = _scattered(_DESIGN, 3, 0.3)
    plain = _comparison(_DESIGN, "screw-pitch", "thermal-drift")
    found = evidence_of(plain, _DESIGN, readings, 1e-6)
    again = evidence_of(plain.expecting(Expected()), _DESIGN, readings, 1e-6)
    np.testing.assert_array_equal(again.effects, found.effects)


def test_the_posterior_is_the_restricted_likelihood_times_the_prior() -> None:
    readings = _scattered(_DESIGN, 3, 0.5)
    stated = np.array([[0.0, 0.03, 0.1, 0.25], [0.1, 0.2, 0.3, 0.4]])
    comparison = _comparison(_DESIGN, "screw-pitch").expecting(Expected({NoiseSource.POSITION: stated}))
    parts = noise_parts(_DESIGN)
    base = np.concatenate([term.effect.columns(_DESIGN, np.empty(0)) for term in _MODEL.terms], axis=1)
    place = [part.source for part in parts].index(NoiseSource.POSITION)
    logarithms = []
    for ratios in ratio_grid(parts):
        covariance = np.eye(len(base))
        for part, ratio in zip(parts, ratios, strict=True):
            covariance += ratio * part.factor @ part.factor.T
        inverse = np.linalg.inv(covariance)
        gram = base.T @ inverse @ base
        left = readings - base @ np.linalg.solve(gram, base.T @ inverse @ readings)
        degrees = len(base) - base.shape[1]
        restricted = np.linalg.slogdet(covariance)[1] + np.linalg.slogdet(gram)[1]
        restricted += degrees * np.log(left @ inverse @ left)
        prior = stated[1][np.searchsorted(stated[0], ratios[place])]
        logarithms.append(np.log(prior) - 0.5 * restricted)
    expected = np.exp(np.array(logarithms) - max(logarithms))
    np.testing.assert_allclose(comparison.posterior(readings), expected / expected.sum(), rtol=1e-6)


def test_what_was_learned_are_the_probabilities_from_which_the_tests_come() -> None:
    fits = _fits(0.5, 3)
    found = _learned(fits).noise["position"]
    ratios, probabilities = np.array(found.ratios), np.array(found.probabilities)
    keys = _learned(fits)
    expected = Expected.of(keys, AXIS)
    counts = np.full(len(ratios), 1.0 / len(ratios))  # of the test that knows nothing
    for each in fits:
        parts = noise_parts(each.design)
        comparison = Comparison.of(each.design, each.base(), [EFFECTS["screw-pitch"]], each.noise.weights)
        posterior = comparison.expecting(expected).posterior(each.open_deviation)
        column = comparison.grid[:, [part.source for part in parts].index(NoiseSource.POSITION)]
        counts += [posterior[column == ratio].sum() for ratio in ratios]
    np.testing.assert_allclose(probabilities, counts / counts.sum(), atol=2e-3)


def test_what_a_ledger_keeps_of_a_test_teaches_the_same() -> None:
    lessons = [Lesson.of(each) for each in _fits(0.3, 3)]
    kept = [Lesson.from_json(json.loads(json.dumps(each.as_json()))) for each in lessons]
    assert as_text(learned(kept), "ledger") == as_text(learned(lessons), "ledger")


def test_axes_with_geometry_of_their_own_teach_it_and_others_teach_that_there_is_none() -> None:
    irregular, smooth = (_learned(_fits(fixed, 6)).noise["position"].probabilities for fixed in (0.5, 0.0))
    assert sum(irregular[2:]) > 0.8
    assert smooth[0] + smooth[1] > 0.6
    assert sum(irregular) == pytest.approx(1.0)


def test_the_size_of_an_effect_is_what_the_rest_of_the_model_cannot_imitate() -> None:
    keys = _learned(_fits(0.0, 2))
    # A lost motion of 2 µm is ± 1 µm, in as many readings up as down.
    assert keys.effects["backlash"].rms == pytest.approx(1.0, abs=0.1)
    assert keys.effects["backlash"].tests == 2


def test_an_effect_of_the_expected_size_has_more_evidence_than_one_of_another() -> None:
    readings = noise(_DESIGN, 5) + 5 * SIGMA * EFFECTS["first-run"].columns(_DESIGN, np.empty(0))[:, 0]
    plain = _comparison(_DESIGN, "first-run")
    size = 5 * np.sqrt(np.mean(EFFECTS["first-run"].columns(_DESIGN, np.empty(0)) ** 2))
    known, wrong = (
        evidence_of(plain.expecting(Expected(sizes={"first-run": each})), _DESIGN, readings, 1e-6)
        for each in (float(size), 300.0)
    )
    assert known.effects[0] > wrong.effects[0] + 2
    small = Expected(sizes={"first-run": 2e-6}).in_units_of(1e-6)
    assert small.square("first-run") == pytest.approx(4.0)
    assert small.square("backlash") == 1.0


def test_ratios_of_a_file_that_are_not_tried_count_for_the_nearest() -> None:
    parts = [part for part in noise_parts(_DESIGN) if part.source is NoiseSource.POSITION]
    expected = Expected({NoiseSource.POSITION: np.array([[0.01, 0.2, 0.5], [1.0, 2.0, 1.0]])})
    found = expected.probabilities([part.source for part in parts], ratio_grid(parts))
    np.testing.assert_allclose(found, [0.25, 0.0, 0.0, 0.75], atol=2e-3)
    assert np.all(found > 0)


def test_a_shape_without_a_name_gains_nothing_from_what_is_known_of_the_noise_but_that() -> None:
    readings = _scattered(_DESIGN, 3, 0.5)
    plain = _comparison(_DESIGN, "screw-pitch")
    parts = noise_parts(_DESIGN)
    # One φ, of those under which shapes are tried, is all but certain.
    known = {part.source: part.ratios[1 if len(part.ratios) == 3 else 2] for part in parts}
    ratios = {source: np.array([[ratio], [1.0]]) for source, ratio in known.items()}
    row = int(np.argmin(np.abs(plain.grid - list(known.values())).sum(axis=1)))
    criteria = plain.criteria(readings)
    shapes = criteria.nameless.reshape(-1, len(SIZES), len(plain.nameless))
    of_row = shapes[sorted(plain._nameless_modes).index(row)]
    likelihoods = np.exp(-0.5 * (of_row - criteria.null[row])).mean(axis=0)
    found = evidence_of(plain.expecting(Expected(ratios)), _DESIGN, readings, 1e-6).nameless
    np.testing.assert_allclose(found, 2 * np.log(likelihoods), atol=0.15)
