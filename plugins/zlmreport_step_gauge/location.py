"""Locates a step gauge from its initial points: the line through its first and last block."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from zlmreport.plugin import FloatArray, InputError
from zlmreport_step_gauge.blocks import (
    Block,
    compute_angle_between,
    find_another_section,
    find_askew,
    find_no_blocks,
    fit_block,
    fit_block_along,
)
from zlmreport_step_gauge.gauge import GaugeLocation, StepGauge
from zlmreport_step_gauge.initial_points import BLOCKS, InitialPoints

#: An angle from a direction that scatters alike both ways across, in units of its standard uncertainty:
#: beyond, 5 % of all angles lie by chance (√(−2·ln 0.05)).
SIGNIFICANT = math.sqrt(-2 * math.log(0.05))

#: Points are moved by this much to see what becomes of the direction, m: far more than rounding, far less
#: than a block.
_MOVED = 1e-6


@dataclass(frozen=True, slots=True)
class Misalignment:
    """The angle between a face's normal and the direction C1C2."""

    angle: float  #: rad.
    uncertainty: float  #: Standard uncertainty of the angle, rad, from that of the points.

    @property
    def is_significant(self) -> bool:
        """Whether the scatter of the points explains so large an angle in less than 5 % of all cases."""
        return self.angle > SIGNIFICANT * self.uncertainty


@dataclass(frozen=True, slots=True)
class Located:
    """A located gauge."""

    location: GaugeLocation  #: Where it lies.
    #: begin and end: The blocks that were touched.
    begin: Block
    end: Block
    #: Standard uncertainty of a coordinate that was taken, m: the stated one, or the scatter of the blocks'
    #: sizes where that is larger.
    point_uncertainty: float
    #: begin_misalignment and end_misalignment: Of N1 and N2.
    begin_misalignment: Misalignment
    end_misalignment: Misalignment


def compute_direction_of(coordinates: FloatArray, radius: float) -> FloatArray:
    """Return the unit vector from C1 to C2, shape (..., 3), of points of shape (..., block, point, 3).

    The centres are taken twice: with the normals of the faces, and then with the direction that these give.
    So the small face, of which three points know the normal badly, tilts no centre out of its place.
    """
    direction = _find_between(fit_block(coordinates, radius))
    return _find_between(_square_blocks(coordinates, radius, direction))


def _square_blocks(coordinates: FloatArray, radius: float, direction: FloatArray) -> Block:
    """Return both blocks with their faces square to a direction."""
    return fit_block_along(coordinates, radius, -direction[..., np.newaxis, :])


def _find_between(blocks: Block) -> FloatArray:
    """Return the unit vector between the centres of two blocks."""
    between = np.diff(blocks.centre, axis=-2)[..., 0, :]
    unit: FloatArray = between / np.linalg.norm(between, axis=-1, keepdims=True)
    return unit


def locate(points: InitialPoints, gauge: StepGauge, radius: float, uncertainty: float) -> Located:
    """Return where the section of a gauge lies.

    Raises `InputError` if the points define no block, blocks of another size, or a section of another length;
    or if the beginning and the end are exchanged.

    `points`: On the first and on the last block of the section.
    `radius`: Nominal radius of the tip, m; 0 where the points are those of the surface.
    `uncertainty`: Standard uncertainty of a coordinate, m.

    The uncertainty of the direction is that of the 48 coordinates by the law of propagation (JCGM 100,
    5.1.2), its sensitivities found by moving each of them.
    """
    coordinates = _put_top_first(points.coordinates)
    blocks = fit_block(coordinates, radius)
    begin, end = (_take_from_stack(blocks, index) for index in range(len(BLOCKS)))
    problems = list(find_no_blocks(points, coordinates, (begin, end), gauge))
    if problems:
        raise InputError(problems)
    direction = compute_direction_of(coordinates, radius)
    problems = [
        *find_askew(points, (begin, end), direction),
        *find_another_section(points, (begin, end), gauge),
    ]
    if problems:
        raise InputError(problems)
    taken = max(uncertainty, _spread(blocks))
    of_direction, of_normals = _propagate(coordinates, radius, taken)
    begin_misalignment, end_misalignment = (
        Misalignment(compute_angle_between(-block.normal, direction), math.hypot(of_normal, of_direction))
        for block, of_normal in zip((begin, end), of_normals, strict=True)
    )
    squared = _square_blocks(coordinates, radius, direction)
    upward = squared.upward.sum(axis=0)
    upward = upward - np.dot(upward, direction) * direction
    location = GaugeLocation(
        begin=_take_triple(squared.centre[0]),
        end=_take_triple(squared.centre[1]),
        direction=_take_triple(direction),
        upward=_take_triple(upward / np.linalg.norm(upward)),
        direction_uncertainty=of_direction,
    )
    return Located(location, begin, end, taken, begin_misalignment, end_misalignment)


def _take_triple(vector: FloatArray) -> tuple[float, float, float]:
    x, y, z = vector.tolist()
    return x, y, z


def _take_from_stack(blocks: Block, index: int) -> Block:
    return Block(
        *(
            each[index]
            for each in (
                blocks.normal,
                blocks.sideward,
                blocks.upward,
                blocks.centre,
                blocks.length,
                blocks.width,
                blocks.height,
            )
        )
    )


def _put_top_first(coordinates: FloatArray) -> FloatArray:
    """Return the points with P6 above P7 where they were exchanged and the top of the gauge looks up."""
    ordered = coordinates.copy()
    for points in ordered:
        rise = points[5] - points[6]
        if rise[2] < -0.5 * np.linalg.norm(rise):
            points[[5, 6]] = points[[6, 5]]
    return ordered


def _spread(blocks: Block) -> float:
    """Return the standard deviation of a coordinate by the sizes of the two blocks, m.

    Each size is a difference of two coordinates, and the difference of two sizes one of four; three sizes
    make three degrees of freedom.
    """
    sizes = np.stack([blocks.length, blocks.width, blocks.height])
    return float(np.sqrt(np.sum(np.diff(sizes, axis=-1) ** 2) / (4 * len(sizes))))


def _propagate(coordinates: FloatArray, radius: float, uncertainty: float) -> tuple[float, list[float]]:
    """Return the standard uncertainties of the direction and of the two normals, across each of them, rad."""
    moves = np.eye(coordinates.size).reshape(-1, *coordinates.shape) * _MOVED
    moved = coordinates + moves
    per_metre = uncertainty / _MOVED
    of_direction = compute_direction_of(moved, radius) - compute_direction_of(coordinates, radius)
    of_normals = fit_block(moved, radius).normal - fit_block(coordinates, radius).normal
    return (
        _compute_across(of_direction * per_metre),
        [_compute_across(of_normals[:, index] * per_metre) for index in range(len(BLOCKS))],
    )


def _compute_across(parts: FloatArray) -> float:
    """Return the root of the mean variance in the two directions across, of the parts of shape (part, 3)."""
    return float(np.sqrt(np.sum(parts**2) / 2))
