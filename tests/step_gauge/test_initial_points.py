"""Initial points are read with their places, and each of the sixteen is there once."""

from __future__ import annotations

from pathlib import Path

import pytest

from refusals import refusal
from zlmreport.plugin import InputError
from zlmreport_step_gauge.initial_points import read_initial_points

ROWS = [f"{block},{point},{point},2,3" for block in ("begin", "end") for point in range(1, 9)]


def written(folder: Path, rows: list[str]) -> Path:
    path = folder / "points.csv"
    path.write_text("\n".join(["block,point,x,y,z", *rows]), encoding="utf-8")
    return path


def told(folder: Path, rows: list[str]) -> str:
    return refusal(read_initial_points, written(folder, rows))


def test_points_come_by_block_and_number_in_metres_whatever_their_order(tmp_path: Path) -> None:
    found = read_initial_points(written(tmp_path, ROWS[::-1])).coordinates
    assert found.shape == (2, 8, 3)
    assert found[1, 6].tolist() == pytest.approx([7e-3, 2e-3, 3e-3])


def test_a_point_that_is_missing_is_named(tmp_path: Path) -> None:
    assert "points.csv: point 5 of block begin is missing" in told(tmp_path, ROWS[:4] + ROWS[5:])


def test_a_point_that_is_there_twice_is_named_with_its_line(tmp_path: Path) -> None:
    assert "points.csv:18:7: point 1 of block begin is there twice" in told(
        tmp_path, [*ROWS, "begin,1,0,0,0"]
    )


def test_a_ninth_point_is_refused(tmp_path: Path) -> None:
    assert "points.csv:18:5: a block has the points 1 to 8" in told(tmp_path, [*ROWS, "end,9,0,0,0"])


def test_a_third_block_is_refused(tmp_path: Path) -> None:
    assert "column block: begin or end is expected" in told(tmp_path, [*ROWS, "middle,1,0,0,0"])


def test_a_coordinate_with_a_decimal_comma_is_told_how_to_write_it(tmp_path: Path) -> None:
    semicolons = [row.replace(",", ";") for row in ROWS[:-1]]
    path = tmp_path / "points.csv"
    path.write_text("\n".join(["block;point;x;y;z", *semicolons, "end;8;8,5;2;3"]), encoding="utf-8")
    with pytest.raises(InputError, match=r"write '8\.5' if that is meant"):
        read_initial_points(path)
