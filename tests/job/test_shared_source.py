"""One file with all lines of a test: its source is named once, for the tests that have none of their own."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml

from installed import registry
from refusals import refused
from zlmreport.job.loading import load
from zlmreport.plugin import InputError
from zlmreport.plugin.extension import Job

DRIFT = {"plugin": "channels-csv", "file": "drift.csv"}


def job(folder: Path, **measurement: Any) -> Job:
    for name in ("drift.csv", "other.csv"):
        (folder / name).write_text("time,X1,Z\n0,1,2\n60,2,3\n", encoding="utf-8")
    keys = {
        "schema": "zlmreport/job/1",
        "certificate": {"number": "D-1", "kind": "report"},
        "measurement": measurement,
        "evaluate": ["iso230-3"],
    }
    path = folder / "job.yaml"
    path.write_text(yaml.safe_dump(keys), encoding="utf-8")
    return load(path, registry())


def files(of: Job) -> dict[str, str]:
    return {name: test.source.options.file.name for name, test in of.tests.items()}


def test_tests_without_a_source_share_that_of_the_measurement(tmp_path: Path) -> None:
    assert files(job(tmp_path, source=DRIFT, tests={"X1": {}, "Z": {}})) == {
        "X1": "drift.csv",
        "Z": "drift.csv",
    }


def test_a_test_with_a_source_of_its_own_keeps_it(tmp_path: Path) -> None:
    own = {"source": {**DRIFT, "file": "other.csv"}}
    assert files(job(tmp_path, source=DRIFT, tests={"X1": {}, "Z": own})) == {
        "X1": "drift.csv",
        "Z": "other.csv",
    }


def test_a_source_that_no_test_takes_is_told(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="each of the tests has a source of its own; take this one out"):
        job(tmp_path, source=DRIFT, tests={"X1": {"source": DRIFT}})


def test_without_any_source_each_test_is_told_to_lack_one(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="missing; say where the readings of this test come from"):
        job(tmp_path, tests={"X1": {}})


def test_a_mistake_in_it_is_told_once_and_in_its_place(tmp_path: Path) -> None:
    (problem,) = refused(job, tmp_path, source={**DRIFT, "intervall": 60}, tests={"X1": {}, "Z": {}}).problems
    assert "'interval'" in problem.message
    assert problem.place.line is not None
