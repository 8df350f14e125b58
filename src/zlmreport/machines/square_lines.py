"""A squareness error where it was measured, and where the straightness errors of its two axes were.

A straightness error has no slope: what its axis leans is the squareness error's. But an axis that turns as it
moves leans otherwise at another tool, or where the other axes stand elsewhere. So a squareness error that was
measured there is that of the model only if what the known angles lean from one place to the other is taken
off: then the model is as square as was measured, at the very place where it was. What angles may lean that
nobody measured is a doubt with a size.

What is taken off is as uncertain as the angles, and correlated with them. With S as measured, ε the values of
an angle at its nodes and r the row by which they lean the axes there, the model has S' = S − r·ε, so that
cov(S', ε) = −r·cov(ε). Where Δ is g·ε + h·S' it is (g − h·r)·ε + h·S: an angle counts only with what it
leans between the two places. Where S was measured g leans by h·r, and the axes of the model are as surely
square as was measured there. So a moved error keeps −r·factor(ε), as columns of that angle.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from zlmreport.machines.curve import AxisErrorCurve
from zlmreport.machines.kinematics import (
    ROTATIONS,
    Chain,
    ErrorLine,
    find_square_slope,
    weights,
)
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.circle_design import AXES

#: A lean that is none: of a picometre over a metre, rad.
_NOTHING = 1e-12


@dataclass(frozen=True, slots=True)
class MovedSquare:
    """A squareness error that was measured elsewhere than the model has it."""

    name: str
    measured: float  #: Where it was measured, rad.
    angles: tuple[str, ...]  #: The known errors that lean its axes from there to the model's place.


@dataclass(frozen=True, slots=True)
class SquareDoubt:
    """What angles that nobody measured may lean between a squareness error's place and a straightness's."""

    name: str
    straightness: str
    angles: tuple[str, ...]
    size: float  #: At most, over the length, m.
    length: float  #: Of the straightness error's range, m.


def move_squares(
    curves: Iterable[AxisErrorCurve], chain: Chain
) -> tuple[tuple[AxisErrorCurve, ...], tuple[MovedSquare, ...]]:
    """Return errors with the squareness errors at the place of the model, and which of them were moved."""
    known = {each.name: each for each in curves}
    found: list[AxisErrorCurve] = []
    moved: list[MovedSquare] = []
    for curve in known.values():
        if not curve.is_single:
            found.append(curve)
            continue
        rows = list(_list_leans(curve, known, chain))
        value = curve.values - sum(row @ angle.values for angle, row in rows)
        borrowed = {angle.name: -(row @ angle.factor)[np.newaxis] for angle, row in rows}
        found.append(replace(curve, values=np.asarray(value), borrowed=borrowed))
        if abs(float(value[0] - curve.values[0])) > _NOTHING:
            names = tuple(angle.name for angle, _ in rows)
            moved.append(MovedSquare(curve.name, float(curve.values[0]), names))
    return tuple(found), tuple(moved)


def list_square_doubts(
    curves: Iterable[AxisErrorCurve], bounds: Mapping[str, float], chain: Chain
) -> Iterator[SquareDoubt]:
    """Yield what angles that nobody measured leave open of each squareness error.

    `bounds`: Of errors that nobody measured, half-widths of their ranges, rad.
    """
    known = {each.name: each for each in curves}
    for curve in known.values():
        for axis, direction, _ in _list_axes(curve.name) if curve.is_single else ():
            straightness = known.get(f"E{AXES[direction]}{axis}")
            if straightness is None:
                continue
            place = _find_place(curve, straightness)
            arms = {
                name: abs(float(_weigh(name, place, known, np.zeros(1), chain)[0, direction]))
                for name in ROTATIONS
                if name[2] == axis and name in bounds
            }
            size = sum(2.0 * bounds[name] * arm for name, arm in arms.items())
            names = tuple(name for name, arm in arms.items() if bounds[name] * arm > _NOTHING)
            if names:
                length = float(np.ptp(straightness.nodes))
                yield SquareDoubt(curve.name, straightness.name, names, size, length)


def _list_axes(name: str) -> Iterator[tuple[str, int, float]]:
    """Yield both axes of a squareness error: which, where it leans, and how the error grows with that."""
    leaning, along, sign = find_square_slope(name)
    yield along, AXES.index(leaning), sign
    yield leaning, AXES.index(along), sign


def _list_leans(
    square: AxisErrorCurve, known: Mapping[str, AxisErrorCurve], chain: Chain
) -> Iterator[tuple[AxisErrorCurve, FloatArray]]:
    """Yield the known angles that lean the model's axes at a squareness error's place.

    With each the row by which its nodes make that error there.
    """
    for axis, direction, sign in _list_axes(square.name):
        straightness = known.get(f"E{AXES[direction]}{axis}")
        place = _find_place(square, straightness)
        for name in ROTATIONS:
            angle = known.get(name)
            if angle is None or angle.axis != axis:
                continue
            nodes = angle.nodes if straightness is None else straightness.nodes
            gain = _weigh(name, place, known, nodes, chain)[:, direction]
            if not np.any(gain):
                continue
            off = nodes - nodes.mean()
            reading = angle.weigh_nodes(nodes, np.zeros(len(nodes))) * gain[:, np.newaxis]
            yield angle, sign * (off / np.sum(off**2)) @ reading


def _find_place(square: AxisErrorCurve, straightness: AxisErrorCurve | None) -> ErrorLine:
    """Return where the lean of an axis was measured: where nobody says it, as its straightness was."""
    if straightness is None:
        return square.line
    tool = straightness.line.tool if square.line.tool is None else square.line.tool
    return ErrorLine({**straightness.line.others, **square.line.others}, tool)


def _weigh(
    name: str, place: ErrorLine, known: Mapping[str, AxisErrorCurve], nodes: FloatArray, chain: Chain
) -> FloatArray:
    """Return what a unit of an angle makes of Δ along its axis at a place."""
    lines = {each.name: each.line for each in known.values()}
    places = np.tile([place.others.get(axis, 0.0) for axis in AXES], (len(nodes), 1))
    places[:, AXES.index(name[2])] = nodes
    return weights(name, chain, lines, places, place.tool or (0.0, 0.0, 0.0))
