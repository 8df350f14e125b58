"""What each control writes in its own way: decimals, block numbers, addresses, the head."""

from __future__ import annotations

import pytest

from plugins.part_programs.controls import CONTROLS, fanuc, heidenhain, linuxcnc, siemens
from plugins.part_programs.planned import written
from refusals import refused
from zlmreport.plugin import Axis, AxisKind, InputError
from zlmreport.testing import sample_motion

controls = pytest.mark.parametrize("control", CONTROLS)


@pytest.mark.parametrize(
    ("control", "block"),
    [
        ("linuxcnc", "G53 G1 X3.1250"),
        ("fanuc", "G01 X3.125"),
        ("siemens-840d", "SUPA G1 X=3.1250"),
        ("heidenhain", "L X+3.1250 R0 F1500 M91"),
    ],
)
def test_position_has_the_decimals_of_its_control(control: str, block: str) -> None:
    lines = written(control).splitlines()
    assert any(line == block or line.endswith(f" {block}") for line in lines)


@pytest.mark.parametrize(
    ("control", "block"),
    [
        ("linuxcnc", "G4 P3.5"),
        ("fanuc", "N1 G04 X3.5 (TARGET 1 + RUN 1)"),
        ("siemens-840d", "N1 G4 F3.5 ; target 1 + run 1"),
        ("heidenhain", "CYCL DEF 9.1 DWELL 3.5"),
    ],
)
def test_dwell_is_written_in_seconds(control: str, block: str) -> None:
    lines = written(control).splitlines()
    assert any(line == block or line.endswith(f" {block}") for line in lines)


@controls
def test_more_decimals_are_written_where_the_control_takes_them(control: str) -> None:
    fine = sample_motion(targets=(0.0, 10.12345), overrun=2.5)
    run = CONTROLS[control](written(control, fine, decimals=5))
    assert 10.12345 in [position for position, _ in run.stops]


@controls
def test_target_of_more_decimals_than_the_control_takes_is_refused(control: str) -> None:
    (problem,) = refused(written, control, sample_motion(targets=(0.0, 10.12345))).problems
    assert "target 2, 10.12345 mm, has more than the" in problem.message


@pytest.mark.parametrize("run", [fanuc, siemens])
def test_block_of_a_reading_has_its_number(run: object) -> None:
    control = {fanuc: "fanuc", siemens: "siemens-840d"}[run]
    assert CONTROLS[control](written(control)).blocks == list(range(1, 17))


@controls
def test_head_names_job_axis_method_and_targets(control: str) -> None:
    text = written(control).upper()
    assert "JOB KIT-7" in text
    assert "AXIS X, LINEAR METHOD, 2 RUNS, 16 READINGS" in text
    assert "TARGETS 1 TO 4, -20.5 3.125 30.002 58.25 MM" in text


@controls
def test_axis_is_called_by_its_address_on_the_machine(control: str) -> None:
    named = sample_motion(axis=Axis("Table, long"))
    assert CONTROLS[control](written(control, named, axis="v")).stops
    with pytest.raises(InputError, match="'TABLE, LONG' is no address of an axis on this control"):
        written(control, named)


def test_siemens_axis_may_have_a_number() -> None:
    assert "SUPA G1 X1=" in written("siemens-840d", axis="X1")


@pytest.mark.parametrize("control", ["linuxcnc", "fanuc", "heidenhain"])
def test_other_axes_are_single_letters(control: str) -> None:
    with pytest.raises(InputError, match="'X1' is no address"):
        written(control, axis="X1")


@controls
def test_rotary_axis_is_warned_of_the_shorter_way(control: str) -> None:
    turning = sample_motion(axis=Axis("C", AxisKind.ROTARY), targets=(0.0, 90.0, 180.0, 270.0))
    assert "SHORTER WAY" in written(control, turning).upper()
    assert "SHORTER WAY" not in written(control).upper()


def test_fanuc_program_has_its_number_and_work_offset() -> None:
    text = written("fanuc", number=12, work_offset="G59")
    assert text.startswith("%\nO0012\n")
    assert "(G59 OF X MUST BE ZERO)" in text
    assert fanuc(text).stops == fanuc(written("fanuc")).stops


def test_fanuc_whole_numbers_have_a_point() -> None:
    assert "\nF1500.\n" in written("fanuc")


def test_heidenhain_program_is_called_by_the_job_without_points() -> None:
    text = written("heidenhain", sample_motion())
    assert text.startswith("0 BEGIN PGM KIT-7 MM\n")
    assert heidenhain(text).stops == linuxcnc(written("linuxcnc")).stops
