"""Renishaw's linear and angular test files."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from pydantic import ValidationError

from installed import registry
from plugins.sources.reading import DATA, MM, File, assert_same_readings, missing_in, said
from zlmreport.plugin import Approach, Axis, AxisKind, Language

SPECIMEN = (DATA / "sources" / "bidirectional.rtl").read_bytes()
ROTARY = Axis("C", AxisKind.ROTARY)


@pytest.fixture
def file(tmp_path: Path) -> File:
    return File("renishaw-rtl", tmp_path / "x.rtl")


def specimen(deviations: str, *, targets: str = "0 100 200", kind: str = "rtl", more: str = "") -> str:
    """Return a smallest test file; the first deviation stands in line 10."""
    count = len(targets.split())
    return (
        f"HEADER::\nFile type : {kind}\n\nTARGET DATA::\nTarget-count: {count}\nTargets :\n{targets}\n"
        f"Flags: 0 0 2 0\nDEVIATIONS::\n{deviations}\n{more}EOF::\n"
    )


BIDIRECTIONAL = "1 1 1.0\n1 2 2.0\n1 3 3.0\n2 3 3.5\n2 2 2.5\n2 1 1.5"


def test_the_specimen_is_the_published_table(file: File, tmp_path: Path) -> None:
    table = File("laser-csv", tmp_path / "x.csv").read((DATA / "published/ecmc_13e6c326.csv").read_bytes())
    assert_same_readings(file.read(SPECIMEN), table)


def test_single_direction_runs_are_paired_to_cycles(file: File) -> None:
    runs = f"{BIDIRECTIONAL}\n3 1 1.1\n3 2 2.1\n3 3 3.1\n4 3 3.6\n4 2 2.6\n4 1 1.6"
    measurements = file.read(specimen(runs))
    assert measurements.run.tolist() == [1] * 6 + [2] * 6
    assert measurements.approach.tolist() == ([1] * 3 + [-1] * 3) * 2


def test_runs_of_a_unidirectional_test_are_counted_one_by_one(file: File) -> None:
    measurements = file.read(specimen("1 1 1\n1 2 2\n1 3 3\n2 1 1\n2 2 2\n2 3 3\n3 1 1\n3 2 2\n3 3 3"))
    assert measurements.approaches == (Approach.POSITIVE,)
    assert measurements.runs.tolist() == [1, 2, 3]


def test_the_direction_is_the_progression_of_targets_and_not_the_runs_parity(file: File) -> None:
    measurements = file.read(specimen("1 3 3\n1 2 2\n1 1 1\n2 1 1.5\n2 2 2.5\n2 3 3.5"))
    assert measurements.approach.tolist() == [-1, -1, -1, 1, 1, 1]


def test_the_direction_is_that_of_the_positions_where_targets_are_listed_falling(file: File) -> None:
    measurements = file.read(specimen(BIDIRECTIONAL, targets="200 100 0"))
    assert measurements.approach.tolist() == [-1, -1, -1, 1, 1, 1]
    assert measurements.target_positions[measurements.target[0]] == 200 * MM


def test_targets_go_by_their_number_and_not_by_the_line(file: File) -> None:
    measurements = file.read(specimen("1 1 1\n1 3 3\n2 3 3.5\n2 2 2.5\n2 1 1.5"))
    assert measurements.target.tolist() == [0, 1, 2, 2, 1, 0]
    assert missing_in(measurements) == [(100 * MM, Approach.POSITIVE, 1)]


def test_runs_may_be_interleaved(file: File) -> None:
    measurements = file.read(specimen("1 1 1\n2 3 3.5\n1 2 2\n2 2 2.5\n1 3 3\n2 1 1.5"))
    assert_same_readings(measurements, file.read(specimen(BIDIRECTIONAL)))


def test_keys_are_known_without_regard_to_case_and_blanks(file: File) -> None:
    content = specimen(BIDIRECTIONAL).replace("Targets :", "TARGETS:").replace("File type :", "filetype  :")
    assert_same_readings(file.read(content), file.read(specimen(BIDIRECTIONAL)))


def test_targets_may_begin_behind_their_key_and_wrap(file: File) -> None:
    content = specimen(BIDIRECTIONAL).replace("Targets :\n0 100 200", "Targets : 0\n100\n\n 200")
    assert_same_readings(file.read(content), file.read(specimen(BIDIRECTIONAL)))


@pytest.mark.parametrize("change", [("\r\n", "\n"), ("EOF::\r\n", "EOF::"), ("EOF::\r\n", "")])
def test_ends_of_lines_and_of_the_file_may_differ(file: File, change: tuple[str, str]) -> None:
    assert_same_readings(file.read(SPECIMEN.decode().replace(*change)), file.read(SPECIMEN))


def test_sections_that_hold_no_deviations_may_be_missing(file: File) -> None:
    content = "TARGET DATA::\nTargets :\n0 100\nDEVIATIONS::\nRun Target Data: \n1 1 1\n1 2 2"
    assert file.read(content).deviation.tolist() == [1 / 1e6, 2 / 1e6]


def test_an_encoding_may_be_stated(file: File) -> None:
    content = specimen(BIDIRECTIONAL, more="USER-TEXT::\nMachine:Fräse\n").encode("cp1252")
    assert file.complaint(content).startswith("x.rtl:17:11: byte 0xE4 is not UTF-8; ")
    assert "User’s text in the file: Machine:Fräse." in said(file.read(content, encoding="cp1252"))


def test_an_angular_file_is_in_milliradians_and_says_that_this_was_supposed(file: File) -> None:
    measurements = file.read(specimen("1 1 0.1\n1 2 0.2", targets="0 90", kind="rta"), ROTARY)
    assert measurements.target_positions[1] == pytest.approx(math.pi / 2, rel=4e-16)
    assert measurements.deviation.tolist() == [0.1 / 1e3, 0.2 / 1e3]
    assert said(measurements)[0] == (
        "The file does not name the unit of its deviations; they were read as mrad, which is usual in files "
        "of this kind (.rta)."
    )


def test_the_unit_of_deviations_may_be_stated(file: File) -> None:
    content = specimen("1 1 10\n1 2 20", targets="0 90", kind="rta")
    measurements = file.read(content, ROTARY, deviation_unit="arcsec")
    np.testing.assert_allclose(
        measurements.deviation, np.radians([10 / 3600, 20 / 3600]), rtol=4e-16, atol=0.0
    )
    assert said(measurements)[0] == (
        "The file does not name the unit of its deviations; they were read as ″, as the job states."
    )
    assert file.complaint(content, ROTARY, deviation_unit="um").startswith(
        "job.yaml:9:5: deviation_unit: 'um' is no unit of this quantity; "
    )


def test_a_unit_that_there_is_not_is_refused_with_the_job() -> None:
    with pytest.raises(ValidationError, match="'furlong' is no unit of this quantity"):
        registry().source("renishaw-rtl").options.model_validate(
            {"file": "x.rtl", "deviation_unit": "furlong"}
        )


@pytest.mark.parametrize(
    ("kind", "axis", "complaint"),
    [
        (
            "rta",
            Axis("X"),
            (
                "x.rtl:2:1: the file is of type rta, and the axis is linear (axis.kind): angular deviations "
                "of a linear axis are pitch, yaw or roll, and no positioning test"
            ),
        ),
        (
            "rtl",
            ROTARY,
            (
                "x.rtl:2:1: the file is of type rtl, and the axis is rotary (axis.kind): the linear test of "
                "a rotary axis is none of its angular positions"
            ),
        ),
        (
            "rtx",
            Axis("X"),
            "x.rtl:2:1: the file is of type 'rtx'; linear (rtl) and angular (rta) tests are read",
        ),
    ],
)
def test_the_kind_of_file_is_that_of_the_axis(file: File, kind: str, axis: Axis, complaint: str) -> None:
    assert file.complaint(specimen(BIDIRECTIONAL, kind=kind), axis) == complaint


def test_without_a_header_the_suffix_tells_the_kind(tmp_path: Path) -> None:
    file = File("renishaw-rtl", tmp_path / "x.RTA")
    content = "TARGET DATA::\nTargets :\n0 100\nDEVIATIONS::\n1 1 1\n1 2 2"
    assert file.complaint(content).startswith("x.RTA: the file is of type rta, and the axis is linear")
    assert file.read(content, ROTARY).deviation.tolist() == [1 / 1e3, 2 / 1e3]


def test_reverse_runs_that_a_program_padded_with_zeros_are_refused_by_name(file: File) -> None:
    runs = "1 1 1\n1 2 2\n1 3 3\n2 3 0.0\n2 2 0.0\n2 1 0.0"
    assert file.complaint(specimen(runs)) == (
        "x.rtl:13:5: run 2: all 3 deviations are exactly zero; some programs pad the reverse runs that a "
        "unidirectional test does not have. Remove the lines of this run, and correct 'Run-count'"
    )


@pytest.mark.parametrize(
    ("deviations", "complaint"),
    [
        ("1 1 1\n1 2 x", "x.rtl:11:5: deviation: 'x' stands where a number belongs"),
        (
            "1 1 1\n1 2 inf",
            "x.rtl:11:5: deviation: 'inf' is infinite, and no reading is; a missing reading is an empty cell",
        ),
        ("1 1 1\n1 2 2\n1 4 4", "x.rtl:12:3: there is no target 4; the file lists 3 targets"),
        ("1 1 1\n1 2 2\n1 0 4", "x.rtl:12:3: '0' is no number of a target; they count from 1"),
        ("1 1 1\n1 2 2\n-1 3 4", "x.rtl:12:1: '-1' is no number of a run; they count from 1"),
        (
            "1 1 1\n1 2 2\n1 3",
            "x.rtl:12:1: '1 3' is no deviation line, which has a run, a target and a deviation",
        ),
        ("1 1 1", "x.rtl:10:5: run 1 has readings at one target only; its direction cannot be told"),
        (
            "1 1 1\n1 3 3\n1 2 2",
            (
                "x.rtl:10:5: run 1 goes from target to target in both directions; a run goes in one, and "
                "which of them cannot be told"
            ),
        ),
        (
            "1 1 1\n1 2 2\n1 2 2.5",
            (
                "x.rtl:12:5: target 100 mm ↑, run 1, stands in line 11 already; "
                "a repeated run has a number of its own"
            ),
        ),
        (
            "1 1 1\n1 2 2e6",
            (
                "x.rtl:11:5: the deviation, 2000000 µm, is larger than the smallest target interval, 100 mm; "
                "is it a position given as deviation, or a wrong unit?"
            ),
        ),
        ("Run Target Data:", "x.rtl: holds no readings"),
    ],
)
def test_a_damaged_deviation_is_named_by_line_and_column(file: File, deviations: str, complaint: str) -> None:
    assert file.complaint(specimen(deviations)) == complaint


@pytest.mark.parametrize(("announced", "said"), [(10, "10 runs"), (1, "1 run")])
def test_a_file_that_was_cut_off_has_not_the_runs_that_it_announces(
    file: File, announced: int, said: str
) -> None:
    content = specimen(BIDIRECTIONAL).replace("DEVIATIONS::", f"RUNS::\nRun-count:{announced}\nDEVIATIONS::")
    assert file.complaint(content) == (
        f"x.rtl:10:1: the file announces {said} and has readings of 2; was it cut off?"
    )


def test_a_file_of_many_targets_and_runs_and_hardly_any_readings_is_refused(file: File) -> None:
    targets = " ".join(str(10 * number) for number in range(1000))
    runs = "\n".join(f"{run} 1 1\n{run} 2 2" for run in range(1, 501))
    assert file.complaint(specimen(runs, targets=targets)) == (
        "x.rtl: has 1,000 targets and 500 runs, and only 1,000 readings"
    )


@pytest.mark.parametrize(
    ("old", "new", "complaint"),
    [
        ("0 100 200", "0 100", "x.rtl:5:1: the file announces 3 targets and lists 2; was it cut off?"),
        ("0 100 200", "0 1OO 200", "x.rtl:7:3: target position: '1OO' stands where a number belongs"),
        ("count: 3", "count: three", "x.rtl:5:1: Target-count is 'three'; a number belongs there"),
        ("Target-count: 3\nTargets :\n0 100 200\n", "Targets :\n", "x.rtl:5:1: no target positions follow"),
        ("Targets :", "Tagets :", "x.rtl:4:1: this section has no key 'Targets :', so no target positions"),
        ("DEVIATIONS::", "DEVIATION::", "x.rtl: has no section DEVIATIONS::; did you mean 'DEVIATION'?"),
        ("HEADER::", "Header", "x.rtl:1:1: 'Header' stands before the first section; "),
        ("EOF::", "HEADER::", "x.rtl:16:1: the section HEADER:: begins in line 1 already"),
    ],
)
def test_a_damaged_section_is_named(file: File, old: str, new: str, complaint: str) -> None:
    assert file.complaint(specimen(BIDIRECTIONAL).replace(old, new)).startswith(complaint)


def test_what_the_file_says_of_the_test_is_kept(file: File) -> None:
    assert said(file.read(SPECIMEN))[1:-1] == [
        "Header of the file: File type : rtl; Owner : Linear; Version no : V20.02.02.",
        (
            "User’s text in the file: Machine:ASSEMBLED SPECIMEN - not written by Renishaw software; "
            "Date:2022-04-07 09:50:57; Axis:Y; TITLE:b02 y axis (ESS target), deviations from ecmc report."
        ),
        "Air temperature: 20.3373 °C at the start, 20.385 °C at the end of the test.",
        "Air pressure: 99.039 kPa at the start, 99.0493 kPa at the end of the test.",
        "Relative humidity: 46.9549 % at the start, 46.8939 % at the end of the test.",
        "Material temperature 1: 20.2033 °C at the start, 20.3213 °C at the end of the test.",
        "Environmental factor: 0.316411 at the start, 0.316411 at the end of the test.",
        "Expansion coefficient: 8 ppm/°C at the start, 8 ppm/°C at the end of the test.",
        'Date Time: "10:46 Dec 12 2016" "11:01 Dec 12 2016".',
    ]


def test_equipment_is_kept_and_an_unknown_unit_is_not_guessed(file: File) -> None:
    more = "EQUIPMENT::\nLaser : 12A345\nENVIRONMENT::\nAir temp : 68.1 68.2 1\n"
    assert said(file.read(specimen(BIDIRECTIONAL, more=more)))[2:-1] == [
        "Equipment named in the file: Laser : 12A345.",
        "Air temperature: 68.1 (unit 1) at the start, 68.2 (unit 1) at the end of the test.",
    ]


def test_a_condition_that_is_no_number_is_named(file: File) -> None:
    content = specimen(BIDIRECTIONAL, more="ENVIRONMENT::\nAir temp : warm 20 0\n")
    assert file.complaint(content) == "x.rtl:17:1: Air temp: 'warm' stands where a number belongs"


def test_lines_of_the_file_are_parted_as_each_language_parts_them(file: File) -> None:
    measurements = file.read(specimen(BIDIRECTIONAL, more="USER-TEXT::\nMachine 7\nHall 3\n"))
    (remark,) = (
        each for each in measurements.provenance.remarks if each.en.startswith("User’s text in the file")
    )
    assert remark.in_language(Language.ENGLISH).endswith(": Machine 7; Hall 3.")
    assert remark.in_language(Language.FRENCH).endswith(
        "\N{NO-BREAK SPACE}: Machine 7\N{NO-BREAK SPACE}; Hall 3."
    )
