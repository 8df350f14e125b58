"""What stands in the way of a probe: the blocks of a gauge and its base."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from zlmreport.quantities.arrays import FloatArray, read_only_floats
from zlmreport.step_gauge.gauge import StepGauge

#: The base is taken as wide as the blocks and so many times as deep as they are high: no calibration says.
_BASE_DEPTH = 3.0
#: Enough to find the point of a move that is nearest to a box to a part in 10¹⁰ of the move.
_STEPS = 60


@dataclass(frozen=True, slots=True)
class Obstacles:
    """Boxes in the gauge's own coordinates.

    Attributes
    ----------
    blocks
        Numbers of the blocks, in their order; the last box of all is the base.
    lower, upper : (b + 1, 3) arrays
        Corners: along, across and upward, m from the centre of the first block of the section.
    """

    blocks: tuple[int, ...]
    lower: FloatArray
    upper: FloatArray

    @property
    def names(self) -> tuple[str, ...]:
        """What messages call them."""
        return (*(f"block {number}" for number in self.blocks), "the base of the gauge")

    def distances(self, starts: FloatArray, ends: FloatArray) -> FloatArray:
        """Return how near straight moves come to each box.

        Parameters
        ----------
        starts, ends : (m, 3) arrays
            In the gauge's own coordinates, m.

        Returns
        -------
        (m, b + 1) array
            Least distance of the point that moves from the box, m; 0 inside it.
        """
        shape = (len(starts), len(self.lower))
        low, high = np.zeros(shape), np.ones(shape)
        for _ in range(_STEPS):  # the distance from a box is a convex function along a line
            third = (high - low) / 3
            is_left = self._distance(starts, ends, low + third) < self._distance(starts, ends, high - third)
            low, high = np.where(is_left, low, low + third), np.where(is_left, high - third, high)
        nearest = [self._distance(starts, ends, at) for at in (low, np.zeros(shape), np.ones(shape))]
        found: FloatArray = np.min(nearest, axis=0)
        return found

    def _distance(self, starts: FloatArray, ends: FloatArray, share: FloatArray) -> FloatArray:
        at = starts[:, None, :] + share[..., None] * (ends - starts)[:, None, :]
        outside = np.maximum(np.maximum(self.lower - at, at - self.upper), 0.0)
        distance: FloatArray = np.linalg.norm(outside, axis=-1)
        return distance


def obstacles(gauge: StepGauge, first_block: int, width: float, height: float) -> Obstacles:
    """Return the boxes of a gauge.

    Parameters
    ----------
    gauge
        The whole gauge: blocks outside the section that is used stand in the way, too.
    first_block
        Number of the block whose centre is the origin.
    width, height
        Of the blocks, m.
    """
    ends = {block: block_ends(gauge, block) for block in gauge.blocks}
    origin = sum(ends[first_block]) / 2
    lower = [(low - origin, -width / 2, -height / 2) for low, _ in ends.values()]
    upper = [(high - origin, width / 2, height / 2) for _, high in ends.values()]
    lower.append((lower[0][0], -width / 2, -(0.5 + _BASE_DEPTH) * height))
    upper.append((upper[-1][0], width / 2, -height / 2))
    return Obstacles(tuple(ends), read_only_floats(lower), read_only_floats(upper))


def block_ends(gauge: StepGauge, block: int) -> tuple[float, float]:
    """Return the nominal distances of a block's faces from the reference face, m."""
    low, high = sorted(face.nominal for face in gauge.faces if face.block == block)
    return low, high
