"""A loaded job: SI inside, plugins chosen, and every key with its place."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from job.jobs import SOUND, loaded, mistakes, with_line, with_lines
from zlmreport.plugin import AxisKind


def test_lengths_become_metres(tmp_path: Path) -> None:
    line = "axis: {name: X, travel: [-20, 1e3], screw_pitch: 10, signal_period: 0.02, scale_element: 250}"
    axis = loaded(with_line(7, line), tmp_path).axis
    assert axis.travel == (-0.02, 1.0)
    assert (axis.screw_pitch, axis.signal_period, axis.scale_element) == (0.01, 0.02e-3, 0.25)


def test_angles_become_radians(tmp_path: Path) -> None:
    axis = loaded(with_line(7, "axis: {name: C, kind: rotary, travel: [0, 360]}"), tmp_path).axis
    assert axis.kind is AxisKind.ROTARY
    assert axis.travel is not None
    assert axis.travel[1] == pytest.approx(2 * math.pi, rel=1e-15)


def test_tolerance_is_micrometres_on_a_linear_axis(tmp_path: Path) -> None:
    (choice,) = loaded(
        with_line(14, "  - {standard: 'exemplary:1', tolerances: {E: 20}}"), tmp_path
    ).standards
    assert choice.tolerances == {"E": 20e-6}


def test_tolerance_is_arc_seconds_on_a_rotary_axis(tmp_path: Path) -> None:
    (choice,) = loaded(with_line(7, "axis: {name: C, kind: rotary}"), tmp_path).standards
    assert choice.tolerances["E"] == pytest.approx(20 * math.pi / 180 / 3600, rel=1e-15)


def test_standard_has_its_own_keys(tmp_path: Path) -> None:
    (choice,) = loaded(with_line(14, "  - {standard: 'exemplary:1', factor: 3}"), tmp_path).standards
    assert choice.options.factor == 3.0  # type: ignore[attr-defined]


def test_bare_identifier_is_a_standard_with_its_usual_keys(tmp_path: Path) -> None:
    (choice,) = loaded(with_line(14, "  - exemplary:1"), tmp_path).standards
    assert choice.identifier == "exemplary:1"
    assert choice.options.factor == 2.0  # type: ignore[attr-defined]
    assert choice.tolerances == {}


def test_bare_name_is_an_effect_with_all_its_parameters_free(tmp_path: Path) -> None:
    (choice,) = loaded(with_lines("model: {effects: [exemplary-wave]}"), tmp_path).effects
    assert (choice.identifier, choice.values) == ("exemplary-wave", {})


def test_effect_has_its_own_keys_and_the_parameters_that_are_fixed(tmp_path: Path) -> None:
    text = with_lines("model: {effects: [{exemplary-wave: {wavelength: 12.5, rectified: true}}]}")
    (choice,) = loaded(text, tmp_path).effects
    assert choice.values == {"wavelength": 12.5}
    assert choice.settings.rectified  # type: ignore[attr-defined]
    assert (choice.place.line, choice.place.column) == (16, 19)


def test_effect_whose_group_of_parameters_is_empty_fixes_none(tmp_path: Path) -> None:
    (choice,) = loaded(with_lines("model:", "  effects:", "  - exemplary-wave:"), tmp_path).effects
    assert choice.values == {}


def test_without_a_model_there_are_no_effects(tmp_path: Path) -> None:
    assert loaded(SOUND, tmp_path).effects == ()


def test_offset_from_the_scale_becomes_metres(tmp_path: Path) -> None:
    axis = loaded(with_line(7, "axis: {name: X, abbe_offset: -150}"), tmp_path).axis
    assert axis.abbe_offset == -0.15


def test_tables_of_the_axis_are_read_beside_the_file_that_names_them(tmp_path: Path) -> None:
    (tmp_path / "comp.csv").write_text("position,deviation\n0,0\n100,5\n", encoding="utf-8")
    (tmp_path / "yaw.csv").write_text("position,angle\n0,0\n100,20\n", encoding="utf-8")
    axis = loaded(
        with_line(7, "axis: {name: X, compensation_table: comp.csv, angular_errors: yaw.csv}"), tmp_path
    ).axis
    assert axis.compensation_table is not None
    assert axis.angular_errors is not None
    assert axis.compensation_table.values == (0.0, 5e-6)
    assert axis.angular_errors.values == (0.0, 20e-6)


def test_mistake_in_a_table_is_told_at_its_line(tmp_path: Path) -> None:
    (tmp_path / "comp.csv").write_text("position,deviation\n0,0\n100,five\n", encoding="utf-8")
    (message,) = mistakes(with_line(7, "axis: {name: X, compensation_table: comp.csv}"), tmp_path)
    assert message == "comp.csv:3:5: 'five' stands where a number belongs"


def test_files_go_beside_the_job_unless_it_says_otherwise(tmp_path: Path) -> None:
    assert loaded(with_line(15, "output: {formats: [exemplary]}"), tmp_path).directory == tmp_path


@pytest.mark.parametrize(
    ("key", "line", "column"),
    [
        ("certificate.number", 3, 11),
        ("certificate", 2, 1),
        ("certificate.issued", 2, 1),
        ("laboratory.name", 1, 1),
        ("axis.travel", 7, 31),
        ("axis.travel.1", 7, 43),
        ("measurement.source.file", 12, 11),
        ("evaluate.0.tolerances.E", 14, 47),
        ("evaluate.0.tolerances.A", 14, 31),
        ("evaluate.7", 13, 1),
    ],
)
def test_place_of_a_key_or_of_what_should_have_it(key: str, line: int, column: int, tmp_path: Path) -> None:
    place = loaded(with_line(14, "  - {standard: 'exemplary:1', tolerances: {E: 20}}"), tmp_path).place_of(
        key
    )
    assert (place.line, place.column) == (line, column)


def test_same_format_twice_is_written_once(tmp_path: Path) -> None:
    job = loaded(with_line(15, "output: {formats: [exemplary, exemplary]}"), tmp_path)
    assert job.formats == ("exemplary",)


def test_what_is_not_said_of_the_measurement_as_found_is_as_in_the_measurement(tmp_path: Path) -> None:
    stated = "  at: {Y: 100}\n  feed: 2000\n  warm_up: 1 h\n  remarks: Hot.\n  date: 2026-11-18\n"
    as_found = "as_found: {measurement: {feed: 500, source: {plugin: exemplary-text, file: six.txt}}}\n"
    job = loaded(SOUND.replace("  date: 2026-11-18\n", stated) + as_found, tmp_path).as_found
    assert job is not None
    measurement = job.keys.measurement
    assert (measurement.feed, measurement.warm_up, measurement.at) == (500, "1 h", {"Y": 100})
    assert job.axis.at == (("Y", 0.1),)
    assert (measurement.date, measurement.remarks) == (None, None)
