"""What a step came with: the effect of the error model that changed most, and another instrument."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import date
from statistics import fmean, stdev

from zlmreport.fleet.drifts import Trend
from zlmreport.fleet.trend import Series

#: A parameter that changed by fewer of its standard deviations is not named.
_LEAST = 3.0


@dataclass(frozen=True, slots=True)
class Cause:
    """What changed with a step.

    Attributes
    ----------
    since
        Date of the first test after it.
    effect, name, change, unit
        The parameter of the error model that changed most against what is known of it; empty for none.
    before, after
        The instruments, where they are not the same; else empty.
    """

    since: date
    effect: str = ""
    name: str = ""
    change: float = 0.0
    unit: str = ""
    before: str = ""
    after: str = ""


def cause_of(trend: Trend, effects: Iterable[Series]) -> Cause | None:
    """Return what a step came with; None without a step.

    Parameters
    ----------
    trend
        Of the parameter.
    effects
        Parameters of the error models of all axes over time.
    """
    step, calibrations = trend.step, trend.series.calibrations
    if step is None or trend.course is None:
        return None
    since = calibrations[step.index].measured
    first = calibrations[min(trend.course.since)].measured
    old, new = calibrations[step.index - 1].entry.instrument, calibrations[step.index].entry.instrument
    before, after = (old, new) if old and new and old != new else ("", "")
    found = []
    for each in effects:
        if (each.machine, each.axis) == (trend.series.machine, trend.series.axis):
            change, ratio = _change(each, first, since)
            found.append((ratio, change, each))
    ratio, change, best = max(found, key=lambda one: one[0], default=(0.0, 0.0, None))
    if best is None or ratio < _LEAST:
        return Cause(since, before=before, after=after)
    effect, _, name = best.symbol.partition(".")
    return Cause(since, effect, name, change, best.unit, before, after)


def _change(series: Series, first: date, since: date) -> tuple[float, float]:
    """Return by how much a parameter changed, and as how many standard deviations."""
    before = [each.parameter for each in series.calibrations if first <= each.measured < since]
    after = [each.parameter for each in series.calibrations if each.measured >= since]
    if not before or not after:
        return 0.0, 0.0
    values = [each.value for each in before]
    change = fmean(each.value for each in after) - fmean(values)
    stated = [(each.expanded_uncertainty or 0.0) / 2 for each in (*before, *after)]
    deviation = max(math.sqrt(fmean(u**2 for u in stated)), stdev(values) if len(values) > 2 else 0.0)
    scale = deviation * math.sqrt(1 / len(before) + 1 / len(after))
    return change, abs(change) / scale if scale else 0.0
