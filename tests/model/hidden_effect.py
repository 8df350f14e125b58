"""The example of the tutorial: a job whose model lacks an effect, and its readings."""

from __future__ import annotations

import shutil
from functools import cache
from pathlib import Path

from environments import ROOT
from installed import registry
from replacing import replace_in
from zlmreport import pipeline
from zlmreport.job.loading import load
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis
from zlmreport.model.diagnosis.study import Fitted, Study
from zlmreport.plugin.extension import Job

CONFIG = ROOT / "configs" / "hidden-effect"
#: The line of the job's last effect.
LAST = "    - backlash\n"


def written(folder: Path, *changes: tuple[str, str]) -> Path:
    """Return a copy of the example in a folder; `changes` replace parts of its job."""
    for file in CONFIG.iterdir():
        shutil.copy(file, folder)
    path = folder / "job.yaml"
    replace_in(path, *changes)
    return path


def job(path: Path) -> Job:
    return load(path, registry())


def study(path: Path) -> Study:
    """Return the study of a job."""
    loaded = job(path)
    return Study.of(loaded, pipeline.read(loaded, registry()), registry().effects)


@cache
def example() -> Study:
    """Return the study of the example as it is."""
    return study(CONFIG / "job.yaml")


@cache
def example_history() -> tuple[Fitted, ...]:
    return example().fit_history()


@cache
def example_diagnosis() -> AxisDiagnosis:
    return example().diagnose(registry().effects)
