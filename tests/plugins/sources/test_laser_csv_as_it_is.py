"""What a job says of a table that nobody laid out for a program, key by key."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, strategies as st
from openpyxl import Workbook
from pydantic import ValidationError

from installed import registry
from plugins.sources.reading import UM, File, said
from plugins.sources.test_any_file import WIDE, damaged
from plugins.sources.untidy_files import FILES
from zlmreport.looking import look_at
from zlmreport.plugin import Axis, AxisKind, InputError

REGISTRY = registry()
HEADER = "target;direction;run;deviation\n"
#: What damage is done to.
SAMPLES = [
    WIDE,
    *(
        each.content.decode("utf-16" if each.content.startswith(b"\xff\xfe") else "latin-1")
        for each in (make() for make in FILES)
        if not each.name.endswith("xlsx")
    ),
]
LYING = "Position;0;100\n1+;1,5;2,5\n1-;0,5;\n"


def sheet(path: Path, *rows: list[object]) -> Path:
    """Write a workbook of one sheet."""
    book = Workbook()
    for row in rows:
        book.active.append(row)
    book.save(path)
    return path


def test_a_row_of_units_below_the_header_counts(file: File) -> None:
    measurements = file.read("target;direction;run;deviation\nm;;;[nm]\n1;+;1;2000\n")
    assert measurements.target_positions.tolist() == [1.0]
    assert measurements.deviation.tolist() == [2 * UM]


def test_a_unit_in_the_header_stands_above_one_below_it(file: File) -> None:
    measurements = file.read("target;direction;run;deviation (µm)\nmm;;;mm\n1;+;1;2\n")
    assert measurements.deviation.tolist() == [2 * UM]


def test_a_unit_of_another_quantity_in_such_a_row_is_refused_where_it_stands(file: File) -> None:
    assert file.complaint("target;direction;run;deviation\nmm;;;°C\n1;+;1;2\n").startswith(
        "x.csv:2:6: column 'deviation': '°C' is no unit of this quantity"
    )


def test_a_unit_that_none_knows_is_answered_with_the_key_that_says_another(file: File) -> None:
    table = "target (DMS);direction;run;deviation\n1°30′00″;+;1;1\n"
    rotary = Axis("C", AxisKind.ROTARY)
    assert file.complaint(table, rotary).endswith("the job says so, as in 'units: {target: °}'")
    (target,) = file.read(table, rotary, units={"target": "°"}).target_positions
    assert target == pytest.approx(np.deg2rad(1.5))


@pytest.mark.parametrize("heading", ["deviation / nm", "deviation in nm", "deviation, nm", "deviation_nm"])
def test_a_unit_behind_a_name_counts(file: File, heading: str) -> None:
    measurements = file.read(f"target\tdirection\trun\t{heading}\n0\t+\t1\t2000\n")
    assert measurements.deviation.tolist() == [2 * UM]


def test_a_unit_behind_a_number_counts_for_that_number(file: File) -> None:
    measurements = file.read(f"{HEADER}0 mm;+;1;0,002 mm\n1 m;+;1;3 µm\n")
    assert measurements.target_positions.tolist() == [0.0, 1.0]
    np.testing.assert_allclose(measurements.deviation, [2 * UM, 3 * UM], rtol=1e-12)


def test_degrees_may_have_minutes_and_seconds(file: File) -> None:
    rows = "0°;+;1;1\n10°30'36\";+;1;2\n-1° 30′;+;1;3\n"
    measurements = file.read(HEADER + rows, Axis("C", AxisKind.ROTARY))
    np.testing.assert_allclose(np.degrees(measurements.target_positions), [-1.5, 0.0, 10.51], rtol=1e-12)


def test_rows_above_the_header_are_skipped_and_it_is_said_what_was_read(file: File) -> None:
    measurements = file.read(
        f"Report\n\n{HEADER}0;+;1;1\n9;+;1;2\nMean;;;1,5\n", skip_rows=2, ends_before="Mean"
    )
    assert measurements.deviation.tolist() == [1 * UM, 2 * UM]
    assert "Lines 3 to 5 of the file were read." in said(measurements)


def test_a_row_that_is_to_end_the_table_must_be_there(file: File) -> None:
    assert file.complaint(f"{HEADER}0;+;1;1\n", ends_before="Mean") == (
        "x.csv:1:1: no row below begins with 'Mean', as 'ends_before' says"
    )


def test_a_table_on_its_side_is_read_with_the_places_of_its_cells(file: File) -> None:
    keys: dict[str, Any] = {"transposed": True, "layout": "wide", "columns": {"target": "Position"}}
    measurements = file.read(LYING, **keys)
    np.testing.assert_allclose(measurements.deviations()[:, :, 0] / UM, [[1.5, 2.5], [0.5, np.nan]])
    assert file.complaint(LYING.replace("2,5", "two"), **keys) == (
        "x.csv:2:8: 'two' stands where a number belongs"
    )


def test_names_may_be_made_of_two_rows(file: File) -> None:
    table = "target;Run 1;;Run 2;\n(mm);up;down;up;down\n0;1;2;3;4\n"
    measurements = file.read(table, layout="wide", header_rows=2)
    assert (measurements.deviations()[:, 0] / UM).round(9).tolist() == [[1, 3], [2, 4]]


def test_the_job_may_name_the_columns(file: File) -> None:
    measurements = file.read(
        "0 1.5\n100  2.5\n", delimiter="blanks", header=["target", "deviation"], direction="+"
    )
    np.testing.assert_allclose(measurements.deviation, [1.5 * UM, 2.5 * UM], rtol=1e-12)


@pytest.mark.parametrize(
    ("name", "number"), [("point", "1.250,5"), ("blank", "1\u202f250,5"), ("apostrophe", "1’250,5")]
)
def test_thousands_are_parted_as_the_job_says(file: File, name: str, number: str) -> None:
    measurements = file.read(f"{HEADER}0;+;1;0,5\n{number};+;1;1,5\n", thousands=name)
    assert measurements.target_positions.tolist() == [0.0, 1.2505]


def test_what_stands_for_a_missing_reading_is_said_in_the_job(file: File) -> None:
    measurements = file.read(f"{HEADER}0;+;1;---\n9;+;1;1\n", missing=["---"])
    assert len(measurements.missing()) == 1
    assert "A reading counts as missing where the file has ---." in said(measurements)


def test_the_order_of_rows_may_tell_directions_and_runs(file: File) -> None:
    table = "target;deviation\n" + "".join(
        f"{target};{target}\n" for target in (0, 5, 9, 9, 5, 0, 0, 5, 9, 9, 5, 0)
    )
    measurements = file.read(table, direction="by-order", runs="counted")
    assert measurements.approach.tolist() == [1, 1, 1, -1, -1, -1] * 2
    assert measurements.run.tolist() == [1] * 6 + [2] * 6


def test_a_target_that_a_run_left_out_is_missing_in_that_run(file: File) -> None:
    """The order of the rows tells the passes; the n-th reading would be of another run."""
    table = "target;deviation\n" + "".join(
        f"{target};{target}\n" for target in (0, 5, 9, 9, 0, 0, 5, 9, 9, 5, 0)
    )
    measurements = file.read(table, direction="by-order", runs="counted")
    assert measurements.run.tolist() == [1] * 5 + [2] * 6


@pytest.mark.parametrize("directions", [True, False])
def test_a_reading_too_many_is_told_where_runs_are_counted(file: File, *, directions: bool) -> None:
    rows = [(0, "+"), (5, "+"), (5, "+"), (9, "+"), (9, "-"), (5, "-"), (0, "-")]
    rows += [(0, "+"), (5, "+"), (9, "+"), (9, "-"), (5, "-"), (0, "-")]
    header = "target;direction;deviation" if directions else "target;deviation"
    table = "".join(f"{target};{sense};1\n" if directions else f"{target};1\n" for target, sense in rows)
    keys = {} if directions else {"direction": "by-order"}
    assert file.complaint(f"{header}\n{table}", runs="counted", **keys).endswith(
        "target 5 ↑ was read in line 3 already, and has 3 readings where most have 2; keep one of them, for "
        "runs are counted by them"
    )


def test_runs_that_number_the_passes_are_told(file: File) -> None:
    table = "target;direction;Lauf\n;deviation".replace("\n", "") + "\n0;+;1;1\n9;+;1;1\n9;-;2;1\n0;-;2;1\n"
    assert file.complaint(table, columns={"run": "Lauf"}) == (
        "x.csv:4:7: each of 2 runs has one direction: the column 'Lauf' numbers the passes, and a run is one "
        "there and back; say 'runs: counted' in the job, and 'ignore: [Lauf]'"
    )


def test_runs_below_each_other_in_a_wide_table_are_counted(file: File) -> None:
    table = "target;1+;1-\n0;1;2\n9;3;4\n0;5;6\n9;7;8\n"
    measurements = file.read(table, layout="wide", runs="counted")
    assert (measurements.deviations() / UM).round(9).tolist() == [[[1, 5], [3, 7]], [[2, 6], [4, 8]]]
    assert measurements.run.tolist() == [1] * 4 + [2] * 4


def test_tables_of_one_file_are_parts_of_one_test(file: File) -> None:
    table = "forward\ntarget;Run 1\n0;1\n9;2\nback\ntarget;Run 1\n0;3\n9;4\n"
    parts = [{"lines": [2, 4], "direction": "up"}, {"lines": [6, 8], "direction": "down"}]
    measurements = file.read(table, layout="wide", parts=parts)
    assert (measurements.deviations()[:, :, 0] / UM).round(9).tolist() == [[1, 2], [3, 4]]


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("18.11.2026 8:15:00", "18.11.2026 8:15:31,5"),
        ("08:15:00", "08:15:31.5"),
        ("23:59:45", "00:00:16.5"),
        ("18.11.26 08:15:00 Uhr", "18.11.26 08:15:31.5 Uhr"),
    ],
)
def test_times_are_read_as_spreadsheets_write_them(file: File, first: str, second: str) -> None:
    time = file.read(f"target;direction;run;deviation;time\n0;+;1;1;{first}\n9;+;1;1;{second}\n").time
    np.testing.assert_allclose(time, [0.0, 31.5])


def test_an_empty_last_cell_of_a_sheet_is_a_missing_reading(tmp_path: Path) -> None:
    path = sheet(tmp_path / "x.xlsx", ["target", "1+", "1-"], [0, 1, 2], [9, 3, None])
    assert len(File("laser-csv", path).read_as_it_is(layout="wide").missing()) == 1


def test_a_place_in_a_sheet_is_row_and_column(tmp_path: Path) -> None:
    path = sheet(tmp_path / "x.xlsx", ["target", "1+", "1-"], [0, 1, "two"])
    with pytest.raises(InputError, match=r"x\.xlsx:2:3: 'two' stands where a number belongs"):
        File("laser-csv", path).read_as_it_is(layout="wide")


def test_in_a_sheet_numbers_have_a_point_and_texts_may_have_a_comma(tmp_path: Path) -> None:
    path = sheet(tmp_path / "x.xlsx", ["target", "1+", "1-"], [0, 0.25, "1,5"], [9, 1.5, "0,25"])
    measurements = File("laser-csv", path).read_as_it_is(layout="wide")
    assert (measurements.deviations()[:, :, 0] / UM).round(9).tolist() == [[0.25, 1.5], [1.5, 0.25]]


def test_a_cell_in_quotation_marks_may_go_over_lines(file: File) -> None:
    table = 'target;direction;run;"deviation\n(nm)"\n0;+;1;2000\n'
    assert file.read(table).deviation.tolist() == [2 * UM]


@pytest.mark.parametrize(
    ("keys", "complaint"),
    [
        ({"lines": [1, 3], "skip_rows": 1}, "'lines' stands in place of"),
        ({"layout": "wide", "direction": "by-order"}, "is for 'layout: long'"),
        ({"header": ["target"], "header_rows": 2}, "remove 'header_rows'"),
        ({"thousands": "point", "decimal": "point"}, "are both point"),
    ],
)
def test_keys_that_contradict_each_other_are_refused(
    file: File, keys: dict[str, Any], complaint: str
) -> None:
    with pytest.raises(ValidationError, match=complaint):
        file.read(HEADER, **keys)


@given(data=st.data())
def test_whatever_is_in_a_file_it_is_looked_at_or_refused(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    path = tmp_path_factory.mktemp("looked") / "x.csv"
    path.write_bytes(data.draw(damaged(data.draw(st.sampled_from(SAMPLES)))).encode("utf-8", "replace"))
    with contextlib.suppress(InputError):
        look_at(path, REGISTRY)
