"""At how many phases of a known period targets lie: with fewer than three, a wave is not seen whole."""

from __future__ import annotations

import numpy as np

from zlmreport.evaluation import printed
from zlmreport.foresight.targets import periods
from zlmreport.language import Words
from zlmreport.measurement.axis import Axis
from zlmreport.quantities.arrays import BoolArray, FloatArray

#: Phases that agree within this share of a period are one.
_ONE_PHASE = 0.01

_PERIODS = {
    "axis.screw_pitch": Words(en="the pitch of {period}", de="der Steigung von {period}"),
    "axis.signal_period": Words(en="the signal period of {period}", de="der Signalperiode von {period}"),
}


def periods_at_phases(axis: Axis, targets: FloatArray, number: int) -> list[Words]:
    """Return the known periods of an axis at exactly so many phases of which targets lie.

    Parameters
    ----------
    axis
        Which states its periods, or none.
    targets : (m,) array
        m or rad.
    number
        1 or 2.
    """
    return [
        _PERIODS[key].given(period=printed.position(axis, period))
        for key, period in periods(axis)
        if phases(targets, period) == number
    ]


def phases(targets: FloatArray, period: float) -> int:
    """Return at how many phases of a period targets lie: 1, 2, or 3 for more."""
    elsewhere = targets[~_at_phase_of_first(targets, period)]
    if not elsewhere.size:
        return 1
    return 2 if _at_phase_of_first(elsewhere, period).all() else 3


def _at_phase_of_first(targets: FloatArray, period: float) -> BoolArray:
    turns = (targets - targets[0]) / period
    return np.asarray(np.abs(turns - np.rint(turns)) < _ONE_PHASE)
