"""The line through a series, the chance that it rises or falls by accident, and when it meets a limit.

Calibrations weigh by their stated uncertainties, wᵢ = 1/Uᵢ². How much they scatter is told by the series
itself and not by U: what is common to all of them, such as the error of one and the same interferometer,
shifts the whole line, leaves its slope alone, and must not be counted as scatter.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date

from zlmreport.fleet.trend import Series
from zlmreport.model.distributions import f_tail, t_quantile

DAYS_PER_YEAR = 365.25
#: Of the interval in which a limit is met.
CONFIDENCE = 0.95
#: A line through some quarters says nothing of what is farther ahead.
MOST_YEARS_AHEAD = 20
#: A smaller scatter, as a part of the largest value, is the rounding of doubles.
_RESOLUTION = 1e-9


@dataclass(frozen=True, slots=True)
class Line:
    """A straight line, about the weighted mean of its dates, where level and slope are not correlated.

    Attributes
    ----------
    origin
        Mean date t̄, in days of the calendar (`date.toordinal`).
    level
        a: the line at t̄, µm or ″.
    slope
        b, per year.
    level_variance, slope_variance
        u²(a) and u²(b), from the scatter about the line.
    degrees
        Of freedom: n − 2.
    """

    origin: float
    level: float
    slope: float
    level_variance: float
    slope_variance: float
    degrees: int

    def at(self, day: date) -> float:
        """Return the line at a date."""
        return self.level + self.slope * (day.toordinal() - self.origin) / DAYS_PER_YEAR

    @property
    def p_value(self) -> float:
        """The chance of so steep a line, up or down, where nothing drifts: Student's t, two-sided."""
        if self.slope == 0:
            return 1.0
        return f_tail(self.slope**2 / self.slope_variance, 1, self.degrees)

    @property
    def expanded_slope_uncertainty(self) -> float:
        """U(b) for the same probability as the interval of a forecast, per year."""
        return t_quantile(CONFIDENCE, self.degrees) * math.sqrt(self.slope_variance)


@dataclass(frozen=True, slots=True)
class Forecast:
    """When a line meets a limit.

    Attributes
    ----------
    expected
        Where the line itself meets it.
    earliest, latest
        Where lines meet it that the calibrations leave possible (95 %); `latest` is None where that is more
        than `MOST_YEARS_AHEAD` away.
    """

    expected: date
    earliest: date
    latest: date | None


def line_through(series: Series) -> Line:
    """Return the line of weighted least squares through a series of three or more calibrations."""
    days = [float(each.measured.toordinal()) for each in series.calibrations]
    values = [each.parameter.value for each in series.calibrations]
    weights = _weights([each.parameter.expanded_uncertainty for each in series.calibrations])
    total = math.fsum(weights)
    origin = math.fsum(w * day for w, day in zip(weights, days, strict=True)) / total
    level = math.fsum(w * value for w, value in zip(weights, values, strict=True)) / total
    years = [(day - origin) / DAYS_PER_YEAR for day in days]
    spread = math.fsum(w * year**2 for w, year in zip(weights, years, strict=True))
    lever = [w * year / spread for w, year in zip(weights, years, strict=True)]
    slope = math.fsum(part * (value - level) for part, value in zip(lever, values, strict=True))
    rest = math.fsum(
        w * (value - level - slope * year) ** 2 for w, value, year in zip(weights, values, years, strict=True)
    )
    degrees = len(days) - 2
    scatter = max(rest / degrees, (_RESOLUTION * max(map(abs, values))) ** 2)
    return Line(origin, level, slope, scatter / total, scatter / spread, degrees)


def forecast(line: Line, limit: float, last: date) -> Forecast | None:
    """Return when the amount of a parameter meets its limit, by Fieller's theorem.

    Of the line, and so of values as the next calibrations of the same kind will state them.

    Parameters
    ----------
    line
        Of the parameter.
    limit
        |y| ≤ TL, in the unit of the line.
    last
        Date of the last calibration.

    Returns
    -------
    Forecast or None
        None where the amount does not grow, where the slope is not known well enough for an interval, and
        where the limit is more than `MOST_YEARS_AHEAD` away.
    """
    rising = math.copysign(1.0, line.slope)
    squared_quantile = t_quantile(CONFIDENCE, line.degrees) ** 2
    steepness = line.slope**2 - squared_quantile * line.slope_variance
    if steepness <= 0 or rising * line.at(last) <= 0:
        return None
    gap = rising * limit - line.level
    # Where (a + b·t − TL)² = q²·(u²(a) + u²(b)·t²), with t from the mean date.
    middle = line.slope * gap / steepness
    half = math.sqrt(max(0.0, middle**2 - (gap**2 - squared_quantile * line.level_variance) / steepness))
    latest_day = last.toordinal() + MOST_YEARS_AHEAD * DAYS_PER_YEAR
    days = [line.origin + years * DAYS_PER_YEAR for years in (gap / line.slope, middle - half, middle + half)]
    if days[0] > latest_day:
        return None
    expected, earliest, latest = days
    return Forecast(_day(expected), _day(earliest), _day(latest) if latest <= latest_day else None)


def _weights(uncertainties: Sequence[float | None]) -> list[float]:
    """Return 1/U², their mean 1; all alike where an uncertainty is missing."""
    if not all(uncertainties):
        return [1.0] * len(uncertainties)
    weights = [1 / uncertainty**2 for uncertainty in uncertainties if uncertainty]
    mean = math.fsum(weights) / len(weights)
    return [weight / mean for weight in weights]


def _day(ordinal: float) -> date:
    return date.fromordinal(max(1, round(ordinal)))
