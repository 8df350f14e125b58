"""The written files are read back as what was simulated."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from model.simulation.files import REGISTRY, SOUND, described, loaded, with_line
from zlmreport.model.simulation.files import write_job_text, write_readings_table
from zlmreport.model.simulation.simulate import simulate
from zlmreport.plugin import MeasurementSet, Place
from zlmreport.plugin.protocols import SourceContext

GAPS = with_line(11, "noise: {reading: 0.5, missing_share: 0.1}")


def _there_and_back(text: str, folder: Path) -> tuple[MeasurementSet, MeasurementSet]:
    """Return the simulated readings, and the same out of their file."""
    made = simulate(described(text, folder)).measurements
    path = folder / "readings.csv"
    path.write_text(write_readings_table(made, ["made up"]), encoding="utf-8")
    source = REGISTRY.source("laser-csv")
    options = source.options.model_validate({"file": path})
    return made, source.read(options, SourceContext(made.axis, Place("job.yaml")))


@pytest.mark.parametrize("text", [SOUND, GAPS], ids=["sound", "with gaps"])
def test_readings_come_back_to_the_digits_of_the_file(text: str, tmp_path: Path) -> None:
    made, read = _there_and_back(text, tmp_path)
    np.testing.assert_array_equal(read.target_positions, made.target_positions)
    for name in ("target", "approach", "run"):
        np.testing.assert_array_equal(getattr(read, name), getattr(made, name))
    np.testing.assert_allclose(read.deviation, made.deviation, atol=0.51e-9, rtol=0)
    assert made.time is not None
    assert read.time is not None
    np.testing.assert_allclose(read.time, made.time, atol=0.051, rtol=0)
    logged = "axis_temperature"
    np.testing.assert_allclose(read.conditions[logged], made.conditions[logged], atol=0.51e-4, rtol=0)


def test_a_missing_reading_is_an_empty_cell(tmp_path: Path) -> None:
    made, read = _there_and_back(GAPS, tmp_path)
    assert np.count_nonzero(np.isnan(read.deviation)) == np.count_nonzero(np.isnan(made.deviation)) > 0


def test_readings_without_times_have_no_column_of_times(tmp_path: Path) -> None:
    made, read = _there_and_back(SOUND + "time_logged: false\n", tmp_path)
    assert made.time is read.time is None


def test_the_head_of_the_table_says_where_it_comes_from(tmp_path: Path) -> None:
    made = simulate(described(SOUND, tmp_path)).measurements
    lines = write_readings_table(made, ["one", "two"]).splitlines()
    assert lines[:3] == ["# one", "# two", "target,direction,run,deviation,time,axis_temperature"]


def test_the_job_has_the_axis_of_the_simulation_and_a_model(tmp_path: Path) -> None:
    text = write_job_text(loaded(SOUND, tmp_path), tmp_path, "x.csv")
    assert "axis: {name: X, travel: [0, 600], screw_pitch: 10} # mm\n" in text
    assert "  source: {plugin: laser-csv, file: x.csv}\n" in text
    assert "  effects:\n    - offset\n    - scale-error\n    - backlash\n" in text


def test_the_job_has_the_model_that_the_simulation_states(tmp_path: Path) -> None:
    model = "model: {effects: [{polynomial: {order: 5}}, {backlash: {lost_motion: -2.5}}]}\n"
    text = write_job_text(loaded(SOUND + model, tmp_path), tmp_path, "x.csv")
    assert "    - {polynomial: {order: 5}}\n    - {backlash: {lost_motion: -2.5}}\n" in text


def test_tables_of_the_axis_are_named_from_the_folder_of_the_job(tmp_path: Path) -> None:
    (tmp_path / "comp.csv").write_text("position,deviation\n0,0\n600,5\n", encoding="utf-8")
    file = loaded(
        with_line(3, "axis: {name: X 1, travel: [0, 600], screw_pitch: 10, compensation_table: comp.csv}"),
        tmp_path,
    )
    text = write_job_text(file, tmp_path / "deep" / "below", "x.csv")
    assert "name: X 1," in text
    assert 'compensation_table: "../../comp.csv"' in text
