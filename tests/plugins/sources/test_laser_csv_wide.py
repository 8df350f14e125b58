"""Wide tables: one target position a row, one column a run and direction."""

from __future__ import annotations

import pytest

from plugins.sources.reading import File, assert_same_readings, missing_in, said
from zlmreport.plugin import Approach, MeasurementSet

UP, DOWN = Approach.POSITIVE, Approach.NEGATIVE

LONG = (
    "target,direction,run,deviation\n"
    "0,+,1,1\n100,+,1,5\n100,-,1,6\n0,-,1,2\n0,+,2,3\n100,+,2,7\n100,-,2,8\n0,-,2,4\n"
)
ROWS = "0,1,2,3,4\n100,5,6,7,8\n"


def wide(file: File, content: str, **keys: object) -> MeasurementSet:
    return file.read(content, layout="wide", **keys)


@pytest.mark.parametrize(
    "header",
    [
        "target,1+,1-,2+,2-",
        "Target (mm),1 ↑,1 ↓,2 ↑,2 ↓",
        "target,Run 1 fwd,Run 1 bwd,Run 2 fwd,Run 2 bwd",
        "target,run_1_up (µm),run_1_down (µm),run_2_up (µm),run_2_down (µm)",
        "target,+1,-1,+2,-2",
        "target,Run 1 (fwd),Run 1 [bwd],Run 2 (+),Run 2 (-)",
        "target,Forward Run 1,Reverse Run 1,Forward Run 2,Reverse Run 2",
        "target,Lauf 1 auf,Lauf 1 ab,Lauf 2 auf,Lauf 2 ab",
    ],
)
def test_a_wide_table_holds_the_same_readings_as_a_long_one(file: File, header: str) -> None:
    assert_same_readings(wide(file, f"{header}\n{ROWS}"), file.read(LONG))


def test_the_order_of_columns_and_rows_does_not_matter(file: File) -> None:
    table = "2-,1+,target,2+,1-\n8,5,100,7,6\n4,1,0,3,2\n"
    assert_same_readings(wide(file, table), file.read(LONG))


def test_it_is_said_that_the_table_does_not_tell_the_order_of_readings(file: File) -> None:
    remarks = said(wide(file, f"target,1+,1-,2+,2-\n{ROWS}"))
    assert remarks[:2] == [
        "Target positions from the column “target” (mm), deviations from “1+” (µm) to “2-” (µm).",
        (
            "The table does not tell the order of the readings: they are listed run by run, upwards and then "
            "downwards."
        ),
    ]


@pytest.mark.parametrize(
    ("header", "told"),
    [
        ("1+", (1, UP)),
        ("12 -", (12, DOWN)),
        ("3−", (3, DOWN)),
    ],
)
def test_a_header_tells_run_and_direction(file: File, header: str, told: tuple[int, Approach]) -> None:
    found = wide(file, f"target,{header}\n0,1\n")
    assert (found.run.tolist(), found.approaches) == ([told[0]], (told[1],))


def test_a_header_may_tell_the_run_alone(file: File) -> None:
    assert wide(file, "target,RUN 7\n0,1\n", direction="up").run.tolist() == [7]


@pytest.mark.parametrize("header", ["Run-1", "run 0 +", "1+2", "Average", "fwd", "posıtıv 1"])
def test_a_header_tells_run_and_direction_by_a_rule_or_nothing(file: File, header: str) -> None:
    complaint = file.complaint(f"target,1-,{header}\n0,1,2\n", layout="wide")
    assert f"no rule reads the column '{header}'" in complaint


def test_a_column_without_a_meaning_is_never_dropped_silently(file: File) -> None:
    table = "target,1+,1-,Average\n0,1,2,1.5\n"
    assert file.complaint(table, layout="wide") == (
        "x.csv:1:14: no rule reads the column 'Average' of a wide table; its columns are named after run and "
        "direction, as in '1+', '1-' or 'Run 1 fwd', mapped to such a name, as in 'columns: {1+: …}', or "
        "listed under 'ignore'"
    )
    measurements = wide(file, table, ignore=["Average"])
    assert len(measurements.deviation) == 2
    assert "Columns not read: Average." in said(measurements)


def test_a_direction_that_the_columns_do_not_tell_is_asked_of_the_job(file: File) -> None:
    table = "target,RUN 1,RUN 2\n0,1,2\n"
    assert file.complaints(table, layout="wide")[0] == (
        "x.csv:1:8: the column 'RUN 1' does not tell its direction; say 'direction: up' in the job for all "
        "such columns, or 'columns: {1+: RUN 1}' for this one"
    )
    assert wide(file, table, direction="down").approaches == (DOWN,)


def test_columns_are_mapped_to_run_and_direction(file: File) -> None:
    table = f"Soll,RUN 1,RUN 2,RUN 3,RUN 4\n{ROWS}"
    columns = {"target": "Soll", "1+": "RUN 1", "1-": "RUN 2", "2+": "RUN 3", "2-": "RUN 4"}
    assert_same_readings(wide(file, table, columns=columns), file.read(LONG))


def test_a_run_and_direction_is_one_column(file: File) -> None:
    assert file.complaint("target,1+,Run 1 fwd\n0,1,2\n", layout="wide") == (
        "x.csv:1:11: 'Run 1 fwd' and '1+' are the same run and direction"
    )


def test_a_wide_table_may_hold_positions(file: File) -> None:
    measurements = wide(file, "target,1+,1-\n0,0.001,-0.002\n", values="position")
    assert measurements.deviation.tolist() == [0.001 / 1e3, -0.002 / 1e3]


def test_no_sign_is_exchanged_where_positions_are_read(file: File) -> None:
    keys = {"layout": "wide", "values": "position", "sign": "nominal-actual"}
    assert file.complaint("target,1+\n0,0.001\n", **keys) == (
        "x.csv:1:1: 'sign: nominal-actual' is said of deviations, and 'values: position' says there are none"
    )


def test_units_are_of_each_column_or_stated_for_all(file: File) -> None:
    assert wide(file, "target,1+ (nm),1-\n0,1500,2\n").deviation.tolist() == [1500 / 1e9, 2 / 1e6]
    stated = wide(file, "target,1+,1-\n0,0.001,0.002\n", units={"deviation": "mm"})
    assert stated.deviation.tolist() == [0.001 / 1e3, 0.002 / 1e3]


def test_an_empty_cell_is_a_missing_reading(file: File) -> None:
    measurements = wide(file, "target,1+,1-\n0,1,2\n100,,4\n")
    assert missing_in(measurements) == [(0.1, UP, 1)]


def test_a_target_that_stands_in_two_rows_is_there_twice(file: File) -> None:
    assert file.complaints("target,1+,1-\n0,1,2\n0,3,4\n", layout="wide") == [
        f"x.csv:3:{column}: target 0 mm {arrow}, run 1, stands in line 2 already; "
        "a repeated run has a number of its own"
        for column, arrow in ((3, "↑"), (5, "↓"))
    ]


def test_a_wide_table_read_as_a_long_one_is_recognised(file: File) -> None:
    assert file.complaint(f"target,1+,1-,2+,2-\n{ROWS}") == (
        "x.csv:1:1: the header names runs as columns; say 'layout: wide' in the job"
    )


def test_a_wide_table_has_targets_and_readings(file: File) -> None:
    assert file.complaint("position,1+\n0,1\n", layout="wide", ignore=["position"]).startswith(
        "x.csv:1:1: there is no column 'target'; "
    )
    assert file.complaint("target,note\n0,1\n", layout="wide", ignore=["note"]).startswith(
        "x.csv:1:1: a wide table has no columns of readings here; its columns are named after run"
    )
