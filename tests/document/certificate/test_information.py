"""What a standard wants reported of a test, held against what the job states."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from document.certificate.documents import COMPLETE, certificate
from zlmreport.plugin import Language

_TOLD: Mapping[str, Any] = {
    "axis": {"name": "Y", "travel": [-20, 20], "compensation_table": "none"},
    "measurement": {
        **COMPLETE["measurement"],
        "feed": 600,
        "dwell": 3,
        "warm_up": "30 min",
        "line": "20 mm above the table",
    },
    "instrument": {**COMPLETE["instrument"], "compensation": "none"},
    "environment": {"air_temperature": 20.1, "axis_temperature": 20, "sensors": "beside the axis"},
}
_REFERENCE = "Results for 20 °C: measured there, corrected to it, or within 1 K of it with the expansion in U"
REPORTED = (
    "Feed, dwell at each target and warm-up reported",
    "Measuring line, or where the other axes stood, reported",
    "Compensations of the machine that were active reported",
    "Temperatures reported, and where they were measured",
    _REFERENCE,
    "Measuring instrument, its calibration and its compensation reported",
)


def found(folder: Path, changes: Mapping[str, Any]) -> dict[str, tuple[str, bool | None]]:
    """Return the findings on information by the first standard: what was found, and whether it is met."""
    evaluation = certificate(folder, {**COMPLETE, **changes}).evaluations[0]
    english = Language.ENGLISH
    said = {
        each.requirement.in_language(english): (each.found.in_language(english), each.met)
        for each in evaluation.findings
    }
    return {name: said[name] for name in REPORTED if name in said}


def test_everything_that_is_told_is_met(tmp_path: Path) -> None:
    assert [met for _, met in found(tmp_path, _TOLD).values()] == [True] * len(REPORTED)


@pytest.mark.parametrize(
    ("group", "key", "requirement", "lacking"),
    [
        ("measurement", "feed", REPORTED[0], "feed"),
        ("measurement", "warm_up", REPORTED[0], "warm-up"),
        ("measurement", "line", REPORTED[1], "measuring line"),
        ("axis", "compensation_table", REPORTED[2], "state of the compensation"),
        ("environment", "sensors", REPORTED[3], "sensor locations"),
        ("environment", "air_temperature", REPORTED[3], "temperature of the air"),
        ("instrument", "compensation", REPORTED[5], "its compensation"),
    ],
)
def test_what_is_not_told_is_open(
    tmp_path: Path, group: str, key: str, requirement: str, lacking: str
) -> None:
    less = {name: value for name, value in _TOLD[group].items() if name != key}
    says = found(tmp_path, {**_TOLD, group: less})
    assert says.pop(requirement) == (f"not stated: {lacking}", None)
    assert all(met for _, met in says.values())


def test_expansion_that_nobody_corrected_is_in_u_or_not_met(tmp_path: Path) -> None:
    environment = {**_TOLD["environment"], "axis_temperature": 25, "expansion_coefficient": 11.5}
    report = {"number": "R-1", "kind": "report"}
    warm = {**_TOLD, "environment": environment, "certificate": report}
    assert found(tmp_path, warm)[_REFERENCE] == (
        "5 K from 20 °C, and not corrected; U holds the expansion whole",
        False,
    )
    near = {**environment, "axis_temperature": 20.5}
    assert found(tmp_path, {**warm, "environment": near})[_REFERENCE] == (
        "not corrected; U holds the expansion whole",
        True,
    )
    no_uncertainty = {"certificate": {"number": "R-1", "kind": "report"}, "instrument": {"name": "Sensor"}}
    assert found(tmp_path, {**warm, **no_uncertainty})[_REFERENCE] == (
        "not at 20 °C, and not corrected",
        False,
    )


def test_correction_names_the_coefficient_that_it_used(tmp_path: Path) -> None:
    environment = {**_TOLD["environment"], "material_temperature": 25, "expansion_coefficient": 11.5}
    changes = {
        **_TOLD,
        "environment": environment,
        "corrections": {"material": {"expansion_coefficient": 23}},
        "uncertainty": {"resolution": 0.1, **COMPLETE["uncertainty"]},
    }
    assert found(tmp_path, changes)[_REFERENCE] == ("corrected by α = 23 µm/(m·K)", True)


def test_temperature_that_nobody_knows_leaves_the_reference_open(tmp_path: Path) -> None:
    changes = {**_TOLD, "certificate": {"number": "R-1", "kind": "report"}, "environment": {}}
    assert found(tmp_path, changes)[_REFERENCE] == ("the temperature or the coefficient is not known", None)


def test_rotary_axis_has_no_length_to_correct(tmp_path: Path) -> None:
    axis = {"name": "C", "kind": "rotary", "travel": [-20, 20], "compensation_table": "none"}
    changes = {**_TOLD, "axis": axis, "uncertainty": {"negligible": {"environmental_variation": "still"}}}
    assert _REFERENCE not in found(tmp_path, changes)


def test_standard_that_asks_for_nothing_finds_nothing(tmp_path: Path) -> None:
    assert found(tmp_path, {"evaluate": ["nmtba"]}) == {}
