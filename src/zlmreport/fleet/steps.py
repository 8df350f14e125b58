"""Steps of a parameter: which test of an axis differs from those before by more than the scatter.

The scatter between tests is that of the axis itself, with what the whole fleet knows of it in view
(`zlmreport.fleet.scatter`). A test is named if so large a difference from the mean of those before it is
less likely than a false alarm may be.

Values, changes and scatter are in parts of the limit here, or in the unit of the ledger where there is none.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from statistics import fmean

from zlmreport.fleet.scatter import ScatterLikelihood
from zlmreport.model.fitting.distributions import normal_tail

#: What is less than this part of the limit is no news.
SMALL = 0.1
#: No smaller step need be seen, so that false alarms are rare where the scatter is small.
WANTED = 0.2
#: A step of so many scatters is seen at once in 95 % of all cases, from so many tests before it on.
SEEN, LEAST_BEFORE = 5.0, 4
#: Normal quantile of 95 %, 1.64, and what is lost to a scatter not quite known and to a look at drifts.
_POWER = 1.85
#: Chance of a false alarm of one test towards the limit: of 300 axes about one a night, and never more.
_MOST_FALSE = 1 / 340
#: Of the steps as large as the smallest that is printed, this part is missed, and one in a hundred more by
#: what is lost to a scatter not quite known.
_MISSED = 0.04
#: A change that leads away from the limit is worth so much less of the chance for a false alarm.
_AWAY = 0.02
#: Chance of so steep a line by accident, above which a step is not held against it.
_STEEP = 0.005
#: Standard deviation of an effect at its largest, in scatters.
_EXPECTED = 5.0
#: Tests, the one that stands out among them, that are held against a drift.
_FOLLOWING = 3
#: Tests whose scatter is held against that of all before them, and the chance of a false alarm.
_WINDOW, _SCATTER_LEVEL = 4, 1 / 4000


@dataclass(frozen=True, slots=True)
class ParameterStep:
    """A change of a parameter from one test to the next."""

    index: int  #: Of the first test after it.
    change: float  #: By how much.
    #: That it is a step, and neither chance nor a drift, if each of these is as likely beforehand.
    probability: float


@dataclass(frozen=True, slots=True)
class ParameterCourse:
    """What the tests of a parameter, one after another, say of steps."""

    steps: tuple[ParameterStep, ...]  #: That were borne out by the next test, and one of the latest test.
    #: Tests since the last step that was borne out; odd ones, and a step of the latest, are left out.
    since: tuple[int, ...]
    is_wilder: bool  #: Whether the latest tests scatter more than those before.
    scatter: ScatterLikelihood  #: Between the tests since the last step, the whole fleet's in view.
    share: float  #: Of the chance for a false alarm.

    @property
    def smallest(self) -> float | None:
        """The step towards the limit that the next test would show in 95 % of all cases.

        None where too little is known.
        """
        if self.scatter.degrees < 1:
            return None
        wider = math.sqrt(1 + 1 / len(self.since))
        level = self.share * compute_level_of(len(self.since))
        threshold = max(
            wider * self.scatter.compute_quantile(level), _compute_least(wider * self.scatter.deviation)
        )
        return max(SMALL, threshold + wider * self.scatter.compute_quantile(_MISSED))


def judge_course(values: Sequence[float], fleet: ScatterLikelihood, share: float = 1.0) -> ParameterCourse:
    """Return the course of a parameter.

    `values`: In the order of measurement, one at the least.
    `share`: Of the chance for a false alarm, where an axis has several parameters.
    """
    steps: list[ParameterStep] = []
    first, base = 0, [0]
    for index in range(1, len(values)):
        before = [values[each] for each in base]
        if not _is_standing_out(before, values[index], fleet, share):
            base.append(index)
            continue
        is_latest = index + 1 == len(values)
        if not is_latest and not _is_borne_out(before, values[index], values[index + 1]):
            continue  # an odd one
        if not is_latest and _is_rather_drift(before, values[index : index + _FOLLOWING], fleet):
            base.append(index)
        else:
            change = values[index] - fmean(before)
            chances = compute_chances([*before, values[index]], fleet)
            steps.append(ParameterStep(index, change, chances.steps[-1]))
            if not is_latest:
                first, base = index, [index]
    since = [values[each] for each in base]
    scatter = fleet.update(sum_squares_about_mean(since), len(since) - 1)
    return ParameterCourse(tuple(steps), tuple(base), _is_wilder(values[first:], fleet), scatter, share)


def _is_standing_out(before: Sequence[float], value: float, fleet: ScatterLikelihood, share: float) -> bool:
    """Whether a test differs from those before it, and from a drift that these show.

    `fleet`, `share`: As `judge_course` has them.
    """
    number, mean = len(before), fmean(before)
    change = value - mean
    if abs(change) < SMALL:
        return False
    squares = sum_squares_about_mean(before)
    scatter = fleet.update(squares, number - 1)
    level = share * compute_level_of(number) * (1 if change * mean >= 0 else _AWAY)
    wider = math.sqrt(1 + 1 / number)
    if (
        scatter.degrees < 1
        or abs(change) <= _compute_least(wider * scatter.deviation)
        or scatter.compute_chance_of_change(abs(change) / wider) >= level
    ):
        return False
    if number < 3:
        return True
    middle = (number - 1) / 2
    spread = math.fsum((each - middle) ** 2 for each in range(number))
    slope = math.fsum((each - middle) * y for each, y in enumerate(before)) / spread
    about = fleet.update(max(0.0, squares - slope**2 * spread), number - 2)
    if slope * change <= 0 or about.compute_chance_of_change(abs(slope) * math.sqrt(spread)) > _STEEP / 2:
        return True
    ahead = number - middle
    rest = abs(change) - abs(slope) * ahead
    return (
        rest > SMALL
        and about.compute_chance_of_change(rest / math.sqrt(1 + 1 / number + ahead**2 / spread)) < level
    )


def compute_level_of(number: int) -> float:
    """Return the chance of a false alarm of one test towards the limit, after so many tests.

    It is such that a step of `SEEN` scatters is seen in 95 % of all cases; so it falls as the history grows.
    """
    return min(_MOST_FALSE, normal_tail(SEEN / math.sqrt(1 + 1 / number) - _POWER))


@dataclass(frozen=True, slots=True)
class Chances:
    """How likely it is that nothing changed, that each test began a step (none for the first), or a drift."""

    nothing: float
    steps: tuple[float, ...]
    drift: float


def compute_chances(values: Sequence[float], fleet: ScatterLikelihood) -> Chances:
    """Return how likely nothing, a step, and a drift are, each taken for as likely beforehand as any other.

    The mean may be any, an effect is normal with a standard deviation of five scatters at its largest; so the
    evidence is a closed expression for each scatter that the fleet lets expect.

    `values`: Two or more.
    """
    number = len(values)
    lines = [[0.0] * index + [1.0] * (number - index) for index in range(1, number)]
    lines.append([each / (number - 1) for each in range(number)])
    odds = [_compute_odds(values, line, fleet) for line in lines]
    weights = [*(each / (number - 1) for each in odds[:-1]), odds[-1]]
    total = 1.0 + math.fsum(weights)
    return Chances(1.0 / total, (0.0, *(each / total for each in weights[:-1])), weights[-1] / total)


def _compute_odds(values: Sequence[float], shape: Sequence[float], fleet: ScatterLikelihood) -> float:
    """Return the evidence of an effect of this shape over that of nothing."""
    number = len(values)
    mean, middle = fmean(values), fmean(shape)
    length = math.fsum((each - middle) ** 2 for each in shape)
    along = math.fsum((x - middle) * (y - mean) for x, y in zip(shape, values, strict=True))
    gain = 1 + _EXPECTED**2 * length
    squares = sum_squares_about_mean(values)
    rest = max(0.0, squares - along**2 * _EXPECTED**2 / gain)
    more = fleet.compute_evidence(rest, number - 1) - fleet.compute_evidence(squares, number - 1)
    return math.exp(min(600.0, more - 0.5 * math.log(gain)))


def sum_squares_between(values: Sequence[float], steps: Sequence[ParameterStep]) -> tuple[float, int]:
    """Return the sum of squares of what lies between steps, and its degrees of freedom.

    Odd ones are in it: to leave out what is far off would make the scatter look smaller than it is.
    """
    bounds = [0, *(each.index for each in steps), len(values)]
    parts = [values[begin:end] for begin, end in pairwise(bounds)]
    return math.fsum(map(sum_squares_about_mean, parts)), sum(max(0, len(each) - 1) for each in parts)


def sum_squares_about_mean(values: Sequence[float]) -> float:
    """Return Σ(y − ȳ)²; 0 of no values."""
    mean = fmean(values) if values else 0.0
    return math.fsum((value - mean) ** 2 for value in values)


def _is_rather_drift(before: Sequence[float], after: Sequence[float], fleet: ScatterLikelihood) -> bool:
    """Whether a drift explains a test that stands out, and those after it, better than a step there does."""
    likely = compute_chances([*before, *after], fleet)
    return likely.drift > likely.steps[len(before)]


def _is_borne_out(before: Sequence[float], value: float, following: float) -> bool:
    """Whether the next test lies nearer to the one that stands out than to those before it."""
    return abs(following - value) < abs(following - fmean(before))


def _compute_least(deviation: float) -> float:
    """Return the least difference that is looked at, so that no step below `WANTED` need be seen."""
    return WANTED - _POWER * deviation


def _is_wilder(values: Sequence[float], fleet: ScatterLikelihood) -> bool:
    latest, before = values[-_WINDOW:], values[:-_WINDOW]
    if len(before) < _WINDOW:
        return False
    squares, degrees = sum_squares_about_mean(latest), _WINDOW - 1
    known = fleet.update(sum_squares_about_mean(before), len(before) - 1)
    return squares > SMALL**2 * degrees and known.compute_chance_of_squares(squares, degrees) < _SCATTER_LEVEL
