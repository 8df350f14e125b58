"""A plane as the values of `zlmreport surface --json`: full precision, millimetres and micrometres."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from zlmreport.measurement.axis import Axis
from zlmreport.model.report import report_error
from zlmreport.plane.plane import Plane
from zlmreport.plane.surface import Surface, coefficient_names

SCHEMA = "zlmreport/surface/1"


def report(plane: Plane, points: Sequence[tuple[float, float]]) -> dict[str, Any]:
    """Return a plane as plain values for a JSON file.

    Parameters
    ----------
    plane
        The plane.
    points
        Where the deviation is asked for: P and R, m.
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
                "set_aside": len(line.aside()),
            }
            for line in plane.lines
        ],
        "directions": [_direction(each, plane.axis, points) for each in plane.surfaces],
    }


def _direction(surface: Surface, axis: Axis, points: Sequence[tuple[float, float]]) -> dict[str, Any]:
    unit = axis.deviation_unit
    interaction = surface.interaction
    return {
        "direction": "+" if surface.approach > 0 else "-",
        "along": [axis.position_unit.from_si(end) for end in surface.along],
        "across": [axis.position_unit.from_si(end) for end in surface.across],
        "error": report_error(surface.error, axis),
        **_coefficients(surface, axis),
        "interaction": {
            "value": unit.from_si(interaction.value),
            "expanded_uncertainty": unit.from_si(interaction.expanded_uncertainty),
            "coverage_factor": interaction.coverage_factor,
            "unit": unit.ascii,
        },
        "points": _points(surface, axis, points),
    }


def _coefficients(surface: Surface, axis: Axis) -> dict[str, Any]:
    """Return the coefficients of equation (13) for positions in mm and deviations in µm."""
    found = surface.coefficients().in_units(axis.position_unit, axis.deviation_unit)
    return {
        "coefficients": [
            {"name": name, "value": value, "unit": _unit(axis, sum(powers))}
            for name, value, powers in zip(
                coefficient_names(found.orders), found.values.tolist(), found.powers, strict=True
            )
        ],
        "covariance": found.covariance.tolist(),
    }


def _unit(axis: Axis, power: int) -> str:
    unit = axis.deviation_unit.ascii
    if power == 0:
        return unit
    return f"{unit}/{axis.position_unit.ascii}{power if power > 1 else ''}"


def _points(surface: Surface, axis: Axis, points: Sequence[tuple[float, float]]) -> list[dict[str, float]]:
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
