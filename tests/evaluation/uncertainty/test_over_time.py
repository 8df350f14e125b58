"""The budget of readings over time: the instrument errs as it drifts; the environment is what is measured."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from document.certificate.documents import COMPLETE, job as job_of
from evaluation.uncertainty.budgets import make_budget_of
from installed import registry
from zlmreport import pipeline
from zlmreport.plugin import same_in_all_languages
from zlmreport.plugin.extension import Acts, Job
from zlmreport.plugin.renderer import Budget
from zlmreport.plugin.source import Correction

HOURS = np.arange(0.0, 8.25, 0.25)
MICROMETRE = 1e-6
#: A correction that a program made of readings.
CORRECTED = Correction(*[same_in_all_languages("any")] * 3, MICROMETRE)


def job(folder: Path, **changed: Any) -> Job:
    rows = [f"{3600 * hour:g},{hour:.2f}" for hour in HOURS]
    (folder / "drift.csv").write_text("\n".join(["time,Z", *rows]))
    keys = {
        **{key: each for key, each in COMPLETE.items() if key not in {"axis", "uncertainty"}},
        "certificate": {**COMPLETE["certificate"], "kind": "report"},
        "instrument": {"name": "Sensor", "certificate": "C-1", "expanded_uncertainty": 0.4},
        "measurement": {
            "date": "2022-04-07",
            "tests": {"Z": {"source": {"plugin": "channels-csv", "file": "drift.csv"}}},
        },
        "evaluate": ["iso230-3"],
    }
    return job_of(folder, {**keys, **changed})


def budget(of: Job) -> Budget:
    return make_budget_of(of).tests["Z"]


def test_instrument_and_resolution_make_it_complete(tmp_path: Path) -> None:
    found = budget(job(tmp_path))
    assert found.missing == ()
    assert {each.contributor for each in found.contributions} == {"instrument", "resolution"}


def test_the_instrument_errs_as_it_drifts(tmp_path: Path) -> None:
    acts = {each.contributor: each.acts for each in budget(job(tmp_path)).contributions}
    assert acts["instrument"] is Acts.IN_TIME


def test_a_job_may_know_better_how_the_instrument_errs(tmp_path: Path) -> None:
    stated = job(tmp_path, uncertainty={"instrument_acts": "at-each-reading"})
    acts = {each.contributor: each.acts for each in budget(stated).contributions}
    assert acts["instrument"] is Acts.AT_EACH_READING


def test_a_part_per_metre_has_no_metres_in_hours(tmp_path: Path) -> None:
    instrument = {"name": "Sensor", "certificate": "C-1", "expanded_uncertainty": "0.4 + 5*L"}
    assert budget(job(tmp_path, instrument=instrument)).standard_uncertainty == pytest.approx(
        budget(job(tmp_path)).standard_uncertainty
    )


def test_a_drift_of_the_instrument_with_the_machine_s_is_within_its_uncertainty(tmp_path: Path) -> None:
    """The worst that U = 0.4 µm lets an instrument do: to go with the machine from end to end."""
    evaluated = pipeline.evaluate_all(
        job(tmp_path), pipeline.read(job(tmp_path), registry()), registry(), 2000
    )
    (drift,) = evaluated[0].evaluation.parameters
    assert drift.value == pytest.approx(8 * MICROMETRE)
    assert drift.expanded_uncertainty is not None
    assert 0.4 * MICROMETRE < drift.expanded_uncertainty < 1.2 * MICROMETRE


def test_the_resolution_of_corrected_readings_is_missing(tmp_path: Path) -> None:
    of = job(tmp_path)
    whole = pipeline.read(of, registry())
    read = whole.tests["Z"]
    corrected = replace(read, provenance=replace(read.provenance, corrections=(CORRECTED,)))
    found = make_budget_of(of, replace(whole, tests={"Z": corrected}))
    assert found.tests["Z"].missing == ("resolution",)
