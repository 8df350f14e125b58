"""A circle in a job: it stands instead of an axis, and what speaks of targets does not go with it."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

from installed import registry
from job.jobs import make_editor
from refusals import mistakes
from zlmreport.job.loading import load
from zlmreport.plugin import CIRCLE

JOB = {
    "schema": "zlmreport/job/1",
    "certificate": {"number": "CAL-1", "kind": "report"},
    "circle": {"plane": "YZ", "radius": 150, "feed": 1000, "centre": [250, 200, 100]},
    "measurement": {"source": {"plugin": "circle-csv", "file": "circle.csv"}},
    "evaluate": ["iso230-4:2005"],
}


def loaded(folder: Path, **keys):
    path = folder / "job.yaml"
    job = {name: value for name, value in {**JOB, **keys}.items() if value is not None}
    path.write_text(yaml.safe_dump(job, sort_keys=False))
    return load(path, registry())


def test_its_plane_stands_for_the_axis(tmp_path: Path) -> None:
    job = loaded(tmp_path)
    circle = job.axis.circle
    assert circle is not None
    assert (job.axis.name, job.axis.measurand, circle.axes) == ("YZ", CIRCLE, ("Y", "Z"))
    assert circle.radius == pytest.approx(0.15)
    assert circle.feed == pytest.approx(1 / 60)
    assert circle.angular_speed == pytest.approx(1 / 9)
    assert circle.centre == pytest.approx((0.25, 0.2, 0.1))
    assert not circle.is_calibrated


def test_the_standard_gets_it_too(tmp_path: Path) -> None:
    job = loaded(tmp_path, circle={**JOB["circle"], "calibrated_length": True})
    assert job.standards[0].options.has_length


def test_without_a_plane_it_is_that_of_x_and_y(tmp_path: Path) -> None:
    assert loaded(tmp_path, circle={"radius": 100, "feed": 500}).axis.name == "XY"


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"axis": {"name": "X"}}, "axis: a circle stands instead of an axis; take one of the two out"),
        ({"circle": {"plane": "YX", "radius": 1, "feed": 1}}, "'YX' is unknown; known: XY, YZ, ZX"),
        ({"circle": {"plane": "XY", "raduis": 1, "feed": 1}}, "did you mean 'radius'?"),
        ({"circle": {"radius": -5, "feed": 1}}, "circle.radius"),
        ({"circle": {"radius": 5}}, "circle.feed is missing"),
        ({"evaluate": ["iso230-2:2014"]}, "this job is on a circle (circle: …); would fit: iso230-4:2005"),
        ({"circle": None, "axis": {"name": "X"}}, "circle: missing; say which circle was run"),
        ({"corrections": {"material": {}}}, "corrections: belongs to positioning"),
        ({"compensation": {"controller": "linuxcnc"}}, "compensation: belongs to positioning"),
        ({"model": {"effects": ["backlash"]}}, "backlash acts on positioning, straightness, not on circle"),
    ],
)
def test_what_does_not_go_with_it_is_refused(tmp_path: Path, keys, said: str) -> None:
    found = mistakes(tmp_path, loaded, tmp_path, **keys)
    assert any(said in each for each in found), found


def test_a_mistake_in_it_is_said_once(tmp_path: Path) -> None:
    (only,) = mistakes(tmp_path, loaded, tmp_path, circle={"radius": -5, "feed": 1})
    assert "circle.radius" in only


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        ("method", "linear", "measurement.method: a circle has no targets"),
        ("dwell", 5, "measurement.dwell: a circle has no targets"),
        ("feed", 2000, "measurement.feed: 2000 is not the feed of the circle (circle.feed: 1000)"),
        ("error", "EXX", "measurement.error: names the error of one axis"),
    ],
)
def test_keys_of_lines_are_refused(tmp_path: Path, key: str, value, said: str) -> None:
    found = mistakes(tmp_path, loaded, tmp_path, measurement={**JOB["measurement"], key: value})
    assert any(said in each for each in found), found


def test_the_schema_takes_a_circle_instead_of_an_axis_and_not_neither() -> None:
    editor = make_editor(registry())
    assert editor.is_valid(JOB)
    assert not editor.is_valid({key: value for key, value in JOB.items() if key != "circle"})
    assert not editor.is_valid({**JOB, "circle": {"plane": "XX", "radius": 1, "feed": 1}})
