"""What the measured errors make of the work space: its largest error on a grid, and its diagonals.

Δ is taken relative to the middle of the space, since no error of an axis has a zero of its own. The space is
what was measured: the overlap of the ranges of each axis' errors; nothing is extrapolated.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from zlmreport.machines.kinematics import SQUARENESS, weights
from zlmreport.machines.machine import MachineModel
from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.circle_design import AXES

#: Points of the map along each axis.
_POINTS = 11
_ON_A_DIAGONAL = 21
#: The body diagonals by the signs of their directions, as ISO 230-6 has them.
DIAGONALS = ("PPP", "NPP", "PNP", "NNP")


@dataclass(frozen=True, slots=True)
class Space:
    """A box of the machine."""

    low: FloatArray  #: (3,): m.
    high: FloatArray  #: (3,): m.

    @property
    def middle(self) -> FloatArray:
        """Its centre, (3,), m."""
        return (self.low + self.high) / 2.0


@dataclass(frozen=True, slots=True)
class VolumeMap:
    """The error over a grid of the work space, relative to its middle."""

    space: Space
    grids: tuple[FloatArray, FloatArray, FloatArray]  #: Positions along each axis, m.
    deviation: FloatArray  #: (nx, ny, nz, 3): Δ, m.
    #: (nx, ny, nz): U of its length, k = 2, from the errors that were measured.
    expanded_uncertainty: FloatArray
    bound: FloatArray  #: (nx, ny, nz): Standard deviation of what nobody measured, m.

    @property
    def length(self) -> FloatArray:
        """The length of Δ, (nx, ny, nz), m."""
        return np.asarray(np.linalg.norm(self.deviation, axis=-1), dtype=np.float64)

    @property
    def largest(self) -> tuple[int, int, int]:
        """Where Δ is longest."""
        first, second, third = np.unravel_index(int(np.argmax(self.length)), self.length.shape)
        return int(first), int(second), int(third)


@dataclass(frozen=True, slots=True)
class Diagonal:
    """What the errors predict of a body diagonal, as a laser along it would read."""

    name: str
    at: FloatArray  #: (n,): Distance from its beginning, m.
    deviation: FloatArray  #: (n,): m.
    expanded_uncertainty: FloatArray  #: (n,): k = 2, m.

    @property
    def span(self) -> float:
        """The largest minus the smallest deviation, m."""
        return float(np.ptp(self.deviation))


def find_measured_space(machine: MachineModel) -> Space | None:
    """Return the box over which the errors of the axes were measured; None if no axis was."""
    low, high = np.array([find_measured_range(machine, axis) for axis in AXES]).T
    return Space(low, high) if np.any(high > low) and np.all(high >= low) else None


def find_measured_range(machine: MachineModel, axis: str) -> tuple[float, float]:
    """Return from where to where all errors of an axis were measured, m.

    The end lies below the beginning where their ranges do not overlap. Where none was measured it is one
    place: 0, or where the axis stood.
    """
    own = [each for each in machine.curves if each.axis == axis and not each.is_single]
    if own:
        return max(float(each.nodes[0]) for each in own), min(float(each.nodes[-1]) for each in own)
    place = next((each.line.others[axis] for each in machine.curves if axis in each.line.others), 0.0)
    return place, place


def is_parted(machine: MachineModel, axis: str) -> bool:
    """Return whether no place of an axis lies within the ranges of all its errors."""
    low, high = find_measured_range(machine, axis)
    return high < low


def map_volume(machine: MachineModel, space: Space) -> VolumeMap:
    """Return the error over the work space."""
    grids = [
        np.linspace(low, high, _POINTS) if high > low else np.array([low])
        for low, high in zip(space.low, space.high, strict=True)
    ]
    points = np.array(list(product(*grids)))
    values, factor, bound = _compute_relative(machine, points, space.middle)
    shape = tuple(len(grid) for grid in grids)
    length = np.linalg.norm(values, axis=1)
    # U of the length of Δ: along Δ; where Δ is nothing, the largest of any direction.
    along = values / np.where(length > 0, length, 1.0)[:, np.newaxis]
    u = np.sqrt(np.sum(np.einsum("nd,ndr->nr", along, factor) ** 2, axis=1))
    widest = np.sqrt(np.sum(factor**2, axis=2)).max(axis=1)
    expanded = 2.0 * np.where(length > 0, u, widest)
    return VolumeMap(
        space,
        (grids[0], grids[1], grids[2]),
        values.reshape(*shape, 3),
        expanded.reshape(shape),
        bound.reshape(shape),
    )


def predict_diagonals(machine: MachineModel, space: Space) -> tuple[Diagonal, ...]:
    """Return what the errors predict of the four body diagonals."""
    found = []
    for name in DIAGONALS:
        forward = np.array([letter == "P" for letter in name])
        begin = np.where(forward, space.low, space.high)
        end = np.where(forward, space.high, space.low)
        way = end - begin
        length = float(np.linalg.norm(way))
        share = np.linspace(0.0, 1.0, _ON_A_DIAGONAL)
        values, factor, _ = _compute_relative(machine, begin + share[:, np.newaxis] * way, begin)
        sensed = np.einsum("ndr,d->nr", factor, way / length)
        found.append(
            Diagonal(name, share * length, values @ way / length, 2.0 * np.sqrt(np.sum(sensed**2, axis=1)))
        )
    return tuple(found)


def _compute_relative(
    machine: MachineModel, points: FloatArray, origin: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return Δ relative to a point, (N, 3), its factor, (N, 3, r), and u of what nobody measured, (N,)."""
    together = np.concatenate([points, origin[np.newaxis]])
    rest = np.zeros(len(together))
    values, factors = np.zeros((len(together), 3)), {"": np.zeros((len(together), 3, 0))}
    for curve in machine.curves:
        gain = weights(curve.name, machine.chain, machine.lines, together, machine.tool)
        reading = curve.weigh_nodes(together[:, AXES.index(curve.axis)], rest)
        values += gain * (reading @ curve.values)[:, np.newaxis]
        for name, columns in curve.columns.items():
            own = gain[:, :, np.newaxis] * (reading @ columns)[:, np.newaxis, :]
            factors[name] = factors.get(name, 0.0) + own
    factor = np.concatenate(list(factors.values()), axis=2)
    unknown = np.zeros(len(points))
    for each in machine.unmeasured:
        gain = weights(each.name, machine.chain, machine.lines, together, machine.tool)
        # A squareness error is one number at both places; of a curve each place has its own.
        from_there = gain[:-1] - gain[-1] if each.name in SQUARENESS else gain[:-1]
        unknown += each.variance * np.sum(from_there**2, axis=1)
    return values[:-1] - values[-1], factor[:-1] - factor[-1], np.sqrt(unknown)
