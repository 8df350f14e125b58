"""Steps: which test of an axis differs from those before it by more than its tests scatter.

The scatter between tests is that of the axis itself, moderated by what the whole fleet has: variances that
are known by few tests each are drawn towards one that all of them know, the more so the better they agree
(G. K. Smyth, Statistical Applications in Genetics and Molecular Biology 3 (2004) article 3).
A test is held against the mean of those before it by Student's t with all these degrees of freedom.

Values, changes and scatter are in parts of the limit here, or in the unit of the ledger where there is none.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from statistics import fmean

from zlmreport.model.distributions import f_tail, normal_tail, t_quantile

#: What is less than this part of the limit is no news.
SMALL = 0.1
#: No smaller step need be seen, so that false alarms are rare where the scatter is small.
WANTED = 0.2
#: A step of so many scatters is seen at once in 95 % of all cases, with so many tests before it.
SEEN, LEAST_BEFORE = 5.0, 4
#: Normal quantile of 95 %, 1.64, and what is lost to a scatter not quite known and to a look at drifts.
_POWER = 1.80
#: A change that leads away from the limit is worth so much less of the chance for a false alarm.
_AWAY = 0.05
#: Chance of so steep a line by accident, above which a step is not held against it.
_STEEP = 0.005
#: Standard deviation of an effect at its largest, in scatters.
_EXPECTED = 5.0
#: Tests, the one that stands out among them, that are held against a drift.
_FOLLOWING = 3
#: No scatter is taken for smaller, in parts of the limit.
_LEAST_SCATTER = 1e-3
#: An axis that scatters more than the fleet lets expect with this chance is no longer judged by the fleet.
_WILD = 0.1
#: Tests whose scatter is held against that of all before them, and the chance of a false alarm.
_WINDOW, _SCATTER_LEVEL = 4, 1 / 4000


@dataclass(frozen=True, slots=True)
class Scatter:
    """What a fleet knows of a variance between tests: how large it is, and as if by how many tests."""

    variance: float = 0.0
    degrees: float = 0.0

    def moderated(self, squares: float, degrees: int) -> Scatter:
        """Return this with a sum of squares of an axis itself, of so many degrees of freedom."""
        trusted = self.degrees * self._trust(squares, degrees)
        total = trusted + degrees
        variance = (trusted * self.variance + squares) / total if total else 0.0
        return Scatter(max(variance, _LEAST_SCATTER**2), total)

    def _trust(self, squares: float, degrees: int) -> float:
        """Return how far the fleet may speak for an axis: the less, the plainer it scatters more."""
        if not degrees or not self.degrees or not self.variance:
            return 1.0
        return min(1.0, f_tail(squares / degrees / self.variance, degrees, self.degrees) / _WILD)


@dataclass(frozen=True, slots=True)
class Step:
    """A change of a parameter from one test to the next.

    Attributes
    ----------
    index
        Of the first test after it.
    change
        By how much.
    probability
        That it is a step, and neither chance nor a drift, if each of these is as likely beforehand.
    """

    index: int
    change: float
    probability: float


@dataclass(frozen=True, slots=True)
class Course:
    """What the tests of a parameter, one after another, say of steps.

    Attributes
    ----------
    steps
        That were borne out by the next test, and one of the latest test.
    since
        Tests since the last step that was borne out; odd ones, and a step of the latest, are left out.
    smallest
        The step that the next test would show in 95 % of all cases; None where too little is known.
    is_wilder
        Whether the latest tests scatter more than those before.
    scatter
        Between the tests since the last step, the whole fleet's in view.
    """

    steps: tuple[Step, ...]
    since: tuple[int, ...]
    smallest: float | None
    is_wilder: bool
    scatter: Scatter


def course(values: Sequence[float], fleet: Scatter, share: float = 1.0) -> Course:
    """Return the course of a parameter.

    Parameters
    ----------
    values
        In the order of measurement, one at the least.
    share
        Of the chance for a false alarm, where an axis has several parameters.
    """
    steps: list[Step] = []
    first, base = 0, [0]
    for index in range(1, len(values)):
        before = [values[each] for each in base]
        if not stands_out(before, values[index], fleet, share):
            base.append(index)
            continue
        is_latest = index + 1 == len(values)
        if not is_latest and not _is_borne_out(before, values[index], values[index + 1]):
            continue  # an odd one
        if not is_latest and _is_rather_drift(before, values[index : index + _FOLLOWING], fleet):
            base.append(index)
        else:
            change = values[index] - fmean(before)
            steps.append(Step(index, change, chances([*before, values[index]], fleet).last_step))
            if not is_latest:
                first, base = index, [index]
    since = [values[each] for each in base]
    scatter = fleet.moderated(_squares(since), len(since) - 1)
    return Course(
        tuple(steps),
        tuple(base),
        _smallest(len(since), scatter, share),
        _is_wilder(values[first:], fleet),
        scatter,
    )


def stands_out(before: Sequence[float], value: float, fleet: Scatter, share: float = 1.0) -> bool:
    """Whether a test differs from those before it, and from a drift that these show.

    Parameters
    ----------
    fleet, share
        As `course` has them.
    """
    number, mean = len(before), fmean(before)
    change = value - mean
    squares = _squares(before)
    scatter = fleet.moderated(squares, number - 1)
    if abs(change) < SMALL or scatter.degrees < 1:
        return False
    level = share * level_of(number) * (1 if change * mean >= 0 else _AWAY)
    if abs(change) <= _threshold(number, scatter, level):
        return False
    if number < 3:
        return True
    middle = (number - 1) / 2
    spread = math.fsum((each - middle) ** 2 for each in range(number))
    slope = math.fsum((each - middle) * y for each, y in enumerate(before)) / spread
    about = fleet.moderated(max(0.0, squares - slope**2 * spread), number - 2)
    if slope * change <= 0 or about.degrees < 1:
        return True
    if abs(slope) < _quantile(_STEEP / 2, about.degrees) * math.sqrt(about.variance / spread):
        return True
    ahead = number - middle
    rest = change - slope * ahead
    deviation = math.sqrt(about.variance * (1 + 1 / number + ahead**2 / spread))
    return rest * change > 0 and abs(rest) > max(SMALL, _quantile(level, about.degrees) * deviation)


def level_of(number: int) -> float:
    """Return the chance of a false alarm of one test towards the limit, after so many tests.

    It is such that a step of `SEEN` scatters is seen in 95 % of all cases where the scatter is known; so it
    falls as the history grows. With fewer tests than `LEAST_BEFORE` it stays, and less is seen.
    """
    known = max(number, LEAST_BEFORE)
    return normal_tail(SEEN / math.sqrt(1 + 1 / known) - _POWER)


@dataclass(frozen=True, slots=True)
class Chances:
    """How likely it is that nothing changed, that each test began a step (none for the first), or a drift."""

    nothing: float
    steps: tuple[float, ...]
    drift: float

    @property
    def last_step(self) -> float:
        """That the last test began a step."""
        return self.steps[-1]


def chances(values: Sequence[float], fleet: Scatter) -> Chances:
    """Return how likely nothing, a step, and a drift are, each taken for as likely beforehand as any other.

    The mean may be any, an effect is normal with a standard deviation of five scatters at its largest; the
    variance has the scatter of the fleet as its inverse-χ² prior: then the evidence is a closed expression.

    Parameters
    ----------
    values
        Two or more.
    """
    number = len(values)
    lines = [[0.0] * index + [1.0] * (number - index) for index in range(1, number)]
    lines.append([each / (number - 1) for each in range(number)])
    odds = [_odds(values, line, fleet) for line in lines]
    weights = [*(each / (number - 1) for each in odds[:-1]), odds[-1]]
    total = 1.0 + math.fsum(weights)
    return Chances(1.0 / total, (0.0, *(each / total for each in weights[:-1])), weights[-1] / total)


def _odds(values: Sequence[float], shape: Sequence[float], fleet: Scatter) -> float:
    """Return the evidence of an effect of this shape over that of nothing."""
    number = len(values)
    mean, middle = fmean(values), fmean(shape)
    length = math.fsum((each - middle) ** 2 for each in shape)
    along = math.fsum((x - middle) * (y - mean) for x, y in zip(shape, values, strict=True))
    gain = 1 + _EXPECTED**2 * length
    squares = max(fleet.degrees * fleet.variance + _squares(values), _LEAST_SCATTER**2)
    rest = squares - along**2 * _EXPECTED**2 / gain
    exponent = (fleet.degrees + number - 1) / 2
    return math.exp(min(600.0, -0.5 * math.log(gain) - exponent * math.log(max(rest / squares, 1e-12))))


def learned(samples: Iterable[tuple[float, int]]) -> Scatter:
    """Return what variances have in common, by the moments of their logarithms (Smyth 2004, section 6.2).

    Parameters
    ----------
    samples
        Each a sum of squares about a mean, and its degrees of freedom, one or more.
    """
    known = [(max(squares / degrees, _LEAST_SCATTER**2), degrees) for squares, degrees in samples]
    if len(known) < 2:
        return Scatter()
    logs = [math.log(variance) - digamma(d / 2) + math.log(d / 2) for variance, d in known]
    mean = fmean(logs)
    spread = math.fsum((each - mean) ** 2 for each in logs) / (len(logs) - 1)
    # As far as they differ by no more than chance lets them, they are taken for one.
    chance = 0.5 * spread * math.sqrt(4 / len(logs))
    excess = spread - fmean(trigamma(d / 2) for _, d in known) - chance
    most = float(sum(d for _, d in known))  # together they know no more than they all know
    degrees = min(most, 2 * _trigamma_inverse(excess)) if excess > 0 else most
    return Scatter(math.exp(mean + digamma(degrees / 2) - math.log(degrees / 2)), degrees)


def digamma(x: float) -> float:
    """Return ψ(x) for x > 0."""
    below = 0.0
    while x < 10:
        below, x = below - 1 / x, x + 1
    y = 1 / x**2
    return below + math.log(x) - 0.5 / x - y * (1 / 12 - y * (1 / 120 - y * (1 / 252 - y / 240)))


def trigamma(x: float) -> float:
    """Return ψ′(x) for x > 0."""
    below = 0.0
    while x < 10:
        below, x = below + 1 / x**2, x + 1
    y = 1 / x**2
    return below + 1 / x + y / 2 + y / x * (1 / 6 - y * (1 / 30 - y * (1 / 42 - y / 30)))


def _trigamma_inverse(value: float) -> float:
    """Return where ψ′ has a value above 0, by bisection: it falls."""
    low, high = 1e-6, 1e8
    for _ in range(100):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if trigamma(middle) > value else (low, middle)
    return low


def squares_before_the_last(values: Sequence[float], since: Sequence[int]) -> tuple[float, int]:
    """Return the sum of squares since the last step, and its degrees of freedom, without the latest test."""
    kept = [values[each] for each in since if each + 1 < len(values)]
    return _squares(kept), len(kept) - 1


def _squares(values: Sequence[float]) -> float:
    mean = fmean(values) if values else 0.0
    return math.fsum((value - mean) ** 2 for value in values)


def _is_rather_drift(before: Sequence[float], after: Sequence[float], fleet: Scatter) -> bool:
    """Whether a drift explains a test that stands out, and those after it, better than a step there does."""
    likely = chances([*before, *after], fleet)
    return likely.drift > likely.steps[len(before)]


def _is_borne_out(before: Sequence[float], value: float, following: float) -> bool:
    """Whether the next test lies nearer to the one that stands out than to those before it."""
    return abs(following - value) < abs(following - fmean(before))


def _smallest(number: int, scatter: Scatter, share: float) -> float | None:
    if scatter.degrees < 1:
        return None
    deviation = math.sqrt(scatter.variance * (1 + 1 / number))
    power = _quantile(0.05, scatter.degrees)
    return max(SMALL, _threshold(number, scatter, share * level_of(number)) + power * deviation)


def _threshold(number: int, scatter: Scatter, level: float) -> float:
    """Return by how much a test must differ from the mean of those before it."""
    deviation = math.sqrt(scatter.variance * (1 + 1 / number))
    return max(_quantile(level, scatter.degrees) * deviation, WANTED - _POWER * deviation)


def _is_wilder(values: Sequence[float], fleet: Scatter) -> bool:
    latest, before = values[-_WINDOW:], values[:-_WINDOW]
    if len(before) < _WINDOW:
        return False
    variance = _squares(latest) / (_WINDOW - 1)
    known = fleet.moderated(_squares(before), len(before) - 1)
    chance = f_tail(variance / known.variance, _WINDOW - 1, known.degrees)
    return variance > SMALL**2 and chance < _SCATTER_LEVEL


@cache
def _quantile(level: float, degrees: float) -> float:
    """Return Student's t that is exceeded upwards with this chance."""
    return t_quantile(1 - 2 * level, degrees)
