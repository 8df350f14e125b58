"""What the axes of a machine predict, and its tests, as plain values: mm, degrees, µm, arc seconds."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from zlmreport.machines.comparison import ComparedTest
from zlmreport.machines.course import CircularTest
from zlmreport.machines.kinematics import ERRORS
from zlmreport.machines.machine import MachineModel, find_unit_of
from zlmreport.machines.residual import Stretch
from zlmreport.machines.volume import Diagonal, VolumeMap, find_measured_space, map_volume, predict_diagonals
from zlmreport.model.effects.circle_design import AXES

SCHEMA = "zlmreport/prediction/1"
_MICRO, _MILLI = 1e6, 1e3
_SENSES = {1: "ccw", -1: "cw"}


def collect_prediction(machine: MachineModel, compared: Iterable[ComparedTest]) -> dict[str, Any]:
    """Return what the axes predict of each test, of the work space and of its diagonals."""
    space = find_measured_space(machine)
    return {
        "schema": SCHEMA,
        "chain": machine.chain.letters,
        "errors": collect_errors(machine),
        "tests": [collect_compared(each) for each in compared],
        "volume": collect_volume(map_volume(machine, space)) if space else None,
        "diagonals": [collect_diagonal(each) for each in predict_diagonals(machine, space)] if space else [],
    }


def collect_errors(machine: MachineModel) -> list[dict[str, Any]]:
    """Return the 21 errors: those that are known with their uncertainty, the others with their bounds."""
    unmeasured = {each.name: each for each in machine.unmeasured}
    found: list[dict[str, Any]] = []
    moved = {each.name: each for each in machine.moved_squares}
    for name in ERRORS:
        unit, curve = find_unit_of(name), machine.find_curve(name)
        if curve is None:
            missing = unmeasured[name]
            found.append(
                {
                    "error": name,
                    "known": False,
                    "bound": float(unit.from_si(missing.bound)),
                    "bound_is_assumed": missing.is_assumed,
                    "unit": unit.ascii,
                }
            )
            continue
        found.append(
            {
                "error": name,
                "known": True,
                "value": float(unit.from_si(curve.values[0] if curve.is_single else curve.span)),
                "expanded_uncertainty": float(unit.from_si(curve.largest_uncertainty)),
                "unit": unit.ascii,
                "range": None if curve.is_single else (curve.nodes[[0, -1]] * _MILLI).tolist(),
                "at": {axis: place * _MILLI for axis, place in curve.line.others.items()},
                "tool": [place * _MILLI for place in curve.line.tool or (0.0, 0.0, 0.0)],
                "source": curve.source or "stated",
                **({"as_measured": float(unit.from_si(moved[name].measured))} if name in moved else {}),
                **({"doubts": doubts} if (doubts := _collect_doubts(machine, name)) else {}),
            }
        )
    return found


def _collect_doubts(machine: MachineModel, name: str) -> list[dict[str, Any]]:
    """Return what angles that nobody measured leave open of a squareness error."""
    return [
        {
            "straightness": each.straightness,
            "not_measured": list(each.angles),
            "up_to": _MICRO * each.size,
            "unit": "um",
            "length": _MILLI * each.length,
        }
        for each in machine.square_doubts
        if each.name == name
    ]


def collect_compared(found: ComparedTest) -> dict[str, Any]:
    """Return a test with all its curves."""
    prediction, test = found.prediction, found.test
    if isinstance(test, CircularTest):
        nominal = test.nominal
        where: dict[str, Any] = {
            "kind": "circle",
            "plane": nominal.plane,
            "radius": nominal.radius * _MILLI,
            "feed": nominal.feed * _MILLI * 60.0,
            "at": np.degrees(test.angle).tolist(),
            "at_unit": "deg",
            "sense": [_SENSES[int(each)] for each in test.sense.tolist()],
            "run": test.run.tolist(),
        }
    else:
        where = {
            "kind": "line",
            "at": (test.at * _MILLI).tolist(),
            "at_unit": "mm",
            "direction": [int(each) for each in test.direction],
        }
    return {
        "test": found.name,
        **where,
        "predicted": (_MICRO * prediction.values).tolist(),
        "expanded_uncertainty": (_MICRO * prediction.expanded_uncertainty).tolist(),
        "not_measured": (_MICRO * 2.0 * prediction.bound).tolist(),
        "outside_measured_range": prediction.outside.tolist(),
        "measured": (_MICRO * test.deviation).tolist(),
        "residual": (_MICRO * found.left).tolist(),
        **collect_compared_sizes(found),
    }


def collect_compared_sizes(found: ComparedTest) -> dict[str, Any]:
    """Return how large a test is, without its curves."""
    return {
        "test": found.name,
        "rms_measured": _MICRO * found.rms.measured,
        "rms_predicted": _MICRO * found.rms.predicted,
        "rms_left": _MICRO * found.rms.left,
        "numbers": [
            {
                "standard": numbers.standard,
                "measured": {each.quantity.symbol: _MICRO * each.value for each in numbers.measured},
                "predicted": _write_in_micrometres(numbers.predicted),
                "left": _write_in_micrometres(numbers.left),
            }
            for numbers in found.numbers
        ],
        "of_axes": _write_in_micrometres(found.of_axes),
        "of_effects": _write_in_micrometres({effect.identifier: size for effect, size in found.of_effects}),
        "fails": [
            collect_stretch(each, is_circle=isinstance(found.test, CircularTest)) for each in found.fails
        ],
        "unit": "um",
    }


def _write_in_micrometres(values: Mapping[str, float]) -> dict[str, float]:
    return {name: _MICRO * value for name, value in values.items()}


def collect_stretch(stretch: Stretch, *, is_circle: bool) -> dict[str, Any]:
    """Return where a residual leaves its band: over the angle or the line, and on each axis that moves."""
    begin, end = (
        float(np.degrees(each)) if is_circle else each * _MILLI for each in (stretch.begin, stretch.end)
    )
    return {
        **({"sense": _SENSES[int(stretch.sense)]} if is_circle else {"direction": int(stretch.sense)}),
        "from": begin,
        "to": end,
        **{axis: [_MILLI * end for end in ends] for axis, ends in stretch.coordinates.items()},
        "largest": _MICRO * stretch.largest,
        "unit": "um",
    }


def collect_volume(found: VolumeMap) -> dict[str, Any]:
    """Return the map of the work space."""
    place = found.largest
    return {
        "from": dict(zip(AXES, (found.space.low * _MILLI).tolist(), strict=True)),
        "to": dict(zip(AXES, (found.space.high * _MILLI).tolist(), strict=True)),
        "largest": _MICRO * float(found.length[place]),
        "expanded_uncertainty": _MICRO * float(found.expanded_uncertainty[place]),
        "not_measured": _MICRO * 2.0 * float(found.bound[place]),
        "at": {
            axis: float(grid[index] * _MILLI)
            for axis, grid, index in zip(AXES, found.grids, place, strict=True)
        },
        "relative_to": dict(zip(AXES, (found.space.middle * _MILLI).tolist(), strict=True)),
        "grid": {axis: (grid * _MILLI).tolist() for axis, grid in zip(AXES, found.grids, strict=True)},
        "deviation": (_MICRO * found.deviation).tolist(),
        "unit": "um",
    }


def collect_diagonal(diagonal: Diagonal) -> dict[str, Any]:
    """Return what is predicted of a body diagonal."""
    return {
        "diagonal": diagonal.name,
        "at": (diagonal.at * _MILLI).tolist(),
        "predicted": (_MICRO * diagonal.deviation).tolist(),
        "expanded_uncertainty": (_MICRO * diagonal.expanded_uncertainty).tolist(),
        "E": _MICRO * diagonal.span,
        "unit": "um",
    }
