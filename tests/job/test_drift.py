"""A drift in a job: sensors as named tests, and nothing that speaks of lengths along an axis."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

from installed import registry
from job.jobs import make_editor
from refusals import mistakes
from zlmreport.job.loading import load
from zlmreport.plugin import DISPLACEMENT, Coordinate

SOURCE = {"source": {"plugin": "channels-csv", "file": "drift.csv"}}
JOB = {
    "schema": "zlmreport/job/1",
    "certificate": {"number": "CAL-1", "kind": "report"},
    "measurement": {"tests": {"X1": SOURCE, "X2": SOURCE}},
    "evaluate": [{"standard": "iso230-3", "hours": 4, "distance": {"X": 200}}],
}


def loaded(folder: Path, **keys):
    path = folder / "job.yaml"
    path.write_text(yaml.safe_dump({**JOB, **keys}, sort_keys=False))
    return load(path, registry())


def test_each_test_is_a_sensor_over_time(tmp_path: Path) -> None:
    job = loaded(tmp_path)
    assert job.axis.measurand.coordinate is Coordinate.TIME
    assert [(name, each.axis.name, each.axis.measurand) for name, each in job.tests.items()] == [
        ("X1", "X1", DISPLACEMENT),
        ("X2", "X2", DISPLACEMENT),
    ]


def test_an_editor_takes_it() -> None:
    assert make_editor(registry()).is_valid(JOB)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        (
            {"uncertainty": {"environmental_variation": 1}},
            "uncertainty.environmental_variation: is what this job measures",
        ),
        ({"uncertainty": {"misalignment": 1}}, "uncertainty.misalignment: belongs to a length along an axis"),
        (
            {"uncertainty": {"instrument_acts": "along-the-length"}},
            "along-the-length does not fit: time is no length",
        ),
        (
            {"uncertainty": {"contributions": [{"name": "Nest", "range": 1, "acts": "along-the-length"}]}},
            "along-the-length does not fit: time is no length",
        ),
        ({"corrections": {"material": {"expansion_coefficient": 11}}}, "corrections: belongs to positioning"),
        (
            {"measurement": {"tests": {"Q1": SOURCE}}},
            "measurement.tests.Q1: 'Q1' is none of the lines of drift",
        ),
        (
            {"axis": {"name": "X"}, "measurement": SOURCE},
            "measurement.tests: drift follows from several measured lines",
        ),
        ({"evaluate": [{"standard": "iso230-3", "hours": 0}]}, "evaluate.hours: '0' is not a number greater"),
        (
            {"evaluate": [{"standard": "iso230-3", "distance": {"X": -5}}]},
            "evaluate.distance.X: '-5' is not a number greater",
        ),
    ],
)
def test_what_does_not_go_with_a_drift_is_refused(keys: dict, message: str, tmp_path: Path) -> None:
    assert any(message in each for each in mistakes(tmp_path, loaded, tmp_path, **keys))
