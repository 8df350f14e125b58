"""The data of an evaluation: findings, quantities, parameters with decisions, columns by position."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum

from zlmreport.evaluation.statistics import PositionStatistics
from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.units import Unit


class Conformity(Enum):
    """The statement."""

    MET = "pass"
    CONDITIONALLY_MET = "conditional-pass"
    CONDITIONALLY_FAILED = "conditional-fail"
    FAILED = "fail"
    UNDECIDED = "undecided"

    @property
    def conforms(self) -> bool | None:
        """Whether the limit counts as kept; None where nothing is decided."""
        if self is Conformity.UNDECIDED:
            return None
        return self in (Conformity.MET, Conformity.CONDITIONALLY_MET)


@dataclass(frozen=True, slots=True)
class Decision:
    """What a decision rule says of one value.

    Attributes
    ----------
    conformity
        The statement.
    acceptance_limit
        TL − w, m or rad: up to it the limit is kept. Negative where no value could keep it; None where the
        rule needs an uncertainty that was not evaluated.
    rejection_limit
        m or rad: beyond it the limit is exceeded. None as above.
    risk
        Probability that the statement is wrong: that the true value lies beyond the limit although the
        statement says that it keeps it, or the other way round, for a normally distributed value
        (JCGM 106:2012, clause 7). None where nothing is stated, or no uncertainty was evaluated.
    """

    conformity: Conformity
    acceptance_limit: float | None
    rejection_limit: float | None
    risk: float | None


class Basis(Enum):
    """How sure it is that a rule stands in the standard's text as given here.

    Only what is PUBLISHED may be printed as the standard's word; the rest is printed as the rule that
    the laboratory applied.
    """

    PUBLISHED = "published"
    APPLIED = "applied"


@dataclass(frozen=True, slots=True)
class Finding:
    """One requirement held against the test.

    Attributes
    ----------
    requirement
        What is asked.
    found
        What the test has.
    met
        True, False, or None where the job does not tell.
    basis
        Where the requirement is known from.
    undecided
        Symbols of parameters that the standard does not give for such a test: nothing is decided on their
        limits.
    """

    requirement: Words
    found: Words
    met: bool | None
    basis: Basis = Basis.APPLIED
    undecided: tuple[str, ...] = ()


class QuantityGroup(Enum):
    """The three kinds of deviation that all standards tell apart (ZLM, G 1.3)."""

    SYSTEMATIC = "systematic"
    RANDOM = "random"
    COMPOSITE = "composite"


@dataclass(frozen=True, slots=True)
class Quantity:
    """A parameter of the axis as a standard defines it.

    Attributes
    ----------
    symbol
        ASCII, as in the results file: ``A_fwd``.
    notation
        As printed (`zlmreport.language.formatting`): ``A↑``.
    name
        The name in the wording of the standard's edition.
    group
        Systematic, random or composite.
    formula
        The definition as printed, in notation.
    meaning
        What it says of a part made (or measured) on the machine, in a sentence.
    can_be_limited
        Whether a job may state a tolerance for it.
    printed_sign
        −1 where the edition prints the value with the sign opposite to the results file; else 1.
    unit
        Its own, where it is not a deviation of what was measured, as a slope; None for the measurand's.
    never_below
        Symbols of parameters whose amount it is never smaller than, by its definition, as E of M: a larger
        limit for one of them decides nothing.
    """

    symbol: str
    notation: str
    name: Words
    group: QuantityGroup
    formula: str
    meaning: Words
    can_be_limited: bool = True
    printed_sign: int = 1
    unit: Unit | None = None
    never_below: tuple[str, ...] = ()

    def unit_or(self, usual: Unit) -> Unit:
        """Return its own unit, or the usual one where it has none."""
        return self.unit or usual


@dataclass(frozen=True, slots=True)
class PositionQuantity:
    """A column of the table by position: one value at each target position.

    Attributes
    ----------
    symbol
        ASCII key, as in the results file: ``mean_fwd``.
    notation
        As printed: ``x̄_{i}↑``.
    name
        In words.
    """

    symbol: str
    notation: str
    name: Words


@dataclass(frozen=True, slots=True)
class Arithmetic:
    """What a standard's formulas give, for one test or for a stack of tests.

    Attributes
    ----------
    parameters : mapping of symbol to (...) array
        Parameters of the axis, m or rad. NaN where the test does not define the parameter: it is then
        not reported, and never zero.
    positions : mapping of symbol to (..., position) array
        The standard's own columns of the table by position, m or rad; NaN where not defined.
    """

    parameters: Mapping[str, FloatArray]
    positions: Mapping[str, FloatArray] = field(default_factory=dict)


class Least(Enum):
    """What U was raised to, where the budget gave less: to a flatter axis, the instrument's U, the CMC."""

    FLATTER_AXIS = "flatter-axis"
    INSTRUMENT = "instrument"
    LABORATORY = "cmc"


@dataclass(frozen=True, slots=True)
class EvaluatedParameter:
    """One value of the results table.

    Attributes
    ----------
    quantity
        What it is.
    value
        m or rad, unrounded, with the sign of the results file.
    limit
        Tolerance that the job states, m or rad; None without one.
    expanded_uncertainty, coverage_factor
        U = k·u + |known error| (m or rad) and k; None where not evaluated.
    decision
        What the decision rule says of the unrounded value; None without a limit.
    raised_to
        The bound to which U was raised; None where it is the budget's.
    axis_interval
        Where another test of the same plan, with the same set-up left in place, would find it, m or rad; None
        where one run tells nothing. Errors of the set-up are not in it.
    known_error
        What the value would change by if the errors of known size that are in the readings, as an expansion
        that is not corrected, were taken out of them, m or rad. U holds it whole.
    """

    quantity: Quantity
    value: float
    limit: float | None = None
    expanded_uncertainty: float | None = None
    coverage_factor: float | None = None
    decision: Decision | None = None
    raised_to: Least | None = None
    axis_interval: tuple[float, float] | None = None
    known_error: float = 0.0

    @property
    def conforms(self) -> bool | None:
        """Whether the limit counts as kept; None without a limit, or where the rule decides nothing."""
        return None if self.decision is None else self.decision.conformity.conforms

    @property
    def standard_uncertainty(self) -> float | None:
        """The u of the value, (U − |known error|)/k, m or rad; None where not evaluated."""
        if self.expanded_uncertainty is None or self.coverage_factor is None:
            return None
        return max(0.0, self.expanded_uncertainty - abs(self.known_error)) / self.coverage_factor

    @property
    def printed_value(self) -> float:
        """The value with the sign that the standard's edition prints, m or rad."""
        return self.quantity.printed_sign * self.value


@dataclass(frozen=True, slots=True)
class Change:
    """A parameter of one axis in two tests, as found and as left; one of the two may not define it."""

    before: EvaluatedParameter | None
    after: EvaluatedParameter | None

    @property
    def either(self) -> EvaluatedParameter:
        """One of the two, which are alike but for their values."""
        parameter = self.after or self.before
        assert parameter is not None  # noqa: S101 - a change is of a parameter that one of the tests defines
        return parameter

    @property
    def value(self) -> float | None:
        """As left − as found, m or rad; None where one of the two is not defined."""
        return self.after.value - self.before.value if self.before and self.after else None

    @property
    def expanded_uncertainty(self) -> float | None:
        """U of the change, m or rad: the sum of both U; None where one of the two is not known.

        Nobody knows how far the errors of the two tests are shared. Those that both have alike leave a
        change where they act alike on both, and add up in one where they do not, as a scale error on an
        axis whose slope was turned (JCGM 100, 5.2.2, note 1).
        """
        if not (self.before and self.after):
            return None
        before, after = self.before.expanded_uncertainty, self.after.expanded_uncertainty
        return before + after if before and after else None

    @property
    def coverage_factor(self) -> float | None:
        """The factor k of U, known errors apart, where u is the sum of both u; None where U is not known."""
        if self.before is None or self.after is None or self.expanded_uncertainty is None:
            return None
        before, after = self.before.standard_uncertainty, self.after.standard_uncertainty
        known = abs(self.before.known_error) + abs(self.after.known_error)
        return (self.expanded_uncertainty - known) / (before + after) if before and after else None


@dataclass(frozen=True, slots=True)
class PositionColumn:
    """A column of the table by position: the quantity, and its value at each target, shape (m,)."""

    quantity: PositionQuantity
    values: FloatArray


@dataclass(frozen=True, slots=True)
class MeanUncertainty:
    """Expanded uncertainty U = k·u of the mean deviations, m or rad; NaN where there is no mean."""

    coverage_factor: float  #: k.
    by_approach: FloatArray  #: (approach, position): U of x̄_i↑ and x̄_i↓.
    bidirectional: FloatArray  #: (position,): U of x̄_i.


@dataclass(frozen=True, slots=True)
class Evaluation:
    """A test evaluated by a standard.

    Attributes
    ----------
    standard
        The standard's identifier, edition included.
    designation
        As printed: ``ISO 230-2:2014``.
    title
        The standard's subject, in words.
    position_index
        The letter that counts target positions in the standard's symbols.
    measurements
        What was evaluated.
    statistics
        Means, standard deviations and counts by position.
    parameters
        The parameters that this test defines, in the standard's order.
    columns
        The standard's own columns of the table by position.
    findings
        Requirements of the standard, met or not.
    notes
        What a reader must know: formulas' source, corrections of errata, sign conventions.
    mean_uncertainty
        Of the mean deviations by position; None where not evaluated.
    uncertainty_is_complete
        Whether every usual contributor is in U, or declared negligible; a rule that uses U decides nothing
        from an incomplete one.
    is_method
        Whether it is a published method and nobody's standard: a heading says so.
    specification
        The document from which the limits were taken; empty where the job does not say.
    undefined
        Symbols of the parameters for which a limit is stated and which this test does not define.
    """

    standard: str
    designation: str
    title: Words
    position_index: str
    measurements: MeasurementSet
    statistics: PositionStatistics
    parameters: tuple[EvaluatedParameter, ...]
    columns: tuple[PositionColumn, ...]
    findings: tuple[Finding, ...]
    notes: tuple[Words, ...]
    mean_uncertainty: MeanUncertainty | None = None
    uncertainty_is_complete: bool = True
    is_method: bool = False
    specification: str = ""
    undefined: tuple[str, ...] = ()

    def parameter(self, symbol: str) -> EvaluatedParameter | None:
        """Return a parameter of the axis; None where the test does not define it."""
        for parameter in self.parameters:
            if parameter.quantity.symbol == symbol:
                return parameter
        return None

    def value(self, symbol: str) -> float | None:
        """Return a parameter's value, m or rad; None where the test does not define it."""
        parameter = self.parameter(symbol)
        return None if parameter is None else parameter.value

    def column(self, symbol: str) -> FloatArray:
        """Return one of the standard's own columns, shape (m,), m or rad."""
        for column in self.columns:
            if column.quantity.symbol == symbol:
                return column.values
        known = ", ".join(column.quantity.symbol for column in self.columns)
        raise KeyError(f"{self.standard} has no column {symbol!r} by position (it has: {known})")


def judge_together(evaluations: Iterable[Evaluation]) -> bool | None:
    """Return whether every stated limit is met; None without limits, or where one is not decided."""
    verdicts: set[bool | None] = set()
    for each in evaluations:
        verdicts.update(parameter.conforms for parameter in each.parameters if parameter.limit is not None)
        verdicts.update(None for _ in each.undefined)
    return False if False in verdicts else True if verdicts == {True} else None


def compare_parameters(before: Evaluation, after: Evaluation) -> tuple[Change, ...]:
    """Return each parameter that either of two tests defines by one standard, in the standard's order."""
    only_before = (each for each in before.parameters if after.parameter(each.quantity.symbol) is None)
    return (
        *(Change(before.parameter(each.quantity.symbol), each) for each in after.parameters),
        *(Change(each, None) for each in only_before),
    )
