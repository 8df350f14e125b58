"""Logs of positioning tests with ecmc."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from plugins.sources.reading import DATA, MM, File, assert_same_readings, missing_in, said
from zlmreport.plugin import Approach, Axis, AxisKind

SPECIMEN = (DATA / "sources" / "ecmc_13e6c326.dat").read_bytes()
#: One cycle at two targets; the first line is 1, the last 8.
LOG = """\
CYCLES=1
POSITIONS=2
TGT_DATA[1]=-20
TGT_DATA[2]=20
REF_DATA_FWD[1,1]=-19.999
REF_DATA_FWD[2,1]=20.001
REF_DATA_BWD[1,1]=-20.001
REF_DATA_BWD[2,1]=19.999
"""
#: A deviation is the difference of two doubles near 20 mm, each half a unit in its last place off.
NOISE = 2 * np.spacing(20.0) * MM


@pytest.fixture
def file(tmp_path: Path) -> File:
    return File("ecmc", tmp_path / "x.dat")


def test_actual_positions_give_deviations_cycle_by_cycle(file: File) -> None:
    measurements = file.read(LOG)
    assert measurements.target_positions.tolist() == [-20 * MM, 20 * MM]
    assert measurements.target.tolist() == [0, 1, 1, 0]
    assert measurements.approach.tolist() == [1, 1, -1, -1]
    np.testing.assert_allclose(measurements.deviation, [1e-6, 1e-6, -1e-6, -1e-6], rtol=0.0, atol=NOISE)


def test_the_log_and_the_report_of_one_test_have_their_directions_exchanged(
    file: File, tmp_path: Path
) -> None:
    report = File("laser-csv", tmp_path / "x.csv").read((DATA / "published/ecmc_13e6c326.csv").read_bytes())
    log = file.read(SPECIMEN)
    np.testing.assert_allclose(log.deviations()[::-1], report.deviations(), rtol=0.0, atol=NOISE)
    assert_same_readings(file.read(SPECIMEN, exchange_directions=True), report, NOISE)


def test_an_exchange_of_directions_is_said(file: File) -> None:
    assert said(file.read(LOG, exchange_directions=True))[1] == (
        "The directions of approach were exchanged against the file (FWD read as ↓, BWD as ↑), as the job "
        "states."
    )


def test_keys_may_stand_in_any_order_with_blanks_around_and_comments(file: File) -> None:
    lines = LOG.splitlines()
    shuffled = "\n".join(
        f"  {line.replace('=', ' = ').replace('[', ' [ ').replace(',', ' , ')}  # x" for line in lines[::-1]
    )
    assert_same_readings(file.read(f"# a comment\n\n{shuffled}"), file.read(LOG))


def test_a_first_line_that_is_glued_to_a_comment_is_a_comment(file: File) -> None:
    assert_same_readings(file.read(f"TEST_DATA=# a log\n{LOG}"), file.read(LOG))
    assert file.complaint(f"{LOG}TEST_DATA=# a log\n").startswith(
        "x.dat:9:1: 'TEST_DATA' is no key of a log; "
    )


def test_names_of_signals_and_decimals_are_not_read(file: File) -> None:
    content = f"REF_PV=IOC:m1\nTEST_PV=IOC:m2\nTGT_SET_PV=IOC:m3.VAL\nDEC=five\n{LOG}"
    assert_same_readings(file.read(content), file.read(LOG))


@pytest.mark.parametrize(
    ("text", "millimetres"), [("-.0033", -0.0033), ("19.99999999999999999999", 20.0), ("-1e-05", -1e-05)]
)
def test_numbers_may_lack_the_zero_have_twenty_digits_or_an_exponent(
    file: File, text: str, millimetres: float
) -> None:
    log = f"CYCLES=1\nPOSITIONS=2\nTGT_DATA[1]=-100\nTGT_DATA[2]=0\nREF_DATA_FWD[2,1]={text}\n"
    assert file.read(log).deviations()[0, 1, 0] == millimetres / 1e3


def test_a_log_in_degrees_is_of_a_rotary_axis(file: File) -> None:
    rotary = Axis("C", AxisKind.ROTARY)
    assert file.read(f"UNIT=deg\n{LOG}", rotary).target_positions[1] == pytest.approx(math.pi / 9, rel=4e-16)
    assert file.complaint(f"UNIT=deg\n{LOG}").startswith(
        "x.dat:1:6: UNIT: 'deg' is no unit of this quantity; "
    )
    assert file.complaint(LOG, rotary).startswith("job.yaml:9:5: UNIT: 'mm' is no unit of this quantity; ")


def test_an_entry_that_is_empty_or_not_there_is_a_missing_reading(file: File) -> None:
    content = LOG.replace("REF_DATA_FWD[1,1]=-19.999", "REF_DATA_FWD[1,1]=").replace(
        "REF_DATA_BWD[2,1]=19.999\n", ""
    )
    assert missing_in(file.read(content)) == [
        (-20 * MM, Approach.POSITIVE, 1),
        (20 * MM, Approach.NEGATIVE, 1),
    ]


def test_a_direction_without_any_entry_was_not_measured(file: File) -> None:
    measurements = file.read("".join(line for line in LOG.splitlines(keepends=True) if "BWD" not in line))
    assert measurements.approaches == (Approach.POSITIVE,)
    assert measurements.missing() == ()


def test_cycles_that_were_announced_and_not_run_are_missing(file: File) -> None:
    assert len(file.read(LOG.replace("CYCLES=1", "CYCLES=3")).missing()) == 8


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        ("TGT_DATA[2]", "TGT_DTA[2]", "x.dat:4:1: 'TGT_DTA' is no key of a log; did you mean 'TGT_DATA'?"),
        ("TGT_DATA[2]=20", "TGT_DATA[2]", "x.dat:4:1: 'TGT_DATA[2]' is not of the form KEY=VALUE"),
        (
            "FWD[2,1]",
            "FWD[2]",
            "x.dat:6:1: 'REF_DATA_FWD[2]' is not of the form REF_DATA_FWD[position,cycle], counted from 1",
        ),
        (
            "FWD[2,1]",
            "FWD[0,1]",
            "x.dat:6:1: 'REF_DATA_FWD[0,1]' is not of the form REF_DATA_FWD[position,cycle]",
        ),
        ("FWD[2,1]", "FWD[2,2]", "x.dat:6:19: REF_DATA_FWD[2,2] is one too many: CYCLES is 1"),
        ("FWD[2,1]", "FWD[3,1]", "x.dat:6:19: REF_DATA_FWD[3,1] is one too many: POSITIONS is 2"),
        ("FWD[2,1]", "FWD[1,1]", "x.dat:6:1: REF_DATA_FWD[1,1] stands in line 5 already; keep one of them"),
        (
            "=20.001",
            "=20,001",
            "x.dat:6:19: REF_DATA_FWD[2,1]: '20,001' is no number with a decimal point; write '20.001'",
        ),
        ("=20.001", "=nan", "x.dat:6:19: REF_DATA_FWD[2,1]: 'nan' is no number; "),
        (
            "=20.001",
            "=1e9",
            "x.dat:6:19: the deviation, 9.9999998e+11 µm, is larger than the smallest target interval",
        ),
        ("TGT_DATA[2]=20\n", "", "x.dat:2:11: there is no TGT_DATA[2], and POSITIONS is 2"),
        (
            "POSITIONS=2\n",
            "",
            (
                "x.dat: there is no TGT_DATA[3], TGT_DATA[4], TGT_DATA[5], TGT_DATA[6], TGT_DATA[7] …, and "
                "POSITIONS is not stated, which in such a log means 8"
            ),
        ),
        ("CYCLES=1", "CYCLES=one", "x.dat:1:8: CYCLES is 'one'; a number of them belongs there"),
        (
            "CYCLES=1",
            "CYCLES=99999",
            "x.dat: holds 8 entries for 2 positions and 99,999 cycles; are POSITIONS and CYCLES right?",
        ),
    ],
)
def test_a_damaged_log_is_named_by_line_and_column(file: File, old: str, new: str, complaint: str) -> None:
    assert file.complaint(LOG.replace(old, new)).startswith(complaint)


def test_all_that_is_wrong_is_named_at_once(file: File) -> None:
    content = LOG.replace("-19.999", "x").replace("19.999", "y") + "ZZZ=1\n"
    assert [complaint.split(": ", 1)[0] for complaint in file.complaints(content)] == [
        "x.dat:5:19",
        "x.dat:8:19",
        "x.dat:9:1",
    ]


def test_what_is_no_log_is_asked_for(file: File) -> None:
    assert file.complaint("target,direction,run,deviation\n0,+,1,1\n") == (
        "x.dat: holds no entry such as 'TGT_DATA[1]=-20'; is it an ecmc log?"
    )
