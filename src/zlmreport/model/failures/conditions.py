"""Test against logged conditions: whether the residual, or its slope along the axis, follows one."""

from __future__ import annotations

import numpy as np

from zlmreport.language import Words, same
from zlmreport.model.failures.failure import Failure, ResidualTest
from zlmreport.model.failures.residuals import Residuals

_FOLLOW = Words(
    en="the residuals follow a logged condition, in their zero or in their slope",
    de="die Residuen folgen einer aufgezeichneten Bedingung, mit Nullpunkt oder Steigung",
)


def conditions(residuals: Residuals) -> Failure | None:
    """Return the test of the logged condition that the residuals follow most closely."""
    design = residuals.design
    p_values = {}
    for name, log in design.conditions.items():
        if np.ptp(log) == 0:
            continue
        change = log - log.mean()
        columns = np.column_stack([change, change * (design.position - design.middle)])
        p_values[name] = residuals.p_value(columns)
    if not p_values:
        return None
    closest = min(p_values, key=p_values.__getitem__)
    p_value = min(1.0, len(p_values) * p_values[closest])
    return Failure(ResidualTest.CONDITION, p_value, same(closest), _FOLLOW)
