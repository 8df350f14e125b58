"""Which steps and drifts are named over a whole fleet, so that many tests make few false alarms.

Steps come first (`zlmreport.fleet.steps`), and a drift is looked for in what follows the last of them.

The parameters of one axis come from the same readings and hang together in ways that nobody knows: within
an axis Holm's method holds whatever the dependence (S. Holm, Scandinavian Journal of Statistics 6 (1979) 65).
Axes are tested by readings of their own: over them the method of Benjamini and Hochberg holds the share of
false names among all that are named (Journal of the Royal Statistical Society B 57 (1995) 289). Within the R
of m axes so chosen, the parameters are held to the level α·R/m, which keeps the promise for them, too
(Y. Benjamini and M. Bogomolov, ibid. 76 (2014) 297).
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date
from statistics import fmean

from zlmreport.fleet.scatter import ScatterLikelihood, learn_scatter
from zlmreport.fleet.steps import (
    SMALL,
    ParameterCourse,
    ParameterStep,
    compute_chances,
    judge_course,
    sum_squares_between,
)
from zlmreport.fleet.trend import (
    DAYS_PER_YEAR,
    LimitCrossing,
    Series,
    TrendLine,
    fit_line_through,
    forecast,
    rank_p_value,
)

#: Of the axes that are named, no larger share is named by accident, in the long run.
FALSE_SHARE = 0.05
#: With fewer dates the order alone can never speak against chance at that level: 2/4! = 0.083.
LEAST_DATES = 5


@dataclass(frozen=True, slots=True)
class Trend:
    """What the calibrations of a parameter say of its drift."""

    series: Series  #: The calibrations.
    #: Through them; None with fewer than `LEAST_DATES` dates, and then nothing is tested.
    line: TrendLine | None = None
    rank_p_value: float | None = None  #: Of the test that knows only the order; None likewise.
    drifts: bool = False  #: Whether it is named, with the whole fleet's tests in view.
    #: When a drift meets its limit; None without a drift, without a limit, and where there is no such date.
    forecast: LimitCrossing | None = None
    #: What its tests say of steps, in parts of `scale`; None of a parameter that is not asked.
    course: ParameterCourse | None = None
    scale: float = 1.0  #: The limit; 1 where there is none.
    #: That the latest test shows, or that looked like a drift; in the unit of the series.
    step: ParameterStep | None = None
    #: That it is a drift, and neither a step nor chance, if each is as likely beforehand; 0 where none is
    #: named.
    probability: float = 0.0
    since: date | None = None  #: From which day on the line is laid: that of the first test after a step.
    years: float = 0.0  #: That the line covers.

    @property
    def smallest(self) -> float | None:
        """The step that the next test would show in 95 % of all cases."""
        known = self.course.smallest if self.course else None
        return None if known is None else known * self.scale

    @property
    def was_beyond(self) -> bool:
        """Whether its line is beyond the limit from its first date on: when it met it, nobody saw."""
        first = self.since or self.series.calibrations[0].measured
        return self.forecast is not None and self.forecast.expected < first

    @property
    def is_wilder(self) -> bool:
        """Whether the latest tests scatter more than those before."""
        return self.course is not None and self.course.is_wilder

    @property
    def p_value(self) -> float | None:
        """Of the slope, of this parameter alone."""
        return self.line.p_value if self.line else None


def group_by_axis(trends: Iterable[Trend]) -> Mapping[tuple[str, str], list[Trend]]:
    """Return trends by machine and axis, in the order in which the axes come first."""
    found: defaultdict[tuple[str, str], list[Trend]] = defaultdict(list)
    for each in trends:
        found[each.series.machine, each.series.axis].append(each)
    return found


def judge_trends(series: Iterable[Series]) -> tuple[Trend, ...]:
    """Return the trend of each series of a fleet, in the same order."""
    every = tuple(series)
    stepping = _find_steps(every)
    excluded = _list_excluded_days(stepping.values())
    looked_at = [
        _judge_trend(each, stepping.get(index), excluded[each.machine, each.axis])
        for index, each in enumerate(every)
    ]
    scales = _choose_scales(every)
    families: defaultdict[tuple[str, str], dict[int, float]] = defaultdict(dict)
    for index, trend in enumerate(looked_at):
        if trend.p_value is not None and trend.rank_p_value is not None:
            # A slope that the order of the values does not bear out is an odd calibration and no drift.
            borne_out = trend.rank_p_value <= FALSE_SHARE and not _is_small(trend, scales[index])
            axis = trend.series.machine, trend.series.axis
            families[axis][index] = trend.p_value if borne_out else 1.0
    named = name_in_families(families.values(), FALSE_SHARE)
    return tuple(
        _name_trend(trend, stepping.get(index)) if index in named else trend
        for index, trend in enumerate(looked_at)
    )


@dataclass(frozen=True, slots=True)
class _Stepping:
    """A series that is asked for steps: its values in parts of its scale, and what is known of them."""

    series: Series
    scale: float
    values: tuple[float, ...]
    fleet: ScatterLikelihood
    course: ParameterCourse


def _find_steps(series: Sequence[Series]) -> Mapping[int, _Stepping]:
    """Return what those series say that are asked: with a limit, or else the first of an axis."""
    by_axis: defaultdict[tuple[str, str], list[int]] = defaultdict(list)
    for index, each in enumerate(series):
        by_axis[each.machine, each.axis].append(index)
    asked: dict[int, float] = {}
    for of_axis in by_axis.values():
        limited = [index for index in of_axis if series[index].latest.limit]
        asked |= dict.fromkeys(limited or of_axis[:1], 1 / max(1, len(limited)))
    found: dict[int, _Stepping] = {}
    for group in (True, False):  # parts of a limit, and µm or ″, have each a scatter of their own
        shares = {index: part for index, part in asked.items() if bool(series[index].latest.limit) is group}
        scales = {index: series[index].latest.limit or 1.0 for index in shares}
        values = {
            index: tuple(each.parameter.value / scale for each in series[index].calibrations)
            for index, scale in scales.items()
        }
        # Of the latest tests each may begin a step; what was taken for one is left out the second time.
        known = [sum_squares_between(each[:-1], ()) for each in values.values()]
        for _ in range(2):
            others = learn_scatter(known)
            courses = [
                judge_course(values[index], fleet, part)
                for (index, part), fleet in zip(shares.items(), others, strict=True)
            ]
            known = [
                sum_squares_between(each, own.steps)
                for each, own in zip(values.values(), courses, strict=True)
            ]
        for index, fleet, own in zip(shares, others, courses, strict=True):
            found[index] = _Stepping(series[index], scales[index], values[index], fleet, own)
    return found


def _list_excluded_days(stepping: Iterable[_Stepping]) -> Mapping[tuple[str, str], frozenset[date]]:
    """Return the days of each axis that are no part of a line: before a step, odd ones, a new step."""
    found: defaultdict[tuple[str, str], frozenset[date]] = defaultdict(frozenset)
    for each in stepping:
        calibrations = each.series.calibrations
        kept = {calibrations[index].measured for index in each.course.since}
        found[each.series.machine, each.series.axis] |= {
            one.measured for one in calibrations if one.measured not in kept
        }
    return found


def _choose_scales(series: Sequence[Series]) -> Sequence[float | None]:
    """Return against what a change of each series is small: its limit, or the least of its standard."""
    least: dict[tuple[str, str, str, str], float] = {}
    for each in series:
        if each.latest.limit:
            key = each.machine, each.axis, each.standard, each.unit
            least[key] = min(each.latest.limit, least.get(key, each.latest.limit))
    return [
        each.latest.limit or least.get((each.machine, each.axis, each.standard, each.unit)) for each in series
    ]


def _is_small(trend: Trend, scale: float | None) -> bool:
    """Whether the whole change along a line is no news."""
    if scale is None or trend.line is None:
        return False
    return abs(trend.line.slope) * trend.years < SMALL * scale


def name_in_families(families: Iterable[Mapping[int, float]], level: float) -> frozenset[int]:
    """Return the tests that are named, out of p-values in families.

    `families`: Of each family, the p-value of each of its tests.
    `level`: Largest expected share of false names.
    """
    adjusted = [adjust_by_holm(p_values) for p_values in families]
    chosen = choose_by_benjamini_hochberg([min(each.values()) for each in adjusted], level)
    within = level * chosen / max(1, len(adjusted))
    return frozenset(index for each in adjusted for index, p in each.items() if p <= within)


def adjust_by_holm(p_values: Mapping[int, float]) -> dict[int, float]:
    """Return p-values adjusted by Holm's method.

    Whoever rejects those up to α rejects any true hypothesis with a chance of no more than α.
    """
    adjusted: dict[int, float] = {}
    largest = 0.0
    rising = sorted(p_values, key=lambda index: p_values[index])
    for place, index in enumerate(rising):
        largest = max(largest, min(1.0, (len(rising) - place) * p_values[index]))
        adjusted[index] = largest
    return adjusted


def choose_by_benjamini_hochberg(p_values: Sequence[float], level: float) -> int:
    """Return how many of the smallest p-values are chosen: the most for which p₍ᵣ₎ ≤ α·r/m."""
    number = len(p_values)
    return max(
        (rank for rank, p in enumerate(sorted(p_values), start=1) if p <= level * rank / number), default=0
    )


def _judge_trend(series: Series, stepping: _Stepping | None, excluded: frozenset[date]) -> Trend:
    kept = tuple(each for each in series.calibrations if each.measured not in excluded)
    trend = Trend(series, since=kept[0].measured if kept else None)
    if stepping:
        steps, scale = stepping.course.steps, stepping.scale
        is_latest = bool(steps) and steps[-1].index + 1 == len(series.calibrations)
        step = replace(steps[-1], change=steps[-1].change * scale) if is_latest else None
        trend = replace(trend, course=stepping.course, scale=scale, step=step)
    if len({each.measured for each in kept}) < LEAST_DATES:
        return trend
    line = fit_line_through(replace(series, calibrations=kept))
    years = (kept[-1].measured - kept[0].measured).days / DAYS_PER_YEAR
    order = rank_p_value([each.parameter.value for each in kept])
    return replace(trend, line=line, rank_p_value=order, years=years)


def _name_trend(trend: Trend, stepping: _Stepping | None) -> Trend:
    """Return a trend as the drift that it was named, or as a step where that is more likely."""
    probability = 0.0
    if stepping:
        since = stepping.course.since
        likely = compute_chances([stepping.values[index] for index in since], stepping.fleet)
        best = max(range(len(since)), key=lambda each: likely.steps[each])
        if sum(likely.steps) > likely.drift:
            values = [stepping.values[index] * stepping.scale for index in since]
            change = fmean(values[best:]) - fmean(values[:best])
            return replace(trend, step=trend.step or ParameterStep(since[best], change, sum(likely.steps)))
        probability = likely.drift
    limit, line = trend.series.latest.limit, trend.line
    last = trend.series.calibrations[-1].measured
    reached = forecast(line, limit, last) if line and limit is not None else None
    return replace(trend, drifts=True, forecast=reached, probability=probability)
