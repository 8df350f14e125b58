"""A plane from jobs: each job measures one line of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from zlmreport.errors import InputError, Problem
from zlmreport.job.job import Job
from zlmreport.job.measurement_keys import LineOfPlane
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.axis_model import ModelError
from zlmreport.model.observations import observations_of
from zlmreport.model.study import instrument_error
from zlmreport.plane.lines import Line, side_by_side
from zlmreport.plane.surface import Surface, surface

#: A job, and what it measured.
Measured = tuple[Job, MeasurementSet]

_KEY = "measurement.plane"


@dataclass(frozen=True, slots=True)
class Plane:
    """The deviation of an axis over a plane.

    Attributes
    ----------
    axis
        The axis that was measured.
    second
        Name of the second axis.
    lines
        In rising order of the second axis.
    surfaces
        One for each direction of approach.
    """

    axis: Axis
    second: str
    lines: tuple[Line, ...]
    surfaces: tuple[Surface, ...]


def plane_of(measured: Sequence[Measured]) -> Plane:
    """Fit the deviation over the plane that jobs have measured line by line.

    Raises
    ------
    InputError
        With every reason why the jobs are no lines of one plane.
    """
    places = _places([job for job, _ in measured])
    problems = list(_differences(measured, places))
    if problems:
        raise InputError(problems)
    (first, sample), second = measured[0], places[0].axis
    lines = tuple(
        sorted(
            (
                Line(job.axis.position_unit.to_si(place.at), observations_of(measurements))
                for (job, measurements), place in zip(measured, places, strict=True)
            ),
            key=lambda line: line.across,
        )
    )
    try:
        surfaces = tuple(
            surface(side_by_side(lines, approach, second), instrument_error(first))
            for approach in sample.approaches
        )
    except ModelError as error:
        raise InputError(Problem(first.place_of(_KEY), sentence) for sentence in error.sentences) from error
    return Plane(first.axis, second, lines, surfaces)


def _places(jobs: Sequence[Job]) -> list[LineOfPlane]:
    """Return where the lines of jobs lie."""
    places = [job.keys.measurement.plane for job in jobs]
    problems = [
        Problem(
            job.place_of("measurement"),
            "the job does not say where its line lies in the plane; add to measurement, for a line at "
            "Y = 200 mm: plane: {axis: Y, at: 200}",
        )
        for job, place in zip(jobs, places, strict=True)
        if place is None
    ]
    if problems:
        raise InputError(problems)
    return [place for place in places if place is not None]


def _differences(measured: Sequence[Measured], places: Sequence[LineOfPlane]) -> Iterator[Problem]:
    """Yield why lines do not belong together."""
    (first, sample), leading = measured[0], places[0]
    if len({place.at for place in places}) < 2:
        yield Problem(
            first.place_of(_KEY), "a plane needs lines at two positions of the second axis at least"
        )
    if first.axis.kind is not AxisKind.LINEAR:
        yield Problem(first.place_of("axis.kind"), "a plane has two linear axes, and this axis is rotary")
    if leading.axis == first.axis.name:
        yield Problem(
            first.place_of(f"{_KEY}.axis"),
            f"{leading.axis} is the axis under test; name the other axis of the plane",
        )
    for (job, measurements), place in zip(measured[1:], places[1:], strict=True):
        if (job.axis.name, job.axis.kind) != (first.axis.name, first.axis.kind):
            yield Problem(
                job.place_of("axis.name"),
                f"this line is of axis {job.axis.name}, the first one of axis {first.axis.name}; "
                "all lines of a plane are of the same axis",
            )
        if place.axis != leading.axis:
            yield Problem(
                job.place_of(f"{_KEY}.axis"),
                f"the second axis is {place.axis} here and {leading.axis} in the first job",
            )
        if measurements.approaches != sample.approaches:
            yield Problem(
                job.source.place,
                f"this line was approached {_arrows(measurements)}, the first one {_arrows(sample)}; "
                "all lines of a plane need the same directions",
            )
        if instrument_error(job) != instrument_error(first):
            yield Problem(
                job.place_of("instrument.expanded_uncertainty"),
                "the instrument's uncertainty is not that of the first job; one instrument measures a plane",
            )


def _arrows(measurements: MeasurementSet) -> str:
    return " and ".join(approach.arrow for approach in measurements.approaches)
