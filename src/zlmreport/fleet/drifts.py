"""Who drifts: the tests of a whole fleet together, so that many tests do not make many false alarms.

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
from dataclasses import dataclass

from zlmreport.fleet.trend import Forecast, Line, Series, forecast, line_through, rank_p_value

#: Of the axes that are named, no larger share is named by accident, in the long run.
FALSE_SHARE = 0.05
#: With fewer dates the order alone can never speak against chance at that level: 2/4! = 0.083.
LEAST_DATES = 5


@dataclass(frozen=True, slots=True)
class Trend:
    """What the calibrations of a parameter say of its drift.

    Attributes
    ----------
    series
        The calibrations.
    line
        Through them; None with fewer than `LEAST_DATES` dates, and then nothing is tested.
    rank_p_value
        Of the test that knows only the order; None likewise.
    drifts
        Whether it is named, with the whole fleet's tests in view.
    forecast
        When a drift meets its limit; None without a drift, without a limit, and where there is no such date.
    """

    series: Series
    line: Line | None = None
    rank_p_value: float | None = None
    drifts: bool = False
    forecast: Forecast | None = None

    @property
    def p_value(self) -> float | None:
        """Of the slope, of this parameter alone."""
        return self.line.p_value if self.line else None


def trends(series: Iterable[Series]) -> tuple[Trend, ...]:
    """Return the trend of each series of a fleet, in the same order."""
    looked_at = [_looked_at(each) for each in series]
    families: defaultdict[tuple[str, str], dict[int, float]] = defaultdict(dict)
    for index, trend in enumerate(looked_at):
        if trend.p_value is not None and trend.rank_p_value is not None:
            # A slope that the order of the values does not bear out is an odd calibration and no drift.
            borne_out = trend.rank_p_value <= FALSE_SHARE
            axis = trend.series.machine, trend.series.axis
            families[axis][index] = trend.p_value if borne_out else 1.0
    named = named_in_families(families.values(), FALSE_SHARE)
    return tuple(_named(trend) if index in named else trend for index, trend in enumerate(looked_at))


def named_in_families(families: Iterable[Mapping[int, float]], level: float) -> frozenset[int]:
    """Return the tests that are named, out of p-values in families.

    Parameters
    ----------
    families
        Of each family, the p-value of each of its tests.
    level
        Largest expected share of false names.
    """
    adjusted = [holm(p_values) for p_values in families]
    chosen = chosen_by_benjamini_hochberg([min(each.values()) for each in adjusted], level)
    within = level * chosen / max(1, len(adjusted))
    return frozenset(index for each in adjusted for index, p in each.items() if p <= within)


def holm(p_values: Mapping[int, float]) -> dict[int, float]:
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


def chosen_by_benjamini_hochberg(p_values: Sequence[float], level: float) -> int:
    """Return how many of the smallest p-values are chosen: the most for which p₍ᵣ₎ ≤ α·r/m."""
    number = len(p_values)
    return max(
        (rank for rank, p in enumerate(sorted(p_values), start=1) if p <= level * rank / number), default=0
    )


def _looked_at(series: Series) -> Trend:
    if len({each.measured for each in series.calibrations}) < LEAST_DATES:
        return Trend(series)
    values = [each.parameter.value for each in series.calibrations]
    return Trend(series, line_through(series), rank_p_value(values))


def _named(trend: Trend) -> Trend:
    limit, line = trend.series.latest.limit, trend.line
    last = trend.series.calibrations[-1].measured
    reached = forecast(line, limit, last) if line and limit is not None else None
    return Trend(trend.series, line, trend.rank_p_value, drifts=True, forecast=reached)
