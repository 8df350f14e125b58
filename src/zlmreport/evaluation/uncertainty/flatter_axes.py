"""Simulated axes flatter than the readings, for U where the instrument errs as much as the axis.

Errors that differ from position to position widen a range. They have done so in the readings already, and
widen what was read less when they are drawn a second time: an axis that is flatter than its readings show is
farther from them than any test simulated about them. So tests are simulated of axes of several flatnesses,
and those stay possible of which the readings may be a test (`zlmreport.evaluation.uncertainty.monte_carlo`
asks them). Of axes of one range those are widened most of which many targets lie at its ends, where the
largest error of many counts. So every target that was read within 2·u of an end, and may lie there but for
its error, is put there. Of a line that is held against a body the slope is the set-up's, and what is
flattened lies about a line. Derived here.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from zlmreport.evaluation.uncertainty.budget import COVERAGE_FACTOR, Acts, Budget
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.measurement_set import MeasurementSet

#: u/S from which the errors matter to the range of the means: below it U gains less than its second digit.
_MATTERS = 0.25
#: Parts of the range of the means that is read, from all of it down to a flat axis.
_PARTS = tuple(np.linspace(1.0, 0.0, 7).tolist())
_FEWEST = 3


def make_flatter_axes(measurements: MeasurementSet, budget: Budget) -> Sequence[MeasurementSet]:
    """Return the readings as flatter axes would have them, the flattest last.

    None where errors matter little. Of several measured lines each is flattened for itself, all by the same
    part.
    """
    if measurements.tests:
        found = {
            name: make_flatter_axes(each, budget.tests[name]) for name, each in measurements.tests.items()
        }
        if not any(found.values()):
            return ()
        return [
            replace(
                measurements,
                tests={
                    name: found[name][number] if found[name] else each
                    for name, each in measurements.tests.items()
                },
            )
            for number in range(len(_PARTS))
        ]
    readings = measurements.deviations()
    there = np.isfinite(readings)
    count = there.sum(axis=(0, 2))
    if len(count) < _FEWEST or not count.all():
        return ()
    means = np.where(there, readings, 0.0).sum(axis=(0, 2)) / count
    degree = 1 if measurements.axis.measurand.has_reference_body else 0
    around = means - _fit_polynomial(measurements.target_positions, means, degree)
    error = math.sqrt(budget.variance(Acts.AT_EACH_POSITION))
    if error <= _MATTERS * math.sqrt(float(around @ around) / (len(means) - 1 - degree)):
        return ()
    shape = _fill_ends(around, COVERAGE_FACTOR * error)
    changes = (part * shape - around for part in _PARTS)
    return [
        replace(
            measurements, deviation=read_only_floats(measurements.deviation + change[measurements.target])
        )
        for change in changes
    ]


def _fit_polynomial(positions: FloatArray, values: FloatArray, degree: int) -> FloatArray:
    """Return the polynomial of least squares through values, at their positions."""
    powers = np.vander((positions - positions.mean()) / np.ptp(positions), degree + 1)
    found, *_ = np.linalg.lstsq(powers, values, rcond=None)
    return np.asarray(powers @ found)


def _fill_ends(means: FloatArray, reach: float) -> FloatArray:
    """Return means about the middle of their range, those within reach of an end put there."""
    half = float(np.ptp(means)) / 2
    about = means - (float(means.min()) + half)
    inside = np.abs(about) < half - min(reach, half)
    return np.where(inside, about, np.copysign(half, about))
