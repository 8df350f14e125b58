"""What results files say of a fitted model agrees with itself."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model.axis_tests import INSTALLED, SIGMA, hidden, linear_test, model_of, noise, observations
from model.hidden_effect import example_diagnosis
from zlmreport.model.diagnosis.diagnosis import DiagnosisVerdict, diagnose
from zlmreport.model.diagnosis.faults import DataFault, FaultKind
from zlmreport.model.diagnosis.report import report, write_verdict_statement
from zlmreport.model.fitting.fit import fit
from zlmreport.plugin import Language, same_in_all_languages as same
from zlmreport.plugin.effect import report_model, report_precision

_DESIGN = linear_test(11, 3)
_DEVIATION = 2e-6 + hidden(_DESIGN, "thermal-growth", [300.0], size=8.0) + noise(_DESIGN)
_FIT = fit(model_of("offset", "thermal-growth"), _DESIGN, _DEVIATION)


def test_covariance_has_the_standard_uncertainties_on_its_diagonal() -> None:
    found = report_precision(_FIT)["covariance"]
    expected = {
        f"{each['effect']}.{each['name']}": each["expanded_uncertainty"] / each["coverage_factor"]
        for each in report_model(_FIT)["parameters"]
    }
    standard = dict(zip(found["parameters"], np.sqrt(np.diagonal(found["covariance"])), strict=True))
    assert standard == pytest.approx(expected)


def test_parameter_is_wholly_correlated_with_itself() -> None:
    correlation = np.array(report_precision(_FIT)["covariance"]["correlation"])
    np.testing.assert_allclose(np.diagonal(correlation), 1.0)
    assert np.all(np.abs(correlation) <= 1.0 + 1e-12)


def test_covariance_is_symmetric() -> None:
    covariance = np.array(report_precision(_FIT)["covariance"]["covariance"])
    np.testing.assert_array_equal(covariance, covariance.T)


def test_intervals_are_in_the_units_of_the_parameters() -> None:
    parameters = report_model(_FIT)["parameters"]
    intervals = report_precision(_FIT)["intervals"]
    assert [each["unit"] for each in intervals] == [each["unit"] for each in parameters]
    for each, parameter in zip(intervals, parameters, strict=True):
        assert each["low"] < parameter["value"] < each["high"]


def test_residuals_are_left_out_where_single_readings_are_not_told() -> None:
    assert "residuals" not in report_precision(_FIT, with_residuals=False)


def test_residuals_are_what_the_model_leaves_of_each_reading() -> None:
    found = report_precision(_FIT)["residuals"]
    assert [each["residual"] for each in found] == pytest.approx((_FIT.residual * 1e6).tolist())
    assert (found[0]["direction"], found[0]["run"]) == ("+", 1)


def test_what_may_be_left_instead_of_something_without_a_name_is_reported_with_its_odds() -> None:
    design = linear_test(11, 5, seed=0)
    runs = np.select([design.cycle == design.cycle.min(), design.cycle == design.cycle.min() + 2], [3, 1.5])
    found = diagnose(
        model_of("offset"), observations(design, SIGMA * runs + noise(design, seed=50)), INSTALLED
    )
    assert found.remainder is not None
    assert found.remainder.shape.en == "every run displaced as a whole"
    instead = report(found)["remainder"]["instead"]
    assert instead["effects"] == ["first-run"]
    assert instead["odds"] >= 1 / 20
    certain = observations(design, 4 * SIGMA * (design.position > 0.4) + noise(design, seed=50))
    assert report(diagnose(model_of("offset"), certain, ()))["remainder"]["instead"] is None


def test_parts_of_what_is_left_are_reported_each_with_its_place_and_size() -> None:
    design = linear_test(21, 5)
    stretch = 5 * SIGMA * ((design.position > 0.3) & (design.position < 0.5))
    runs = 3 * SIGMA * np.random.default_rng(3).standard_normal(5)[design.cycle - design.cycle.min()]
    deviation = stretch + runs + noise(design)
    left = report(diagnose(model_of("offset"), observations(design, deviation), ()))["remainder"]
    (also,) = left["further"]
    shapes = {each["shape"]: each for each in (left, also)}
    assert "every run displaced as a whole" in shapes
    (stretched,) = (each for shape, each in shapes.items() if "displaced as a whole," in shape)
    assert stretched["from"] == pytest.approx(300, abs=50)
    assert stretched["to"] == pytest.approx(500, abs=50)
    assert also["rms"] <= left["rms"]


def test_of_a_wrong_unit_it_is_not_said_that_no_cause_is_sought() -> None:
    """What is missing is named beside it, and `model build` adds it: nothing depends on the unit."""
    unit = DataFault(FaultKind.WRONG_UNIT, None, 0.9, same("as if in mm"), same("state source.units"))
    found = replace(
        example_diagnosis(),
        verdict=DiagnosisVerdict.UNEXPLAINED,
        together=(),
        remainder=None,
        failures=(),
        faults=(unit,),
    )
    said = write_verdict_statement(found).in_language(Language.ENGLISH)
    assert said.startswith(
        "The data look wrong: as if in mm. Remedy: state source.units. The model describes"
    )
    swapped = replace(unit, kind=FaultKind.SWAPPED_DIRECTION, run=3, probability=1.0)
    said = write_verdict_statement(replace(found, faults=(swapped,))).in_language(Language.ENGLISH)
    assert said.startswith("The data look wrong, and no cause is sought before they are right: as if in mm.")
