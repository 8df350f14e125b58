"""Reads tests of a whole machine from their jobs: circles, and lines in other places."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from zlmreport import pipeline
from zlmreport.errors import InputError, quoted
from zlmreport.evaluation.evaluation import Evaluation
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.machines.axis_errors import find_error_of, find_line_of_job, find_line_of_test
from zlmreport.machines.course import CircularTest, StraightTest, ToolCourse
from zlmreport.machines.kinematics import SQUARENESS, ErrorLine, Point
from zlmreport.machines.volume import DIAGONALS
from zlmreport.measurement.arrays import FloatArray, IntArray
from zlmreport.measurement.circle import NominalCircle
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.provenance import SourceFile
from zlmreport.measurement.units import MILLIMETRE
from zlmreport.model.effects.circle_design import AXES
from zlmreport.plugin.registry import Registry

#: Diagonals of a face, by its axes and the signs of their directions.
_FACE_DIAGONALS = tuple(f"{axes}{signs}" for axes in ("XY", "XZ", "YZ") for signs in ("PP", "NP"))
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


def read_tests(
    path: Path, registry: Registry
) -> tuple[Sequence[MeasuredCircle | StraightTest], list[SourceFile]]:
    """Return the tests of the whole machine that a job measured, and the files that they came from.

    Raises `InputError` for a job that measured something else.
    """
    job = load(path, registry)
    measurements = pipeline.read(job, registry)
    files = [*job.files, *measurements.provenance.files]
    if job.axis.circle is not None:
        return [read_measured_circle(path.stem, job, job.axis.circle, measurements)], files
    if job.tests and {*job.tests} <= {*DIAGONALS, *_FACE_DIAGONALS}:
        return [
            _read_diagonal(f"{path.stem}-{name}", name, job, measurements.tests[name]) for name in job.tests
        ], files
    return [_read_line(path.stem, job, measurements)], files


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
    way, sensed = np.zeros(3), np.zeros(3)
    way[AXES.index(error[2])] = sensed[AXES.index(error[1])] = 1.0
    line = find_line_of_job(job)
    return _make_straight_test(name, measurements, _Way(_find_start(line), way, sensed, line.tool))


def _read_diagonal(name: str, diagonal: str, job: Job, measurements: MeasurementSet) -> StraightTest:
    """Return a diagonal as a line: its place counts from the corner in which it begins."""
    axes, signs = (diagonal[:2], diagonal[2:]) if diagonal in _FACE_DIAGONALS else ("XYZ", diagonal)
    space = next((each.options.axes for each in job.standards if hasattr(each.options, "axes")), None)
    line = find_line_of_test(job, diagonal)
    start, way = _find_start(line), np.zeros(3)
    for axis, sign in zip(axes, signs, strict=True):
        ends = getattr(space, axis, None)
        if ends is None:
            raise InputError.at(
                job.place_of(f"measurement.tests.{diagonal}"),
                f"where {diagonal} lies is not known: name from where to where {axis} moves, such as "
                f"axes: {{X: [0, 500], Y: [0, 400], Z: [0, 300]}}",
            )
        low, high = MILLIMETRE.to_si(ends[0]), MILLIMETRE.to_si(ends[1])
        start[AXES.index(axis)] = low if sign == "P" else high
        way[AXES.index(axis)] = high - low if sign == "P" else low - high
    way /= np.linalg.norm(way)
    return _make_straight_test(name, measurements, _Way(start, way, way, line.tool))


def _find_start(line: ErrorLine) -> FloatArray:
    """Return where the axes stand at the place 0 of a line, (3,), m."""
    return np.array([line.others.get(axis, 0.0) for axis in AXES])


class _Way(NamedTuple):
    """How a line lies in the machine."""

    start: FloatArray  #: Its place 0, (3,), m.
    along: FloatArray  #: Unit vector in which its places rise, (3,).
    sensed: FloatArray  #: Unit vector along which the deviation was sensed, (3,).
    tool: Point | None  #: The tool's offset, m; None for that of the machine.


def _make_straight_test(name: str, measurements: MeasurementSet, way: _Way) -> StraightTest:
    """Return the means of readings along a line."""
    found, sides = measurements.deviations(), measurements.approaches
    at = np.concatenate([measurements.target_positions for _ in sides])
    direction = np.repeat([float(each.value) for each in sides], len(measurements.target_positions))
    counts = np.sum(np.isfinite(found), axis=2)
    n = np.concatenate([counts[each.index] for each in sides])
    values = np.concatenate([found[each.index] for each in sides])
    there = n > 0
    means = np.nanmean(values[there], axis=1)
    freedom = max(int(n.sum() - np.count_nonzero(there)), 1)
    squares = float(np.nansum((values[there] - means[:, np.newaxis]) ** 2))
    scatter = np.sqrt(squares / freedom / n[there])
    at, direction = at[there], direction[there]
    course = ToolCourse(
        way.start + np.outer(at, way.along),
        np.tile(way.sensed, (len(at), 1)),
        np.outer(direction, np.sign(way.along)),
        way.tool,
    )
    return StraightTest(name, course, at, means, scatter, direction)
