"""The formulas of Pahk and Kim, sections 4.1 and 4.2, on the statistics of one test or of a stack of tests.

Equations 4 to 7 are the statistics themselves; `zlmreport.step_gauge.equations` has the others. NaN stands
for what is not defined: at the ends of the section there is no neighbour to interpolate with.
"""

from __future__ import annotations

import numpy as np

from zlmreport.evaluation.evaluation import Arithmetic
from zlmreport.evaluation.ranges import average, largest, width
from zlmreport.evaluation.statistics import PositionStatistics
from zlmreport.quantities.arrays import FloatArray
from zlmreport.step_gauge import equations


def arithmetic(statistics: PositionStatistics) -> Arithmetic:
    """Return every parameter and every column."""
    forward, backward = (
        equations.interpolated(each) for each in (statistics.mean_positive, statistics.mean_negative)
    )
    of_forward, of_backward = (
        2 * equations.interpolated(each) for each in (statistics.s_positive, statistics.s_negative)
    )
    reversal = equations.reversal_error(forward, backward)
    columns = {
        "XF": forward,
        "XB": backward,
        "XM": equations.mean_error(forward, backward),
        "S2F": of_forward,
        "S2B": of_backward,
        "XR": reversal,
        "B": -reversal,
    }
    return Arithmetic(_parameters(statistics, reversal), columns)


def _parameters(statistics: PositionStatistics, reversal: FloatArray) -> dict[str, FloatArray]:
    """Return the parameters of the axis; of what was measured, but for the reversal error."""
    forward, backward = statistics.mean_positive, statistics.mean_negative
    twice = 2 * statistics.standard_deviation
    both = np.concatenate([forward, backward], axis=-1)
    return {
        "W": np.where(statistics.is_bidirectional, width(both, both), np.nan),
        "W_fwd": width(forward, forward),
        "W_bwd": width(backward, backward),
        "S2": largest(np.fmax(twice[..., 0, :], twice[..., 1, :])),
        "S2_fwd": largest(twice[..., 0, :]),
        "S2_bwd": largest(twice[..., 1, :]),
        "XR": largest(np.abs(reversal)),
        "XR_mean": average(reversal),
        "B_mean": -average(reversal),
    }
