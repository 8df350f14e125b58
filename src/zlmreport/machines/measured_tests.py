"""Reads tests of a whole machine from their jobs: circles, and lines in other places."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from zlmreport import pipeline
from zlmreport.errors import InputError, quoted
from zlmreport.evaluation.evaluation import Evaluation
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.machines.axis_errors import find_error_of, find_line_of_job
from zlmreport.machines.course import CircularTest, StraightTest, ToolCourse
from zlmreport.machines.kinematics import SQUARENESS
from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.measurement.circle import NominalCircle
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.provenance import SourceFile
from zlmreport.model.effects.circle_design import AXES
from zlmreport.plugin.registry import Registry

#: Between two turns of a test, s, as long as nothing else is known.
_PAUSE = 5.0


@dataclass(frozen=True, slots=True)
class MeasuredCircle:
    """A circle with the job that measured it."""

    circle: CircularTest
    job: Job
    readings: MeasurementSet
    kept: IntArray  #: Which of the readings the circle has: those that are not missing.

    def evaluate(self, deviation: FloatArray, registry: Registry) -> tuple[Evaluation, ...]:
        """Evaluate other deviations at the same places, (N,), m, by the standards that the job names."""
        values = np.full(len(self.readings.deviation), np.nan)
        values[self.kept] = deviation
        return pipeline.evaluate_parameters(self.job, replace(self.readings, deviation=values), registry)


def read_test(path: Path, registry: Registry) -> tuple[MeasuredCircle | StraightTest, list[SourceFile]]:
    """Return a test of the whole machine, and the files that it came from.

    Raises `InputError` for a job that measured something else.
    """
    job = load(path, registry)
    measurements = pipeline.read(job, registry)
    files = [*job.files, *measurements.provenance.files]
    if job.axis.circle is not None:
        return read_measured_circle(path.stem, job, job.axis.circle, measurements), files
    return _read_line(path.stem, job, measurements), files


def read_measured_circle(
    name: str, job: Job, nominal: NominalCircle, measurements: MeasurementSet
) -> MeasuredCircle:
    """Return the circle that a job measured."""
    kept = np.flatnonzero(np.isfinite(measurements.deviation))
    bare = CircularTest(
        name,
        nominal,
        measurements.target_positions[measurements.target[kept]],
        measurements.approach[kept].astype(np.float64),
        measurements.run[kept],
        measurements.deviation[kept],
        np.zeros(len(kept)),
        find_line_of_job(job).tool,
    )
    logged = None if measurements.time is None else measurements.time[kept]
    circle = replace(bare, time=_reckon_times(bare) if logged is None or np.isnan(logged).any() else logged)
    return MeasuredCircle(circle, job, measurements, kept)


def _reckon_times(circle: CircularTest) -> FloatArray:
    """Return times by the feed, the turns in the order of their readings, one after the other."""
    time, begun = np.zeros(len(circle.angle)), 0.0
    for own in sorted(circle.list_turns(), key=lambda each: int(each[0])):
        travelled = np.abs(np.unwrap(circle.angle[own]) - circle.angle[own][0])
        time[own] = begun + travelled / circle.nominal.angular_speed
        begun = float(time[own].max()) + _PAUSE
    return time


def _read_line(name: str, job: Job, measurements: MeasurementSet) -> StraightTest:
    """Return a line in another place: the displacement that a job measured along it."""
    error = find_error_of(job)
    if error in SQUARENESS or error[1] not in AXES:
        raise InputError.at(
            job.place_of("measurement.error"),
            f"{quoted(error)} is an angle; a test of the machine is a displacement: a circle, a diagonal or "
            "a line. Name this job under errors",
        )
    found, sides = measurements.deviations(), measurements.approaches
    counts = np.sum(np.isfinite(found), axis=2)
    line, moving, sensed = find_line_of_job(job), AXES.index(error[2]), AXES.index(error[1])
    at = np.concatenate([measurements.target_positions for _ in sides])
    position = np.zeros((len(at), 3))
    for axis, place in line.others.items():
        position[:, AXES.index(axis)] = place
    position[:, moving] = at
    motion, sensing = np.zeros_like(position), np.zeros_like(position)
    motion[:, moving] = np.repeat([each.value for each in sides], len(measurements.target_positions))
    sensing[:, sensed] = 1.0
    n = np.concatenate([counts[each.index] for each in sides])
    values = np.concatenate([found[each.index] for each in sides])
    there = n > 0
    means = np.nanmean(values[there], axis=1)
    freedom = max(int(n.sum() - np.count_nonzero(there)), 1)
    squares = float(np.nansum((values[there] - means[:, np.newaxis]) ** 2))
    scatter = np.sqrt(squares / freedom / n[there])
    course = ToolCourse(position[there], sensing[there], motion[there], line.tool)
    return StraightTest(name, course, at[there], means, scatter)
