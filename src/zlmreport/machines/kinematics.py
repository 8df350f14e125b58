"""What the errors of three linear axes do to the tool: one rule for every order of the axes.

Errors are taken as they are measured: tool relative to workpiece, on a line whose place is known. With the
errors E of each axis a there, the others at q_m and the tool at t_m, and its angles ε, which are the same on
every line::

    Δ = Σ_a [E_a + ε_a × L_a] + squareness,   L_a = (t − t_m) + Σ over axes b between a and the tool of
                                              (q_b − q_b,m)·e_b

"Between" reads along the letters of the chain, from workpiece to tool; the place of the bed, F, does not
matter, so that there are six orders and not 24 machines. A table that carries the workpiece fits the same
rule, since its errors are meant as those of the tool relative to the workpiece. The rule is of first order:
what it leaves out, ε·E and ε², is below a nanometre for errors of 15 µm and 60 µrad
(`tests/machines/test_kinematics.py` holds it against products of exact matrices).

Δ is actual − nominal of the tool relative to the workpiece. Angles are right-handed: C0Y > 0 turns the Y axis
towards −X, B0Z > 0 the Z axis towards +X, A0Z > 0 the Z axis towards −Y.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.circle_design import AXES

#: A point, or the tool's offset: X, Y, Z in m.
Point: TypeAlias = tuple[float, float, float]
_ORIGIN: Point = (0.0, 0.0, 0.0)

#: The names of the component errors by ISO 230-1: direction of the error, then axis that moves.
TRANSLATIONS = tuple(f"E{direction}{axis}" for axis in AXES for direction in AXES)
ROTATIONS = tuple(f"E{direction}{axis}" for axis in AXES for direction in "ABC")
COMPONENTS = (*TRANSLATIONS, *ROTATIONS)
SQUARENESS = ("C0Y", "B0Z", "A0Z")
#: All 21 errors of three linear axes, X being the primary axis and Y the secondary.
ERRORS = (*COMPONENTS, *SQUARENESS)
#: Of each squareness error, the direction in which Δ shows it and the axis that it grows along, with sign.
_SQUARE: Mapping[str, tuple[int, int, float]] = {"C0Y": (0, 1, -1.0), "B0Z": (0, 2, 1.0), "A0Z": (1, 2, -1.0)}


def find_square_slope(error: str) -> tuple[str, str, float]:
    """Return of a squareness error which axis is off along which, and how Δ grows with each rad of it."""
    direction, along, sign = _SQUARE[error]
    return AXES[direction], AXES[along], sign


def find_direction_of_arm(angle: str, axis: str) -> str:
    """Return in which direction an angle shows by an arm along an axis; empty where it turns about that."""
    left = set(AXES) - {axis, AXES["ABC".index(angle[1])]}
    return left.pop() if len(left) == 1 else ""


@dataclass(frozen=True, slots=True)
class Chain:
    """The order of the axes from workpiece to tool, with F for the bed: ``XYFZ``."""

    letters: str

    def __post_init__(self) -> None:
        """Refuse what is no order of three axes and a bed."""
        if sorted(self.letters) != ["F", *AXES]:
            raise ValueError(
                f"{self.letters[:20]!r} is no chain of X, Y, Z and the bed F, from workpiece to tool; "
                "a table in X on a saddle in Y with the column in Z is XYFZ"
            )

    @property
    def order(self) -> str:
        """The order of the axes alone."""
        return self.letters.replace("F", "")

    def list_axes_behind(self, axis: str) -> str:
        """Return the axes between one and the tool."""
        return self.order[self.order.index(axis) + 1 :]


@dataclass(frozen=True, slots=True)
class ErrorLine:
    """Where an error was measured: the others axes' positions, and the tool's offset there, m."""

    others: Mapping[str, float]  #: By axis; 0 for one that is not named.
    tool: Point | None = None  #: None where nobody says it: the point to which all axis errors refer.


def weights(
    error: str,
    chain: Chain,
    lines: Mapping[str, ErrorLine],
    position: FloatArray,
    tool: FloatArray | Point = _ORIGIN,
) -> FloatArray:
    """Return what one unit of an error (m or rad) makes of Δ at some positions, shape (N, 3).

    The error's own value there is the business of its curve; a squareness error has one value.

    `lines`: By name, where each error was measured that was. The arm of an angle counts from the line of the
        translation in which it shows, for that has what the angle makes there; where nobody measured it, from
        the angle's own, and else from the origin.
    `position`, (N, 3): x, y, z, m; `tool`, (3,) or (N, 3): the tool's offset, m.
    """
    found = np.zeros((len(position), 3))
    if error in _SQUARE:
        direction, along, sign = _SQUARE[error]
        found[:, direction] = sign * position[:, along]
        return found
    axis = error[2]
    if error[1] in AXES:
        found[:, AXES.index(error[1])] = 1.0
        return found
    turned = np.zeros(3)
    turned["ABC".index(error[1])] = 1.0
    for index, shown_in in enumerate(AXES):
        line = lines.get(f"E{shown_in}{axis}") or lines.get(error) or ErrorLine({})
        found[:, index] = np.cross(turned, lever_arm(axis, chain, line, position, tool))[:, index]
    return found


def lever_arm(
    axis: str, chain: Chain, line: ErrorLine, position: FloatArray, tool: FloatArray | Point = _ORIGIN
) -> FloatArray:
    """Return L, the arm by which the rotations of an axis act, shape (N, 3), m."""
    offset = np.asarray(tool, dtype=np.float64) - np.asarray(line.tool or _ORIGIN)
    arm = np.broadcast_to(offset, position.shape).copy()
    for other in chain.list_axes_behind(axis):
        index = AXES.index(other)
        arm[:, index] += position[:, index] - line.others.get(other, 0.0)
    return arm


def deviation(
    errors: Mapping[str, FloatArray | float],
    chain: Chain,
    position: FloatArray,
    tool: FloatArray | Point = _ORIGIN,
    lines: Mapping[str, ErrorLine] | None = None,
) -> FloatArray:
    """Return Δ at some positions, shape (N, 3), m.

    `errors`: By name, m or rad, the value of each at each position, shape (N,); those that are not there are
        zero.
    `lines`: Where each was measured; at the origin, with the tool's offset zero, where it does not say.
    """
    found = np.zeros((len(position), 3))
    for name, value in errors.items():
        found += weights(name, chain, lines or {}, position, tool) * np.reshape(value, (-1, 1))
    return found
