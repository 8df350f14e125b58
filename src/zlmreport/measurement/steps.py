"""The step in which readings were given: that of their last digit, or a coarser one that all of them keep."""

from __future__ import annotations

import numpy as np

from zlmreport.measurement.arrays import IntArray, count_decimals_of
from zlmreport.measurement.measurement_set import MeasurementSet

#: Decimals in which deviations may be given, in their unit.
_MOST_DECIMALS = 3
#: Differences that must all be multiples of a step, and how many sizes they must have at least: of one that
#: is a multiple by chance, with a probability of a half at most, twenty in a row are none.
_FEWEST_DIFFERENCES, _FEWEST_SIZES = 20, 2


def find_last_digit(measurements: MeasurementSet) -> float:
    """Return the step of the last digit of the readings, 0.001 at least, in the unit of deviations."""
    readings = measurements.axis.deviation_unit.from_si(measurements.deviation)
    return float(10.0 ** -count_decimals_of(readings, _MOST_DECIMALS))


def find_step(measurements: MeasurementSet) -> float:
    """Return the step in which the readings were given, in the unit of deviations.

    It is that of their last digit, or a coarser one where all of them differ by multiples of more, as those
    of a display with steps of 10 µm. Of positions that were read so the deviations keep it at each target
    alone.
    """
    digit = find_last_digit(measurements)
    there = np.isfinite(measurements.deviation)
    readings = measurements.axis.deviation_unit.from_si(measurements.deviation[there])
    given = np.round(readings / digit).astype(np.int64)
    return digit * _find_common_step(given, measurements.target[there])


def _find_common_step(given: IntArray, target: IntArray) -> int:
    """Return the largest number of which all readings at a target differ by multiples; 1 where chance may do.

    `given`: Readings in steps of their last digit; `target`: the target of each.
    """
    if not given.size:
        return 1
    first = np.zeros(int(target.max()) + 1, dtype=np.int64)
    first[target[::-1]] = given[::-1]
    for differences in (given - first[target], given - given[0]):
        sizes = np.abs(differences[differences != 0])
        if sizes.size >= _FEWEST_DIFFERENCES and len(np.unique(sizes)) >= _FEWEST_SIZES:
            return int(np.gcd.reduce(sizes))
    return 1
