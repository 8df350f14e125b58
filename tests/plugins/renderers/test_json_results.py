"""The results file, as users are promised it."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from document.typesetting import samples
from evaluation.uncertainty.budgets import contribution
from model.hidden_effect import example_diagnosis
from plugins.renderers.results import VALIDATOR, results_of
from zlmreport.document.certificate.attachments import Source, SourceRole
from zlmreport.measurement.provenance import Exclusion
from zlmreport.plugin import Approach, AxisKind, Language, MeasurementSet, Options, Words
from zlmreport.plugin.extension import Acts, Distribution, with_uncertainty
from zlmreport.plugin.renderer import Budget, NoBudget
from zlmreport.plugin.source import SourceFile
from zlmreport.plugin.standard import decided, decision_rule


@cache
def sample() -> Any:
    return results_of(samples.certificate())


def results_of_readings(readings: MeasurementSet) -> Any:
    """The results of these readings by the sample standard."""
    evaluations = (samples.evaluation(readings),)
    return results_of(samples.certificate(readings=readings, standards=0, evaluations=evaluations))


def test_it_names_its_format_and_its_certificate() -> None:
    assert sample()["schema"] == "zlmreport/results/1"
    assert sample()["certificate"] == {
        "number": "CAL-2026-0117",
        "title": "Calibration certificate",
        "language": "en",
        "issued": "2026-11-20",
    }


def test_a_report_without_a_date_of_issue_states_none() -> None:
    assert "issued" not in results_of(samples.certificate(issued=None))["certificate"]


def test_it_has_one_evaluation_for_each_standard_in_order() -> None:
    assert [evaluation["standard"] for evaluation in sample()["evaluations"]] == ["sample:2026"] * 2
    assert sample()["evaluations"][0]["designation"] == "SAMPLE 1:2026"


def test_a_parameter_with_a_limit_states_it_and_whether_it_conforms() -> None:
    kept, exceeded, _ = sample()["evaluations"][0]["parameters"]
    assert (kept["symbol"], kept["limit"], kept["conforms"]) == ("M", 20.0, True)
    assert (exceeded["symbol"], exceeded["limit"], exceeded["conforms"]) == ("R_fwd", 1.5, False)


def test_a_parameter_without_a_limit_has_no_place_for_one() -> None:
    parameter = sample()["evaluations"][0]["parameters"][2]
    assert set(parameter) == {"symbol", "name", "value", "unit"}


def test_an_undecided_limit_says_so() -> None:
    certificate = samples.certificate(standards=1)
    # The rule needs an uncertainty, and none was evaluated.
    undecided = decided(certificate.evaluations[0], decision_rule("guard-band"))
    results = results_of(replace(certificate, evaluations=(undecided,)))
    assert results["evaluations"][0]["parameters"][0]["conforms"] is None


def test_uncertainty_and_coverage_factor_stand_where_they_were_evaluated() -> None:
    certificate = samples.certificate(standards=1)
    evaluation = certificate.evaluations[0]
    first = replace(evaluation.parameters[0], expanded_uncertainty=1.4e-6, coverage_factor=2.0)
    results = results_of(replace(certificate, evaluations=(replace(evaluation, parameters=(first,)),)))
    (parameter,) = results["evaluations"][0]["parameters"]
    assert (parameter["expanded_uncertainty"], parameter["coverage_factor"]) == (1.4, 2.0)


@cache
def with_budget() -> Any:
    """The results of the sample standard with the uncertainties of a budget."""
    budget = Budget(
        (
            contribution(0.5, Acts.ALONG_THE_LENGTH),
            contribution(0.2, Acts.AT_EACH_READING, Distribution.RECTANGULAR),
        ),
        missing=("misalignment",),
    )
    bare = samples.certificate(standards=1)
    arithmetic = partial(samples.SampleStandard().arithmetic, options=Options())
    (uncertain,) = with_uncertainty([(bare.evaluations[0], arithmetic)], budget)
    return results_of(replace(bare, evaluations=(uncertain,), budget=budget))


def test_the_budget_stands_with_every_contribution() -> None:
    budget = with_budget()["uncertainty"]
    along, own = budget["contributions"]
    assert (along["standard_uncertainty"], along["acts"], along["distribution"]) == (
        pytest.approx(0.5),
        "along-the-length",
        "normal",
    )
    assert (own["standard_uncertainty"], own["acts"]) == (pytest.approx(0.2), "at-each-reading")
    assert along["share"] == pytest.approx(0.25 / 0.29)
    assert budget["combined_standard_uncertainty"] == pytest.approx(math.sqrt(0.29))
    assert (budget["unit"], budget["state"], budget["missing"]) == ("um", "incomplete", ["misalignment"])


def test_every_parameter_and_every_mean_of_a_budget_has_its_uncertainty() -> None:
    (evaluation,) = with_budget()["evaluations"]
    assert all(parameter["expanded_uncertainty"] > 0 for parameter in evaluation["parameters"])
    last = evaluation["positions"][-1]
    assert last["U_mean_fwd"] == pytest.approx(2 * math.sqrt(0.25 + 0.04 / 5))
    assert last["U_mean"] == pytest.approx(2 * math.sqrt(0.25 + 0.04 / 10))


def test_without_a_budget_the_reason_stands_in_its_place() -> None:
    reason = NoBudget(Words("nothing is known", "nichts ist bekannt"))
    results = results_of(replace(samples.certificate(), budget=reason))
    assert results["uncertainty"] == {
        "state": "incomplete",
        "missing": ["instrument"],
        "negligible": {},
        "not_evaluated": "nothing is known",
        "contributions": [],
    }


def test_values_are_unrounded_micrometres() -> None:
    readings = samples.measurements()
    by_hand = np.max(4 * np.std(1e6 * readings.deviations()[0], axis=-1, ddof=1))
    parameter = sample()["evaluations"][0]["parameters"][1]
    assert parameter["unit"] == "um"
    # Two ways of rounding doubles: a few units of the sixteenth digit.
    assert parameter["value"] == pytest.approx(by_hand, rel=1e-14)


def test_each_target_position_has_its_statistics_and_the_standards_own_column() -> None:
    rows = sample()["evaluations"][0]["positions"]
    deviations = 1e6 * samples.measurements().deviations()
    assert [row["target"] for row in rows] == [50.0 * i for i in range(samples.TARGETS)]
    forward, backward = deviations.mean(axis=-1)
    expected = {
        "mean_fwd": forward,
        "mean_bwd": backward,
        "mean": (forward + backward) / 2,
        "s_fwd": deviations[0].std(axis=-1, ddof=1),
        "s_bwd": deviations[1].std(axis=-1, ddof=1),
        "reversal": forward - backward,
        "R_i_fwd": 4 * deviations[0].std(axis=-1, ddof=1),
    }
    for symbol, values in expected.items():
        assert [row[symbol] for row in rows] == pytest.approx(values.tolist(), rel=1e-12, abs=1e-12), symbol
    assert {(row["n_fwd"], row["n_bwd"]) for row in rows} == {(5, 5)}


def test_targets_are_as_they_were_typed() -> None:
    typed = [0.1, 0.3, 19.999, 123.456, 1000.000001]
    readings = samples.measurements(targets=len(typed))
    shifted = replace(readings, target_positions=np.array(typed) / 1e3)
    assert [row["target"] for row in results_of_readings(shifted)["evaluations"][0]["positions"]] == typed


def test_what_a_test_in_one_direction_does_not_define_is_absent() -> None:
    results = results_of_readings(samples.measurements(approaches=(Approach.POSITIVE,)))
    assert {frozenset(row) for row in results["evaluations"][0]["positions"]} == {
        frozenset({"target", "n_fwd", "mean_fwd", "s_fwd", "R_i_fwd"})
    }


def test_a_single_run_has_no_standard_deviation() -> None:
    (evaluation,) = results_of_readings(samples.measurements(runs=1))["evaluations"]
    assert {frozenset(row) for row in evaluation["positions"]} == {
        frozenset({"target", "n_fwd", "n_bwd", "mean_fwd", "mean_bwd", "mean", "reversal"})
    }


def test_parameters_that_a_test_does_not_define_are_absent() -> None:
    (evaluation,) = results_of_readings(samples.measurements(runs=1))["evaluations"]
    assert [parameter["symbol"] for parameter in evaluation["parameters"]] == ["M", "B"]


def test_missing_readings_are_named_and_counted() -> None:
    results = results_of_readings(samples.measurements(missing=(3, 25)))
    measurements = results["measurements"]
    assert measurements["readings"] == 2 * samples.TARGETS * samples.RUNS - 2
    assert measurements["missing"] == [
        {"target": 150.0, "direction": "fwd", "run": 1},
        {"target": 800.0, "direction": "bwd", "run": 1},
    ]
    rows = {row["target"]: row for row in results["evaluations"][0]["positions"]}
    assert (rows[150.0]["n_fwd"], rows[150.0]["n_bwd"]) == (4, 5)


def test_readings_that_were_set_aside_are_named_with_value_and_reason() -> None:
    measurements = samples.measurements(missing=(3,))
    aside = Exclusion(3, 0.15, Approach.POSITIVE, 1, 2.5e-6, "Air hose touched the reflector.")
    provenance = replace(measurements.provenance, exclusions=(aside,))
    results = results_of_readings(replace(measurements, provenance=provenance))
    assert results["measurements"]["excluded"] == [
        {
            "target": 150.0,
            "direction": "fwd",
            "run": 1,
            "deviation": pytest.approx(2.5),
            "reason": "Air hose touched the reflector.",
        }
    ]


def test_a_rotary_axis_is_in_degrees_and_seconds_of_arc() -> None:
    results = results_of_readings(samples.measurements(kind=AxisKind.ROTARY))
    assert results["measurements"]["units"] == {"position": "deg", "deviation": "arcsec"}
    evaluation = results["evaluations"][0]
    assert {parameter["unit"] for parameter in evaluation["parameters"]} == {"arcsec"}
    assert evaluation["positions"][1]["target"] == 50.0
    # The sample's readings have the same figures on either kind of axis.
    linear = sample()["evaluations"][0]["parameters"]
    for rotary, parameter in zip(evaluation["parameters"], linear, strict=True):
        assert rotary["value"] == pytest.approx(parameter["value"], rel=1e-12)


def test_findings_say_what_is_asked_what_was_found_and_whether_it_is_met() -> None:
    findings = sample()["evaluations"][0]["findings"]
    assert findings[0] == {
        "requirement": "at least five target positions",
        "found": "21 target positions",
        "met": True,
        "basis": "published",
    }
    assert [finding["met"] for finding in findings] == [True, False, None]


def test_there_is_a_place_for_the_error_model() -> None:
    assert sample()["model"] == {"effects": [], "parameters": [], "error": {}}


def test_error_model_has_what_is_known_of_its_parameters_and_what_it_leaves() -> None:
    results = results_of(replace(samples.certificate(), diagnosis=example_diagnosis()))
    VALIDATOR.validate(results)
    model = results["model"]
    names = [f"{each['effect']}.{each['name']}" for each in model["parameters"]]
    assert (model["covariance"]["parameters"], [each["parameter"] for each in model["intervals"]]) == (
        names,
        names,
    )
    assert len(model["residuals"]) == len(example_diagnosis().fit.residual)


def test_provenance_tells_files_programs_and_remarks() -> None:
    provenance = sample()["provenance"]
    assert provenance["source"] == "laser-csv"
    assert provenance["generator"] == "zlmreport 0.1.0"
    assert provenance["plugins"] == {"laser-csv": "zlmreport 0.1.0", "sample:2026": "zlmreport 0.1.0"}
    assert [file["name"] for file in provenance["files"]] == ["x-axis.csv"]
    assert provenance["remarks"] == ["decimal point, comma between cells"]


def test_words_are_of_the_documents_language() -> None:
    results = results_of(samples.certificate(Language.GERMAN))
    assert results["evaluations"][0]["parameters"][2]["name"] == "Umkehrspanne"


def test_symbols_and_units_are_ascii() -> None:
    for evaluation in sample()["evaluations"]:
        for parameter in evaluation["parameters"]:
            assert (parameter["symbol"] + parameter["unit"]).isascii()


@pytest.mark.parametrize("title", ["Ω 🙂 \u202e", "half a pair \ud83d", '"\\\x00'])
def test_any_text_comes_out_as_it_went_in(title: str) -> None:
    assert results_of(samples.certificate(standards=0, title=title))["certificate"]["title"] == title


@pytest.mark.parametrize(
    "readings",
    [
        samples.measurements(),
        samples.measurements(runs=1),
        samples.measurements(approaches=(Approach.NEGATIVE,)),
        samples.measurements(kind=AxisKind.ROTARY, missing=(0,)),
    ],
    ids=["both directions", "one run", "one direction", "rotary, a reading missing"],
)
def test_it_keeps_its_published_schema(readings: MeasurementSet) -> None:
    assert violations(results_of_readings(readings)) == set()


def test_a_budget_keeps_the_published_schema() -> None:
    assert violations(with_budget()) == set()


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"schema": "zlmreport/results/2"}, "$.schema"),
        ({"evaluations": {}}, "$.evaluations"),
        ({"certificate": {"number": "1"}}, "$.certificate"),
        ({"extra": 1}, "$"),
        ({"uncertainty": {"unit": "um"}}, "$.uncertainty"),
        ({"model": {"effects": [1], "parameters": [], "error": {}}}, "$.model.effects[0]"),
    ],
)
def test_what_breaks_the_schema_is_noticed(change: dict[str, Any], complaint: str) -> None:
    assert complaint in violations({**sample(), **change})


def violations(value: Any) -> set[str]:
    """Return the paths at which a results file breaks its schema."""
    return {error.json_path for error in VALIDATOR.iter_errors(value)}


def test_every_file_that_it_was_made_from_is_named_with_its_role_path_and_digest() -> None:
    file = SourceFile.of(Path("shared/laboratory.yaml"), b"laboratory: {}\n")
    source = Source(SourceRole.EXTENDED, "laboratory.yaml", "../shared/laboratory.yaml", file)
    certificate = replace(samples.certificate(standards=0), sources=(source,))
    assert results_of(certificate)["provenance"]["sources"] == [
        {
            "role": "extended",
            "name": "laboratory.yaml",
            "path": "../shared/laboratory.yaml",
            "sha256": file.sha256,
            "size": 15,
        }
    ]
    VALIDATOR.validate(results_of(certificate))
