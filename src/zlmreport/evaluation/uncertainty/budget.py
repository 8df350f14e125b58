"""The uncertainty budget: contributions, distributions, coverage factor; those of lines joined.

The formulas are those of the contributors that ISO/TR 230-9:2005 lists for ISO 230-2, in this project's own
words; each takes a full range R of possible values, so that u = R/√12 (JCGM 100, 4.3.7). Lengths in m, angles
in rad.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from typing import Any

import numpy as np

from zlmreport.language import Words, named
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.measurand import Coordinate
from zlmreport.measurement.measurement_set import MeasurementSet

#: Probability that intervals y ± U hold the true value: 2 standard deviations of a normal distribution
#: (JCGM 100, 6.2.2 and table G.1).
COVERAGE_PROBABILITY = 0.9545
#: Of the mean deviations by position, whose errors are sums of many.
COVERAGE_FACTOR = 2.0


class Acts(Enum):
    """Which readings of a test share one error.

    Of a scale error all: zero at the datum, where the instrument is zeroed, and in proportion to the
    distance from it. Of an error that parts the directions (the radius of a probe that touches one face in
    each of them) all of the negative direction: the datum lies in the positive one. Of an error of the datum
    all, and alike. Of an error of position (the faces of a polygon, the nonlinearity of a sensor)
    all readings of one target position; of a face that is touched from one side only all
    readings of one target position in one direction. Of a drift those that are near in time
    (`zlmreport.evaluation.uncertainty.drift`). Of a fluctuation none: each reading has its own. Of an error
    round a circle all readings of an angle, and nearly those of the angles beside it
    (`zlmreport.evaluation.uncertainty.round_the_circle`); likewise of a centre that lies off. Of a wrong
    scale of the instrument all, in proportion to what was read.
    """

    ALONG_THE_LENGTH = "along-the-length"
    BETWEEN_DIRECTIONS = "between-directions"
    WITH_THE_READING = "with-the-reading"
    AT_THE_DATUM = "at-the-datum"
    AT_EACH_POSITION = "at-each-position"
    ROUND_THE_CIRCLE = "round-the-circle"
    OFF_CENTRE = "off-centre"
    AT_EACH_APPROACH = "at-each-approach"
    IN_TIME = "in-time"
    AT_EACH_READING = "at-each-reading"


class Distribution(Enum):
    """How the error is distributed over the values that it may have.

    ONE_SIDED is rectangular from zero to the whole range: a cosine error, that makes every length too
    short and none too long.
    """

    NORMAL = "normal"
    RECTANGULAR = "rectangular"
    TRIANGULAR = "triangular"
    ONE_SIDED = "one-sided"

    @property
    def range_over_standard_uncertainty(self) -> float:
        """The full range of the possible values in units of their root mean square (JCGM 100, 4.3.7, 4.3.9).

        A normal distribution has no ends: it is infinite.
        """
        return _RANGES[self]


_RANGES = {
    Distribution.NORMAL: math.inf,
    Distribution.RECTANGULAR: math.sqrt(12.0),
    Distribution.TRIANGULAR: math.sqrt(24.0),
    Distribution.ONE_SIDED: math.sqrt(3.0),
}


@dataclass(frozen=True, slots=True)
class Contribution:
    """A contribution to the uncertainty of the readings.

    Attributes
    ----------
    name
        What it comes from.
    standard_uncertainty
        u at full effect, m or rad: the root mean square of the error of a single reading, of one that acts
        along the length at the end of the measured length. About zero, for no reading is corrected for it:
        of a one-sided error it holds the mean too.
    acts
        Which readings share one error.
    distribution
        Of the error.
    stated
        The figure from which u was formed, as it is printed: ``U = 0.3 µm (k = 2)``.
    source
        Where that figure comes from.
    contributor
        Which usual contributor it is, by its key under ``uncertainty`` or ``instrument``; None for others.
    effect : (N,) array
        Which part of it acts on each reading, where its size changes from reading to reading: an error of the
        expansion coefficient acts as far as the machine is from 20 °C. None where it acts as `acts` says.
    shared_as
        By which name several measured lines share one error, as they were measured with one device, one after
        the other; empty where each has its own.
    """

    name: Words
    standard_uncertainty: float
    acts: Acts
    distribution: Distribution
    stated: Words
    source: Words
    contributor: str | None = None
    effect: FloatArray | None = field(default=None, compare=False)
    shared_as: str = ""


@dataclass(frozen=True, slots=True)
class KnownError:
    """An error of known size that nobody took out of the readings (JCGM 100, F.2.4.5).

    It is no distribution: U holds it whole, beside what is spread about it.
    """

    name: Words  #: What it comes from.
    correction: FloatArray  #: (N,): What would have to be added to each reading, m.
    #: stated and source: As in `Contribution`.
    stated: Words
    source: Words

    @property
    def largest(self) -> float:
        """The correction of the largest amount, with its sign, m."""
        return float(self.correction[np.argmax(np.abs(self.correction))]) if self.correction.size else 0.0


def write_of_the_reading(share: float, measurements: MeasurementSet, name: str) -> dict[str, Any]:
    """Return what a contribution is that acts in proportion to what was read: its size, and how it acts.

    `share`: u over the reading. `name`: Of the error. Lines that were read one after the other were read by
    one device and share its scale; what is read over time is read by as many devices as there are lines.
    """
    largest = float(np.nanmax(np.abs(measurements.deviation), initial=0.0))
    effect = measurements.deviation / largest if largest else np.zeros_like(measurements.deviation)
    is_of_one = measurements.axis.measurand.coordinate is not Coordinate.TIME
    return {
        "standard_uncertainty": share * largest,
        "acts": Acts.WITH_THE_READING,
        "effect": read_only_floats(effect),
        "shared_as": name if is_of_one else "",
    }


def from_range(full_range: float, distribution: Distribution) -> float:
    """Return u of an error that lies in a range: R/√12 if all its values are alike (JCGM 100, 4.3.7)."""
    return full_range / distribution.range_over_standard_uncertainty


def find_full_range(contribution: Contribution) -> float:
    """Return the range, m or rad, of an error whose values in it are all alike: a drift, a last digit."""
    return contribution.standard_uncertainty * Distribution.RECTANGULAR.range_over_standard_uncertainty


def compute_misalignment_range(misalignment: float, length: float) -> float:
    """Return the range of the cosine error, R²/(2L), m.

    A measuring line that departs from the axis by R over the length L sees L·cos(R/L) ≈ L − R²/(2L): the
    error lies between zero and this range, and never on the other side of zero.
    """
    return misalignment**2 / (2 * length) if length else 0.0


def compute_temperature_range(expansion_coefficient: float, length: float, temperature_range: float) -> float:
    """Return the range α·L·R(θ) of the error from the measured temperature of machine or device, m."""
    return abs(expansion_coefficient) * length * temperature_range


def compute_expansion_range(length: float, difference: float, coefficient_range: float) -> float:
    """Return the range L·ΔT·R(α) of the error from the expansion coefficient of machine or device, m.

    `length`: L, m.
    `difference`: ΔT, the largest distance of the temperature from 20 °C, K.
    `coefficient_range`: R(α), 1/K.
    """
    return length * abs(difference) * coefficient_range


@dataclass(frozen=True, slots=True)
class Budget:
    """The contributions of a measuring set-up.

    Attributes
    ----------
    contributions
        Those that were taken, at least one; those that act alike stand together.
    missing
        Usual contributors of which the job states nothing, by their keys: U is then incomplete.
    negligible
        Usual contributors that the laboratory declares negligible, by their keys, each with its reason.
    of_the_instrument
        U of the measuring instrument at the measured length, m or rad, where it acts in the usual way: no
        parameter that compares positions has a smaller U (ISO/TR 230-9). 0 for no such bound.
    least
        U below which the laboratory's accreditation lets it state none (its CMC), m or rad.
    uncorrected_expansion
        By how much the measured length was longer than at 20 °C, m: it is among the contributions. None
        where nobody knows it.
    known_errors
        Errors of known size that are in the readings: they are in no u, and in every U whole.
    difference
        ΔT, the largest distance of the machine's temperature from 20 °C, K; 0 where nobody knows it.
    tests
        Of several measured lines that are evaluated together: the budget of each, by its name; it then has no
        contributions of its own.
    """

    contributions: tuple[Contribution, ...]
    missing: tuple[str, ...] = ()
    negligible: tuple[tuple[str, str], ...] = ()
    of_the_instrument: float = 0.0
    least: float = 0.0
    uncorrected_expansion: float | None = 0.0
    known_errors: tuple[KnownError, ...] = ()
    difference: float = 0.0
    tests: Mapping[str, Budget] = field(default_factory=dict)

    @property
    def lines(self) -> tuple[Budget, ...]:
        """What has contributions: the budget of each of several measured lines, or the budget itself."""
        return tuple(self.tests.values()) or (self,)

    @property
    def is_complete(self) -> bool:
        """Whether every usual contributor is stated or declared negligible."""
        return not self.missing

    def acting(self, acts: Acts) -> tuple[Contribution, ...]:
        """Return the contributions that act in one way."""
        return tuple(each for each in self.contributions if each.acts is acts)

    def steady(self, acts: Acts) -> tuple[Contribution, ...]:
        """Return those of them whose size is the same at all readings."""
        return tuple(each for each in self.acting(acts) if each.effect is None)

    @property
    def changing(self) -> tuple[Contribution, ...]:
        """The contributions whose size changes from reading to reading."""
        return tuple(each for each in self.contributions if each.effect is not None)

    def variance(self, acts: Acts) -> float:
        """Return the sum of u² of the steady contributions that act in one way, m² or rad²."""
        return math.fsum(each.standard_uncertainty**2 for each in self.steady(acts))

    @property
    def correction(self) -> FloatArray | None:
        """What all known errors together would have to add to each reading, (N,), m; None without any."""
        return np.sum([each.correction for each in self.known_errors], axis=0) if self.known_errors else None

    @property
    def standard_uncertainty(self) -> float:
        """The combined u of a single reading at the end of the measured length, m or rad."""
        return math.sqrt(math.fsum(each.standard_uncertainty**2 for each in self.contributions))

    def share(self, contribution: Contribution) -> float:
        """Return the share of a contribution in the variance of such a reading, from 0 to 1."""
        combined = self.standard_uncertainty
        return (contribution.standard_uncertainty / combined) ** 2 if combined else 0.0


@dataclass(frozen=True, slots=True)
class NoBudget:
    """What stands in the place of a budget that cannot be made.

    Attributes
    ----------
    reason
        Why it cannot, in words.
    missing, negligible, uncorrected_expansion
        As in `Budget`.
    """

    reason: Words
    missing: tuple[str, ...] = ("instrument",)
    negligible: tuple[tuple[str, str], ...] = ()
    uncorrected_expansion: float | None = 0.0

    @property
    def is_complete(self) -> bool:
        """Never: nothing is known of the instrument."""
        return False


def compute_effect_along(target_positions: FloatArray) -> FloatArray:
    """Return what part of an error along the length acts at each target position, shape (m,).

    Nothing at the datum, which is the first target position; all of it at the last one.
    """
    distance = target_positions - target_positions[0]
    length = float(distance[-1])
    return np.asarray(distance / length) if length else distance


def join_budgets(
    budgets: Mapping[str, Budget | NoBudget],
    brought: Iterable[Mapping[str, Sequence[Contribution]]] = (),
    demanded: Iterable[str] = (),
    negligible: Iterable[tuple[str, str]] = (),
) -> Budget | NoBudget:
    """Return the budget of an evaluation of several lines; none where one of them has none.

    `budgets`: Of each line, by its name.
    `brought`: What standards know of the errors of a line beside that, as that of the artefact that joins two
        lines.
    `demanded`: Contributors that the evaluation asks for, by their keys.
    `negligible`: Contributors that the laboratory declares negligible, by their keys, each with its reason.
    """
    tests: dict[str, Budget] = {}
    lacking = tuple(dict.fromkeys(each for of in budgets.values() for each in of.missing))
    declared = dict(pair for of in budgets.values() for pair in of.negligible) | dict(negligible)
    longer = None if any(of.uncorrected_expansion is None for of in budgets.values()) else 0.0
    more = [each for of in brought for each in of.items()]
    considered = {each.contributor for _, of in more for each in of} | declared.keys()
    missing = (*lacking, *(each for each in demanded if each not in considered))
    for name, of in budgets.items():
        if isinstance(of, NoBudget):
            return NoBudget(named(name, of.reason), missing, tuple(declared.items()), longer)
        own = (*of.contributions, *(each for test, found in more if test == name for each in found))
        ordered = tuple(each for acts in Acts for each in own if each.acts is acts)
        tests[name] = replace(of, contributions=ordered)
    return Budget((), missing, tuple(declared.items()), uncorrected_expansion=longer, tests=tests)
