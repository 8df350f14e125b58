"""Equation (13): recovery, an independent computation, uncertainty anywhere in the plane."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model import halaj
from model.plane.planes import COEFFICIENTS, DESIGN, LINES, LOST_MOTION, fitted, measured, truth
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.estimate import InstrumentError
from zlmreport.model.fitting.noise import NoiseSource, list_noise_parts
from zlmreport.model.plane.surface import Surface, SurfaceLine, join_side_by_side, list_coefficient_names
from zlmreport.plugin import MICROMETRE, MILLIMETRE, Approach, FloatArray

INSTRUMENT = InstrumentError(0.5e-6)
#: Where nobody measured: P and R, m.
BETWEEN = [(0.05, 0.12), (0.33, 0.2), (0.5, 0.4), (0.71, 0.33), (0.97, 0.48)]


def _columns(surface: Surface) -> FloatArray:
    return halaj.columns(surface.fit.design.position, surface.readings.across)


def _deviation_at(surface: Surface) -> FloatArray:
    along, across = np.array(BETWEEN).T
    return truth(along, across, float(surface.approach))


@pytest.mark.parametrize("approach", Approach)
def test_readings_without_noise_give_the_coefficients_back(approach: Approach) -> None:
    found = fitted(measured(sigma=0.0), approach).compute_coefficients()
    expected = COEFFICIENTS + np.array([approach * LOST_MOTION / 2, 0, 0, 0, 0, 0, 0])
    assert found.values == pytest.approx(expected, rel=1e-7)


def test_where_every_point_has_as_many_readings_the_estimate_is_that_of_the_paper() -> None:
    surface = fitted(measured(), instrument=INSTRUMENT)
    assert np.ptp(surface.fit.noise.weights) == 0.0  # the scatter is the same everywhere
    points = [surface.fit.design.position, surface.readings.across]
    (along, across), mean, u = halaj.means(points, surface.fit.deviation)
    pooled = float(np.sqrt(np.mean(u**2)))
    expected, _ = halaj.solve(halaj.columns(along, across), mean, pooled, INSTRUMENT.common)
    assert surface.compute_coefficients().values == pytest.approx(expected, rel=1e-6)


def test_the_covariance_is_that_of_the_textbook() -> None:
    surface = fitted(measured(), instrument=INSTRUMENT)
    noise, columns = surface.fit.noise, _columns(surface)
    variance = np.diag(noise.weights)
    for part in list_noise_parts(surface.fit.design):
        variance = variance + noise.ratios.get(part.source, 0.0) * part.factor @ part.factor.T
    variance = noise.sigma**2 * variance + INSTRUMENT.common**2
    expected = np.linalg.inv(columns.T @ np.linalg.inv(variance) @ columns)
    found = surface.compute_coefficients().covariance
    lengths = np.sqrt(np.diag(expected))
    assert found / np.outer(lengths, lengths) == pytest.approx(
        expected / np.outer(lengths, lengths), abs=1e-5
    )


def test_coefficients_and_covariance_give_the_deviation_anywhere() -> None:
    surface = fitted(measured(), instrument=INSTRUMENT)
    found, predicted = surface.compute_coefficients(), surface.predict(BETWEEN)
    rows = halaj.columns(*np.array(BETWEEN).T)
    assert rows @ found.values == pytest.approx(predicted.deviation, rel=1e-9)
    u = np.sqrt(np.einsum("np,pq,nq->n", rows, found.covariance, rows))
    assert u == pytest.approx(predicted.standard_uncertainty, rel=1e-6)


def test_expanded_uncertainty_holds_where_nobody_measured() -> None:
    holds = []
    for seed in range(40):
        surface = fitted(measured(seed))
        found = surface.predict(BETWEEN)
        holds.append(np.abs(found.deviation - _deviation_at(surface)) <= found.expanded_uncertainty)
    # 95 % at each place; the places of a plane go together, so 40 planes know the share to about 3 %.
    assert 0.87 <= np.mean(holds) <= 1.0


def test_expanded_uncertainty_holds_where_every_run_is_displaced() -> None:
    holds = []
    for seed in range(40):
        random = np.random.default_rng([seed, 5])
        lines = [
            SurfaceLine(
                line.across, replace(line.observed, deviation=line.observed.deviation + shift[DESIGN.run - 1])
            )
            for line in measured(seed)
            for shift in [0.8e-6 * random.standard_normal(4)]
        ]
        surface = fitted(lines)
        found = surface.predict(BETWEEN)
        holds.append(np.abs(found.deviation - _deviation_at(surface)) <= found.expanded_uncertainty)
    assert 0.87 <= np.mean(holds) <= 1.0


def test_the_error_of_the_instrument_is_in_every_deviation_and_in_no_estimate() -> None:
    lines = measured()
    without, with_it = fitted(lines), fitted(lines, instrument=INSTRUMENT)
    before, after = without.predict(BETWEEN), with_it.predict(BETWEEN)
    assert np.array_equal(before.deviation, after.deviation)
    assert after.standard_uncertainty == pytest.approx(
        np.hypot(before.standard_uncertainty, INSTRUMENT.common), rel=1e-9
    )


def test_lines_that_differ_in_slope_show_the_interaction() -> None:
    surface = fitted(measured(interaction=20e-6))
    half = (DESIGN.length / 2) * (LINES[-1] - LINES[0]) / 2
    corner = 20e-6 * half
    assert surface.interaction.value == pytest.approx(corner, abs=surface.interaction.expanded_uncertainty)
    assert surface.interaction.value > surface.interaction.expanded_uncertainty


def test_lines_of_one_slope_show_no_interaction() -> None:
    found = [fitted(measured(seed)).interaction for seed in range(20)]
    beyond = [abs(each.value) > each.expanded_uncertainty for each in found]
    assert sum(beyond) <= 4  # 1 of 20 by chance; more than 4 in one plane of 400


@pytest.mark.parametrize(
    ("lines", "names"),
    [
        ((0.1, 0.5), ("a", "b1", "c1", "d1", "b2")),
        ((0.1, 0.3, 0.5), ("a", "b1", "c1", "d1", "b2", "c2")),
        ((0.1, 0.2, 0.3, 0.5), ("a", "b1", "c1", "d1", "b2", "c2", "d2")),
    ],
)
def test_fewer_lines_carry_fewer_powers(lines: tuple[float, ...], names: tuple[str, ...]) -> None:
    found = fitted(measured(lines=lines)).compute_coefficients()
    assert list_coefficient_names(found.orders) == names
    assert len(found.values) == len(found.powers) == len(names)


def test_coefficients_in_printed_units_give_micrometres_for_millimetres() -> None:
    found = fitted(measured(sigma=0.0)).compute_coefficients().in_units(MILLIMETRE, MICROMETRE)
    rows = halaj.columns(np.array([250.0]), np.array([300.0]))
    expected = truth(np.array([0.25]), np.array([0.3]), 1.0)
    assert rows @ found.values == pytest.approx(expected * 1e6, rel=1e-7)


@pytest.mark.parametrize(
    ("point", "sentence"),
    [
        ((0.5, 0.6), "Y = 600 mm lies outside of what was measured, 100 to 500 mm"),
        ((-0.5, 0.3), "X = -500 mm lies outside of what was measured"),
    ],
)
def test_beyond_what_was_measured_nothing_is_said(point: tuple[float, float], sentence: str) -> None:
    with pytest.raises(ModelError, match=sentence):
        fitted(measured()).predict([point])


def test_a_single_line_is_no_plane() -> None:
    with pytest.raises(ModelError, match="two lines"):
        fitted(measured(lines=(0.1,)))


def test_too_few_readings_are_refused() -> None:
    lines = [
        SurfaceLine(line.across, line.observed.without(np.flatnonzero(DESIGN.run > 1)))
        for line in measured(lines=(0.1, 0.2))
    ]
    few = [SurfaceLine(line.across, line.observed.without(np.arange(2, 16))) for line in lines]
    with pytest.raises(ModelError, match="do not determine the"):
        fitted(few)


def test_a_reading_that_stands_off_is_set_aside() -> None:
    lines = measured()
    spoilt = lines[2].observed.deviation.copy()
    spoilt[17] += 40e-6
    lines[2] = SurfaceLine(lines[2].across, replace(lines[2].observed, deviation=spoilt))
    assert lines[2].list_aside().tolist() == [17]
    surface = fitted(lines, Approach(int(DESIGN.direction[17])))
    assert len(surface.fit.deviation) == len(LINES) * len(DESIGN.position) // 2 - 1
    assert np.abs(surface.fit.residual).max() < 5e-6


def test_a_line_that_is_measured_again_shares_its_points_and_no_runs() -> None:
    lines = measured()
    design = join_side_by_side([*lines, lines[0]], Approach.POSITIVE).design
    points = len(LINES) * len(DESIGN.target_positions)
    assert len(np.unique(design.target)) == points
    assert len(np.unique(design.run)) == (len(LINES) + 1) * 4


def test_single_runs_make_a_plane_without_a_noise_floor() -> None:
    lines = [
        SurfaceLine(line.across, line.observed.without(np.flatnonzero(DESIGN.run > 1))) for line in measured()
    ]
    surface = fitted(lines)
    assert surface.error.noise_rms is None
    assert np.all(np.isfinite(surface.predict(BETWEEN).expanded_uncertainty))


def _with_one_displaced(lines: list[SurfaceLine]) -> list[SurfaceLine]:
    third = lines[2].observed
    displaced = SurfaceLine(lines[2].across, replace(third, deviation=third.deviation + 2e-6))
    return [*lines[:2], displaced, *lines[3:]]


def test_of_five_lines_one_that_is_displaced_shows_in_error_and_uncertainty() -> None:
    sound, spoilt = fitted(measured()), fitted(_with_one_displaced(measured()))
    assert spoilt.error.rms > 1.2 * sound.error.rms
    before, after = sound.predict(BETWEEN), spoilt.predict(BETWEEN)
    assert np.all(after.expanded_uncertainty > 1.5 * before.expanded_uncertainty)


def test_of_four_lines_one_that_is_displaced_goes_unseen() -> None:
    lines = measured(lines=(0.1, 0.2, 0.3, 0.4))
    sound, spoilt = fitted(lines), fitted(_with_one_displaced(lines))
    assert spoilt.error.rms == pytest.approx(sound.error.rms, rel=1e-6)


def test_displaced_runs_are_noise_and_no_slope_across() -> None:
    surface = fitted(measured())
    assert set(surface.fit.noise.ratios) == {NoiseSource.POSITION, NoiseSource.RUN}
