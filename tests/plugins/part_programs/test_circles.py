"""On the path of a circular test each control runs every turn in its sense, and stops where it should."""

from __future__ import annotations

import math
import re
import shutil
from pathlib import Path
from typing import Any

import pytest

from plugins.part_programs.circle_controls import CONTROLS, Tool, linuxcnc
from plugins.part_programs.planned import REGISTRY
from processes import run
from zlmreport.plugin import InputError
from zlmreport.plugin.program import CirclePath
from zlmreport.plugin.protocols import find_circle_writer
from zlmreport.testing import CIRCLE_PROGRAM_CHECKS, sample_circle_path

PLANES = ("XY", "YZ", "ZX")
controls = pytest.mark.parametrize("control", CONTROLS)


def written(identifier: str, path: CirclePath | None = None, **keys: Any) -> str:
    program = REGISTRY.part_program(identifier)
    write = find_circle_writer(program)
    assert write is not None
    return write(path or sample_circle_path(), program.options(**keys))


def done(identifier: str, path: CirclePath | None = None, **keys: Any) -> Tool:
    return CONTROLS[identifier](written(identifier, path, **keys))


@controls
@pytest.mark.parametrize("check", CIRCLE_PROGRAM_CHECKS, ids=lambda check: check.__name__)
def test_it_passes_the_kit(control: str, check: Any) -> None:
    check(REGISTRY.part_program(control), lambda text: CONTROLS[control](text).moves, {})


@controls
def test_all_controls_run_the_same_moves(control: str) -> None:
    for plane in PLANES:
        path = sample_circle_path(plane, first=90, extent=180, arc=90)
        assert done(control, path).moves == done("linuxcnc", path).moves


@controls
def test_the_operator_is_waited_for_outside_the_circle_at_the_start(control: str) -> None:
    assert done(control).waits == [(-102.0, 0.0)]
    assert done(control, wait="never").waits == []


@controls
def test_the_operator_may_be_waited_for_before_each_turn(control: str) -> None:
    tool = done(control, wait="runs")
    assert tool.waits == [(-102.0, 0.0)] * 4
    assert tool.rests == []


@controls
def test_the_tool_rests_between_turns(control: str) -> None:
    assert done(control).rests == [4.0] * 3


@controls
def test_each_turn_begins_and_ends_on_a_line_to_the_circle(control: str) -> None:
    """So an instrument sees by the displacement where a turn begins."""
    moves = done(control).moves
    lines = [math.hypot(*move.end) for move in moves if not move.sense]
    assert lines == [102.0, *(100.0, 102.0) * 4]


@controls
def test_the_evaluated_turn_is_a_block_of_its_own(control: str) -> None:
    arcs = [move.end for move in done(control).moves if move.sense]
    assert arcs[:3] == [(100.0, 0.0), (100.0, 0.0), (-100.0, 0.0)]


@controls
def test_without_arcs_beside_it_a_turn_is_one_block(control: str) -> None:
    assert [move.sense for move in done(control, sample_circle_path(arc=0.0)).moves if move.sense] == [
        1,
        -1,
    ] * 2


@controls
def test_a_single_run_has_a_program_of_its_own(control: str) -> None:
    text = written(control, sample_circle_path(runs=3).of_run(2)).upper()
    assert "TURN 1, CCW, RUN 2" in text
    assert "RUN 1" not in text


@controls
def test_its_head_says_where_zero_must_be_and_what_does_not_move(control: str) -> None:
    text = written(control, sample_circle_path("YZ")).upper()
    assert "ZERO IS THE CENTRE OF THE CIRCLE, AT X 250 Y 200 Z 120 MM OF THE MACHINE" in text
    assert "ONLY Y AND Z MOVE, X MUST STAND AT ITS ZERO" in text
    assert "EVALUATED 0 TO 360 DEG FROM Y TO Z, 180 DEG BEFORE AND BEHIND" in text


@controls
def test_one_axis_has_no_name_of_its_own(control: str) -> None:
    with pytest.raises(InputError, match="a circle is run by X and Y, called so"):
        written(control, axis="X")


@pytest.mark.parametrize(
    ("control", "block"),
    [
        ("linuxcnc", "G3 X100.0000 Y0.0000 I-100.0000 J0.0000 (evaluated)"),
        ("fanuc", "G03 I-100.000 J0.000 (EVALUATED)"),
        ("siemens-840d", "G3 X=100.0000 Y=0.0000 I=-100.0000 J=0.0000 ; evaluated"),
        ("heidenhain", "C X+100.0000 Y+0.0000 DR+"),
    ],
)
def test_a_full_turn_is_written_as_its_control_takes_it(control: str, block: str) -> None:
    assert any(line == block or line.endswith(f" {block}") for line in written(control).splitlines())


@pytest.mark.parametrize("control", ["linuxcnc", "fanuc", "siemens-840d"])
def test_the_work_offset_is_chosen(control: str) -> None:
    assert re.search(r"\bG56\b", written(control, work_offset="G56"))


@pytest.mark.parametrize("plane", PLANES)
def test_interpreter_of_linuxcnc_runs_the_same_arcs(plane: str, tmp_path: Path) -> None:
    rs274 = shutil.which("rs274")
    if rs274 is None:
        pytest.skip("LinuxCNC's stand-alone interpreter, rs274, is not installed")
    text = written("linuxcnc", sample_circle_path(plane, first=30, extent=220, arc=15))
    (tmp_path / "test.ngc").write_text(text, encoding="ascii")
    for name in ("variables", "tools"):
        (tmp_path / name).touch()
    output = run(rs274, "-v", "variables", "-t", "tools", "-g", "test.ngc", cwd=tmp_path, check=True).stdout
    arcs = [
        tuple(map(float, found))
        for found in re.findall(r"ARC_FEED\((.+?), (.+?), (.+?), (.+?), (-?1),", output)
    ]
    assert arcs == [(*move.end, *move.centre, move.sense) for move in _rounded(linuxcnc(text))]


def _rounded(tool: Tool) -> list[Any]:
    arcs = [move for move in tool.moves if move.sense]
    return [
        type(move)(move.end, move.feed, move.sense, tuple(round(each, 4) + 0.0 for each in move.centre))
        for move in arcs
    ]
