"""Tables as text: delimiters, decimal signs, quotation marks, comments, damage."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest
from pydantic import ValidationError

from installed import registry
from plugins.sources.reading import File, assert_same_readings
from refusals import refusal
from zlmreport.plugin import MeasurementSet

HEADER = "target,direction,run,deviation\n"
TABLE = f"{HEADER}0,+,1,1.5\n100,+,1,-2\n"


@pytest.fixture
def expected(tmp_path: Path) -> MeasurementSet:
    return File("laser-csv", tmp_path / "expected.csv").read(TABLE)


@pytest.mark.parametrize(
    "content",
    [
        TABLE.replace(",", ";"),
        TABLE.replace(",", "\t"),
        TABLE.replace(",", ";").replace(".", ","),
        TABLE.replace(",", "\t").replace(".", ","),
        TABLE.replace("\n", "\r\n"),
        TABLE.rstrip("\n"),
        f"\ufeff{TABLE}",
        f"# Laser, 18.11.2026\n\n{TABLE}  # end\n\n",
        TABLE.replace("\n", ",\n"),
        TABLE.replace("\n", ",,\n"),
        TABLE.replace("-2\n", "-2,,,\n"),
        f"{TABLE},,,\n",
        TABLE.replace(",", " , "),
        '"target","direction","run","deviation"\n"0","+","1","1.5"\n100, "+" ,1,"-2"\n',
        '"target","direction","run","deviation"\n0,+,1,"1,5"\n100,+,1,"-2,0"\n',
        TABLE.replace("-2", "−2.0e0"),
    ],
    ids=[
        "semicolon",
        "tab",
        "semicolon and decimal comma",
        "tab and decimal comma",
        "cr lf",
        "no last newline",
        "byte order mark",
        "comments and blank lines",
        "trailing delimiters",
        "two trailing delimiters",
        "more trailing delimiters in a row",
        "row of delimiters",
        "blanks around cells",
        "quotation marks",
        "quoted decimal commas",
        "true minus and exponent",
    ],
)
def test_the_same_readings_in_every_usual_spelling(
    file: File, expected: MeasurementSet, content: str
) -> None:
    assert_same_readings(file.read(content), expected)


def test_a_comma_in_a_name_parts_no_columns_that_semicolons_part(file: File) -> None:
    table = "Soll, mm;Ist, mm;direction;run\n0;0,001;+;1\n"
    measurements = file.read(table, columns={"target": "Soll, mm", "position": "Ist, mm"})
    assert measurements.deviation.tolist() == [0.001 / 1e3]


@pytest.mark.parametrize("delimiter", [";", "semicolon"])
def test_the_delimiter_that_the_job_states_holds(file: File, delimiter: str) -> None:
    table = "target;direction;run;deviation;a,b\n0;+;1;1;2\n"
    assert list(file.read(table, delimiter=delimiter).conditions) == ["a,b"]


def test_a_header_of_one_column_is_asked_for_its_delimiter(file: File) -> None:
    assert file.complaint("target direction run deviation\n0 + 1 1\n") == (
        "x.csv:1:1: the header 'target direction run deviation' has a single column; columns are parted by "
        "commas, semicolons or tabs, or by blanks if the job says 'delimiter: blanks'"
    )


def test_names_that_the_job_gives_are_as_many_as_the_cells(file: File) -> None:
    assert file.complaint("0,+,1,1\n", header=("target", "deviation")) == (
        "x.csv:1:1: 'header' names 2 columns, and no delimiter parts '0,+,1,1' into so many cells; name "
        "every column, or say what parts them, as in 'delimiter: blanks'"
    )


@pytest.mark.parametrize(
    ("row", "complaint"),
    [
        ("---,+,1,1", "x.csv:3:1: there is no target; only a reading may be missing"),
        ("10,---,1,1", "x.csv:3:4: there is no direction; only a reading may be missing"),
        ("10,+,---,1", "x.csv:3:6: there is no run; only a reading may be missing"),
    ],
)
def test_what_stands_for_a_missing_reading_is_no_target_direction_or_run(
    file: File, row: str, complaint: str
) -> None:
    table = f"target,direction,run,deviation\n0,+,1,1\n{row}\n"
    assert file.complaint(table, missing=("---",)) == complaint


@pytest.mark.parametrize(
    "lost",
    [
        *("9999.999", "-9999", "99999", "-999.0", "1e30", "9.91E+37", "32767", "−9999.99"),
        *("-999.25", "-999.2500", "-9999.25", "−999.25", "-32767"),
    ],
)
def test_a_number_that_stands_for_no_reading_is_none(lost: str, file: File) -> None:
    table = f"target,direction,run,deviation\n0,+,1,11.5\n10,+,1,{lost}\n20,+,1,-12\n"
    assert file.complaint(table) == (
        f"x.csv:3:8: '{lost}' is far from all others of its column, and a number by which instruments say "
        f"that they have no reading; if the reading is missing, say 'missing: [\"{lost}\"]' in the job"
    )
    assert np.isnan(file.read(table, missing=[lost]).deviation).tolist() == [False, True, False]


@pytest.mark.parametrize(
    "values", ["9999,8888,7777", "99.9,12,11", "-999.25,-400,1", "999.9,450,410", "9.999,-3.4,1", "0,0,0"]
)
def test_nines_that_a_quantity_has_are_readings(values: str, file: File) -> None:
    at = dict(zip((0, 1000, 2000), values.split(","), strict=True))
    table = "\n".join(f"{target},+,1,{value}" for target, value in at.items())
    read = file.read(f"target,direction,run,deviation\n{table}\n")
    np.testing.assert_allclose(read.deviation * 1e6, [float(value) for value in at.values()])


def test_a_sensor_that_is_not_there_has_no_temperature(file: File) -> None:
    table = "target,direction,run,deviation,air_temperature\n0,+,1,1,-9999.0\n10,+,1,2,-9999.0\n"
    assert file.complaints(table)[0].startswith("x.csv:2:9: '-9999.0' is far from all others of its column")
    assert "air_temperature" not in file.read(table, missing=["-9999.0"]).conditions


def test_a_table_of_bars_has_its_places(file: File) -> None:
    head = "| target | direction | run | deviation |\n|---:|:-:|---|---|\n"
    table = f"{head}| 0 | + | 1 | 5 |\n| 9 | + | 1 | x |\n"
    assert file.complaints(table)[0] == "x.csv:4:15: 'x' stands where a number belongs"
    assert file.read(table.replace("x", "2")).deviation.tolist()[1] == 2e-6


def test_a_file_from_a_chinese_windows_is_told_its_encoding(file: File) -> None:
    assert file.complaint("目标位置,方向\n".encode("gbk")).endswith("as in 'encoding: gbk'")


def test_a_time_may_be_missing_by_the_same_word(file: File) -> None:
    table = "target,direction,run,deviation,time\n0,+,1,1,---\n10,+,1,1,8:15\n20,+,1,1,8:16\n"
    time = file.read(table, missing=("---",)).time
    np.testing.assert_array_equal(time, [np.nan, 0.0, 60.0])


def test_a_time_of_another_spelling_is_told_how_times_are_written(file: File) -> None:
    table = "target,direction,run,deviation,time\n0,+,1,1,11/18/2026 8:00\n"
    assert file.complaint(table) == (
        "x.csv:2:9: '11/18/2026 8:00' stands where a number belongs; a time is a number of seconds, or "
        "written as 2026-11-18 08:15:00 (ISO 8601)"
    )


def test_of_many_wrong_headings_the_first_is_named(file: File) -> None:
    header = ",".join(["target", *["again"] * 30])
    assert file.complaint(f"{header}\n0{',1' * 30}\n") == (
        "x.csv:1:14: column 3 is called 'again', as is column 2 (29 like this: line 1)"
    )


def test_a_number_that_may_have_a_decimal_comma_or_a_thousands_separator_is_a_question(file: File) -> None:
    table = "target;direction;run;deviation\n0;+;1;1,234\n100;+;1;2,345\n"
    assert file.complaint(table) == (
        "x.csv:2:7: '1,234' may have a decimal comma or a thousands separator, and no other number tells; "
        "say 'decimal: comma' or 'decimal: point' in the job"
    )
    assert file.read(table, decimal="comma").deviation.tolist() == [1.234 / 1e6, 2.345 / 1e6]
    assert file.complaints(table, decimal="point")[0] == (
        "x.csv:2:7: '1,234' is no number with a decimal point; write '1.234' if that is meant"
    )


@pytest.mark.parametrize("proof", ["12,5", "0,123", "1234,567", "1,2345", "1,234e1", ",5"])
def test_one_number_that_tells_the_decimal_comma_is_enough(file: File, proof: str) -> None:
    table = f"target;direction;run;deviation\n0;+;1;1,234\n9000;+;1;{proof}\n"
    assert file.read(table).deviation[0] == 1.234 / 1e6


def test_both_decimal_signs_in_one_file_are_a_question(file: File) -> None:
    table = "target;direction;run;deviation\n0;+;1;1,5\n100;+;1;2.5\n"
    assert file.complaint(table) == (
        "x.csv:3:9: both decimal signs occur, '2.5' and '1,5', one here and one in line 2; correct the file, "
        "or say 'decimal: point' or 'decimal: comma' in the job"
    )


def test_thousands_separators_are_refused_with_the_cell_named(file: File) -> None:
    table = 'target,direction,run,deviation\n"1,000.0",+,1,1.5\n2000.0,+,1,2.5\n'
    assert file.complaint(table) == (
        "x.csv:2:1: '1,000.0' has thousands separators; say 'thousands: comma' in the job"
    )


def test_what_is_wrong_in_every_row_is_said_once_with_the_first_lines(file: File) -> None:
    rows = "".join(f'"{1000 + index:,}.0";+;1;1.5\n' for index in range(30))
    assert file.complaint(f"target;direction;run;deviation\n{rows}5;+;1;1.5\n", decimal="point") == (
        "x.csv:2:1: '1,000.0' has thousands separators; say 'thousands: comma' in the job "
        "(30 like this: lines 2, 3, 4, 5, 6, …)"
    )


def test_each_word_in_the_place_of_a_number_is_told(file: File) -> None:
    rows = "".join(f"{index},+,1,{('lost', 'beam')[index % 2]}\n" for index in range(10))
    assert file.complaints(f"target,direction,run,deviation\n{rows}") == [
        "x.csv:2:7: 'lost' stands where a number belongs (5 like this: lines 2, 4, 6, 8, 10)",
        "x.csv:3:7: 'beam' stands where a number belongs (5 like this: lines 3, 5, 7, 9, 11)",
    ]


def test_three_wrong_cells_are_told_each(file: File) -> None:
    table = "target,direction,run,deviation\n0,+,1,a1\n10,+,1,a2\n20,+,1,a3\n"
    assert len(file.complaints(table)) == 3


def test_lines_that_are_too_long_are_told_with_all_else_that_is_wrong(file: File) -> None:
    long = "1" * 100_001
    table = f"target,direction,run,deviation\n0,+,1,1\n10,+,1,{long}\n20,+,1,x\n# {long}\n30,*,1,1\n"
    assert [each[:32] for each in file.complaints(table)] == [
        "x.csv:3:100001: the line has 100",
        "x.csv:4:8: 'x' stands where a nu",
        "x.csv:5:100001: the line has 100",
        "x.csv:6:4: '*' is no direction; ",
    ]


def test_a_header_that_is_too_long_is_told_alone(file: File) -> None:
    assert file.complaint(f"target,{'1' * 100_001}\n0,+,1,x\n").startswith("x.csv:1:100001: the line has")


@pytest.mark.parametrize(
    ("row", "complaint"),
    [
        (
            "200,+,1,1,5",
            (
                "x.csv:4:11: the row has 5 cells, and the header names 4 columns; is there a decimal comma? "
                "Then semicolons part columns"
            ),
        ),
        (
            "200,+,1",
            "x.csv:4:7: the row ends after 3 of 4 cells; a missing reading is an empty cell, with its comma",
        ),
        (
            '200,+,1,"1',
            "x.csv:4:9: a quotation mark stands at the beginning of this cell, and not at its end",
        ),
        (
            '200,+,1,"1"5',
            "x.csv:4:9: a quotation mark stands at the beginning of this cell, and not at its end",
        ),
        ("200,+,1,1 kg", "x.csv:4:9: '1 kg' stands where a number belongs"),
        (
            '200,"+",1,"inf"',
            "x.csv:4:11: 'inf' is infinite, and no reading is; a missing reading is an empty cell",
        ),
        ("200,+,1,NaN", "x.csv:4:9: 'NaN' is no number; a missing reading is an empty cell"),
    ],
)
def test_a_damaged_row_is_named_by_line_and_column(file: File, row: str, complaint: str) -> None:
    assert file.complaint(f"{TABLE}{row}\n") == complaint


def test_a_damaged_header_is_named_by_line_and_column(file: File) -> None:
    assert file.complaint('target,"direction,run,deviation\n0,+,1,1\n') == (
        "x.csv:1:8: a quotation mark stands at the beginning of this cell, and not at its end"
    )
    assert file.complaint(f"target,{'x' * 201},direction,run,deviation\n0,0,+,1,1\n").startswith(
        "x.csv:1:8: 'xxx"
    )


def test_a_file_of_comments_holds_no_table(file: File) -> None:
    assert file.complaint("# nothing\n\n# yet\n") == (
        "x.csv: holds no table: every line is blank or a comment"
    )


def test_a_header_alone_holds_no_readings(file: File) -> None:
    assert file.complaint(HEADER) == "x.csv: holds no readings"


def test_a_table_among_other_things_is_read_by_its_lines(file: File, expected: MeasurementSet) -> None:
    content = f"Work order;17\nOperator;Jo\n{TABLE}Mean;1;2;3\n"
    assert_same_readings(file.read(content, lines=[3, 5]), expected)


def test_lines_beyond_the_file_hold_no_table(file: File) -> None:
    assert file.complaint(TABLE, lines=[10, 20]) == "x.csv: holds no table: nothing stands there"


@pytest.mark.parametrize(
    ("content", "complaint"),
    [
        (b"", "x.csv: is empty"),
        (b"target,direction\0\xff\n", "x.csv:1:18: byte 0xFF is not UTF-8: this is no text file"),
        (TABLE.encode("utf-16"), "x.csv:1:1: is UTF-16 text; save it as UTF-8, or say 'encoding: utf-16'"),
        ("target,Prüfung\n".encode("cp1252"), "x.csv:1:10: byte 0xFC is not UTF-8; save the file as UTF-8"),
    ],
    ids=["empty", "binary", "utf-16", "cp1252"],
)
def test_a_file_that_is_no_text_in_utf_8_is_refused(file: File, content: bytes, complaint: str) -> None:
    assert file.complaint(content).startswith(complaint)


def test_the_encoding_that_the_job_states_is_used(file: File, expected: MeasurementSet) -> None:
    assert_same_readings(file.read(TABLE.encode("utf-16"), encoding="utf-16"), expected)


@pytest.mark.parametrize(
    ("keys", "complaint"),
    [
        (
            {"columns": {"taget": "Soll"}},
            "'taget' is no column of a measurement file; did you mean 'target'?",
        ),
        ({"units": {"run": "mm"}}, "'run' is no column with a unit; "),
        ({"units": {"target": "furlong"}}, "'furlong' is no unit of this quantity; "),
        ({"units": {"air_pressure": "mm"}}, "'mm' is no unit of this quantity; "),
        ({"encoding": "utf-80"}, "'utf-80' is no encoding of text"),
        ({"values": "position"}, "'values' is for 'layout: wide'"),
        ({"lines": [5, 5]}, "'lines' names the header's line and the last line"),
        ({"colums": {}}, "Extra inputs are not permitted"),
    ],
)
def test_job_keys_are_held_against_what_there_is(keys: dict[str, object], complaint: str) -> None:
    with pytest.raises(ValidationError) as caught:
        registry().source("laser-csv").options.model_validate({"file": "x.csv", **keys})
    assert complaint in str(caught.value)


def test_unordered_rows_keep_their_order_and_give_the_same_grid(file: File) -> None:
    rows = ["0,+,1,1", "50,+,1,2", "100,+,1,3"]
    for order in itertools.permutations(rows):
        measurements = file.read(HEADER + "\n".join(order) + "\n")
        assert measurements.deviations()[0, :, 0].tolist() == [1 / 1e6, 2 / 1e6, 3 / 1e6]
        assert measurements.deviation.tolist() == [float(row[-1]) / 1e6 for row in order]


def test_rows_whose_times_contradict_their_order_are_refused(file: File) -> None:
    table = "target,direction,run,deviation,time\n0,+,1,1,3\n100,+,1,2,1\n"
    assert file.complaint(table) == (
        "x.csv:3:9: the time is before that of the reading in line 2; "
        "readings stand in the order in which they were taken"
    )


CURES = {
    "text above the header": (
        "Machine: X\n\ntarget,direction,deviation\n0,+,1\n",
        "1:1: 'Machine: X' is no header, and line 3 names columns: say 'skip_rows: 2' in the job",
    ),
    "cells above the header": (
        "Machine;BZ\ntarget;direction;deviation\n0;+;1\n",
        "1:1: 'Machine;BZ' is no header, and line 2 names columns",
    ),
    "targets along the header": ("target,0,5,10\nup 1,1,2,3\n", "1:1: this table lies on its side"),
    "names down the side": (
        "target,0,5\ndirection,+,+\nrun,1,1\ndeviation,1,2\n",
        "1:1: this table lies on its side",
    ),
}


@pytest.mark.parametrize(("content", "cure"), CURES.values(), ids=CURES)
def test_a_table_of_another_shape_is_refused_with_the_cure(file: File, content: str, cure: str) -> None:
    assert cure in refusal(file.read, content)


def test_directions_may_be_written_in_german(file: File) -> None:
    found = file.read("target,direction,deviation\n0,hin,1\n0,rück,2\n5,vor,1\n5,zurück,2\n")
    assert found.approach.tolist() == [1, -1, 1, -1]
