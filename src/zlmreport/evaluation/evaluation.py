"""The result of evaluating one test by one standard."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

from zlmreport.evaluation.conformity import Decision
from zlmreport.evaluation.quantity import PositionQuantity, Quantity
from zlmreport.evaluation.requirements import Finding
from zlmreport.evaluation.statistics import PositionStatistics
from zlmreport.language import Words
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.quantities.arrays import FloatArray


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
    """What an uncertainty was raised to, where the budget gave less: that of the instrument, or the CMC."""

    INSTRUMENT = "instrument"
    LABORATORY = "cmc"


@dataclass(frozen=True, slots=True)
class Parameter:
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
        U = k·u (m or rad) and k; None where not evaluated.
    decision
        What the decision rule says of the unrounded value; None without a limit.
    raised_to
        The bound to which U was raised; None where it is the budget's.
    axis_interval
        Where another test of the same plan would find it, m or rad; None where one run tells nothing.
    """

    quantity: Quantity
    value: float
    limit: float | None = None
    expanded_uncertainty: float | None = None
    coverage_factor: float | None = None
    decision: Decision | None = None
    raised_to: Least | None = None
    axis_interval: tuple[float, float] | None = None

    @property
    def conforms(self) -> bool | None:
        """Whether the limit counts as kept; None without a limit, or where the rule decides nothing."""
        return None if self.decision is None else self.decision.conformity.conforms

    @property
    def standard_uncertainty(self) -> float | None:
        """u, m or rad; None where not evaluated."""
        if self.expanded_uncertainty is None or self.coverage_factor is None:
            return None
        return self.expanded_uncertainty / self.coverage_factor

    @property
    def printed_value(self) -> float:
        """The value with the sign that the standard's edition prints, m or rad."""
        return self.quantity.printed_sign * self.value


@dataclass(frozen=True, slots=True)
class PositionColumn:
    """A column of the table by position: the quantity, and its value at each target, shape (m,)."""

    quantity: PositionQuantity
    values: FloatArray


@dataclass(frozen=True, slots=True)
class MeanUncertainty:
    """Expanded uncertainty U = k·u of the mean deviations, m or rad; NaN where there is no mean.

    Attributes
    ----------
    coverage_factor
        k.
    by_approach : (approach, position) array
        U of x̄_i↑ and x̄_i↓.
    bidirectional : (position,) array
        U of x̄_i.
    """

    coverage_factor: float
    by_approach: FloatArray
    bidirectional: FloatArray


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
    """

    standard: str
    designation: str
    title: Words
    position_index: str
    measurements: MeasurementSet
    statistics: PositionStatistics
    parameters: tuple[Parameter, ...]
    columns: tuple[PositionColumn, ...]
    findings: tuple[Finding, ...]
    notes: tuple[Words, ...]
    mean_uncertainty: MeanUncertainty | None = None
    uncertainty_is_complete: bool = True
    is_method: bool = False

    def parameter(self, symbol: str) -> Parameter | None:
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
