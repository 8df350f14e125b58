"""Target positions."""

from __future__ import annotations

import numpy as np

from zlmreport.quantities.arrays import FloatArray


def target_positions(
    travel: tuple[float, float], count: int, period: float, random: np.random.Generator
) -> FloatArray:
    """Return target positions P_i = (i − 1)·p + r, rising, all within the travel.

    The random fractions r let the targets see every phase of a periodic error; the interval p leaves room
    for them at the end.

    Parameters
    ----------
    travel
        First and last position, m or rad.
    count
        m, the number of targets; two at least.
    period
        The greatest period that is expected, m or rad: r is drawn anew for each target, evenly from 0 up to
        it. 0 gives even targets.
    random
        Where the fractions come from.

    Raises
    ------
    ValueError
        If targets so many do not fit: p must not be smaller than the period.
    """
    first, last = travel
    interval = (last - first - period) / (count - 1)
    if interval < period:
        most = int((last - first) / period)
        raise ValueError(
            f"{count} targets with fractions of a period do not fit into the travel; up to {most} do"
        )
    return first + interval * np.arange(count) + random.uniform(0.0, period, count)
