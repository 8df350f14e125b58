"""``zlmreport init``: the starter job runs as it is."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cli.commands import Shop
from processes import ZLMREPORT, run
from zlmreport.cli import main
from zlmreport.job.loading import load
from zlmreport.pipeline import compose
from zlmreport.plugin.registry import find_plugins

FILES = ["job.yaml", "laboratory.yaml", "x-axis.csv"]


def test_files_are_written_and_named(shop: Shop) -> None:
    run = shop.run("init", "new/folder")
    assert run.code == 0
    assert sorted(path.name for path in Path("new/folder").iterdir()) == FILES
    assert run.output.splitlines() == [
        *(f"new/folder/{name}" for name in FILES),
        "next: zlmreport new/folder/job.yaml",
    ]


def test_folder_that_is_there_is_filled(shop: Shop) -> None:
    shop.write("here/notes.txt", "mine")
    assert shop.run("init", "here").code == 0
    assert Path("here/notes.txt").read_text() == "mine"


def test_file_that_is_there_is_not_touched(shop: Shop) -> None:
    shop.write("here/laboratory.yaml", "mine")
    run = shop.run("init", "here")
    assert run.code == 2
    assert run.messages == "here/laboratory.yaml: is there already; choose another folder, or remove it\n"
    assert [path.name for path in Path("here").iterdir()] == ["laboratory.yaml"]
    assert Path("here/laboratory.yaml").read_text() == "mine"


def test_file_in_place_of_the_folder_is_an_access_error(shop: Shop) -> None:
    shop.write("here", "a file")
    run = shop.run("init", "here")
    assert (run.code, run.messages) == (3, "here/job.yaml: cannot be written: here is a file and no folder\n")


def test_failure_half_way_leaves_nothing(shop: Shop, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    run = shop.run("init", "here")
    assert (run.code, run.messages) == (3, "here/job.yaml: cannot be written: no space left on device\n")
    assert list(Path("here").iterdir()) == []


def test_starter_job_meets_every_requirement_and_limit(tmp_path: Path) -> None:
    main(["init", str(tmp_path)])
    registry = find_plugins({})
    job = load(tmp_path / "job.yaml", registry)
    evaluations = compose(job, registry).evaluations
    assert [finding for each in evaluations for finding in each.findings if finding.met is not True] == []
    verdicts = [
        parameter.conforms for each in evaluations for parameter in each.parameters if parameter.limit
    ]
    assert verdicts == [True] * 5
    assert evaluations[0].measurements.missing() == ()


@pytest.mark.long
def test_starter_job_makes_its_certificate(tmp_path: Path) -> None:
    main(["init", str(tmp_path)])
    run(*ZLMREPORT, "job.yaml", "--quiet", cwd=tmp_path, check=True)
    assert (tmp_path / "out" / "SAMPLE-0001.pdf").read_bytes().startswith(b"%PDF-")
    results = json.loads((tmp_path / "out" / "SAMPLE-0001.json").read_text())
    assert results["certificate"]["number"] == "SAMPLE-0001"


def test_starter_job_is_commented_in_every_part(tmp_path: Path) -> None:
    main(["init", str(tmp_path)])
    for name in FILES:
        assert (tmp_path / name).read_text(encoding="utf-8").startswith("# ")
