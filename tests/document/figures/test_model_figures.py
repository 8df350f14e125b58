"""The graphs of the error model show readings, model, residuals and noise as they are."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from document.figures.model_samples import (
    LOST_MOTION,
    SIGMA,
    SLOPE,
    WAVE,
    WHOLE,
    diagram,
    fitted,
    history,
    linear_test,
    one_way,
)
from document.figures.samples import drawn
from zlmreport.document.figures.model_diagram import ModelDiagram, estimate
from zlmreport.document.figures.model_residuals import (
    draw_fall_chart,
    draw_over_condition,
    draw_over_position,
    draw_over_run,
    draw_over_time,
    draw_slopes_over_time,
)
from zlmreport.model.effects.design import place_at_positions
from zlmreport.model.fitting.observations import select_readings
from zlmreport.plugin import Approach, Figure, FloatArray, Language
from zlmreport.plugin.standard import Panel, Role

MICROMETRE = 1e6


@cache
def all_figures() -> dict[str, Figure]:
    """Return every graph that a model has."""
    found = [
        draw_over_position(diagram()),
        draw_over_run(diagram()),
        draw_over_time(diagram()),
        estimate(diagram()),
    ]
    found += [draw_over_condition(diagram(), name) for name in diagram().design.conditions]
    found.append(draw_fall_chart(history()))
    return {figure.key: figure for figure in found}


def readings(panel: Panel) -> FloatArray:
    """Return the values of all readings of a panel, upwards first."""
    return np.concatenate([each.y for each in panel.readings])


def by_approach(values: FloatArray) -> FloatArray:
    """Return values of readings, those upwards first."""
    direction = diagram().design.direction
    return np.concatenate([values[direction > 0], values[direction < 0]])


def test_the_upper_panel_has_the_readings_and_the_lower_one_what_the_model_leaves() -> None:
    upper, lower = draw_over_position(diagram()).panels
    fit = diagram().fit
    np.testing.assert_allclose(readings(upper), by_approach(fit.deviation) * MICROMETRE, rtol=1e-12)
    np.testing.assert_allclose(readings(lower), by_approach(fit.residual) * MICROMETRE, atol=1e-9)


def test_the_model_leads_through_each_target_of_each_direction() -> None:
    upper, _ = draw_over_position(diagram()).panels
    up, down = upper.curves
    assert (up.role, down.role) == (Role.MODEL_POSITIVE, Role.MODEL_NEGATIVE)
    np.testing.assert_allclose(up.x, diagram().design.target_positions * 1e3, rtol=1e-12)
    np.testing.assert_allclose(up.y - down.y, LOST_MOTION * MICROMETRE, atol=0.2)


def test_mean_residuals_are_means_of_the_residuals_at_a_target() -> None:
    _, lower = draw_over_position(diagram()).panels
    up = next(curve for curve in lower.curves if curve.role is Role.MEAN_POSITIVE)
    design, residual = diagram().design, diagram().fit.residual
    chosen = (design.direction > 0) & (design.target == 3)
    assert up.y[3] == pytest.approx(float(residual[chosen].mean()) * MICROMETRE, rel=1e-9)


@pytest.mark.parametrize("key", ["model", "residuals-run", "residuals-time", "residuals-air-pressure"])
def test_the_noise_is_drawn_at_twice_the_noise_floor_to_both_sides(key: str) -> None:
    (band,) = all_figures()[key].panels[-1].bands
    floor = diagram().error.noise_rms
    assert floor is not None
    assert band.role is Role.NOISE
    np.testing.assert_allclose(band.upper, 2 * floor * MICROMETRE, rtol=1e-12)
    np.testing.assert_allclose(band.lower, -band.upper, rtol=1e-12)


def test_residuals_over_runs_stand_at_the_numbers_of_the_runs() -> None:
    (panel,) = draw_over_run(diagram()).panels
    assert {x for each in panel.readings for x in each.x.tolist()} == {1.0, 2.0, 3.0, 4.0, 5.0}
    assert [curve.x.tolist() for curve in panel.curves] == [[1.0, 2.0, 3.0, 4.0, 5.0]] * 2


def test_a_long_test_is_told_in_minutes() -> None:
    figure = draw_over_time(diagram())
    assert figure.x_unit == "min"
    last = max(each.x.max() for each in figure.panels[0].readings)
    assert last == pytest.approx(diagram().design.duration / 60)


def test_a_short_test_is_told_in_seconds() -> None:
    design = linear_test()
    found = fitted("offset", "backlash", design=replace(design, time=design.time / 100))
    assert draw_over_time(ModelDiagram(found.fit, found.error)).x_unit == "s"


def test_without_times_residuals_stand_in_their_order() -> None:
    design = linear_test()
    count = np.arange(len(design.time), dtype=np.float64)
    found = fitted("offset", "backlash", design=replace(design, time=count, time_is_counted=True))
    figure = draw_over_time(ModelDiagram(found.fit, found.error))
    assert figure.x_title.en == "Number of the reading"
    assert min(each.x.min() for each in figure.panels[0].readings) == 1.0


@pytest.mark.parametrize(
    ("condition", "unit", "first"),
    [
        ("axis_temperature", "°C", 20.4),
        ("air_pressure", "hPa", 1005.0),
        ("relative_humidity", "%", 50.0),
        ("face", "", -1.0),
    ],
)
def test_a_condition_is_shown_in_the_unit_in_which_it_is_logged(
    condition: str, unit: str, first: float
) -> None:
    figure = draw_over_condition(diagram(), condition)
    assert figure.x_unit == unit
    log = np.concatenate([each.x for each in figure.panels[0].readings])
    assert np.abs(log - first).min() < 1e-9


def test_a_condition_keeps_the_name_that_its_file_gives_it() -> None:
    test = linear_test()
    named = replace(test, conditions={**test.conditions, "PT100_A": test.conditions["face"]})
    found = fitted(*WHOLE, design=named)
    figure = draw_over_condition(ModelDiagram(found.fit, found.error), "PT100_A")
    assert "over PT100_A," in figure.title.in_language(Language.ENGLISH)
    assert "over air pressure," in draw_over_condition(diagram(), "air_pressure").title.in_language(
        Language.ENGLISH
    )


def test_the_course_over_time_leads_through_means_of_neighbours() -> None:
    (curve,) = draw_over_time(diagram()).panels[0].curves
    assert len(curve.x) == 12
    assert np.all(np.diff(curve.x) > 0)
    # Each is a mean of some 18 readings: five standard deviations of it.
    assert np.abs(curve.y).max() < 5 * SIGMA * MICROMETRE / np.sqrt(len(diagram().design.time) // 12)


def test_the_estimate_is_there_between_the_targets() -> None:
    figure = estimate(diagram("offset", "scale-error", "backlash"))
    up, down = figure.panels[0].curves
    assert len(up.x) > 5 * len(diagram().design.target_positions)
    slope = np.polyfit(up.x, up.y, 1)[0]
    assert slope == pytest.approx(SLOPE * 1e3, rel=0.2)
    np.testing.assert_allclose(up.y - down.y, LOST_MOTION * MICROMETRE, atol=0.2)


def test_the_estimate_spans_the_measured_travel() -> None:
    up = estimate(diagram()).panels[0].curves[0]
    first, last = diagram().design.span
    assert (up.x[0], up.x[-1]) == (pytest.approx(first * 1e3), pytest.approx(last * 1e3))


def test_a_wave_shorter_than_the_steps_keeps_its_amplitude_and_never_passes_for_a_longer_one() -> None:
    up = estimate(diagram()).panels[0].curves[0]
    left = up.y - np.polyval(np.polyfit(up.x, up.y, 1), up.x)
    assert left.max() == pytest.approx(WAVE * MICROMETRE, rel=0.15)
    waves = np.abs(np.exp(-2j * np.pi * np.outer(1 / np.linspace(30, 500, 200), up.x)) @ left) * 2 / len(up.x)
    assert waves.max() < 0.3 * WAVE * MICROMETRE


def test_the_uncertainty_of_the_estimate_is_that_of_the_fit() -> None:
    found = diagram("offset", "scale-error", "backlash")
    band = estimate(found).panels[0].bands[0]
    design = found.design
    chosen = np.flatnonzero((design.direction > 0) & (design.run == 3))[[0]]
    at = select_readings(design, chosen)
    expected = float(found.fit.predict(at).expanded_uncertainty[0]) * MICROMETRE
    place = int(np.argmin(np.abs(band.x - at.position[0] * 1e3)))
    assert (band.upper[place] - band.lower[place]) / 2 == pytest.approx(expected, rel=0.05)


def test_an_estimate_that_moves_with_time_says_when_it_holds() -> None:
    assert "at the mean time" in estimate(diagram("offset", "thermal-drift")).title.in_language(
        Language.ENGLISH
    )
    assert "at the mean time" not in estimate(diagram()).title.in_language(Language.ENGLISH)


def test_the_fall_chart_has_a_bar_for_each_effect_and_the_noise_floor() -> None:
    (panel,) = draw_fall_chart(history()).panels
    assert [bar.label.in_language(Language.ENGLISH) for bar in panel.bars] == [
        "without model",
        *(f"+ {name}" for name in WHOLE),
    ]
    np.testing.assert_allclose(
        [bar.y for bar in panel.bars], [each.error.rms * MICROMETRE for each in history()], rtol=1e-12
    )
    (level,) = panel.levels
    floor = history()[-1].error.noise_rms
    assert floor is not None
    assert level.y == pytest.approx(floor * MICROMETRE)


def test_the_slope_of_a_pass_is_that_of_the_line_through_its_residuals() -> None:
    shown = diagram()
    design, residual = shown.design, shown.fit.residual
    own = (design.direction > 0) & (design.run == 1)
    from_mean = design.position[own] - design.position[own].mean()
    slope = from_mean @ residual[own] / (from_mean @ from_mean)
    upwards = draw_slopes_over_time(shown).panels[0].curves[0]
    assert upwards.y[0] == pytest.approx(1e6 * slope)  # µm/m
    assert len(upwards.y) == len(np.unique(design.run))


def test_a_test_in_one_direction_has_one_curve() -> None:
    found = fitted("offset", "scale-error", design=one_way(linear_test()))
    single = ModelDiagram(found.fit, found.error)
    assert single.approaches == (Approach.POSITIVE,)
    assert len(draw_over_position(single).panels[0].curves) == 1
    assert len(estimate(single).panels[0].bands) == 1


@pytest.mark.parametrize("key", all_figures())
def test_a_graph_says_what_it_shows_with_values_in_both_languages(key: str) -> None:
    figure = all_figures()[key]
    for language in Language:
        text = figure.alternative.in_language(language)
        assert any(map(str.isdigit, text))
        assert "{" not in text
        assert figure.title.in_language(language)


@pytest.mark.parametrize("key", all_figures())
def test_a_graph_can_be_drawn(key: str) -> None:
    assert drawn(all_figures()[key]).outlines


@pytest.mark.parametrize("length", [1.0, 3.0])
def test_every_drawn_position_has_the_value_that_the_model_gives_there(length: float) -> None:
    test = linear_test()
    stretched = replace(
        test,
        axis=replace(test.axis, travel=(0.0, length), screw_pitch=5e-3),
        position=test.position * length / np.ptp(test.position),
        span=(0.0, length),
    )
    found = fitted(*WHOLE, design=stretched)
    figure = estimate(ModelDiagram(found.fit, found.error))
    for curve, approach in zip(figure.panels[0].curves, Approach, strict=True):
        asked = place_at_positions(stretched, curve.x / 1e3, approach)
        np.testing.assert_allclose(curve.y, MICROMETRE * found.fit.compute_value_at(asked), atol=1e-6)
    says_so = "the line shows how far they reach" in figure.title.in_language(Language.ENGLISH)
    assert says_so == (length == 3.0)
