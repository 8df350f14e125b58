"""``zlmreport plan`` of a circular test: its path, and a program for each control and feed."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml

from plugins.part_programs.circle_controls import linuxcnc
from plugins.part_programs.planned import REGISTRY
from zlmreport.cli import main

Capture = pytest.CaptureFixture[str]
JOB = {
    "schema": "zlmreport/job/1",
    "certificate": {"number": "CIRCLE-1", "kind": "report"},
    "circle": {"plane": "YZ", "radius": 150, "feed": 1000, "centre": [250, 200, 100]},
    "measurement": {"source": {"plugin": "circle-csv", "file": "circle.csv"}},
    "evaluate": ["iso230-4:2005"],
}


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr("zlmreport.cli.plan.find_plugins", lambda **_: REGISTRY)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    return tmp_path


def plan(*arguments: str, **keys: object) -> int:
    Path("job.yaml").write_text(yaml.safe_dump({**JOB, **keys}), encoding="utf-8")
    return main(["plan", "job.yaml", *arguments])


def test_it_says_how_the_circle_is_run(capsys: Capture) -> None:
    assert plan() == 0
    said = capsys.readouterr().out
    assert "CIRCLE-1  plane YZ: 4 turns of radius 150 mm" in said
    assert "evaluated from 0 to 360°, +Y towards +Z" in said
    assert "2 in each sense (assumed)" in said
    assert "source: {plugin: circle-csv, feed_in: 180, feed_out: 180}" in said


def test_each_feed_says_what_acceleration_it_asks(capsys: Capture) -> None:
    assert plan(plan={"runs": 1, "circle": {"feeds": [500, 6000]}}) == 0
    lines = capsys.readouterr().out.splitlines()
    assert ["500", "113", "7.72", "0.000463"] in [line.split() for line in lines]
    assert ["6000", "9.42", "0.796", "0.0667"] in [line.split() for line in lines]


def test_a_program_is_written_for_each_control_and_feed(folder: Path) -> None:
    assert (
        plan("--program", "linuxcnc,fanuc", "--output", "out", plan={"circle": {"feeds": [500, 2000]}}) == 0
    )
    assert {file.name for file in (folder / "out").iterdir()} == {
        f"CIRCLE-1-F{feed}.{suffix}" for feed in (500, 2000) for suffix in ("ngc", "nc")
    }
    tool = linuxcnc((folder / "out" / "CIRCLE-1-F2000.ngc").read_text())
    assert {move.feed for move in tool.moves} == {2000.0}
    assert tool.plane == "YZ"


def test_programs_of_the_job_are_written_too(folder: Path) -> None:
    assert plan("--output", "out", plan={"programs": ["heidenhain"]}) == 0
    assert [file.name for file in (folder / "out").iterdir()] == ["CIRCLE-1.h"]


def test_a_run_has_a_program_of_its_own(folder: Path) -> None:
    assert plan("--run", "2", "--program", "linuxcnc", "--output", "out", plan={"runs": 3}) == 0
    text = (folder / "out" / "CIRCLE-1-run-2.ngc").read_text()
    assert [move.sense for move in linuxcnc(text).moves if move.sense] == [1, 1, 1, -1, -1, -1]


def test_json_has_turns_and_feeds(capsys: Capture) -> None:
    assert plan("--json", plan={"runs": 1, "circle": {"start": 90, "extent": 180, "arc": 45}}) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["schema"] == "zlmreport/plan/1"
    assert found["circle"] == {"plane": "YZ", "radius": 150, "centre": [250, 200, 100]}
    assert found["turns"] == [
        {"sense": "ccw", "run": 1, "first": 90, "last": 270, "arc": 45},
        {"sense": "cw", "run": 1, "first": 270, "last": 90, "arc": 45},
    ]
    assert [each["feed_per_minute"] for each in found["feeds"]] == [1000]


@pytest.mark.parametrize(
    ("keys", "complaint"),
    [
        ({"targets": {"count": 11}}, "plan.targets: belongs to a test at targets"),
        ({"overrun": 2}, "plan.overrun: belongs to a test at targets"),
        ({"circle": {"extent": 400}}, "plan.circle.extent"),
    ],
)
def test_a_plan_of_targets_does_not_fit(keys: dict[str, object], complaint: str, capsys: Capture) -> None:
    assert plan(plan=keys) == 2
    assert complaint in capsys.readouterr().err


def test_an_axis_has_no_path_of_a_circle(capsys: Capture) -> None:
    axis = {key: each for key, each in JOB.items() if key != "circle"}
    laser = {"source": {"plugin": "laser-csv", "file": "x.csv"}}
    changed = {"axis": {"name": "X"}, "measurement": laser, "evaluate": ["iso230-2:2014"]}
    Path("job.yaml").write_text(yaml.safe_dump({**axis, **changed, "plan": {"circle": {}}}))
    assert main(["plan", "job.yaml"]) == 2
    assert "plan.circle: belongs to a circular test" in capsys.readouterr().err


def test_a_control_that_knows_no_circles_is_refused_by_its_name(
    folder: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("zlmreport.cli.plan.find_circle_writer", lambda _program: None)
    assert plan("--program", "fanuc", "--output", "out") == 2
    assert "fanuc writes no circles" in capsys.readouterr().err
    assert not (folder / "out").exists()
