"""A parameter over the years: the line through its calibrations, its p-value, when it meets a limit.

Calibrations weigh by their stated uncertainties, wᵢ = 1/Uᵢ². How much they scatter is told by the series
itself and not by U: what is common to all of them, such as the error of one and the same interferometer,
shifts the whole line, leaves its slope alone, and must not be counted as scatter.

The test of H. B. Mann and M. G. Kendall knows only which of two values is the larger: one odd calibration,
however far off, cannot make a trend of it, and the values need not be normally distributed.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import date
from functools import cache
from itertools import combinations

import numpy as np

from zlmreport.fleet.records import LedgerEntry, RecordedParameter, State
from zlmreport.model.fitting.distributions import f_tail, normal_tail, t_quantile


@dataclass(frozen=True, slots=True)
class Calibration:
    """One point of a series."""

    measured: date  #: Date of the measurement.
    entry: LedgerEntry  #: The certificate.
    parameter: RecordedParameter  #: What it states.


@dataclass(frozen=True, slots=True)
class Series:
    """A parameter of one axis by one standard over time."""

    #: machine and axis: As in the ledger.
    machine: str
    axis: str
    #: standard, symbol and unit: As in the results file.
    standard: str
    symbol: str
    unit: str
    calibrations: tuple[Calibration, ...]  #: In the order of measurement; at least one.

    @property
    def axis_key(self) -> tuple[str, str]:
        """What tells its axis from others, as of a `Subject`."""
        return self.machine, self.axis

    @property
    def latest(self) -> RecordedParameter:
        """What the latest certificate states."""
        return self.calibrations[-1].parameter


def select_standing(entries: Iterable[LedgerEntry]) -> tuple[LedgerEntry, ...]:
    """Return the certificates that stand, in the order of measurement.

    A job that was made again, and one that amends, replaces what it said of the same measurement before.
    Drafts are not issued and failures state nothing.

    `entries`: Of the ledger, in its order.
    """
    standing: dict[tuple[str, str], LedgerEntry] = {}
    for entry in entries:  # not by the night: its clock may have been set back
        if entry.state is State.MADE and entry.measured:
            standing[entry.job, entry.measured] = entry
    return tuple(sorted(standing.values(), key=lambda entry: (entry.measured, entry.number)))


def list_series_of(certificates: Iterable[LedgerEntry]) -> tuple[Series, ...]:
    """Return every parameter of every axis over time, machine by machine."""
    found: defaultdict[tuple[str, str, str, str, str], list[Calibration]] = defaultdict(list)
    for entry in certificates:
        measured = date.fromisoformat(entry.measured)
        for parameter in entry.parameters:
            key = entry.machine, entry.axis, parameter.standard, parameter.symbol, parameter.unit
            found[key].append(Calibration(measured, entry, parameter))
    # The order within an axis is that of its certificates, and so that of its standards.
    return tuple(
        Series(*key, tuple(calibrations))
        for key, calibrations in sorted(found.items(), key=lambda item: item[0][:2])
    )


#: Up to so many values the chance is counted; beyond, S is as good as normally distributed.
_MOST_COUNTED = 40


def rank_p_value(values: Sequence[float]) -> float:
    """Return the chance of so many rises over falls, or falls over rises, where nothing drifts (two-sided).

    Equal values count as neither, and half a fall is taken as a whole one: with ties the chance comes out too
    large rather than too small.

    `values`: In the order of time, two or more.
    """
    surplus = abs(sum((later > earlier) - (later < earlier) for earlier, later in combinations(values, 2)))
    number = len(values)
    if number > _MOST_COUNTED:
        deviation = math.sqrt(number * (number - 1) * (2 * number + 5) / 18)
        return min(1.0, 2 * normal_tail((surplus - 1) / deviation))
    # With `falls` falls among n(n − 1)/2 pairs the surplus of rises is n(n − 1)/2 − 2·falls.
    most_falls = (number * (number - 1) // 2 - surplus + 1) // 2
    return min(1.0, 2 * _compute_chance_of_falls(number)[most_falls])


@cache
def _compute_chance_of_falls(number: int) -> tuple[float, ...]:
    """Return the chance of at most 0, 1, 2 … falls among the pairs of so many values in random order.

    The n-th value joins n − 1 others anywhere in their order, and so adds 0 to n − 1 falls, each as likely.
    """
    chances = np.ones(1)
    for joined in range(2, number + 1):
        chances = np.convolve(chances, np.full(joined, 1 / joined))
    return tuple(np.cumsum(chances).tolist())


DAYS_PER_YEAR = 365.25
#: Of the interval in which a limit is met.
CONFIDENCE = 0.95
#: A line through some quarters says nothing of what is farther ahead.
MOST_YEARS_AHEAD = 20
#: A smaller scatter, as a part of the largest value, is the rounding of doubles.
_RESOLUTION = 1e-9


@dataclass(frozen=True, slots=True)
class TrendLine:
    """A straight line, about the weighted mean of its dates, where level and slope are not correlated."""

    origin: float  #: Mean date t̄, in days of the calendar (`date.toordinal`).
    level: float  #: a: the line at t̄, µm or ″.
    slope: float  #: b, per year.
    #: level_variance and slope_variance: u²(a) and u²(b), from the scatter about the line.
    level_variance: float
    slope_variance: float
    degrees: int  #: Of freedom: n − 2.

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
class LimitCrossing:
    """When a line meets a limit."""

    expected: date  #: Where the line itself meets it.
    #: earliest and latest: Where lines meet it that the calibrations leave possible (95 %); `latest` is None
    #: where that is more than `MOST_YEARS_AHEAD` away.
    earliest: date
    latest: date | None


def fit_line_through(series: Series) -> TrendLine:
    """Return the line of weighted least squares through a series of three or more calibrations."""
    days = [float(each.measured.toordinal()) for each in series.calibrations]
    values = [each.parameter.value for each in series.calibrations]
    weights = _compute_weights([each.parameter.expanded_uncertainty for each in series.calibrations])
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
    return TrendLine(origin, level, slope, scatter / total, scatter / spread, degrees)


def forecast(line: TrendLine, limit: float, last: date) -> LimitCrossing | None:
    """Return when the amount of a parameter meets its limit, by Fieller's theorem.

    Of the line, and so of values as the next calibrations of the same kind will state them. None where the
    amount does not grow, where the slope is not known well enough for an interval, and where the limit is
    more than `MOST_YEARS_AHEAD` away.

    `limit`: |y| ≤ TL, in the unit of the line.
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
    return LimitCrossing(
        _make_day(expected), _make_day(earliest), _make_day(latest) if latest <= latest_day else None
    )


def _compute_weights(uncertainties: Sequence[float | None]) -> list[float]:
    """Return 1/U², their mean 1; all alike where an uncertainty is missing."""
    if not all(uncertainties):
        return [1.0] * len(uncertainties)
    weights = [1 / uncertainty**2 for uncertainty in uncertainties if uncertainty]
    mean = math.fsum(weights) / len(weights)
    return [weight / mean for weight in weights]


def _make_day(ordinal: float) -> date:
    return date.fromordinal(max(1, round(ordinal)))
