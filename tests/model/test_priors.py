"""What earlier tests say, and how it is learned."""

from __future__ import annotations

import json

import numpy as np
import pytest
import yaml

from model.axis_tests import AXIS, EFFECTS, SIGMA, linear_test, model_of, noise
from zlmreport.job.evaluation_keys import PriorsKeys
from zlmreport.model.diagnosis.contest import Contest
from zlmreport.model.fitting.contrasts import make_contrasts_of
from zlmreport.model.fitting.fit import Fit, fit
from zlmreport.model.fitting.noise import NoiseSource, list_noise_parts, make_ratio_grid
from zlmreport.model.fitting.priors import Lesson, PriorExpectation, learn_priors, write_priors
from zlmreport.plugin import FloatArray
from zlmreport.plugin.effect import Design

_MODEL = model_of("offset", "scale-error", "backlash")
_DESIGN = linear_test(targets=11, runs=3, seed=4)


def _scattered(design: Design, seed: int, fixed: float) -> FloatArray:
    """Return independent noise, and a part of it that is fixed to the positions, in units of SIGMA."""
    random = np.random.default_rng(1000 + seed)
    return (
        noise(design, seed) + fixed * SIGMA * random.standard_normal(design.target.max() + 1)[design.target]
    )


def _learned(fits: list[Fit]) -> PriorsKeys:
    return learn_priors([Lesson.of(each) for each in fits])


def _fits(fixed: float, tests: int) -> list[Fit]:
    designs = [linear_test(targets=15, runs=3, seed=seed) for seed in range(1, tests + 1)]
    lost = [-2e-6 * EFFECTS["backlash"].columns(each, np.empty(0))[:, 0] for each in designs]
    return [
        fit(_MODEL, design, own + _scattered(design, seed, fixed))
        for seed, (design, own) in enumerate(zip(designs, lost, strict=True), start=1)
    ]


def _contest(design: Design, readings: FloatArray, expected: PriorExpectation, *effects: str) -> Contest:
    base = np.concatenate([term.effect.columns(design, np.empty(0)) for term in _MODEL.terms], axis=1)
    return Contest.of(design, base, [EFFECTS[each] for each in effects], readings, expected=expected)


def test_an_amplitude_that_was_seldom_costs_what_its_probability_says() -> None:
    readings = _scattered(_DESIGN, 3, 0.5)
    stated = np.array([[0.0, 0.03, 0.1, 0.25], [0.1, 0.2, 0.3, 0.4]])
    plain = _contest(_DESIGN, readings, PriorExpectation())
    knowing = _contest(_DESIGN, readings, PriorExpectation({NoiseSource.POSITION: stated}))
    place = [part.source for part in plain.parts].index(NoiseSource.POSITION)
    for level, probability in enumerate(stated[1]):
        amplitudes = tuple(level * (number == place) for number in range(len(plain.parts)))
        rise = knowing.compute_criterion(amplitudes, []) - plain.compute_criterion(amplitudes, [])
        assert rise == pytest.approx(-2 * np.log(4 * probability), abs=1e-9)


def test_what_was_learned_are_the_probabilities_from_which_the_tests_come() -> None:
    fits = _fits(0.5, 3)
    found = _learned(fits).noise["position"]
    ratios, probabilities = np.array(found.ratios), np.array(found.probabilities)
    expected = PriorExpectation.of(_learned(fits), AXIS)
    counts = np.full(len(ratios), 1.0 / len(ratios))  # of the test that knows nothing
    for each in fits:
        parts = list_noise_parts(each.design)
        space = make_contrasts_of(each.compute_base(), parts, each.noise.weights)
        criterion, grid = space.make_criterion(space.of(each.open_deviation)), make_ratio_grid(parts)
        criteria = np.array([criterion(row)[0] for row in grid])
        sources = [part.source for part in parts]
        posterior = np.exp(-0.5 * (criteria - criteria.min())) * expected.compute_probabilities(sources, grid)
        column = grid[:, sources.index(NoiseSource.POSITION)]
        counts += [posterior[column == ratio].sum() / posterior.sum() for ratio in ratios]
    np.testing.assert_allclose(probabilities, counts / counts.sum(), atol=2e-3)


def test_what_a_ledger_keeps_of_a_test_teaches_the_same() -> None:
    lessons = [Lesson.of(each) for each in _fits(0.3, 3)]
    kept = [Lesson.from_json(json.loads(json.dumps(each.as_json()))) for each in lessons]
    assert write_priors(learn_priors(kept), "ledger") == write_priors(learn_priors(lessons), "ledger")


def test_the_file_of_priors_is_one_whatever_the_folder_is_called() -> None:
    learned = learn_priors([Lesson.of(each) for each in _fits(0.3, 3)])
    texts = [write_priors(learned, name) for name in ("night", "ni\nght: [", "ni\u2028ght")]
    assert "in night say" in texts[0]
    first, *others = (yaml.safe_load(each) for each in texts)
    assert others == [first, first]


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
    size = 5 * np.sqrt(np.mean(EFFECTS["first-run"].columns(_DESIGN, np.empty(0)) ** 2))
    known, wrong = (
        contest.scan(contest.quiet, []).criterion[0]
        for each in (float(size), 300.0)
        for contest in [_contest(_DESIGN, readings, PriorExpectation(sizes={"first-run": each}), "first-run")]
    )
    assert known < wrong - 2
    small = PriorExpectation(sizes={"first-run": 2e-6}).in_units_of(1e-6)
    assert small.find_square("first-run") == pytest.approx(4.0)
    assert small.find_square("backlash") == 1.0


def test_ratios_of_a_file_that_are_not_tried_count_for_the_nearest() -> None:
    parts = [part for part in list_noise_parts(_DESIGN) if part.source is NoiseSource.POSITION]
    expected = PriorExpectation({NoiseSource.POSITION: np.array([[0.01, 0.2, 0.5], [1.0, 2.0, 1.0]])})
    found = expected.compute_probabilities([part.source for part in parts], make_ratio_grid(parts))
    np.testing.assert_allclose(found, [0.25, 0.0, 0.0, 0.75], atol=2e-3)
    assert np.all(found > 0)


def test_tests_of_an_angle_teach_in_arc_seconds_and_say_what_they_measured() -> None:
    taught = _learned(_fits(0.5, 1)).model_copy(update={"measurand": "angle"})
    written = write_priors(taught, "earlier")
    assert "measurand: angle\n" in written
    assert "root mean square, ″\n" in written
    assert PriorsKeys.model_validate(yaml.safe_load(written)).measurand == "angle"
