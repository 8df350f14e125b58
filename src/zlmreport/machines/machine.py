"""A machine: its chain of axes, its 21 errors, bounds of errors that nobody measured; its prediction."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from zlmreport.machines.course import ToolCourse
from zlmreport.machines.curve import AxisErrorCurve
from zlmreport.machines.kinematics import (
    ERRORS,
    ROTATIONS,
    SQUARENESS,
    TRANSLATIONS,
    Chain,
    ErrorLine,
    Point,
    find_direction_of_arm,
    weights,
)
from zlmreport.machines.square_lines import MovedSquare, SquareDoubt, list_square_doubts
from zlmreport.measurement.arrays import BoolArray, FloatArray
from zlmreport.measurement.units import ARCSECOND, MICROMETRE, Unit
from zlmreport.model.effects.circle_design import AXES

#: How large an error that nobody measured may be where the file states no bound: half-widths of a range, µm
#: over the travel or arc seconds. An assumption of this program, of the order of what machine tools have.
ASSUMED_BOUNDS: Mapping[str, float] = {"position": 10.0, "straightness": 5.0, "angle": 6.0, "squareness": 8.0}


def find_kind_of(error: str) -> str:
    """Return whether an error is one of position, straightness, angle or squareness."""
    if error in SQUARENESS:
        return "squareness"
    if error[1] in "ABC":
        return "angle"
    return "position" if error[1] == error[2] else "straightness"


def find_unit_of(error: str) -> Unit:
    """Return the unit in which an error is read and printed."""
    return ARCSECOND if find_kind_of(error) in {"angle", "squareness"} else MICROMETRE


@dataclass(frozen=True, slots=True)
class Unmeasured:
    """An error that nobody measured, with the bound within which it is taken to lie."""

    name: str
    bound: float  #: Half the width of its range, m or rad.
    is_assumed: bool  #: Whether this program assumed the bound, the file stating none.

    @property
    def variance(self) -> float:
        """Of what lies anywhere within the bound: bound²/3 (JCGM 100, 4.3.7), m² or rad²."""
        return self.bound**2 / 3.0


@dataclass(frozen=True, slots=True)
class MachineModel:
    """A machine as its file describes it."""

    chain: Chain
    tool: Point  #: The tool's offset, m.
    curves: tuple[AxisErrorCurve, ...]  #: What was measured or stated, in the order of `ERRORS`.
    unmeasured: tuple[Unmeasured, ...]  #: All others of the 21.
    #: Squareness errors among them that were measured elsewhere than the model has them.
    moved_squares: tuple[MovedSquare, ...] = ()

    def find_curve(self, name: str) -> AxisErrorCurve | None:
        """Return one of the errors; None if it was not measured."""
        return next((each for each in self.curves if each.name == name), None)

    @property
    def lines(self) -> Mapping[str, ErrorLine]:
        """Where each error was measured, by name."""
        return {each.name: each.line for each in self.curves}

    @property
    def lines_without_place(self) -> tuple[str, ...]:
        """Errors by name in which known angles show by arms of which nobody says where they begin."""
        return tuple(
            each.name
            for each in self.curves
            if each.name in TRANSLATIONS
            and any(
                each.name[1] == find_direction_of_arm(angle.name, axis)
                for angle in self.curves
                if angle.name in ROTATIONS and angle.axis == each.axis
                for axis in self.chain.list_axes_behind(each.axis)
                if axis not in each.line.others
            )
        )

    @property
    def square_doubts(self) -> tuple[SquareDoubt, ...]:
        """What angles that nobody measured leave open of the squareness errors."""
        bounds = {each.name: each.bound for each in self.unmeasured}
        return tuple(list_square_doubts(self.curves, bounds, self.chain))


@dataclass(frozen=True, slots=True)
class TestPrediction:
    """What the axes of a machine predict along a course."""

    values: FloatArray  #: The deviation in the sensing direction, shape (N,), m.
    #: Columns whose random combination is its error, shape (N, r): from the covariance of the errors that
    #: were measured.
    factor: FloatArray
    shares: Mapping[str, FloatArray]  #: What each error makes of it, by name, shape (N,).
    outside: BoolArray  #: Where an error that counts was asked for beyond its measured range, shape (N,).
    #: Standard deviation of what errors that nobody measured may add, shape (N,); each is taken as anywhere
    #: within its bound, independently.
    bound: FloatArray

    @property
    def standard_uncertainty(self) -> FloatArray:
        """Standard deviation of the values from the errors that were measured, (N,), m."""
        return np.asarray(np.sqrt(np.sum(self.factor**2, axis=1)), dtype=np.float64)

    @property
    def expanded_uncertainty(self) -> FloatArray:
        """U of the values from the errors that were measured, k = 2, shape (N,), m."""
        return 2.0 * self.standard_uncertainty


def predict(machine: MachineModel, course: ToolCourse) -> TestPrediction:
    """Return what the axes predict along a course, with its covariance."""
    count = len(course.position)
    tool = machine.tool if course.tool is None else course.tool
    values, outside = np.zeros(count), np.zeros(count, dtype=np.bool_)
    shares: dict[str, FloatArray] = {}
    factors: dict[str, FloatArray] = {}
    for curve in machine.curves:
        gain = _compute_gain(curve.name, machine, course, tool)
        if not np.any(gain):
            continue
        index = AXES.index(curve.axis)
        place = course.position[:, index]
        reading = curve.weigh_nodes(place, course.motion[:, index]) * gain[:, np.newaxis]
        shares[curve.name] = reading @ curve.values
        values = values + shares[curve.name]
        for name, columns in curve.columns.items():
            factors[name] = factors.get(name, 0.0) + reading @ columns
        outside |= curve.find_outside(place) & (np.abs(gain) > 0)
    bound = np.zeros(count)
    for each in machine.unmeasured:
        bound += each.variance * _compute_gain(each.name, machine, course, tool) ** 2
    return TestPrediction(
        values,
        _compress(np.concatenate([np.zeros((count, 0)), *factors.values()], axis=1)),
        MappingProxyType(shares),
        outside,
        np.sqrt(bound),
    )


def _compute_gain(
    name: str, machine: MachineModel, course: ToolCourse, tool: FloatArray | Point
) -> FloatArray:
    """Return what one unit of an error makes of the sensed deviation, shape (N,)."""
    moved = weights(name, machine.chain, machine.lines, course.position, tool)
    return np.asarray(np.sum(moved * course.sensing, axis=1), dtype=np.float64)


def _compress(factor: FloatArray) -> FloatArray:
    """Return a factor of fewer columns with the same covariance."""
    if factor.shape[1] < 2:
        return factor
    sizes, turn = np.linalg.eigh(factor.T @ factor)
    kept = sizes > 1e-12 * sizes[-1]
    return np.asarray(factor @ turn[:, kept], dtype=np.float64)


def list_missing_errors(
    curves: Mapping[str, AxisErrorCurve], stated: Mapping[str, float]
) -> tuple[Unmeasured, ...]:
    """Return the errors that nobody measured, each with its bound: as stated, in m or rad, or as assumed."""
    return tuple(
        Unmeasured(
            name,
            stated.get(name, float(find_unit_of(name).to_si(ASSUMED_BOUNDS[find_kind_of(name)]))),
            name not in stated,
        )
        for name in ERRORS
        if name not in curves
    )
