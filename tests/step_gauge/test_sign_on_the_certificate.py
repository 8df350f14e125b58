"""A certificate says which sign its deviations have: an artefact tells errors of indication."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from environments import ROOT
from installed import load_job, registry
from zlmreport.pipeline import compose
from zlmreport.plugin.renderer import Certificate


def composed(folder: Path, sign: str) -> Certificate:
    shutil.copytree(ROOT / "configs" / "step-gauge", folder / "step-gauge")
    shutil.copy(ROOT / "configs" / "laboratory.yaml", folder)
    job = folder / "step-gauge" / "job.yaml"
    text = job.read_text(encoding="utf-8")
    job.write_text(text.replace("file: probed.csv", f"file: probed.csv\n    sign: {sign}"), encoding="utf-8")
    return compose(load_job(job), registry())


@pytest.mark.parametrize(
    ("sign", "stated", "not_stated"),
    [
        ("indicated-calibrated", "indicated − calibrated position", "actual − target position"),
        ("calibrated-indicated", "actual − target position", "indicated − calibrated position"),
    ],
)
def test_readings_and_signs_tell_the_same_deviation(
    tmp_path: Path, sign: str, stated: str, not_stated: str
) -> None:
    sections = {section.key: repr(section) for section in composed(tmp_path, sign).sections}
    assert f"Deviations x = {stated}" in sections["readings"]
    assert f"Signs: deviation = {stated}" in sections["origin"]
    assert not_stated not in sections["readings"]
    assert f"Signs: deviation = {not_stated}" not in sections["origin"]
