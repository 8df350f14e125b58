"""Doubtful calibrations of a step gauge: refused with the reason, or marked on the first page."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from document.certificate.documents import lines_of
from environments import ROOT
from installed import load_job, registry
from zlmreport import pipeline
from zlmreport.plugin import InputError
from zlmreport.plugin.renderer import Certificate

_CALIBRATED = "calibrated: 2026-04-20"
_COEFFICIENT = "expansion_coefficient: 11.5              # µm/(m·K)"


def composed(folder: Path, *changes: tuple[str, str], file: str = "gauge.yaml") -> Certificate:
    """Return the certificate of the example, some lines of a file of which are others; in few simulations."""
    shutil.copytree(ROOT / "configs" / "step-gauge", folder / "step-gauge")
    shutil.copy(ROOT / "configs" / "laboratory.yaml", folder)
    path = folder / "step-gauge" / file
    text = path.read_text(encoding="utf-8")
    for line, other in changes:
        assert line in text
        text = text.replace(line, other)
    path.write_text(text, encoding="utf-8")
    return pipeline.compose(load_job(folder / "step-gauge" / "job.yaml"), registry(), trials=50)


@pytest.mark.parametrize(
    ("line", "other", "said"),
    [
        (_CALIBRATED, "calibrated: 2026-06-20", "calibrated on 2026-06-20, after the measurement"),
        (_CALIBRATED, "calibrated: 2024-04-20\ndue: 2026-04-20", "calibration was due on 2026-04-20"),
        ("certificate: D-K-00000-2026-04\n", "", "add instrument.certificate"),
        ("certificate: D-K-00000-2026-04", "certificate: STEP-GAUGE-1", "is this document"),
        (f"{_COEFFICIENT}\n", "", "the expansion of the gauge needs its coefficient"),
        ("expansion_coefficient_uncertainty: 0.3", "# 0.3", "needs uncertainty.device_expansion_coefficient"),
    ],
)
def test_a_gauge_whose_calibration_does_not_hold_is_refused(
    line: str, other: str, said: str, tmp_path: Path
) -> None:
    with pytest.raises(InputError, match=said):
        composed(tmp_path, (line, other))


@pytest.mark.parametrize(
    ("line", "other", "said"),
    [
        (_CALIBRATED, "calibrated: 2010-04-20", "calibrated on 2010-04-20, 16 years before the measurement"),
        (_CALIBRATED, "", "Measuring instrument: date of calibration not stated"),
        (
            _COEFFICIENT,
            "expansion_coefficient: 115",
            "Expansion coefficient of the instrument: 115 µm/(m·K) is unusual",
        ),
    ],
)
def test_a_doubtful_calibration_of_a_gauge_is_marked(
    line: str, other: str, said: str, tmp_path: Path
) -> None:
    cover = "\n".join(line for block in composed(tmp_path, (line, other)).cover for line in lines_of(block))
    assert said in cover


def test_a_gauge_that_is_far_from_the_air_is_marked(tmp_path: Path) -> None:
    said = "The step gauge is stated at 31 °C, and the air at 20.5 °C: they lie 10.5 K apart"
    for temperature, marked in (("31", [said]), ("24", [])):
        change = ("gauge_temperature: 20.4 ", f"gauge_temperature: {temperature} ")
        document = composed(tmp_path / temperature, change, file="job.yaml")
        cover = [line for block in document.cover for line in lines_of(block)]
        assert [said for line in cover if said in line] == marked


def test_a_gauge_is_held_against_logged_air_where_none_is_stated(tmp_path: Path) -> None:
    shutil.copytree(ROOT / "configs" / "step-gauge", tmp_path / "step-gauge")
    shutil.copy(ROOT / "configs" / "laboratory.yaml", tmp_path)
    path = tmp_path / "step-gauge" / "job.yaml"
    path.write_text(
        path.read_text(encoding="utf-8").replace("  air_temperature: 20.5\n", "  remarks: none\n"),
        encoding="utf-8",
    )
    job = load_job(path)
    measurements = pipeline.read(job, registry())
    (choice,) = job.extensions
    extension = registry().extension(choice.identifier)
    for logged, count in ((26.0, 1), (22.0, 0), (np.nan, 0)):
        air = np.full(measurements.deviation.size, logged + 273.15)
        conditions = {**measurements.conditions, "air_temperature": air}
        found = list(extension.doubts(job, choice.options, replace(measurements, conditions=conditions)))
        assert len(found) == count


def test_too_short_a_section_does_not_fit_the_points_on_it(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="count the blocks between them"):
        composed(tmp_path, ("last_block: 13", "last_block: 4"), file="job.yaml")


def test_lengths_that_were_calibrated_at_another_temperature_are_taken_to_that_of_the_gauge(
    tmp_path: Path,
) -> None:
    usual = composed(tmp_path / "usual")
    other = composed(tmp_path / "other", ("reference_temperature: 20", "reference_temperature: 25"))
    (correction,) = other.measurements.provenance.corrections
    (before,) = usual.measurements.provenance.corrections
    # Of 230 mm at 11.5 µm/(m·K): from 25 °C to the 20.4 °C of the gauge they shrink, from 20 °C they grow.
    assert (correction.largest - before.largest) * 1e6 == pytest.approx(11.5 * 5.0 * 0.230, rel=0.02)
