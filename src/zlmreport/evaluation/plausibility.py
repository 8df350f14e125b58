"""Whether a parameter can be what its readings give: wrong units and signs in a plugin's formulas show."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np

from zlmreport.evaluation.printed import deviation
from zlmreport.evaluation.quantity import Group, Quantity
from zlmreport.evaluation.requirements import Finding
from zlmreport.evaluation.statistics import PositionStatistics
from zlmreport.language import Words
from zlmreport.measurement.axis import Axis
from zlmreport.quantities.notation import plain

#: No parameter is larger than this many times the largest deviation and the range of all: of two runs s is at
#: most 0.71 of the range, so A = range + 4 s is below 4 of them, and 3 s on both sides below 6.
_FARTHEST = 20.0

_POSSIBLE = Words(
    "A value of {symbol} that these readings can give",
    "Ein Wert von {symbol}, den diese Messwerte ergeben können",
)
_NEGATIVE = Words(
    "{value}: not plausible, {symbol} cannot be negative; the formulas of the plugin are in doubt",
    "{value}: nicht plausibel, {symbol} kann nicht negativ sein; die Formeln des Plug-ins sind zweifelhaft",
)
_TOO_LARGE = Words(
    "{value}: not plausible, no reading deviates by more than {largest}; the formulas of the plugin are in "
    "doubt",
    "{value}: nicht plausibel, kein Messwert weicht um mehr als {largest} ab; die Formeln des Plug-ins sind "
    "zweifelhaft",
)


def reach(statistics: PositionStatistics) -> float:
    """Return what no parameter of a test exceeds, m or rad; NaN without readings."""
    readings = statistics.deviations[~np.isnan(statistics.deviations)]
    if not readings.size:
        return math.nan
    return _FARTHEST * float(np.abs(readings).max() + np.ptp(readings))


def is_negative(quantity: Quantity, value: float, farthest: float) -> bool:
    """Return whether a value is negative, beyond rounding, that is a spread or a range."""
    return quantity.group is not Group.SYSTEMATIC and value < -1e-9 * farthest


def doubts(
    values: Iterable[tuple[Quantity, float]], statistics: PositionStatistics, axis: Axis
) -> Iterator[Finding]:
    """Yield a finding on each value that is not plausible.

    Parameters
    ----------
    values
        Parameters with their values, m or rad; none of them NaN.
    statistics
        Of the test.
    axis
        For the units of the sentences.
    """
    farthest = reach(statistics)
    for quantity, value in values:
        negative = is_negative(quantity, value, farthest)
        if not negative and abs(value) <= farthest:
            continue
        symbol, said = plain(quantity.notation), deviation(axis, value)
        largest = deviation(axis, float(np.nanmax(np.abs(statistics.deviations))))
        found = (_NEGATIVE if negative else _TOO_LARGE).given(symbol=symbol, value=said, largest=largest)
        yield Finding(_POSSIBLE.given(symbol=symbol), found, met=False)
