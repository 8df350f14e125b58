"""What a job states at two places and otherwise each time, one statement by one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from document.certificate.documents import job
from doubtful.doubtful_jobs import SOUND, changed, readings, write
from installed import registry
from zlmreport import pipeline
from zlmreport.evaluation.disagreements import find_disagreements


def said(folder: Path, *changes: tuple[str, Any]) -> list[str]:
    """Return what is said of a sound job with some keys changed."""
    write(folder, readings())
    stated = job(folder, changed(*changes, of=SOUND))
    return [each.en for each in find_disagreements(stated, pipeline.read(stated, registry()))]


def test_a_sound_job_agrees_with_itself(tmp_path: Path) -> None:
    assert said(tmp_path) == []


@pytest.mark.parametrize(("issued", "count"), [("2027-11-18", 0), ("2027-11-19", 1)])
def test_issue_is_late_after_a_year(issued: str, count: int, tmp_path: Path) -> None:
    assert len(said(tmp_path, ("certificate.issued", issued))) == count


@pytest.mark.parametrize(("first", "count"), [("2026-10-18", 0), ("2026-10-17", 1)])
def test_a_measurement_is_long_after_a_month(first: str, count: int, tmp_path: Path) -> None:
    days = {**SOUND["measurement"], "date": first, "end": "2026-11-18"}

    assert len(said(tmp_path, ("measurement", days))) == count


@pytest.mark.parametrize(("material", "count"), [(19.0, 0), (21.0, 0), (21.1, 1), (18.9, 1)])
def test_scale_and_material_differ_by_a_kelvin_at_most(material: float, count: int, tmp_path: Path) -> None:
    assert len(said(tmp_path, ("environment.material_temperature", material))) == count


def test_a_material_is_held_against_air_and_scale(tmp_path: Path) -> None:
    found = said(tmp_path, ("environment.material_temperature", 30.0))

    assert len(found) == 2


def test_temperatures_in_words_are_not_compared(tmp_path: Path) -> None:
    assert said(tmp_path, ("environment.material_temperature", "not measured")) == []


def test_a_correction_by_the_stated_coefficient_agrees(tmp_path: Path) -> None:
    corrected = {"material": {"temperature": "axis_temperature", "expansion_coefficient": 11.5}}

    assert said(tmp_path, ("corrections", corrected), ("uncertainty.resolution", 0.01)) == []


def test_each_certificate_of_two_dates_is_told_once(tmp_path: Path) -> None:
    days = ("2026-02-01", "2026-02-02", "2026-02-03")
    sensors = [{"name": f"T {day}", "certificate": "T-1", "calibrated": day} for day in days]

    assert len(said(tmp_path, ("environment.thermometers", sensors))) == 1
