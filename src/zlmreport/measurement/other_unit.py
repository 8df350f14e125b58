"""A run that looks as if it were in another unit than the others: by the size of its deviations."""

from __future__ import annotations

import numpy as np

from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray, IntArray

_FEWEST_RUNS = 3
#: Times by which such a run is larger or smaller than the others, which differ by less among themselves.
_ANOTHER_UNIT = 100.0

#: What is said of such a run, and what to do.
IN_ANOTHER_UNIT = Words("run {run} looks as if it were in another unit than the others")
CORRECT_RUN = Words("correct the run in the file, or leave it out")


def find_run_in_another_unit(run: IntArray, deviation: FloatArray) -> int | None:
    """Return the run of another size than all others; None where there is none, or too few to tell.

    `run`, (N,): Of each reading.
    `deviation`, (N,): m or rad; NaN where it is missing.
    """
    there = ~np.isnan(deviation)
    sizes = {
        each: float(np.median(np.abs(deviation[there & (run == each)])))
        for each in np.unique(run[there]).tolist()
    }
    for each, size in sizes.items() if len(sizes) >= _FEWEST_RUNS else ():
        others = [other for number, other in sizes.items() if number != each]
        low, high = min(others), max(others)
        if high < _ANOTHER_UNIT * low and (size > _ANOTHER_UNIT * high or size * _ANOTHER_UNIT < low):
            return int(each)
    return None
