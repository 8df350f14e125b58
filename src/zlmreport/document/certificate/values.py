"""The table of parameters: columns of value, U, k, limit and conformity, and what stands in them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from zlmreport.document.blocks import Align, Cell, Column, Symbol
from zlmreport.document.certificate import conformity
from zlmreport.document.writer import (
    NOTHING,
    Writer,
    add_unit,
    is_mixed,
    write_rounded_together,
    write_with_uncertainty,
)
from zlmreport.language import Words, named
from zlmreport.language.formatting import write_fixed_number, write_plain

if TYPE_CHECKING:
    from zlmreport.evaluation.evaluation import EvaluatedParameter, Evaluation, PositionQuantity, Quantity

_SYMBOL = Words("Symbol")
_PARAMETER = Words("Parameter")
_VALUE = Words("Value")
_AXIS, _ANOTHER_TEST = Words("Axis, 95 %"), Words("Another test, 95 %")
_LIMIT = Words("Limit")
_CONFORMITY = Words("Conformity")
_DECIMALS_OF_K = 2
_TOLD_APART = Words("{caption}. U is the expanded uncertainty of measurement; {others}")


def is_of_axis(evaluation: Evaluation) -> bool:
    """Tell whether what is evaluated belongs to an axis, and not to an item that has none, as a plate."""
    return evaluation.measurements.axis.measurand.item is None


@dataclass(frozen=True, slots=True)
class Values:
    """The columns of a table that say how large parameters are."""

    writer: Writer  #: Writes them.
    #: has_uncertainty, has_limits and has_interval: Whether any parameter in the table has an uncertainty, a
    #: limit, or an interval of the axis that is to be shown: without one there is no column.
    has_uncertainty: bool
    has_limits: bool
    has_interval: bool = False
    interval: Words = _AXIS  #: How its column is headed; what is no axis has none.
    is_mixed: bool = False  #: Whether they have different units: each value then has its own beside it.

    @classmethod
    def of(cls, evaluations: Iterable[Evaluation], writer: Writer, *, with_interval: bool = False) -> Values:
        """Return the columns for the parameters of evaluations, with the interval of the axis if wanted."""
        evaluations = tuple(evaluations)
        parameters = [parameter for each in evaluations for parameter in each.parameters]
        return cls(
            writer,
            any(parameter.expanded_uncertainty is not None for parameter in parameters),
            any(parameter.limit is not None for parameter in parameters),
            with_interval and any(parameter.axis_interval is not None for parameter in parameters),
            _AXIS if all(map(is_of_axis, evaluations)) else _ANOTHER_TEST,
            is_mixed(parameters, writer),
        )

    def list_columns(self, parameter: Words = _PARAMETER) -> Iterator[Column]:
        """Yield the headings of a row's symbol, of its parameter, and of what `list_cells` are."""
        say, unit = self.writer.say, "" if self.is_mixed else self.writer.deviation_unit.symbol
        yield Column(say(_SYMBOL))
        yield Column(say(parameter))
        yield Column(say(_VALUE), unit, Align.RIGHT)
        if self.has_uncertainty:
            yield Column(Symbol("U"), unit, Align.RIGHT)
            yield Column(Symbol("k"), align=Align.RIGHT)
        if self.has_interval:
            yield Column(say(self.interval), unit, Align.RIGHT)
        if self.has_limits:
            yield Column(
                say(_LIMIT) + self.writer.marks.write_after("evaluate.tolerances"), unit, Align.RIGHT
            )
            yield Column(say(_CONFORMITY))

    def list_cells(self, parameter: EvaluatedParameter) -> Iterator[Cell]:
        """Yield how large a parameter is, cell by cell."""
        value, uncertainty = write_with_uncertainty(parameter, self.writer)
        yield self._add_unit(value, parameter)
        if self.has_uncertainty:
            yield self._add_unit(uncertainty, parameter)
            yield write_coverage_factor(parameter, self.writer)
        if self.has_interval:
            yield self._add_unit(_write_interval(parameter, self.writer), parameter)
        if self.has_limits:
            yield self._add_unit(limit(parameter, self.writer), parameter)
            yield conformity.make_verdict_cell(parameter, self.writer)

    def _add_unit(self, number: str, parameter: EvaluatedParameter) -> str:
        """Write the unit beside a number, where the column has none."""
        return add_unit(number, parameter.quantity, self.writer) if self.is_mixed else number


def tell_columns_apart(
    caption: Words,
    quantities: Iterable[Quantity | PositionQuantity],
    *,
    has_uncertainty: bool,
    writer: Writer,
) -> tuple[str, tuple[str, ...]]:
    """Write a table's caption; where U heads a column, it tells U from the quantities that begin with U.

    Returns it with the notations of the symbols of which it speaks.
    """
    others = {each.notation: writer.say(each.name) for each in quantities if each.notation[:1] == "U"}
    if not (has_uncertainty and others):
        return writer.say(caption), ()
    told = ", ".join(writer.say(named(write_plain(notation), name)) for notation, name in others.items())
    return writer.say(_TOLD_APART.given(caption=caption, others=told)), ("U", *others)


def write_coverage_factor(parameter: EvaluatedParameter, writer: Writer) -> str:
    """Write k; nothing where there is no uncertainty to cover."""
    if not parameter.expanded_uncertainty or parameter.coverage_factor is None:
        return NOTHING
    return write_fixed_number(parameter.coverage_factor, _DECIMALS_OF_K, writer.language.decimal_sign)


def _write_interval(parameter: EvaluatedParameter, writer: Writer) -> str:
    """Write where another test of the same plan would find a parameter, with the sign that is printed."""
    if parameter.axis_interval is None:
        return NOTHING
    writer = writer.of_quantity(parameter.quantity)
    ends = sorted(parameter.quantity.printed_sign * end for end in parameter.axis_interval)
    return " … ".join(write_rounded_together(end, (ends[1] - ends[0]) / 2, writer)[0] for end in ends)


def limit(parameter: EvaluatedParameter, writer: Writer) -> str:
    """Write a parameter's limit as the job states it, with no digits added."""
    if parameter.limit is None:
        return NOTHING
    return writer.number(writer.of_quantity(parameter.quantity).deviation_unit.from_si(parameter.limit))
