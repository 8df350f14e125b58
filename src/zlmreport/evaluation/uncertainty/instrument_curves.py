"""Shapes of an instrument's error along the axis: of a laser, a gauge, a straightedge or mirror.

Its certificate gives one number, and the curve is whatever it is. What errs at each position by itself leaves
a slope that many positions know well; what is bent by half a wave does not. An error of a whole wave or two
is there as a whole in every test, where errors at each position have their largest in few. So each is asked.
Derived here.
"""

from __future__ import annotations

import math
from enum import Enum

import numpy as np

from zlmreport.evaluation.uncertainty.budget import Acts, Budget, Contribution
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.measurement_set import MeasurementSet


class CurveForm(Enum):
    """How an instrument errs of which only the size is known."""

    AT_EACH_POSITION = "at each position"
    BEND = "bend"
    WAVES = "waves"

    @property
    def half_waves(self) -> tuple[int, ...]:
        """The half waves that it may have on a line; none where each position has an error of its own."""
        # Not the values themselves: Python 3.11 up to 3.11.2 makes an object of a value that is ().
        return {CurveForm.BEND: (1,), CurveForm.WAVES: (2, 4)}.get(self, ())


def list_forms(budget: Budget, measurements: MeasurementSet) -> tuple[CurveForm, ...]:
    """Return the forms that are asked where the error of an instrument is stated.

    A bend only of a body that lines were held against: it is a slope, and what an error along the length does
    to other parameters the bound of U by the instrument counts in. That bound is none of a slope, nor of what
    follows from several lines.
    """
    lines = [
        line
        for of_line, line in zip(budget.lines, measurements.lines, strict=True)
        if any(map(is_of_the_instrument, of_line.contributions)) and not line.axis.measurand.is_continuous
    ]
    if any(line.axis.measurand.has_reference_body for line in lines):
        return tuple(CurveForm)
    return (CurveForm.AT_EACH_POSITION, CurveForm.WAVES) if lines else (CurveForm.AT_EACH_POSITION,)


def is_of_the_instrument(contribution: Contribution) -> bool:
    """Return whether it is an instrument's error at each position, of which nobody knows the curve."""
    return contribution.acts is Acts.AT_EACH_POSITION and contribution.contributor == "instrument"


def sample_waves(
    form: CurveForm, shares: FloatArray, count: int, generator: np.random.Generator
) -> FloatArray:
    """Return waves of any phase along a line, of root mean square 1 at each position: (count, m).

    `shares`: Of the length, at each position. Each number of half waves that a form has is as likely.
    """
    half_waves = generator.choice(form.half_waves, (count, 1))
    phases = 2 * np.pi * generator.random((count, 1))
    return np.asarray(math.sqrt(2.0) * np.sin(np.pi * half_waves * shares + phases))
