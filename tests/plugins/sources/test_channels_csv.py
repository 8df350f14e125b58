"""Tables of channels over time: long and wide, with clocks and units, and averages of many readings."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from pydantic import ValidationError

from plugins.sources.reading import UM, File, said
from zlmreport.plugin import DISPLACEMENT, Axis, InputError

X1 = Axis("X1", quantity=DISPLACEMENT)
LONG = "time,channel,value\n"


@pytest.fixture
def file(tmp_path: Path) -> File:
    return File("channels-csv", tmp_path / "drift.csv")


def test_a_row_may_be_a_reading_of_one_channel(file: File) -> None:
    found = file.read(LONG + "0,X1,1.5\n0,Y1,9\n60,X1,2.5\n60,Y1,8\n", X1)
    np.testing.assert_allclose(found.target_positions, [0, 60])
    np.testing.assert_allclose(found.deviation, [1.5 * UM, 2.5 * UM])
    assert found.approaches == (1,)


def test_a_column_may_be_a_channel(file: File) -> None:
    found = file.read("time,X1,Y1\n0,1.5,9\n60,2.5,8\n", X1)
    np.testing.assert_allclose(found.deviation, [1.5 * UM, 2.5 * UM])


def test_channels_may_stand_one_below_the_other(file: File) -> None:
    rows = "".join(f"{10 * n},{name},{n}\n" for name in ("Y1", "X1") for n in range(4))
    found = file.read(LONG + rows, X1)
    np.testing.assert_allclose(found.target_positions, [0, 10, 20, 30])


def test_times_are_counted_from_the_first_reading_of_all_channels(file: File) -> None:
    found = file.read(LONG + "100,Y1,1\n130,X1,1\n160,Y1,2\n190,X1,2\n", X1)
    np.testing.assert_allclose(found.target_positions, [30, 90])


@pytest.mark.parametrize(
    ("heading", "times"),
    [
        ("time (h)", ["0", "0.5", "1"]),
        ("time (min)", ["0", "30", "60"]),
        ("time", ["2026-11-18T08:00", "2026-11-18T08:30", "2026-11-18T09:00"]),
        ("time", ["18.11.2026 8:00", "18.11.2026 8:30", "18.11.2026 9:00"]),
        ("time", ["2026-11-18 8:00", "2026-11-18 8:30", "2026-11-18 9:00"]),
        ("time", ["2026/11/18 8:00", "2026/11/18 8:30", "2026/11/18 9:00"]),
        ("time", ["11/18/2026 11:45:00 AM", "11/18/2026 12:15:00 PM", "11/18/2026 12:45:00 PM"]),
        ("time", ["11:30 pm", "12:00 am", "12:30 am"]),
        ("time", ["18.11.26 08:00 Uhr", "18.11.26 08:30 Uhr", "18.11.26 09:00 Uhr"]),
        ("time", ["23:30", "0:00", "0:30"]),
    ],
)
def test_times_are_hours_minutes_dates_or_a_clock_that_passes_midnight(
    file: File, heading: str, times: list[str]
) -> None:
    rows = "".join(f"{time},{value}\n" for value, time in enumerate(times))
    found = file.read(f"{heading},X1\n{rows}", X1)
    np.testing.assert_allclose(found.target_positions, [0, 1800, 3600])


def test_a_clock_begins_anew_with_each_channel_that_stands_below_another(file: File) -> None:
    rows = "".join(
        f"{clock},{name},{n}\n" for name in ("Y1", "X1") for n, clock in enumerate(("8:00", "23:00"))
    )
    found = file.read(LONG + rows, X1)
    np.testing.assert_allclose(found.target_positions, [0, 15 * 3600])


@pytest.mark.parametrize(
    ("content", "keys"),
    [
        ("time,X1 (mm)\n0,0.001\n60,0.004\n", {}),
        (LONG + "0,X1 [nm],1000\n60,X1 [nm],4000\n", {}),
        ("time,X1\n0,0.001\n60,0.004\n", {"units": {"value": "mm"}}),
        ("time,X1\n0,1 µm\n60,4 µm\n", {}),
    ],
)
def test_units_are_those_of_file_or_job(file: File, content: str, keys: dict) -> None:
    np.testing.assert_allclose(file.read(content, X1, **keys).deviation, [1 * UM, 4 * UM])


def test_names_of_the_file_are_mapped(file: File) -> None:
    content = (
        "Zeit;Kanal;Wert\n0;Taster 1 (µm);1,5\n0;Halle (°C);20,5\n60;Taster 1 (µm);2,5\n60;Halle (°C);21\n"
    )
    found = file.read(
        content,
        X1,
        columns={"time": "Zeit", "channel": "Kanal", "value": "Wert"},
        channels={"X1": "Taster 1", "air_temperature": "Halle"},
    )
    np.testing.assert_allclose(found.deviation, [1.5 * UM, 2.5 * UM])
    np.testing.assert_allclose(found.conditions["air_temperature"], [293.65, 294.15])


def test_known_conditions_are_in_si_and_other_temperatures_in_celsius(file: File) -> None:
    found = file.read(
        "time,X1,air_temperature (°F),spindle_temperature,bed (K)\n0,1,68,21,294.15\n60,2,68,22,295.15\n", X1
    )
    np.testing.assert_allclose(found.conditions["air_temperature"], [293.15, 293.15])
    np.testing.assert_allclose(found.conditions["spindle_temperature"], [21, 22])
    np.testing.assert_allclose(found.conditions["bed_temperature"], [21, 22])


def test_other_sensors_are_no_conditions(file: File) -> None:
    assert not file.read("time,X1,Y1,Z\n0,1,2,3\n60,2,3,4\n", X1).conditions


def test_conditions_that_were_logged_at_other_times_are_taken_between_and_said(file: File) -> None:
    found = file.read(LONG + "0,air_temperature,20\n30,X1,1\n60,air_temperature,21\n90,X1,2\n", X1)
    np.testing.assert_allclose(found.conditions["air_temperature"], [293.65, np.nan])
    assert any("linear between those that were logged" in each for each in said(found))


def test_an_empty_cell_is_a_reading_that_is_missing(file: File) -> None:
    found = file.read("time,X1,Y1\n0,1,1\n60,,2\n120,3,3\n", X1)
    np.testing.assert_allclose(found.deviation, [1 * UM, np.nan, 3 * UM])
    assert len(found.missing()) == 1


def test_many_readings_are_averaged_and_what_that_leaves_out_is_told(file: File) -> None:
    ripple = [1.0 if second % 2 else -1.0 for second in range(4 * 3600)]
    rows = "".join(f"{second},{value + second / 3600}\n" for second, value in enumerate(ripple))
    found = file.read("time,X1\n" + rows, X1)
    assert len(found.deviation) == 1440
    assert found.target_positions[0] == pytest.approx(5.0)  # of the first ten seconds
    assert found.provenance.averaging.readings == 4 * 3600
    assert found.provenance.averaging.left_out == pytest.approx(1 * UM, rel=1e-3)
    np.testing.assert_allclose(found.deviation, found.target_positions / 3600 * UM, atol=2e-10)


def test_all_channels_of_a_file_are_averaged_over_the_same_intervals(file: File) -> None:
    rows = "".join(f"{second},X1,{second % 7}\n" for second in range(3000))
    rows += "".join(f"{second},Y1,{second}\n" for second in range(0, 3000, 60))
    both = [file.read(LONG + rows, Axis(name, quantity=DISPLACEMENT)) for name in ("X1", "Y1")]
    assert set(both[1].target_positions) <= set(both[0].target_positions)


def test_the_job_states_intervals(file: File) -> None:
    found = file.read("time,X1\n0,1\n10,3\n20,5\n30,7\n", X1, interval=20)
    np.testing.assert_allclose(found.target_positions, [10, 30])
    np.testing.assert_allclose(found.deviation, [2 * UM, 6 * UM])


@pytest.mark.parametrize(
    ("content", "said_of_it"),
    [
        (LONG + "0,X1,1\n60,X1,2\n30,X1,3\n", "drift.csv:4:1: the time is before that of the reading of"),
        (
            LONG + "0,X1,1\n60,X1,2\n60,X1,3\n",
            "drift.csv:4:1: channel 'X1' has a reading of this time in line 3",
        ),
        ("time,X1\n0,1\n60,2\n30,3\n", "drift.csv:4:1: the time is before"),
        (LONG + "0,X1,1\n,X1,2\n", "drift.csv:3:1: there is no time"),
        (LONG + "0,X1,1\n1e9,X1,2\n", "no test takes 1e+09 s; is the unit of its time right?"),
        (LONG + "0,X1,1\n60,,2\n", "drift.csv:3:4: there is no channel"),
        (LONG + "0,X1,1\n60,X1,two\n", "drift.csv:3:7: 'two' stands where a number belongs"),
        (LONG + "0,X1 (°C),20\n60,X1 (°C),21\n", "drift.csv:2:3: channel 'X1': '°C' is no unit"),
        (
            LONG + "0,X1 (µm),1\n60,X1 (mm),2\n",
            "drift.csv:3:4: channel 'X1' is in mm here, and in µm in line 2",
        ),
        (LONG + "0,Y1,1\n60,Y1,2\n", "drift.csv: there is no channel 'X1'; known: Y1; name it in the job"),
        ("time,X1\n0,0.0010\n9,0.0013\n", "drift.csv:1:6: the readings of channel 'X1' span 0.0003"),
        ("time,X1\n0,20000\n9,30000\n19,50000\n", "larger than any displacement over time"),
        ("X1,Y1\n0,1\n9,2\n", "there is no column 'time'"),
        ("time,channel\n0,X1\n9,X1\n", "there is no column 'value'"),
        ("time,X1,bed (°C)\n0,1,20\n9,2,900\n", "drift.csv:3:5: channel 'bed' is not between -50 and 150 °C"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(file: File, content: str, said_of_it: str) -> None:
    assert said_of_it in file.complaint(content, X1)


def test_a_small_drift_in_a_stated_unit_is_believed(file: File) -> None:
    found = file.read("time,X1 (µm)\n0,0.0010\n9,0.0013\n", X1)
    assert float(np.ptp(found.deviation)) == pytest.approx(3e-10)


def test_a_table_of_channels_is_no_test_of_an_axis(file: File) -> None:
    assert "reads displacements over time, and this job is on positioning" in file.complaint(
        "time,X1\n0,1\n9,2\n", Axis("X1")
    )


@pytest.mark.parametrize("name", ["air_temp", "humidity_air"])
def test_a_condition_that_is_none_is_not_lost_without_a_word(file: File, name: str) -> None:
    with pytest.raises(ValueError, match="is no condition"):
        file.source.options.model_validate({"file": file.path, "channels": {name: "Hall"}})


def test_a_file_of_sensors_and_temperatures_is_proposed(file: File) -> None:
    file.path.write_text("time,X1,X2,Z,air_temperature\n0,1,2,3,20\n60,2,3,4,20\n")
    (proposal,) = file.source.proposals(file.path)
    assert proposal.tests == ("X1", "X2", "Z")
    assert any("X1 and X2 apart" in question for question in proposal.asks)


@pytest.mark.parametrize(
    "content", ["target,direction,run,deviation,time\n0,+,1,2,0\n", "time,X1,load\n0,1,2\n", "time,a\n0,1\n"]
)
def test_a_file_of_something_else_is_not(file: File, content: str) -> None:
    file.path.write_text(content)
    assert list(file.source.proposals(file.path)) == []


def test_a_day_may_have_a_column_of_its_own(file: File) -> None:
    rows = "date,time,X1\n18.11.2026,23:00:00,1\n19.11.2026,01:00:00,2\n"
    np.testing.assert_allclose(file.read(rows, X1).target_positions, [0, 7200])


WITH_DAYS = (
    "Datum;Uhrzeit;Taster X1 (µm);Lufttemperatur;Luftfeuchte\n"
    "18.11.2026;08:00;12,42;20,3;41\n18.11.2026;09:00;13,00;20,9;42\n"
)
CLOCKED = "time,X1\n2026-11-18 08:10,1\n2026-11-18 08:40,2\n"


def test_loggers_that_know_the_time_of_day_count_from_one_moment(file: File) -> None:
    found = file.read(CLOCKED, X1, counted_from="2026-11-18 08:00")
    np.testing.assert_allclose(found.target_positions, [600, 2400])
    assert "counted from 2026-11-18 08:00" in said(found)[0]


def test_a_logger_of_seconds_may_have_been_started_later_than_the_test(file: File) -> None:
    found = file.read("time,X1\n0,1\n60,2\n", X1, later_by=90)
    np.testing.assert_allclose(found.target_positions, [90, 150])
    assert "90 s after the test began" in said(found)[0]


@pytest.mark.parametrize(
    ("content", "keys", "message"),
    [
        (CLOCKED, {"counted_from": "08:00"}, "no moment like the times of the file, '2026-11-18 08:10'"),
        (CLOCKED, {"counted_from": "2026-11-18T08:00+01:00"}, "no moment like the times of the file"),
        ("time,X1\n0,1\n60,2\n", {"counted_from": "2026-11-18 08:00"}, "or say 'later_by: 90'"),
        (CLOCKED, {"counted_from": "yesterday"}, "'yesterday' is no moment; 2026-11-18 08:00 is one"),
        (CLOCKED, {"counted_from": "2026-11-18 08:00", "later_by": 9}, "both say when the test began"),
    ],
)
def test_a_beginning_that_the_file_cannot_have_is_refused(
    file: File, content: str, keys: dict[str, object], message: str
) -> None:
    with pytest.raises((InputError, ValidationError), match=re.escape(message)):
        file.read(content, X1, **keys)


@pytest.mark.parametrize(
    ("content", "columns", "channels"),
    [
        ("time,X1\n0,1\n60,2\n", None, None),
        (
            WITH_DAYS,
            {"date": "Datum", "time": "Uhrzeit"},
            {"X1": "Taster X1", "air_temperature": "Lufttemperatur", "relative_humidity": "Luftfeuchte"},
        ),
        (
            "Zeit;Kanal;Messwert\n18.11.2026 08:00;X1 (µm);12,42\n18.11.2026 09:00;X1 (µm);13,0\n",
            {"time": "Zeit", "channel": "Kanal", "value": "Messwert"},
            None,
        ),
        ("Datum;Z (µm)\n18.11.2026 08:00;1,5\n18.11.2026 09:00;2,5\n", {"time": "Datum"}, None),
    ],
)
def test_a_logger_may_call_its_columns_in_german(
    file: File, content: str, columns: dict[str, str] | None, channels: dict[str, str] | None
) -> None:
    file.path.write_text(content, encoding="utf-8")
    (proposal,) = file.source.proposals(file.path)
    assert proposal.keys.get("columns") == columns
    assert proposal.keys.get("channels") == channels
    found = file.read(content, Axis(proposal.tests[0], quantity=DISPLACEMENT), **proposal.keys)
    assert np.isfinite(found.deviation).all()


def test_a_temperature_of_which_nobody_says_whose_it_is_is_asked(file: File) -> None:
    file.path.write_text("Zeit,X1,Temperatur\n0,1,20\n60,2,20\n", encoding="utf-8")
    (proposal,) = file.source.proposals(file.path)
    assert proposal.keys["channels"] == {"air_temperature": "Temperatur"}
    assert "Is 'Temperatur' the temperature of the air?" in proposal.asks[0]
