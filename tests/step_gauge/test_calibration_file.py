"""Calibrations are read with their places, and a section of a gauge is cut by its blocks."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from environments import ROOT
from refusals import refusal
from zlmreport.plugin import Place
from zlmreport_step_gauge.calibration import cut_section, read_calibration
from zlmreport_step_gauge.gauge import Side

TABLE = ROOT / "tests" / "data" / "step_gauge" / "stepgauge_cal.csv"
EXAMPLE = ROOT / "configs" / "step-gauge" / "gauge.yaml"
HEADER = "face,side,nominal_mm,calibrated_mm,U_k2_um\n"
ROWS = "1,front,0,0,0.2\n2,back,10,10.0001,0.2\n3,front,20,20.0002,0.2\n4,back,30,30.0003,0.2\n"


def written(folder: Path, content: str, name: str = "gauge.csv") -> Path:
    path = folder / name
    path.write_text(content, encoding="utf-8")
    return path


def test_a_table_holds_both_faces_of_each_block_in_si() -> None:
    gauge = read_calibration(TABLE).gauge
    assert gauge.blocks == (1, 2, 3, 4, 5)
    last = gauge.faces[-1]
    assert (last.number, last.side, last.block) == (10, Side.BACK, 5)
    assert last.distance == pytest.approx(90.00156e-3)
    assert last.expanded_uncertainty == pytest.approx(0.24e-6)


def test_a_table_says_nothing_of_the_material() -> None:
    assert read_calibration(TABLE).gauge.expansion_coefficient is None


def test_a_yaml_file_has_identity_and_material() -> None:
    gauge = read_calibration(EXAMPLE).gauge
    assert (gauge.name, gauge.serial, gauge.certificate) == (
        "Step gauge SG 310",
        "SG-310-07",
        "D-K-00000-2026-04",
    )
    assert gauge.expansion_coefficient == pytest.approx(11.5e-6)
    assert gauge.expansion_uncertainty == pytest.approx(0.3e-6)
    assert gauge.reference_temperature == pytest.approx(293.15)
    assert (gauge.block_width, gauge.block_height) == (0.02, 0.016)


def test_a_section_holds_its_blocks_whole() -> None:
    part = cut_section(read_calibration(TABLE).gauge, 2, 4, Place("job.yaml"))
    assert [face.number for face in part.faces] == [3, 4, 5, 6, 7, 8]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (ROWS.replace("3,front", "4,front"), "4:1: face 4 stands where face 3 is expected"),
        (ROWS.replace("2,back", "2,front"), "3:1: face 2 is a back face"),
        (ROWS.replace("3,front,20", "3,front,5"), "lies at 5 mm, not behind face 2"),
        (ROWS.replace("3,front,20", "3,front,10"), "lies at 10 mm, not behind face 2"),
        (ROWS.replace("20.0002", "20002"), "is the unit right"),
        (re.sub(r",[0-9.]+$", ",0", ROWS, flags=re.MULTILINE), "2:1: U is 0 at every face; write those of"),
        (ROWS.replace("10.0001", "ten"), "3:11: column calibrated_mm: 'ten' stands where a number belongs"),
        (ROWS.replace("2,back", "2,rear"), "3:3: column side: front or back is expected"),
        ("\n".join(ROWS.splitlines()[:3]), "the calibration ends after 3 faces"),
        (ROWS.partition("\n")[0], "the calibration ends after 1 face;"),
        (ROWS[ROWS.index("2,back") :], "begins with face 2, the back of a block"),
    ],
)
def test_a_defective_table_is_refused_with_the_place(content: str, message: str, tmp_path: Path) -> None:
    assert message in refusal(read_calibration, written(tmp_path, HEADER + content))


def test_a_table_without_a_column_is_refused_with_all_that_it_needs(tmp_path: Path) -> None:
    assert "the header lacks U_k2_um" in refusal(
        read_calibration, written(tmp_path, "face,side,nominal_mm,calibrated_mm\n1,front,0,0\n")
    )


def test_an_unknown_key_of_a_yaml_file_is_refused_with_the_nearest(tmp_path: Path) -> None:
    text = EXAMPLE.read_text(encoding="utf-8").replace("serial:", "seriel:")
    assert "did you mean 'serial'" in refusal(read_calibration, written(tmp_path, text, "gauge.yaml"))


def test_a_job_in_the_place_of_a_calibration_is_refused_by_one_sentence(tmp_path: Path) -> None:
    path = written(tmp_path, "schema: zlmreport/job/1\n", "gauge.yaml")
    assert "this file is a job" in refusal(read_calibration, path)
