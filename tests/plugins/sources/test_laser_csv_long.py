"""Long tables: one reading a row."""

from __future__ import annotations

import math

import numpy as np
import pytest

from plugins.sources.reading import DATA, MM, UM, File, assert_same_readings, missing_in, said
from zlmreport.plugin import Approach, Axis, AxisKind

HEADER = "target,direction,run,deviation\n"
#: 2 targets, both directions.
ROWS = "0,+,1,1.5\n100,+,1,-2\n100,-,1,3\n0,-,1,0.25\n"
ROTARY = Axis("C", AxisKind.ROTARY)
NO_TIMES = "No times were logged: drift and warm-up can only be judged by the order of the readings."


def test_a_table_is_read_in_si_in_the_order_of_its_rows(file: File) -> None:
    measurements = file.read(HEADER + ROWS)
    assert measurements.target_positions.tolist() == [0.0, 100 * MM]
    assert measurements.target.tolist() == [0, 1, 1, 0]
    assert measurements.approach.tolist() == [1, 1, -1, -1]
    assert measurements.run.tolist() == [1, 1, 1, 1]
    assert measurements.deviation.tolist() == [1.5 / 1e6, -2 / 1e6, 3 / 1e6, 0.25 / 1e6]


def test_a_rotary_axis_is_read_in_degrees_and_arc_seconds(file: File) -> None:
    measurements = file.read(f"{HEADER}0,+,1,3600\n90,+,1,0\n", ROTARY)
    assert measurements.target_positions[1] == pytest.approx(math.pi / 2, rel=4e-16)
    assert measurements.deviation[0] == pytest.approx(math.pi / 180, rel=4e-16)


def test_it_is_said_from_which_columns_and_in_which_units_readings_were_taken(file: File) -> None:
    assert said(file.read(HEADER + ROWS)) == [
        "Target positions from the column “target” (mm), deviations from “deviation” (µm).",
        NO_TIMES,
    ]


@pytest.mark.parametrize(
    ("positive", "negative"),
    [
        ("+", "-"),
        ("+", "−"),
        ("up", "down"),
        ("Forward", "Reverse"),
        ("fwd", "bwd"),
        ("↑", "↓"),
        ("1", "-1"),
        ("+1", "−1"),
        ("positive", "negative"),
        ("auf", "ab"),
        ("VORWÄRTS", "rückwärts"),
    ],
)
def test_directions_are_known_by_their_spellings(file: File, positive: str, negative: str) -> None:
    measurements = file.read(f"{HEADER}0,{positive},1,1\n0,{negative},1,1\n")
    assert measurements.approach.tolist() == [1, -1]


def test_an_unknown_direction_is_answered_with_the_nearest(file: File) -> None:
    assert file.complaint(f"{HEADER}0,forwad,1,1\n").startswith(
        "x.csv:2:3: 'forwad' is no direction; did you mean 'forward'?"
    )


def test_actual_positions_give_deviations(file: File) -> None:
    measurements = file.read("target,direction,run,position\n-20,+,1,-19.9945\n20,+,1,19.98\n")
    # Both are doubles near 20 mm: each is half a unit in its last place off, and so is their conversion.
    np.testing.assert_allclose(
        measurements.deviation, [5.5 * UM, -20 * UM], rtol=0.0, atol=2 * np.spacing(20.0) * MM
    )


def test_the_files_own_names_are_mapped_with_or_without_their_units(file: File) -> None:
    german = "Soll [mm];Richtung;Lauf;Abw. (µm)\n0;+;1;1,5\n100;+;1;-2,0\n100;-;1;3,0\n0;-;1;0,25\n"
    columns = {"target": "Soll", "direction": "richtung", "run": "Lauf", "deviation": "Abw. (µm)"}
    assert_same_readings(file.read(german, columns=columns), file.read(HEADER + ROWS))


def test_known_names_are_known_without_regard_to_case_blanks_and_hyphens(file: File) -> None:
    measurements = file.read("TARGET,Direction,Run,Deviation,Air Temperature\n0,+,1,1,20\n")
    assert list(measurements.conditions) == ["air_temperature"]


@pytest.mark.parametrize(
    ("heading", "text", "micrometres"),
    [
        ("deviation (\u00b5m)", "12.5", 12.5),
        ("deviation [\u03bcm]", "12.5", 12.5),
        ("deviation (um)", "12.5", 12.5),
        ("deviation [mm]", "0.0125", 12.5),
        ("deviation (nm)", "12500", 12.5),
        ("deviation (µin)", "100", 2.54),
    ],
)
def test_the_unit_in_the_headers_brackets_holds(
    file: File, heading: str, text: str, micrometres: float
) -> None:
    measurements = file.read(f"target,direction,run,{heading}\n0,+,1,{text}\n")
    assert measurements.deviation[0] == pytest.approx(micrometres * UM, rel=4e-16)


def test_the_unit_that_the_job_states_overrides_the_headers(file: File) -> None:
    table = "target (mm),direction,run,deviation (mm)\n1,+,1,10\n2,+,1,0\n"
    measurements = file.read(table, units={"target": "inch", "deviation": "um"})
    assert measurements.target_positions[0] == pytest.approx(0.0254, rel=4e-16)
    assert measurements.deviation[0] == 10 / 1e6


def test_a_unit_of_another_quantity_is_refused_where_it_stands(file: File) -> None:
    table = "target (mm),direction,run,deviation\n0,+,1,10\n"
    assert file.complaint(table, ROTARY).startswith(
        "x.csv:1:1: column 'target (mm)': 'mm' is no unit of this quantity; "
    )
    assert file.complaint(HEADER + ROWS, ROTARY, units={"deviation": "mm"}).startswith(
        "job.yaml:9:5: column 'deviation': 'mm' is no unit of this quantity; "
    )


def test_deviations_given_as_nominal_minus_actual_change_their_sign(file: File) -> None:
    measurements = file.read(HEADER + ROWS, sign="nominal-actual")
    np.testing.assert_array_equal(measurements.deviation, -file.read(HEADER + ROWS).deviation)
    assert said(measurements)[1] == (
        "The file gives deviations as nominal − actual; their sign was exchanged on reading."
    )


def test_no_sign_is_exchanged_where_positions_were_read(file: File) -> None:
    assert file.complaint("target,direction,run,position\n0,+,1,0\n", sign="nominal-actual") == (
        "x.csv:1:1: 'sign: nominal-actual' is said of deviations, and the file gives positions; remove it"
    )


def test_known_conditions_are_in_si_and_others_as_found(file: File) -> None:
    measurements = file.read(
        "target,direction,run,deviation,air_temperature,screw_temperature (K),air_pressure,"
        "relative_humidity,feed (mm/min)\n0,+,1,1,20.5,295.2,1013.25,45,500\n"
    )
    assert {name: values.tolist() for name, values in measurements.conditions.items()} == {
        "air_temperature": [20.5 + 273.15],
        "screw_temperature": [295.2],
        "air_pressure": [pytest.approx(101325.0, rel=4e-16)],
        "relative_humidity": [pytest.approx(0.45, rel=4e-16)],
        "feed (mm/min)": [500.0],
    }
    assert "Columns kept as conditions, as found: feed (mm/min)." in said(measurements)


def test_a_column_of_words_is_no_condition_unless_it_is_ignored(file: File) -> None:
    table = "target,direction,run,deviation,note\n0,+,1,1,warm\n"
    assert file.complaint(table) == (
        "x.csv:2:9: 'warm' stands where a number belongs; a column that holds no numbers is named in the "
        "job under 'ignore': note"
    )
    measurements = file.read(table, ignore=["Note"])
    assert not measurements.conditions
    assert "Columns not read: Note." in said(measurements)


def test_a_known_condition_is_not_advised_to_be_ignored(file: File) -> None:
    assert file.complaint("target,direction,run,deviation,air_temperature\n0,+,1,1,warm\n") == (
        "x.csv:2:9: 'warm' stands where a number belongs"
    )


def test_times_are_seconds(file: File) -> None:
    measurements = file.read("target,direction,run,deviation,time\n0,+,1,1,10.5\n10,+,1,1,12\n")
    assert measurements.time.tolist() == [0.0, 1.5]


def test_times_may_be_minutes(file: File) -> None:
    measurements = file.read("target,direction,run,deviation,time (min)\n0,+,1,1,0\n10,+,1,1,1.5\n")
    assert measurements.time.tolist() == [0.0, 90.0]


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("2026-11-18T23:59:30", "2026-11-19T00:00:01.5"),
        ("2026-11-18 23:59:30", "2026-11-19 00:00:01.500"),
        ("2026-11-18T23:59:30+01:00", "2026-11-18T23:00:01.5Z"),
    ],
)
def test_times_may_be_iso_8601_across_midnight(file: File, first: str, second: str) -> None:
    table = f"target,direction,run,deviation,time\n0,+,1,1,{first}\n5,+,1,1,\n10,+,1,1,{second}\n"
    time = file.read(table).time
    np.testing.assert_array_equal(time, [0.0, np.nan, 31.5])


@pytest.mark.parametrize("second", ["12.5", "10:00:05", "2026-11-18T10:00:05Z", "soon"])
def test_times_are_all_written_alike(file: File, second: str) -> None:
    table = f"target,direction,run,deviation,time\n0,+,1,1,2026-11-18T10:00:00\n10,+,1,1,{second}\n"
    assert file.complaint(table) == (
        f"x.csv:3:10: {second!r} is no time written like the first one, '2026-11-18T10:00:00'"
    )


def test_a_direction_that_the_file_lacks_is_asked_of_the_job(file: File) -> None:
    table = "target,run,deviation\n0,1,1\n100,1,2\n"
    assert file.complaint(table) == (
        "x.csv:1:1: there is no column 'direction'; name it in the job, as in 'columns: {direction: …}' "
        "(the file has 'target', 'run', 'deviation'); or say 'direction: up' for all readings, "
        "or 'direction: by-order'"
    )
    measurements = file.read(table, direction="reverse")
    assert measurements.approaches == (Approach.NEGATIVE,)
    assert "The direction of approach is not in the file; the job states it (reverse)." in said(measurements)


def test_a_direction_is_not_stated_twice(file: File) -> None:
    assert file.complaint(HEADER + ROWS, direction="up") == (
        "x.csv:1:1: the file has directions, and the job states one for all ('direction'); remove it there"
    )


def test_a_file_without_runs_is_one_run(file: File) -> None:
    table = "target,direction,deviation\n0,+,1\n100,+,2\n"
    measurements = file.read(table)
    assert measurements.run.tolist() == [1, 1]
    assert "The file names no runs: all readings were taken as one run." in said(measurements)
    assert file.complaint(f"{table}0,+,3\n").startswith(
        "x.csv:4:5: target 0 mm ↑, run 1, stands in line 2 already"
    )


def test_a_missing_reading_is_an_empty_cell(file: File) -> None:
    measurements = file.read(f"{HEADER}0,+,1,\n100,+,1,2\n")
    assert missing_in(measurements) == [(0.0, Approach.POSITIVE, 1)]


def test_all_but_the_reading_must_be_there(file: File) -> None:
    assert file.complaints(f"{HEADER},+,1,1\n0,,1,1\n0,+,,1\n") == [
        "x.csv:2:1: there is no target; only a reading may be missing",
        "x.csv:3:3: there is no direction; only a reading may be missing",
        "x.csv:4:5: there is no run; only a reading may be missing",
    ]


@pytest.mark.parametrize("run", ["0", "-1", "1.5", "1e9"])
def test_a_run_is_counted_from_1(file: File, run: str) -> None:
    assert file.complaint(f"{HEADER}0,+,{run},1\n").startswith(
        f"x.csv:2:5: {float(run):.9g} is no number of a run; "
    )


def test_a_run_may_be_written_with_decimals_as_spreadsheets_do(file: File) -> None:
    assert file.read(f"{HEADER}0,+,2.0,1\n").run.tolist() == [2]


def test_a_misspelt_column_is_answered_with_its_name(file: File) -> None:
    assert file.complaint("targt,direction,run,deviation\n0,+,1,1\n") == (
        "x.csv:1:1: there is no column 'target', but 'targt'; name it in the job, as in "
        "'columns: {target: targt}' (the file has 'targt', 'direction', 'run', 'deviation')"
    )


def test_all_missing_columns_are_named_at_once(file: File) -> None:
    complaints = file.complaints("a,b\n0,1\n")
    assert [complaint.split("'")[1] for complaint in complaints] == ["target", "direction", "deviation"]


def test_a_name_that_the_job_maps_must_be_in_the_file(file: File) -> None:
    complaint = file.complaint("Sol,direction,run,deviation\n0,+,1,1\n", columns={"target": "Soll"})
    assert complaint.startswith(
        "x.csv:1:1: the job names a column 'Soll' ('columns: {target: …}'), and there is none; "
        "did you mean 'Sol'?"
    )


def test_a_name_that_the_job_ignores_must_be_in_the_file(file: File) -> None:
    assert file.complaint(HEADER + ROWS, ignore=["note"]).startswith(
        "x.csv:1:1: the job names a column 'note' ('ignore'), and there is none; "
    )


def test_two_columns_of_one_meaning_are_a_question(file: File) -> None:
    table = "target,Soll,direction,run,deviation\n0,0,+,1,1\n"
    assert file.complaint(table, columns={"target": "Soll"}) == (
        "x.csv:1:8: both 'target' and 'Soll' are the column 'target'; "
        "name one of them in the job under 'ignore'"
    )
    assert file.read(table, columns={"target": "Soll"}, ignore=["target"]).deviation.tolist() == [1 / 1e6]


def test_deviation_and_position_are_not_read_both(file: File) -> None:
    table = "target,direction,run,deviation,position\n0,+,1,1,0.001\n"
    assert file.complaint(table) == (
        "x.csv:1:1: there are both deviations and positions; "
        "name one of the columns in the job under 'ignore'"
    )
    assert file.read(table, ignore=["deviation"]).deviation.tolist() == [0.001 / 1e3]


def test_a_table_without_a_header_is_asked_for_one(file: File) -> None:
    assert file.complaint(ROWS) == (
        "x.csv:1:1: the table begins with numbers; its first row names the columns, "
        "as in target,direction,run,deviation, or the job does: 'header: [target, …]'"
    )


def test_a_name_stands_in_the_header_once(file: File) -> None:
    assert file.complaint("target,direction,run,deviation,T,T\n0,+,1,1,2,3\n") == (
        "x.csv:1:34: column 6 is called 'T', as is column 5"
    )


def test_readings_stand_in_no_column_without_a_name(file: File) -> None:
    assert file.complaint("target,direction,run,,deviation\n0,+,1,7,1\n") == (
        "x.csv:2:7: column 4 has no name in the header"
    )


def test_all_defects_of_a_table_are_named_at_once(file: File) -> None:
    table = f"{HEADER}0,+,1,inf\n100,x,1,1\n200,+,1,abc\n300,+,1,1,2\n400,+,1,1\n400,+,1,2\n500,+,1,1e9\n"
    assert [complaint.split(": ", 1)[0] for complaint in file.complaints(table)] == [
        "x.csv:2:7",
        "x.csv:3:5",
        "x.csv:4:9",
        "x.csv:5:11",
        "x.csv:7:9",
        "x.csv:8:9",
    ]


@pytest.mark.parametrize(
    "name",
    ["ecmc_13e6c326", "ecmc_0657b0d4", "ecmc_1139bca6", "ecmc_2845f959", "ecmc_59b90437"],
)
def test_published_linear_measurements_are_full_tests(name: str, file: File) -> None:
    measurements = file.read((DATA / "published" / f"{name}.csv").read_bytes())
    assert measurements.is_bidirectional
    assert len(measurements.runs) == 5
    assert measurements.missing() == ()


def test_the_published_rotary_measurement_is_a_full_test(file: File) -> None:
    measurements = file.read((DATA / "published" / "avs_bifrost_FAT_rotary.csv").read_bytes(), ROTARY)
    assert measurements.deviations().shape == (2, 5, 10)
    assert measurements.missing() == ()
