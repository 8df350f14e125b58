"""Slopes along the lines of a surface plate: stations, feet, the sense of readings, and what is left out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from environments import ROOT
from plugins.sources.reading import MM, File
from zlmreport.plugin import Axis
from zlmreport_plugins.union_jack_lines import LINE, LINES

ARCSECOND = np.pi / 180 / 3600
NW_SE = Axis("NW-SE", quantity=LINE)
PLATE = "line,station,reading\nNW-SE,1,3\nNW-SE,2,4\nNW-SE,3,6\nW-E,1,9\nW-E,2,8\n"


@pytest.fixture
def file(tmp_path: Path) -> File:
    return File("plate-csv", tmp_path / "plate.csv")


def test_a_station_is_where_the_front_foot_stands(file: File) -> None:
    found = file.read(PLATE, NW_SE, foot=101.6)
    np.testing.assert_allclose(found.target_positions, np.array([1, 2, 3]) * 101.6 * MM)
    np.testing.assert_allclose(found.deviation, np.array([3, 4, 6]) * ARCSECOND)
    assert found.approaches == (1,)


def test_readings_that_fall_as_the_front_foot_rises_are_turned(file: File) -> None:
    rising, falling = (file.read(PLATE, NW_SE, foot=100, falls=each) for each in (False, True))
    np.testing.assert_array_equal(falling.deviation, -rising.deviation)


def test_a_line_goes_by_its_points_whatever_parts_them(file: File) -> None:
    found = file.read(PLATE.replace("NW-SE", "nw – se"), NW_SE, foot=100)
    assert found.deviation.size == 3


def test_a_station_that_is_left_out_is_told_with_what_to_write(file: File) -> None:
    complaint = file.complaint(PLATE.replace("NW-SE,2,4\n", ""), NW_SE, foot=100)
    assert complaint.startswith("plate.csv:3:9: station 2 of the line is left out;")
    assert "an empty cell where a reading is missing" in complaint


@pytest.mark.parametrize(
    ("row", "complaint"),
    [
        (",2,4", "plate.csv:3:1: there is no line"),
        ("NW-SE,,4", "plate.csv:3:7: there is no station"),
        ("NW-SE,2,four", "plate.csv:3:9: 'four' stands where a number belongs"),
    ],
)
def test_a_row_that_is_not_whole_is_refused_with_its_place(file: File, row: str, complaint: str) -> None:
    assert file.complaints(PLATE.replace("NW-SE,2,4", row), NW_SE, foot=100)[0].startswith(complaint)


def test_a_station_without_a_reading_is_missing_and_not_left_out(file: File) -> None:
    found = file.read(PLATE.replace("NW-SE,2,4", "NW-SE,2,"), NW_SE, foot=100)
    assert len(found.missing()) == 1


@pytest.mark.parametrize("foot", [0.1, 4.9, 1016])
def test_feet_that_are_in_another_unit_are_told(file: File, foot: float) -> None:
    complaint = file.complaint(PLATE, NW_SE, foot=foot)
    assert f"the feet of a carriage are not {foot:g} mm apart; 'foot' is in millimetres" in complaint


@pytest.mark.parametrize("foot", [0, -100, "four inches"])
def test_feet_that_are_no_distance_are_refused(file: File, foot: object) -> None:
    with pytest.raises(ValueError, match="foot"):
        file.source.options.model_validate({"file": "plate.csv", "foot": foot})


def test_a_line_that_is_not_there_is_told_with_the_nearest(file: File) -> None:
    complaint = file.complaint(PLATE, Axis("NW-SW", quantity=LINE), foot=100)
    assert "there is no line 'NW-SW'" in complaint
    assert "NW-SE" in complaint


def test_a_job_on_something_else_is_told_how_lines_are_named(file: File) -> None:
    assert "name the lines as tests" in file.complaint(PLATE, Axis("X"), foot=100)


def test_the_lines_of_a_file_are_proposed_and_what_it_cannot_say_is_asked(file: File) -> None:
    (proposal,) = file.source.proposals(ROOT / "configs" / "flatness" / "plate.csv")
    assert set(proposal.tests) == set(LINES)
    assert proposal.keys == {"foot": 100}
    feet, sense = proposal.asks
    assert "How far apart are the feet" in feet
    assert "falls: true" in sense


def test_what_is_no_line_of_a_union_jack_is_asked(file: File) -> None:
    file.path.write_text(PLATE + "check,1,2\n")
    (proposal,) = file.source.proposals(file.path)
    assert proposal.tests == ("NW-SE", "W-E")
    assert "What is 'check'?" in proposal.asks[-1]


@pytest.mark.parametrize(
    "content",
    ["target,direction,run,deviation\n0,+,1,2\n", "line,station,reading\na,1,2\n", "line,reading\n"],
)
def test_a_file_of_something_else_is_not_proposed(file: File, content: str) -> None:
    file.path.write_text(content)
    assert list(file.source.proposals(file.path)) == []
