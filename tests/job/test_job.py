"""A loaded job: SI inside, plugins chosen, and every key with its place."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from job.jobs import loaded, with_line
from zlmreport.measurement.axis import AxisKind


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
