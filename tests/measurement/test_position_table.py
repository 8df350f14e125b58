"""Compensation tables and angular records: what is read, and what is said of a file that is none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from refusals import mistakes
from zlmreport.measurement.axis import PositionTable
from zlmreport.measurement.position_table import TableColumn, read_position_table
from zlmreport.plugin import ANGLE_UNITS, LENGTH_UNITS, MICROMETRE, MICRORADIAN, MILLIMETRE, InputError

POSITION = TableColumn("position", MILLIMETRE, LENGTH_UNITS)
DEVIATION = TableColumn("deviation", MICROMETRE, LENGTH_UNITS)
ANGLE = TableColumn("angle", MICRORADIAN, ANGLE_UNITS)


def _read(folder: Path, text: str, value: TableColumn = DEVIATION) -> PositionTable:
    path = folder / "table.csv"
    path.write_text(text, encoding="utf-8")
    return read_position_table(path, POSITION, value)


def _messages(folder: Path, text: str) -> list[str]:
    return mistakes(folder, _read, folder, text)


def test_millimetres_and_micrometres_become_metres(tmp_path: Path) -> None:
    table = _read(tmp_path, "# of 2026\nposition,deviation\n0,-1.5\n\n100,2\n")
    assert table.positions == (0.0, 0.1)
    assert table.values == (-1.5e-6, 2e-6)


def test_a_unit_in_brackets_holds(tmp_path: Path) -> None:
    table = _read(tmp_path, "angle (arcsec); position (m)\n0;0\n3600;1\n", ANGLE)
    assert table.positions == (0.0, 1.0)
    assert table.values[1] == pytest.approx(np.radians(1.0), rel=1e-15)


@pytest.mark.parametrize("header", ["position / mm;deviation / nm", "position in mm;deviation in nm"])
def test_a_unit_may_stand_behind_the_name_as_in_every_table(header: str, tmp_path: Path) -> None:
    table = _read(tmp_path, f"{header}\n0;0\n100;5\n")
    assert table.positions == (0.0, 0.1)
    assert table.values == (0.0, pytest.approx(5e-9))


def test_decimal_commas_are_read_where_no_comma_parts_cells(tmp_path: Path) -> None:
    assert _read(tmp_path, "position;deviation\n0,5;1,25\n1,5;2\n").values == (1.25e-6, 2e-6)


def test_a_table_may_have_a_column_for_each_direction(tmp_path: Path) -> None:
    (tmp_path / "table.csv").write_text("position,forward,reverse\n0,1,5\n100,3,7\n", encoding="utf-8")
    table = read_position_table(tmp_path / "table.csv", POSITION, DEVIATION, ("forward", "reverse"))
    at, direction = np.array([0.05, 0.05, 1.0]), np.array([1.0, -1.0, -1.0])
    np.testing.assert_allclose(table.at(at, direction), [2e-6, 6e-6, 7e-6], atol=1e-18)
    with pytest.raises(InputError, match="the first row names the columns"):
        read_position_table(tmp_path / "table.csv", POSITION, DEVIATION)


def test_the_file_is_known_by_its_digest(tmp_path: Path) -> None:
    source = _read(tmp_path, "position,deviation\n0,0\n1,1\n").source
    assert (source.name, source.size) == ("table.csv", 27)


def test_between_positions_the_table_is_linear_and_beyond_them_it_holds() -> None:
    table = PositionTable((0.0, 0.1, 0.3), (0.0, 2e-6, -2e-6))
    np.testing.assert_allclose(
        table.at(np.array([-1.0, 0.05, 0.2, 1.0])), [0.0, 1e-6, 0.0, -2e-6], atol=1e-18
    )


def test_interval_is_the_median() -> None:
    assert PositionTable((0.0, 1.0, 2.0, 5.0), (0.0,) * 4).interval == 1.0


_HEADER = "the first row names the columns, as in position (mm),deviation (µm); found "
_UNITS = "known: in, m, mm, nm, thou, µin, µm"
_RISING = "position '5' does not lie above the one before it, 5; positions rise from row to row"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("position,error\n0,0\n", f":1:1: {_HEADER}'position, error'"),
        ("0,1\n2,3\n", f":1:1: {_HEADER}'0, 1'"),
        ("# nothing\n", f": {_HEADER}none"),
        (
            "position,deviation (kg)\n0,0\n1,1\n",
            f":1:10: column 'deviation (kg)': 'kg' is no unit of this quantity; {_UNITS}",
        ),
        ("position,deviation\n0,1\n", ": has less than two rows of numbers; a table has two at least"),
        ("position,deviation\n0,1\n5, x\n", ":3:4: 'x' stands where a number belongs"),
        ("position,deviation\n0,1\n5,\n", ":3:3: a number is missing"),
        ("position,deviation\n0,1\n5,1,2\n", ":3:1: a row has 2 cells, and this one 3"),
        ("position,deviation\n0,1\n5,1\n5,2\n", f":4:1: {_RISING}"),
    ],
)
def test_what_is_wrong_is_said_at_its_place(text: str, message: str, tmp_path: Path) -> None:
    assert _messages(tmp_path, text) == [f"table.csv{message}"]


def test_all_that_is_wrong_is_said_at_once(tmp_path: Path) -> None:
    assert len(_messages(tmp_path, "position,deviation\n0,a\nb,1\n2\n")) == 3
