"""The results file of an axis that was adjusted, and of a document that changes another."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from environments import ROOT
from installed import load_job, registry
from plugins.renderers.results import VALIDATOR, results_of
from zlmreport import pipeline

AMENDED = {"number": "EXAMPLE-0", "kind": "replacement", "reason": "Wrong serial number."}


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Return the results file of the example job, made a replacement of another."""
    path: Path = tmp_path_factory.mktemp("job") / "job.yaml"
    example = ROOT / "configs" / "as-found" / "certificate.yaml"
    path.write_text(
        f"schema: zlmreport/job/1\nextends: {example}\n"
        "certificate: {number: EXAMPLE-1, amends: {number: EXAMPLE-0, kind: replacement, "
        "reason: Wrong serial number.}}\n"
    )
    return results_of(pipeline.compose(load_job(path), registry()))


def test_it_fits_its_schema(results: Any) -> None:
    VALIDATOR.validate(results)


def test_it_has_the_axis_as_found_by_the_same_standards(results: Any) -> None:
    after = [each["standard"] for each in results["evaluations"]]
    assert [each["standard"] for each in results["as_found"]["evaluations"]] == after


def test_a_change_is_what_was_left_less_what_was_found_and_its_u_is_the_sum_of_both(results: Any) -> None:
    for found, left, changed in zip(
        results["as_found"]["evaluations"],
        results["evaluations"],
        results["as_found"]["changes"],
        strict=True,
    ):
        assert changed["standard"] == left["standard"]
        for one, other, change in zip(
            found["parameters"], left["parameters"], changed["parameters"], strict=True
        ):
            assert change["symbol"] == other["symbol"]
            assert change["value"] == pytest.approx(other["value"] - one["value"], abs=1e-12)
            both = one["expanded_uncertainty"] + other["expanded_uncertainty"]
            assert change["expanded_uncertainty"] == pytest.approx(both, rel=1e-12)


def test_each_measurement_has_its_own_budget(results: Any) -> None:
    for uncertainty in (results["as_found"]["uncertainty"], results["uncertainty"]):
        assert uncertainty["state"] == "complete"
        assert uncertainty["contributions"]


def test_each_measurement_has_its_own_file_of_readings(results: Any) -> None:
    assert [file["name"] for file in results["as_found"]["files"]] == ["x-as-found.csv"]
    assert [file["name"] for file in results["provenance"]["files"]] == ["x-as-left.csv"]


def test_both_files_are_among_the_sources_of_the_certificate(results: Any) -> None:
    names = {source["name"] for source in results["provenance"]["sources"]}
    assert {"x-as-found.csv", "x-as-left.csv"} <= names


def test_a_document_that_changes_another_names_it(results: Any) -> None:
    assert results["certificate"]["amends"] == AMENDED
