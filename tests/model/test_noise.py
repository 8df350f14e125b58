"""The covariance of a test, and what restricted likelihood finds of it."""

from __future__ import annotations

import numpy as np
import pytest

from model.axis_tests import SIGMA, USUAL, linear_test, noise, realistic_noise
from zlmreport.model.fitting.contrasts import estimate_restricted, make_contrasts_of, make_root, make_whitener
from zlmreport.model.fitting.noise import BY_TARGET, Noise, NoiseSource, list_noise_parts, make_ratio_grid
from zlmreport.plugin import Axis, FloatArray
from zlmreport.plugin.effect import Design

DESIGN = linear_test(targets=9, runs=4)
PARTS = list_noise_parts(DESIGN)
RATIOS = np.array([0.3, 0.1, 0.2, 0.4])
WEIGHTS = np.linspace(0.7, 1.3, len(DESIGN.position))


def _base(design: Design) -> FloatArray:
    return np.concatenate([term.effect.columns(design, np.empty(0)) for term in USUAL.terms], axis=1)


def _covariance(ratios: FloatArray = RATIOS, weights: FloatArray = WEIGHTS) -> FloatArray:
    shared = sum(ratio * part.factor @ part.factor.T for ratio, part in zip(ratios, PARTS, strict=True))
    return np.diag(weights) + shared


def test_readings_of_a_target_a_run_and_a_while_scatter_together() -> None:
    assert [part.source for part in PARTS] == list(NoiseSource)


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.source.value)
def test_every_source_adds_its_ratio_to_the_variance_of_each_reading(part: object) -> None:
    diagonal = np.sum(part.factor**2, axis=1)  # type: ignore[attr-defined]
    assert diagonal == pytest.approx(np.ones(len(diagonal)), rel=1e-12)


def test_direction_has_no_part_in_a_unidirectional_test() -> None:
    one_way = np.flatnonzero(DESIGN.direction > 0)
    design = Design(
        Axis("X"),
        DESIGN.position[one_way],
        DESIGN.direction[one_way],
        DESIGN.run[one_way],
        DESIGN.target[one_way],
        DESIGN.time[one_way],
        time_is_counted=False,
        since_reversal=DESIGN.since_reversal[one_way],
    )
    assert NoiseSource.DIRECTION not in [part.source for part in list_noise_parts(design)]


def test_a_single_run_says_nothing_of_what_targets_share_in_each_direction() -> None:
    design = linear_test(targets=9, runs=1)
    sources = [part.source for part in list_noise_parts(design)]
    assert NoiseSource.DIRECTION not in sources
    assert NoiseSource.RUN not in sources


def test_whitened_readings_are_independent() -> None:
    by_source = {part.source: float(ratio) for part, ratio in zip(PARTS, RATIOS, strict=True)}
    whiten = make_whitener(PARTS, Noise(1.0, by_source, WEIGHTS))
    root = whiten(np.eye(len(WEIGHTS)))
    assert root @ _covariance() @ root.T == pytest.approx(np.eye(len(WEIGHTS)), abs=1e-10)


@pytest.mark.parametrize("left_out", [frozenset(), BY_TARGET, frozenset({NoiseSource.RUN, NoiseSource.TIME})])
def test_the_root_of_a_fit_makes_readings_independent(left_out: frozenset[NoiseSource]) -> None:
    by_source = {
        part.source: 0.0 if part.source in left_out else float(ratio)
        for part, ratio in zip(PARTS, RATIOS, strict=True)
    }
    root = make_root(PARTS, Noise(1.0, by_source, WEIGHTS))
    unit = np.eye(len(WEIGHTS))
    covariance = _covariance(np.array([by_source[part.source] for part in PARTS]))
    assert root(unit) @ covariance @ root(unit).T == pytest.approx(unit, abs=1e-10)
    assert root.apply_transposed(unit) == pytest.approx(root(unit).T, abs=1e-12)


def test_restricted_likelihood_is_that_of_the_textbook() -> None:
    base, values = _base(DESIGN), realistic_noise(DESIGN)
    space = make_contrasts_of(base, PARTS, WEIGHTS)
    differences = []
    for ratios in (RATIOS, 2 * RATIOS):
        covariance = _covariance(ratios)
        inverse = np.linalg.inv(covariance)
        inner = base.T @ inverse @ base
        left = values - base @ np.linalg.solve(inner, base.T @ inverse @ values)
        squares = left @ inverse @ left
        determinants = np.linalg.slogdet(covariance)[1] + np.linalg.slogdet(inner)[1]
        expected = (len(base) - base.shape[1]) * np.log(squares) + determinants
        found, found_squares = space.make_criterion(space.of(values))(ratios)
        assert found_squares == pytest.approx(squares, rel=1e-9)
        differences.append(found - expected)
    assert differences[0] == pytest.approx(differences[1], abs=1e-7)  # a constant of the base model only


def test_estimate_of_the_noise_is_nowhere_surpassed_on_the_grid() -> None:
    values = realistic_noise(DESIGN)
    space = make_contrasts_of(_base(DESIGN), PARTS, WEIGHTS)
    grid = make_ratio_grid(PARTS)
    contrast = space.of(values)
    ratios, _ = estimate_restricted(space, contrast, grid, grid.max(axis=0))
    criterion = space.make_criterion(contrast)
    best = min(criterion(each)[0] for each in grid)
    assert criterion(ratios)[0] <= best


def test_noise_of_known_parts_is_found_on_average() -> None:
    design = linear_test()
    parts = list_noise_parts(design)
    space = make_contrasts_of(_base(design), parts, np.ones(len(design.position)))
    largest = np.full(len(parts), 1e3)
    found = []
    for seed in range(12):
        values = space.of(realistic_noise(design, seed))
        ratios, variance = estimate_restricted(space, values, make_ratio_grid(parts), largest)
        found.append([np.sqrt(variance), np.sqrt(variance * ratios[0])])
    sigma, geometry = np.mean(found, axis=0)
    # 12 tests of 200 degrees of freedom know σ to 1.5 %, those of 16 targets the geometry to 15 %.
    assert sigma == pytest.approx(SIGMA, rel=0.06)
    assert geometry == pytest.approx(0.3e-6, rel=0.45)


def test_independent_noise_needs_no_shared_part() -> None:
    space = make_contrasts_of(_base(DESIGN), PARTS, np.ones(len(DESIGN.position)))
    grid = make_ratio_grid(PARTS)
    ratios, _ = estimate_restricted(space, space.of(noise(DESIGN)), grid, grid.max(axis=0))
    assert ratios.max() < 0.2
