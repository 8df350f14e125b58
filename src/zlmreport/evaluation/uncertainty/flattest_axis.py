"""The flattest axis that readings leave possible, where the instrument errs as much as the axis.

Errors that differ from position to position widen a range. They have done so in the readings already, and
widen what was read less when they are drawn a second time: an axis that is flatter than its readings show is
farther from them than any test simulated about them. So U is asked of two axes: of the one that was read, and
of the flattest that is compatible with the readings. The variance of the means by position is that of
the axis and that of the errors, (m − 1)·S²/ε² of a flat axis is distributed like χ² with m − 1 degrees of
freedom, and its upper limit of 95 % is the most that the errors may have brought. Of a line that is held
against a body the slope is the set-up's, and S² that about a line. Derived here.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from zlmreport.evaluation.uncertainty.budget import Acts, Budget
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.measurement_set import MeasurementSet

#: ε/S from which the errors matter to the range of the means: below it U gains less than its second digit.
_MATTERS = 0.25
#: Quantile of the standard normal distribution at 95 %.
_LIMIT = 1.6449
_FEWEST = 3


def make_flattest(measurements: MeasurementSet, budget: Budget) -> MeasurementSet | None:
    """Return the readings as the flattest axis would have them; None where errors matter little.

    Of several measured lines each is flattened for itself.
    """
    if measurements.tests:
        found = {name: make_flattest(each, budget.tests[name]) for name, each in measurements.tests.items()}
        tests = {name: found[name] or each for name, each in measurements.tests.items()}
        return replace(measurements, tests=tests) if any(found.values()) else None
    readings = measurements.deviations()
    there = np.isfinite(readings)
    count = there.sum(axis=(0, 2))
    if len(count) < _FEWEST or not count.all():
        return None
    means = np.where(there, readings, 0.0).sum(axis=(0, 2)) / count
    degree = 1 if measurements.axis.measurand.has_reference_body else 0
    around = means - _polynomial(measurements.target_positions, means, degree)
    freedom = len(means) - 1 - degree
    observed, brought = float(around @ around) / freedom, budget.variance(Acts.AT_EACH_POSITION)
    if brought <= _MATTERS**2 * observed:
        return None
    left = max(0.0, 1 - brought * _compute_most_by_chance(freedom) / observed) if observed else 0.0
    change = (math.sqrt(left) - 1) * around
    return replace(
        measurements, deviation=read_only_floats(measurements.deviation + change[measurements.target])
    )


def _polynomial(positions: FloatArray, values: FloatArray, degree: int) -> FloatArray:
    """Return the polynomial of least squares through values, at their positions."""
    powers = np.vander((positions - positions.mean()) / np.ptp(positions), degree + 1)
    found, *_ = np.linalg.lstsq(powers, values, rcond=None)
    return np.asarray(powers @ found)


def _compute_most_by_chance(freedom: int) -> float:
    """Return the quantile of χ²/freedom at 95 %, by the approximation of Wilson and Hilferty."""
    spread = 2 / (9 * freedom)
    return float((1 - spread + _LIMIT * math.sqrt(spread)) ** 3)
