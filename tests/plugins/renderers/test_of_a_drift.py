"""Every format carries a drift: over hours, in the units of one, and so that it can be read again."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from dcclib.validation.schematron import SchematronValidator

from document.certificate.documents import COMPLETE, job
from installed import registry
from plugins.renderers.results import VALIDATOR, is_verified, parameters_of, results_of
from zlmreport import pipeline
from zlmreport.plugin.extension import Job
from zlmreport.plugin.renderer import Certificate

HOURS = np.arange(0.0, 6.5, 0.5)
NAMES = ("X1", "X2", "Z")


def report(folder: Path, source: str = "{plugin: channels-csv, file: drift.csv}", **changed: Any) -> Job:
    """Return the job of a report on three sensors; `source` may name the test."""
    shown = [(3 * np.sin(HOURS / 4), 2 * np.cos(HOURS / 4), HOURS, 20 + HOURS / 20)]
    rows = [
        f"{3600 * hour:g}," + ",".join(f"{each:.2f}" for each in of)
        for hour, *of in zip(HOURS, *shown[0], strict=True)
    ]
    (folder / "drift.csv").write_text("\n".join(["time,X1,X2,Z,air_temperature", *rows]) + "\n")
    keys = {
        **{key: each for key, each in COMPLETE.items() if key not in {"axis", "uncertainty"}},
        "certificate": {**COMPLETE["certificate"], "kind": "report"},
        "laboratory": {**COMPLETE["laboratory"], "country": "DE"},
        "measurement": {
            "date": "2022-04-07",
            "tests": {name: {"source": _source(source, name)} for name in NAMES},
        },
        "evaluate": [{"standard": "iso230-3", "hours": 6, "distance": {"X": 200}}],
    }
    return job(folder, {**keys, **changed})


def _source(source: str, name: str) -> dict[str, str]:
    pairs = (each.split(": ") for each in source.strip("{}").split(", "))
    return {key: value.replace("NAME", name) for key, value in pairs}


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Certificate:
    return pipeline.compose(report(tmp_path_factory.mktemp("drift")), registry(), trials=100)


@pytest.fixture(scope="module")
def results(made: Certificate) -> Any:
    return results_of(made)


def test_the_results_file_is_as_promised(results: Any) -> None:
    assert not list(VALIDATOR.iter_errors(results))
    found = {each["symbol"]: each["unit"] for each in results["evaluations"][0]["parameters"]}
    assert found == {"E_X1": "um", "E_X2": "um", "E_Z": "um", "tilt_X": "arcsec"}
    assert results["evaluations"][0]["parameters"][2]["value"] == pytest.approx(6.0)


def test_a_table_has_every_parameter(made: Certificate, results: Any) -> None:
    assert parameters_of(made) == {
        each["symbol"]: repr(each["value"]) for each in results["evaluations"][0]["parameters"]
    }


def test_what_was_measured_over_time_asks_for_no_environment_beside_it(results: Any) -> None:
    missing = " ".join(results["uncertainty"]["missing"])
    assert "environmental_variation" not in missing
    assert "misalignment" not in missing


def test_a_digital_certificate_is_valid_and_speaks_of_hours(made: Certificate) -> None:
    content = registry().renderer("dcc").render(made).decode()
    rules = SchematronValidator.for_dcc().validate_str(content)
    assert rules.failed_assertions == []
    assert [each.text for each in rules.successful_reports if each.role == "error"] == []
    assert content.count(r"<si:unitXMLList>\hour") >= len(NAMES)


def test_its_readings_come_out_of_a_digital_certificate_as_they_went_in(
    made: Certificate, tmp_path: Path
) -> None:
    stated = report(tmp_path)
    before = pipeline.read(stated, registry())
    (tmp_path / "drift.xml").write_bytes(registry().renderer("dcc").render(made))

    after = pipeline.read(report(tmp_path, "{plugin: dcc, file: drift.xml, test: NAME}"), registry())

    for name in NAMES:
        for array in ("target_positions", "approach", "run", "deviation"):
            found, expected = getattr(after.tests[name], array), getattr(before.tests[name], array)
            assert found == pytest.approx(expected, rel=1e-12, abs=1e-15), (name, array)


def test_its_pages_hold(tmp_path: Path) -> None:
    output = {"directory": str(tmp_path), "formats": ["pdf-typst", "json"]}
    assert is_verified(report(tmp_path, output=output))
