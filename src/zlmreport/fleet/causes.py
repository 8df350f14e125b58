"""What a step of a parameter came with (effects of the model), and what machines of one type share."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import date
from statistics import fmean, stdev

from zlmreport.fleet.drifts import Trend, adjust_by_holm
from zlmreport.fleet.trend import Calibration, Series
from zlmreport.model.fitting.distributions import f_tail, t_quantile

#: A parameter that changed by fewer of its standard deviations is not named.
_LEAST = 3.0


@dataclass(frozen=True, slots=True)
class Cause:
    """What changed with a step."""

    since: date  #: Date of the first test after it.
    #: effect, name, change and unit: The parameter of the error model that changed most against what is known
    #: of it; empty for none.
    effect: str = ""
    name: str = ""
    change: float = 0.0
    unit: str = ""
    #: before and after: The instruments, where they are not the same; else empty.
    before: str = ""
    after: str = ""


def find_cause_of(trend: Trend, effects: Iterable[Series]) -> Cause | None:
    """Return what a step came with; None without a step."""
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
            change, ratio = _estimate_change(each, first, since)
            found.append((ratio, change, each))
    ratio, change, best = max(found, key=lambda one: one[0], default=(0.0, 0.0, None))
    if best is None or ratio < _LEAST:
        return Cause(since, before=before, after=after)
    effect, _, name = best.symbol.partition(".")
    return Cause(since, effect, name, change, best.unit, before, after)


def _estimate_change(series: Series, first: date, since: date) -> tuple[float, float]:
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


#: So many machines of a type, at the least, show what they share; and the chance of naming one by accident.
LEAST_MACHINES = 4
_LEVEL = 0.01
_COVERAGE = 0.95


@dataclass(frozen=True, slots=True)
class Shared:
    """A parameter of the error model that machines of one type have in common."""

    #: type and axis: Manufacturer and model; name of the axis.
    type: str
    axis: str
    #: effect, name and unit: The parameter, as the results file has it.
    effect: str
    name: str
    unit: str
    #: mean and expanded_uncertainty: Of the latest values of all machines, with 95 % coverage: what another
    #: machine of the type is built with.
    mean: float
    expanded_uncertainty: float
    machines: tuple[str, ...]  #: By their names.


def find_shared(effects: Iterable[Series]) -> tuple[Shared, ...]:
    """Return what machines of one type share: where the mean of the machines differs from zero.

    The machines' latest values are held against zero by Student's t; how much they scatter is told by
    themselves. Over all parameters of all types Holm's method is used: that any of them is named by accident
    has a chance of 1 %.
    """
    found: defaultdict[tuple[str, str, str, str], dict[str, Calibration]] = defaultdict(dict)
    for each in effects:
        latest = each.calibrations[-1]
        if latest.entry.type:
            found[latest.entry.type, each.axis, each.symbol, each.unit][each.machine] = latest
    groups = [(key, of_type) for key, of_type in sorted(found.items()) if len(of_type) >= LEAST_MACHINES]
    p_values = adjust_by_holm(
        {index: _compute_p_value(of_type.values()) for index, (_, of_type) in enumerate(groups)}
    )
    named = (groups[index] for index in sorted(p_values) if p_values[index] < _LEVEL)
    return tuple(_make_shared(key, of_type) for key, of_type in named)


def _compute_p_value(calibrations: Iterable[Calibration]) -> float:
    values = [each.parameter.value for each in calibrations]
    mean, deviation = fmean(values), stdev(values) / math.sqrt(len(values))
    return f_tail((mean / deviation) ** 2, 1, len(values) - 1) if deviation else float(not mean)


def _make_shared(key: tuple[str, str, str, str], of_type: dict[str, Calibration]) -> Shared:
    values = [each.parameter.value for each in of_type.values()]
    number = len(values)
    expanded = t_quantile(_COVERAGE, number - 1) * stdev(values) / math.sqrt(number)
    effect, _, name = key[2].partition(".")
    return Shared(key[0], key[1], effect, name, key[3], fmean(values), expanded, tuple(sorted(of_type)))
