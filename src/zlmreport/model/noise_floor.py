"""The noise floor: what no effect can take away, because the next reading does not repeat it."""

from __future__ import annotations

import numpy as np

from zlmreport.model.cells import apart_in_time, repeats
from zlmreport.model.design import Design
from zlmreport.quantities.arrays import FloatArray


def noise_floor(design: Design, deviation: FloatArray) -> float | None:
    """Return the standard deviation σ_f of a single reading, drift left out; None without repeats.

    Where the readings of a cell lie apart in time, neighbours within a run are compared: what drifts more
    slowly than a reading drops out. Otherwise the pure error is drift-free as it is. The standard deviations
    of ISO 230-2 contain the drift and are no floor.

    Parameters
    ----------
    design
        The test.
    deviation : (N,) array
        x, m or rad.
    """
    within = repeats(design, deviation)
    if within.degrees < 1:
        return None
    if apart_in_time(design):
        neighbours = (np.diff(within.cell) != 0) & (np.diff(design.run) == 0)
        steps = np.diff(within.centred)[neighbours]
        # A mean of n̄ readings is subtracted from each, and takes a share of 1/n̄ of its variance along.
        shares = 1.0 - 1.0 / within.count[within.cell]
        expected = (shares[1:] + shares[:-1])[neighbours].sum()
        if steps.size and expected > 0:
            return float(np.sqrt(np.sum(steps**2) / expected))
    return float(np.sqrt(within.squares / within.degrees))
