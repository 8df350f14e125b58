"""Equations 1 to 13 of Pahk and Kim, in their order and with their symbols.

Positions along the gauge and distances from its reference face are in metres. Steps are the faces of the
gauge in their order: i counts them from 1, so that odd steps are front faces, which are reached forward, and
even steps back faces, which are reached backward. Batch dimensions lead. What is not there is NaN, and stays
so.

Source: H. Pahk and J. Kim, "Development of computer aided calibration module for CMMs and machine tools
using a compensated step gauge", sections 4.1 and 4.2. Means and standard deviations of the cycles (Eq. 4 to
7) are those of `PositionStatistics`.
"""

from __future__ import annotations

import numpy as np

from zlmreport.plugin import FloatArray


def effective_radius(measured_size: FloatArray, actual_size: FloatArray) -> FloatArray:
    """R_eff = (measured block size − actual block size) / 2, m (Eq. 1).

    `measured_size`: Between the centres of the tip at the back and at the front face of a block, m.
    `actual_size`: The calibrated size of the block, m.
    """
    radius: FloatArray = (measured_size - actual_size) / 2
    return radius


def error(
    position: FloatArray, reference: FloatArray, distance: FloatArray, reference_distance: FloatArray
) -> FloatArray:
    """XF_{i,j} and XB_{i,j} = (M_{i,j} − M_ref) − (S_i − S_ref), m (Eq. 2 and 3).

    `position`: M, the position of a face along C1C2, m.
    `reference`: M_ref, that of the reference face, m.
    `distance`, `reference_distance`: S and S_ref, their actual distances from the origin of the gauge, m.
    """
    deviation: FloatArray = (position - reference) - (distance - reference_distance)
    return deviation


def interpolate(values: FloatArray) -> FloatArray:
    """Return values at each step: those that are there, and between two of them their mean (Eq. 8 to 11).

    XF_{2i} = (XF_{2i−1} + XF_{2i+1})/2, XB_{2i−1} = (XB_{2i−2} + XB_{2i})/2, and likewise SF and SB; shape
    (..., step). At an end of the section a step has one neighbour only: its value is not extrapolated. A step
    is interpolated where the result has a value and `values` has none.
    """
    filled = np.array(values, dtype=np.float64)
    between = (values[..., :-2] + values[..., 2:]) / 2
    inner = filled[..., 1:-1]
    inner[...] = np.where(np.isnan(inner), between, inner)
    return filled


def mean_error(forward: FloatArray, backward: FloatArray) -> FloatArray:
    """XM_i = (XF_i + XB_i) / 2, m (Eq. 12)."""
    centre: FloatArray = (forward + backward) / 2
    return centre


def reversal_error(forward: FloatArray, backward: FloatArray) -> FloatArray:
    """XR_i = XB_i − XF_i, m (Eq. 13): with the sign opposite to that of B_i of ISO 230-2."""
    reversal: FloatArray = backward - forward
    return reversal
