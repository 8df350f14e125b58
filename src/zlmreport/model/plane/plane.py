"""``zlmreport surface``: a plane from jobs, each a line; compared, reported as JSON."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from zlmreport.errors import InputError, Problem
from zlmreport.job.job import Job
from zlmreport.job.measurement_keys import LineOfPlane
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.model.diagnosis.report import report_error
from zlmreport.model.diagnosis.study import find_instrument_error
from zlmreport.model.effects.model_error import ModelError
from zlmreport.model.fitting.observations import make_observations_of
from zlmreport.model.plane.surface import (
    Surface,
    SurfaceLine,
    fit_surface,
    join_side_by_side,
    list_coefficient_names,
)

#: A job, and what it measured.
Measured = tuple[Job, MeasurementSet]

_KEY = "measurement.plane"
SCHEMA = "zlmreport/surface/1"


@dataclass(frozen=True, slots=True)
class Plane:
    """The deviation of an axis over a plane."""

    axis: Axis  #: The axis that was measured.
    second: str  #: Name of the second axis.
    lines: tuple[SurfaceLine, ...]  #: In rising order of the second axis.
    surfaces: tuple[Surface, ...]  #: One for each direction of approach.


def fit_plane(measured: Sequence[Measured]) -> Plane:
    """Fit the deviation over the plane that jobs have measured line by line.

    Raises `InputError` with every reason why the jobs are no lines of one plane.
    """
    places = _list_places([job for job, _ in measured])
    problems = list(_find_differences(measured, places))
    if problems:
        raise InputError(problems)
    (first, sample), second = measured[0], places[0].axis
    lines = tuple(
        sorted(
            (
                SurfaceLine(job.axis.position_unit.to_si(place.at), make_observations_of(measurements))
                for (job, measurements), place in zip(measured, places, strict=True)
            ),
            key=lambda line: line.across,
        )
    )
    length = float(np.ptp(sample.target_positions))
    try:
        surfaces = tuple(
            fit_surface(join_side_by_side(lines, approach, second), find_instrument_error(first, length))
            for approach in sample.approaches
        )
    except ModelError as error:
        raise InputError(Problem(first.place_of(_KEY), sentence) for sentence in error.sentences) from error
    return Plane(first.axis, second, lines, surfaces)


def _list_places(jobs: Sequence[Job]) -> list[LineOfPlane]:
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


def _find_differences(measured: Sequence[Measured], places: Sequence[LineOfPlane]) -> Iterator[Problem]:
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
        yield from _find_other_quantity(job, first)
        if place.axis != leading.axis:
            yield Problem(
                job.place_of(f"{_KEY}.axis"),
                f"the second axis is {place.axis} here and {leading.axis} in the first job",
            )
        if measurements.approaches != sample.approaches:
            yield Problem(
                job.source.place,
                f"this line was approached {_write_arrows(measurements)}, "
                f"the first one {_write_arrows(sample)}; all lines of a plane need the same directions",
            )
        if find_instrument_error(job, 1.0) != find_instrument_error(first, 1.0):
            yield Problem(
                job.place_of("instrument.expanded_uncertainty"),
                "the instrument's uncertainty is not that of the first job; one instrument measures a plane",
            )


def _find_other_quantity(job: Job, first: Job) -> Iterator[Problem]:
    """Yield in what a job measured something else than the first: machine, axis or error."""

    def refuse(key: str, what: str, own: str, of_first: str) -> Problem:
        return Problem(
            job.place_of(key),
            f"this line is of {what} {own}, the first one of {what} {of_first}; all lines of a plane are of "
            f"the same {what}",
        )

    machine, of_first = job.keys.machine, first.keys.machine
    if machine.is_other_than(of_first):
        yield refuse("machine.serial", "machine", machine.serial or "", of_first.serial or "")
    axes = [f"{each.axis.name} ({each.axis.kind})" for each in (job, first)]
    if axes[0] != axes[1]:
        yield refuse("axis.name", "axis", *axes)
    elif _find_error(job) != _find_error(first):
        yield refuse("measurement.error", "error", _find_error(job), _find_error(first))


def _find_error(job: Job) -> str:
    return job.axis.symbol or job.axis.measurand.identifier


def _write_arrows(measurements: MeasurementSet) -> str:
    return " and ".join(approach.arrow for approach in measurements.approaches)


def collect_plane(plane: Plane, points: Sequence[tuple[float, float]]) -> dict[str, Any]:
    """Return a plane as plain values for a JSON file.

    `points`: Where the deviation is asked for: P and R, m.
    """
    millimetre = plane.axis.position_unit
    return {
        "schema": SCHEMA,
        "axis": plane.axis.name,
        "second_axis": plane.second,
        "lines": [
            {
                "at": millimetre.from_si(line.across),
                "readings": len(line.observed.deviation),
                "set_aside": len(line.list_aside()),
            }
            for line in plane.lines
        ],
        "directions": [_collect_direction(each, plane.axis, points) for each in plane.surfaces],
    }


def _collect_direction(surface: Surface, axis: Axis, points: Sequence[tuple[float, float]]) -> dict[str, Any]:
    unit = axis.deviation_unit
    interaction = surface.interaction
    return {
        "direction": surface.approach.sign,
        "along": [axis.position_unit.from_si(end) for end in surface.along],
        "across": [axis.position_unit.from_si(end) for end in surface.across],
        "error": report_error(surface.error, axis),
        "missed": unit.from_si(surface.missed),
        **_collect_coefficients(surface, axis),
        "interaction": {
            "value": unit.from_si(interaction.value),
            "expanded_uncertainty": unit.from_si(interaction.expanded_uncertainty),
            "coverage_factor": interaction.coverage_factor,
            "unit": unit.ascii,
        },
        "points": _collect_points(surface, axis, points),
    }


def _collect_coefficients(surface: Surface, axis: Axis) -> dict[str, Any]:
    """Return the coefficients of equation (13) for positions in mm and deviations in µm."""
    found = surface.compute_coefficients().in_units(axis.position_unit, axis.deviation_unit)
    return {
        "coefficients": [
            {"name": name, "value": value, "unit": _write_unit(axis, sum(powers))}
            for name, value, powers in zip(
                list_coefficient_names(found.orders), found.values.tolist(), found.powers, strict=True
            )
        ],
        "covariance": found.covariance.tolist(),
    }


def _write_unit(axis: Axis, power: int) -> str:
    unit = axis.deviation_unit.ascii
    if power == 0:
        return unit
    return f"{unit}/{axis.position_unit.ascii}{power if power > 1 else ''}"


def _collect_points(
    surface: Surface, axis: Axis, points: Sequence[tuple[float, float]]
) -> list[dict[str, float]]:
    unit, millimetre = axis.deviation_unit, axis.position_unit
    found = surface.predict(points)
    return [
        {
            "along": millimetre.from_si(along),
            "across": millimetre.from_si(across),
            "deviation": unit.from_si(deviation),
            "expanded_uncertainty": unit.from_si(uncertainty),
            "coverage_factor": factor,
        }
        for (along, across), deviation, uncertainty, factor in zip(
            points,
            found.deviation.tolist(),
            found.expanded_uncertainty.tolist(),
            found.coverage_factor.tolist(),
            strict=True,
        )
    ]
