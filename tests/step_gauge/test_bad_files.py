"""Bad files of a step gauge end a job with exit code 2, the place, and what would be right."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from environments import ROOT
from replacing import replace_in
from zlmreport.cli import main

EXAMPLE = ROOT / "configs" / "step-gauge"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    shutil.copytree(EXAMPLE, tmp_path / "step-gauge", ignore=shutil.ignore_patterns("out", "__pycache__"))
    shutil.copy(ROOT / "configs" / "laboratory.yaml", tmp_path)
    return tmp_path / "step-gauge"


def refused(folder: Path, capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["check", str(folder / "job.yaml")]) == 2
    return capsys.readouterr().err


def test_the_example_is_sound(folder: Path) -> None:
    assert main(["check", str(folder / "job.yaml")]) == 0


def test_ends_that_are_exchanged_in_the_initial_points(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    points = folder / "initial-points.csv"
    text = points.read_text(encoding="utf-8")
    points.write_text(
        text.replace("begin,", "other,").replace("end,", "begin,").replace("other,", "end,"),
        encoding="utf-8",
    )
    assert "initial-points.csv: the front faces (P1 to P3) look towards the other end" in refused(
        folder, capsys
    )


def test_points_that_define_no_plane(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    points = folder / "initial-points.csv"
    lines = points.read_text(encoding="utf-8").splitlines()
    first = next(line for line in lines if line.startswith("begin,1,"))
    lines[lines.index(next(line for line in lines if line.startswith("begin,2,")))] = first.replace(
        "begin,1,", "begin,2,"
    )
    points.write_text("\n".join(lines), encoding="utf-8")
    assert "P1, P2 and P3 lie on a line and define no plane" in refused(folder, capsys)


def test_a_missing_initial_point(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    points = folder / "initial-points.csv"
    lines = points.read_text(encoding="utf-8").splitlines()
    points.write_text("\n".join(line for line in lines if not line.startswith("end,8,")), encoding="utf-8")
    assert "point 8 of block end is missing" in refused(folder, capsys)


def test_a_section_of_too_few_blocks(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    replace_in(folder / "job.yaml", ("last_block: 13", "last_block: 12"))
    message = refused(folder, capsys)
    assert "the blocks 2 and 12 of the section 200.000 mm" in message
    assert "step_gauge.first_block, last_block" in message


def test_a_section_beyond_the_gauge(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    replace_in(folder / "job.yaml", ("last_block: 13", "last_block: 31"))
    message = refused(folder, capsys)
    assert "job.yaml:" in message
    assert "block 31, and" in message
    assert "has the blocks 1 to 16" in message


def test_a_section_that_ends_before_it_begins(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    replace_in(folder / "job.yaml", ("last_block: 13", "last_block: 1"))
    assert "the section ends with block 1 and begins with block 2" in refused(folder, capsys)


@pytest.mark.parametrize(("stated", "block"), [("last_block: 1", 1), ("first_block: 16", 16)])
def test_a_section_of_which_the_end_of_the_gauge_leaves_one_block(
    stated: str, block: int, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    replace_in(folder / "job.yaml", ("first_block: 2\n  last_block: 13", stated))
    assert f"from block {block} to block {block} has no two blocks" in refused(folder, capsys)


def test_a_missed_face(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    points = folder / "probed.csv"
    lines = points.read_text(encoding="utf-8").splitlines()
    points.write_text("\n".join(line for line in lines if not line.startswith("10,")), encoding="utf-8")
    assert "face 10 (block 5, back) was missed" in refused(folder, capsys)


def test_faces_that_are_numbered_from_the_other_end(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    points = folder / "probed.csv"
    header, *rows = [
        line for line in points.read_text(encoding="utf-8").splitlines() if not line.startswith("#")
    ]
    turned = [f"{29 - int(row.partition(',')[0])},{row.partition(',')[2]}" for row in rows]
    points.write_text("\n".join([header, *turned]), encoding="utf-8")
    assert "faces are numbered from the wrong end" in refused(folder, capsys)


def test_a_source_without_its_gauge(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    job = folder / "job.yaml"
    text = job.read_text(encoding="utf-8").replace("number: STEP", "kind: report, number: STEP")
    job.write_text(re.sub(r"step_gauge:\n(  .*\n)+", "", text), encoding="utf-8")
    assert "this source needs the gauge; state step_gauge" in refused(folder, capsys)


def test_a_gauge_hotter_than_anything(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its expansion is a number whose square is none, and a library would say so."""
    replace_in(folder / "job.yaml", ("gauge_temperature: 20.4", "gauge_temperature: 1e308"))
    assert "step_gauge.gauge_temperature: '1e308' is not a number of at most 150" in refused(folder, capsys)


def test_a_gauge_colder_than_nothing_can_be(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    replace_in(folder / "job.yaml", ("gauge_temperature: 20.4", "gauge_temperature: -300"))
    assert "step_gauge.gauge_temperature: '-300' is not a number of at least -50" in refused(folder, capsys)


def test_a_reference_temperature_in_kelvin(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    replace_in(folder / "gauge.yaml", ("reference_temperature: 20", "reference_temperature: 293.15"))
    assert "reference_temperature: '293.15' is not a number of at most 150" in refused(folder, capsys)


def test_a_point_beyond_all_machines(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its square is no number, and a library would say so."""
    replace_in(folder / "probed.csv", ("319.6028,202.4096,209.0917", "319.6028,202.4096,1e308"))
    assert "column z: '1e308' is too large for any machine" in refused(folder, capsys)


def test_an_empty_calibration_is_not_called_a_job(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "gauge.yaml").write_text("", encoding="utf-8")
    assert "gauge.yaml:1:1: is empty; a file of keys says first what it is" in refused(folder, capsys)
