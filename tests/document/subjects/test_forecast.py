"""What a standard would say of an axis whose control corrects what the model explains."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from installed import registry
from model.hidden_effect import example, example_history, study, written
from zlmreport import pipeline
from zlmreport.document.subjects.forecast import StandardForecast, make_forecasts
from zlmreport.model.diagnosis.study import correct_by_model
from zlmreport.plugin.standard import evaluate

ALL = ["iso230-2:1988", "iso230-2:2014", "vdi-dgq-3441", "nmtba"]


@cache
def found() -> dict[str, StandardForecast]:
    standards = [(registry().standard(name), registry().standard(name).options()) for name in ALL]
    return {each.standard: each for each in make_forecasts(standards, example(), example_history())}


@pytest.mark.parametrize(
    ("standard", "symbols"),
    [
        ("iso230-2:1988", ["A", "B", "R"]),
        ("iso230-2:2014", ["A", "E", "R"]),
        ("vdi-dgq-3441", ["P", "Pa", "Ps_max"]),
        ("nmtba", ["P", "Pa", "Ps_max"]),
    ],
)
def test_the_leading_parameter_of_each_group_is_forecast(standard: str, symbols: list[str]) -> None:
    assert [quantity.symbol for quantity in found()[standard].quantities] == symbols


@pytest.mark.parametrize("standard", ALL)
def test_the_first_step_is_what_was_measured(standard: str) -> None:
    chosen = registry().standard(standard)
    evaluation = evaluate(chosen, example().measurements, chosen.options(), {})
    expected = [evaluation.value(quantity.symbol) for quantity in found()[standard].quantities]
    np.testing.assert_allclose(found()[standard].by_step[0], expected, rtol=1e-12)


@pytest.mark.parametrize("standard", ALL)
def test_each_step_is_what_the_standard_says_of_the_corrected_readings(standard: str) -> None:
    chosen = registry().standard(standard)
    for step, each in enumerate(example_history()):
        left = correct_by_model(example().measurements, example().observed, each.fit)
        evaluation = evaluate(chosen, left, chosen.options(), {})
        expected = [evaluation.value(quantity.symbol) for quantity in found()[standard].quantities]
        np.testing.assert_allclose(found()[standard].by_step[step], expected, rtol=1e-9)


def test_a_constant_changes_no_parameter() -> None:
    forecast = found()["iso230-2:2014"]
    np.testing.assert_allclose(forecast.by_step[1], forecast.by_step[0], rtol=1e-9)


def test_a_model_fixed_in_position_is_taken_away_whole_by_a_table() -> None:
    forecast = found()["iso230-2:2014"]
    np.testing.assert_allclose(forecast.by_table, forecast.by_step[-1], rtol=1e-9)


def test_a_table_leaves_the_repeatability_that_drift_has_made(tmp_path: Path) -> None:
    path = written(tmp_path, ("    - backlash\n", "    - backlash\n    - thermal-drift\n"))
    warm = study(path)
    history = warm.fit_history()
    (forecast,) = make_forecasts(pipeline.choose_standards(warm.job, registry()), warm, history)
    repeatability = 2
    assert forecast.quantities[repeatability].symbol == "R"
    # Without the drift as with the table: what moves with time is in the scatter of each position.
    assert forecast.by_table[repeatability] != forecast.by_step[-1][repeatability]
    assert forecast.by_table[repeatability] == pytest.approx(forecast.by_step[-2][repeatability], rel=0.05)
