"""A test for each installed standard, with the values that it gives, computed apart from the program."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from plugins.standards.oracle import evaluated_plainly
from plugins.standards.test_iso230_4 import circle_of_the_note
from zlmreport.measurement.measurement_set import join_lines
from zlmreport.plugin import CIRCLE, STRAIGHTNESS, Axis, MeasurementSet, NominalCircle, measurands_of
from zlmreport.plugin.protocols import Standard
from zlmreport.testing import WorkedExample, bidirectional_test

#: mm, and µm in a row for each target.
_TARGETS = [0, 100, 250, 400]
_UP = [[0.0, 1.5, 0.5], [3.0, 4.0, 3.6], [6.0, 6.2, 7.5], [8.0, 9.5, 8.2]]
_DOWN = [[-21.0, -20.0, -22.5], [-15.0, -16.2, -15.5], [-12.0, -12.4, -13.1], [-9.0, -9.6, -8.1]]
#: A line of 50 µm/m and deviations from it of 3 µm upwards, 4 µm downwards, 3.5 µm in the mean of all runs.
_SLOPE = np.array([0.0, 5.0, 10.0, 15.0])[:, np.newaxis]
_STRAIGHT_UP = _SLOPE + np.array([[-1, 1], [3, 3], [3, 3], [-1, 1]])
_STRAIGHT_DOWN = _SLOPE + np.array([[19, 21], [24, 24], [24, 24], [19, 21]])
_OUT_OF_SQUARE = math.degrees(2e-6) * 3600


def examples_of(standard: Standard) -> Sequence[WorkedExample]:
    """Return the worked examples of an installed standard."""
    if standard.identifier in _OF_LINES:
        return _OF_LINES[standard.identifier]()
    test = bidirectional_test(_TARGETS, _UP, _DOWN)
    if standard.identifier == "step-gauge":
        faces = bidirectional_test([0, 10, 20, 30], _FORWARD, _BACKWARD)
        return [WorkedExample(faces, _STEP_GAUGE)]
    found = evaluated_plainly(standard.identifier, _UP, _DOWN).parameters
    return [WorkedExample(test, {symbol: value for symbol, value in found.items() if value is not None})]


def _straightness() -> list[WorkedExample]:
    axis = Axis("X", quantity=STRAIGHTNESS, error="EYX")
    test = bidirectional_test([0, 100, 200, 300], _STRAIGHT_UP, _STRAIGHT_DOWN, axis=axis)
    unnamed = bidirectional_test(
        [0, 100, 200, 300], _STRAIGHT_UP, _STRAIGHT_DOWN, axis=Axis("X", quantity=STRAIGHTNESS)
    )
    values = {"": 3.5, "_fwd": 3.0, "_bwd": 4.0, "_run": 5.0, "_local": 1.75}
    keys = {"window": 200}
    return [
        WorkedExample(
            unnamed, {**{f"straightness{end}": each for end, each in values.items()}, "slope": 50.0}, keys
        ),
        WorkedExample(test, {**{f"EYX{end}": each for end, each in values.items()}, "slope": 50.0}, keys),
        WorkedExample(_square(), {"C0Y": 2 * -math.degrees(50e-6) * 3600, "slope_1": 50.0, "slope_2": 50.0}),
    ]


def _square() -> MeasurementSet:
    """Return two lines that both rise by 50 µm/m towards the other axis."""
    lines = {
        name: bidirectional_test(
            [0, 100, 200, 300],
            _STRAIGHT_UP,
            _STRAIGHT_DOWN,
            axis=Axis(name, quantity=STRAIGHTNESS, error=error),
        )
        for name, error in (("X", "EYX"), ("Y", "EXY"))
    }
    return join_lines(Axis("Y", quantity=measurands_of(_installed("iso230-1:2012"))[2], error="C0Y"), lines)


def _circle() -> list[WorkedExample]:
    """Return the reference case of ISO 230-4, derived with 3600 points a turn."""
    angles, (ccw, cw) = circle_of_the_note()
    axis = Axis("XY", quantity=CIRCLE, circle=NominalCircle("XY", 0.15, 1 / 60))
    test = bidirectional_test(np.degrees(angles), ccw[:, np.newaxis], cw[:, np.newaxis], axis=axis)
    values = {"G_ccw": 5.9825, "G_cw": 6.2626, "G_b": 6.2626, "D": 2.0}
    radial = {"F_max_ccw": 4.991, "F_min_ccw": -0.991, "F_max_cw": 5.131, "F_min_cw": -1.131}
    return [WorkedExample(test, {**values, **radial})]


def _diagonals() -> list[WorkedExample]:
    """Return lines that rise by 4 µm on 200 mm, with 14 µm of lost motion, each 10 % of that more."""
    (of,) = measurands_of(_installed("iso230-6:2002"))
    up, down = [[-1, 1], [1, 3], [3, 5]], [[-15, -13], [-13, -11], [-11, -9]]
    lines, values = {}, {"E_d": 1.3 * 18, "B_d": 1.3 * 14}
    for number, name in enumerate(of.test_names):
        factor = 1 + number / 10
        lines[name] = bidirectional_test(
            [0, 100, 200],
            factor * np.array(up),
            factor * np.array(down),
            axis=Axis(name, quantity=of.of_lines),
        )
        spans = {f"E_{name}": 18, f"E_{name}_fwd": 4, f"E_{name}_bwd": 4, f"B_{name}": 14}
        values |= {symbol: factor * each for symbol, each in spans.items()}
    # γ = ∓(ε1 − ε2)·d²/(2ab) of a face a × b whose diagonals differ by 2 µm/m; sides 500, 400, 300 mm.
    values["C0Y"] = _OUT_OF_SQUARE * 0.41 / 0.4
    values["B0Z"] = -_OUT_OF_SQUARE * 0.34 / 0.3
    values["A0Z"] = _OUT_OF_SQUARE * 0.25 / 0.24
    return [WorkedExample(join_lines(Axis("space", quantity=of), lines), values)]


def _drift() -> list[WorkedExample]:
    """Return sensors that drift by 4 µm in 24 hours, each 10 % of that more, two of them 200 mm apart."""
    (of,) = measurands_of(_installed("iso230-3"))
    lines, values = {}, {}
    hours = np.arange(25.0)
    for number, name in enumerate(of.test_names):
        factor = 1 + number / 10
        lines[name] = bidirectional_test(
            hours,
            factor * hours[:, np.newaxis] / 6,
            np.full((25, 1), math.nan),
            axis=Axis(name, quantity=of.of_lines),
        )
        values[f"E_{name}"] = factor * 4
    tilt = math.degrees(0.4e-6 / 0.2) * 3600
    values |= {f"tilt_{axis}": tilt for axis in "XYZ"}
    keys = {"distance": {"X": 200, "Y": 200, "Z": 200}}
    return [WorkedExample(join_lines(Axis("machine", quantity=of), lines), values, keys)]


def _plate() -> list[WorkedExample]:
    """Return a plate that is twisted by ±4 µm in its corners, with straight edges.

    Its centre lines begin and end at 0, and should be 0 in the middle, too: they rise to 3 and fall to −2 µm.
    """
    (of,) = measurands_of(_installed("union-jack"))
    micrometre = math.degrees(1e-6 / 0.1) * 3600
    rises = {
        "NW-SE": [3, 1, -1, -3],
        "NE-SW": [-3, -1, 1, 3],
        "NW-NE": [2, 2, 2, 2],
        "SW-SE": [-2, -2, -2, -2],
        "NW-SW": [2, 2, 2, 2],
        "NE-SE": [-2, -2, -2, -2],
        "W-E": [1.5, 1.5, -1.5, -1.5],
        "N-S": [-1, -1, 1, 1],
    }
    lines = {
        name: bidirectional_test(
            [100, 200, 300, 400],
            micrometre * np.array([[each + 29.5, each + 30.5] for each in of_line]),
            micrometre * np.array([[each - 30.5, each - 29.5] for each in of_line]),
            axis=Axis(name, quantity=of.of_lines),
        )
        for name, of_line in rises.items()
    }
    values = {"t": 8.0, "t_LS": 8.0, "t_MZ": 8.0, "closure_WE": 3.0, "closure_NS": -2.0}
    return [WorkedExample(join_lines(Axis("plate", quantity=of), lines), values)]


def _installed(identifier: str) -> Any:
    from zlmreport.plugin.registry import find_plugins

    return find_plugins().standard(identifier)


_OF_LINES = {
    "iso230-1:2012": _straightness,
    "iso230-4:2005": _circle,
    "iso230-6:2002": _diagonals,
    "iso230-3": _drift,
    "union-jack": _plate,
}
_NONE = [math.nan, math.nan]
#: Faces in turn, each probed from one side; between its neighbours the other side is interpolated.
_FORWARD = [[0.0, 2.0], _NONE, [4.0, 6.0], _NONE]
_BACKWARD = [_NONE, [-19.0, -19.0], _NONE, [-18.0, -14.0]]
_STEP_GAUGE: Mapping[str, float] = {
    "W": 24.0,
    "W_fwd": 4.0,
    "W_bwd": 3.0,
    "S2": 2 * math.sqrt(8),
    "S2_fwd": 2 * math.sqrt(2),
    "S2_bwd": 2 * math.sqrt(8),
    "XR": 22.5,
    "XR_mean": -22.25,
    "B_mean": 22.25,
}
