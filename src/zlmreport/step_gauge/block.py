"""A block from the eight points on it: its planes, its size and its centre.

All functions take points of shape (..., 8, 3), batch dimensions first; so the uncertainty is propagated, and
a thousand calibrations are simulated, by one call.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.quantities.arrays import FloatArray


@dataclass(frozen=True, slots=True)
class Block:
    """A block in the coordinates of the machine, or a stack of blocks.

    Attributes
    ----------
    normal : (..., 3) array
        N, the outward normal of the front face: P1P2 x P1P3, pointing away from P8.
    sideward, upward : (..., 3) arrays
        Unit vectors from one side to the other and out of the top; with the normal a frame.
    centre : (..., 3) array
        C, m.
    length, width, height : (...) arrays
        Between front and back, between the sides, from the foot to the top, m.
    """

    normal: FloatArray
    sideward: FloatArray
    upward: FloatArray
    centre: FloatArray
    length: FloatArray
    width: FloatArray
    height: FloatArray


def block_of(points: FloatArray, radius: float) -> Block:
    """Return the block that eight points lie on; of points that define none, values are NaN or nonsense.

    Parameters
    ----------
    points : (..., 8, 3) array
        P1 to P8, centres of the tip, m.
    radius
        Of the tip, m; 0 where the points are those of the surface.
    """
    p1, p2, p3, *_, p8 = np.moveaxis(points, -2, 0)
    normal = _unit(np.cross(p2 - p1, p3 - p1))
    front = (p1 + p2 + p3) / 3
    return block_along(points, radius, normal * _sign(_dot(front - p8, normal)))


def block_along(points: FloatArray, radius: float, normal: FloatArray) -> Block:
    """Return the block that eight points lie on, its front face square to a direction that is known.

    Parameters
    ----------
    points, radius
        As of `block_of`.
    normal : (..., 3) array
        Outward normal of the front face.

    Notes
    -----
    The centre lies midway between front and back and between the sides, where the radius cancels. P6 and P7
    are both touched from above, so that it cancels in the height, and the centre lies below their middle by
    the radius.
    """
    p1, p2, p3, p4, p5, p6, p7, p8 = np.moveaxis(points, -2, 0)
    front = (p1 + p2 + p3) / 3
    across = p4 - p5
    sideward = _unit(across - _dot(across, normal) * normal)
    upward = np.cross(normal, sideward)
    upward = upward * _sign(_dot(p6 - p7, upward))
    along = _dot(front + p8, normal) / 2
    aside = _dot(p4 + p5, sideward) / 2
    above = _dot(p6 + p7, upward) / 2 - radius
    return Block(
        normal=normal,
        sideward=sideward,
        upward=upward,
        centre=along * normal + aside * sideward + above * upward,
        length=(_dot(front - p8, normal) - 2 * radius)[..., 0],
        width=(_dot(across, sideward) - 2 * radius)[..., 0],
        height=_dot(p6 - p7, upward)[..., 0],
    )


def altitude(points: FloatArray) -> FloatArray:
    """Return the smallest height of the triangle P1, P2, P3, m, shape (...): 0 where they lie on a line."""
    p1, p2, p3 = np.moveaxis(points[..., :3, :], -2, 0)
    doubled_area = np.linalg.norm(np.cross(p2 - p1, p3 - p1), axis=-1)
    longest = np.max([np.linalg.norm(a - b, axis=-1) for a, b in ((p1, p2), (p2, p3), (p3, p1))], axis=0)
    with np.errstate(invalid="ignore"):
        height: FloatArray = np.where(longest > 0, doubled_area / np.where(longest > 0, longest, 1.0), 0.0)
    return height


def _dot(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the scalar product, its axis kept."""
    product: FloatArray = np.sum(a * b, axis=-1, keepdims=True)
    return product


def _unit(vector: FloatArray) -> FloatArray:
    with np.errstate(invalid="ignore", divide="ignore"):
        unit: FloatArray = vector / np.linalg.norm(vector, axis=-1, keepdims=True)
    return unit


def _sign(value: FloatArray) -> FloatArray:
    """Return 1 or −1, and 1 of zero."""
    return np.where(value < 0, -1.0, 1.0)
