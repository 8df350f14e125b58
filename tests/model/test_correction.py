"""Readings as they would be if the axis were corrected: less the model, and nothing else."""

from __future__ import annotations

import numpy as np

from model.hidden_effect import example, example_history, study, written
from zlmreport.model.compensation.basis import FittedModel, compensate_readings
from zlmreport.model.diagnosis.study import correct_by_model, list_what_moves_with_time
from zlmreport.plugin import Language


def test_what_is_left_is_the_residual() -> None:
    whole = example_history()[-1].fit
    left = correct_by_model(example().measurements, example().observed, whole)
    np.testing.assert_allclose(left.deviation, whole.residual, atol=1e-18)


def test_readings_that_are_missing_stay_missing(tmp_path) -> None:
    path = written(tmp_path)
    table = path.with_name("x-axis.csv")
    text = table.read_text(encoding="utf-8")
    table.write_text(text.replace("37.4799,+,1,-3.12,", "37.4799,+,1,,"), encoding="utf-8")
    holey = study(path)
    left = correct_by_model(holey.measurements, holey.observed, holey.fit_whole().fit)
    assert np.flatnonzero(np.isnan(left.deviation)).tolist() == [1]


def test_nothing_is_taken_away_by_a_model_without_effects() -> None:
    first = example_history()[0].fit
    assert correct_by_model(example().measurements, example().observed, first) is example().measurements


def test_a_table_of_positions_leaves_what_moves_with_time(tmp_path) -> None:
    path = written(tmp_path, ("    - offset\n", "    - offset\n    - thermal-drift\n"))
    warm = study(path)
    fit = warm.fit_whole().fit
    assert list_what_moves_with_time(fit) == ("thermal-drift",)
    whole = correct_by_model(warm.measurements, warm.observed, fit)
    table = compensate_readings(FittedModel(warm.measurements, warm.observed, fit))
    term, theta, gamma = (
        each[1] for each in (fit.model.terms, fit.solution.thetas, fit.solution.coefficients)
    )
    drift = term.effect.columns(warm.observed.design, theta) @ gamma
    np.testing.assert_allclose(table.deviation - whole.deviation, drift, atol=1e-18)


def test_the_measured_readings_stay_as_they_are() -> None:
    before = example().measurements.deviation.copy()
    correct_by_model(example().measurements, example().observed, example_history()[-1].fit)
    np.testing.assert_array_equal(example().measurements.deviation, before)


def test_what_was_done_is_said_of_the_readings() -> None:
    left = correct_by_model(example().measurements, example().observed, example_history()[-1].fit)
    remark = left.provenance.remarks[-1].in_language(Language.ENGLISH)
    assert remark == "Predicted: less what the error model explains by offset, scale-error, backlash"
