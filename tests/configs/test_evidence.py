"""Of the examples only what is so is marked, and of honest readings nothing."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from environments import ROOT
from installed import registry
from zlmreport import pipeline
from zlmreport.evaluation.evidence import find_evidence
from zlmreport.job.loading import load
from zlmreport.plugin import Language
from zlmreport.plugin.extension import Job

CONFIGS = ROOT / "configs"
#: No readings: a cell of the table is damaged, which its fleet shows.
DAMAGED = CONFIGS / "fleet/lt-250/c-2026-10.yaml"
#: Real readings, two of which lie far from all others of their targets.
WITH_OUTLIERS = CONFIGS / "german/messbericht.yaml"
JOBS = sorted(
    path
    for path in CONFIGS.rglob("*.yaml")
    if "schema: zlmreport/job/1" in path.read_text(encoding="utf-8")
    and path.name != "machine.yaml"
    and path not in {DAMAGED, WITH_OUTLIERS}
)
FOLDERS = sorted({path.parent for path in JOBS})


def measured(job: Job) -> Iterator[Job]:
    """Yield each measurement of a job as a job of its own."""
    for part in job.parts:
        yield from part.lines.values()
        if part.as_found:
            yield part.as_found


def marks(path: Path) -> list[str]:
    """Return what the readings of a job show that it does not say."""
    return [
        words.in_language(Language.ENGLISH)
        for job in measured(load(path, registry()))
        for words in find_evidence(job, pipeline.read(job, registry()))
    ]


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda path: path.relative_to(CONFIGS).as_posix())
def test_the_readings_of_an_example_bear_out_its_job(folder: Path) -> None:
    assert {path.name: found for path in JOBS if path.parent == folder and (found := marks(path))} == {}


def test_outliers_are_all_that_is_marked_of_real_readings() -> None:
    assert [each.partition(" lies ")[0] for each in marks(WITH_OUTLIERS)] == [
        "The reading of run 1 at 15 mm ↓",
        "The reading of run 1 at 25.2 mm ↓",
    ]
