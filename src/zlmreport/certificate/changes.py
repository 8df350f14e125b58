"""Parameters of an axis before and after it was adjusted, side by side."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TypeAlias, cast

from zlmreport.certificate import conformity
from zlmreport.certificate.document import Align, Cell, Column, RowGroup, Symbol, Table
from zlmreport.certificate.values import limit
from zlmreport.evaluation.evaluation import Evaluation, Parameter
from zlmreport.language import Words
from zlmreport.presenting.amounts import written
from zlmreport.presenting.writer import NOTHING, Writer

#: Evaluations of both measurements by one standard: as found, as left.
Pair: TypeAlias = tuple[Evaluation, Evaluation]

_BEFORE = Words(en="As found", de="Vorher")
_AFTER = Words(en="As left", de="Nachher")
_CHANGES = Words(
    en="Parameters as found and as left; change = as left − as found, of unrounded values",
    de="Kenngrößen vorher und nachher; Änderung = nachher − vorher, aus ungerundeten Werten",
)
_LIMITS = Words(en="Limits as found and as left", de="Grenzwerte vorher und nachher")


def changes(pairs: Sequence[Pair], writer: Writer) -> Table:
    """Return the table of parameters before and after, with their uncertainties where these are known."""
    unit = writer.deviation_unit.symbol
    known = any(
        each.expanded_uncertainty is not None for pair in pairs for one in pair for each in one.parameters
    )
    uncertainty = [Column(Symbol("U"), unit, Align.RIGHT)] if known else []
    columns = (
        Column(writer.say(Words(en="Symbol", de="Zeichen"))),
        Column(writer.say(Words(en="Parameter", de="Kenngröße"))),
        Column(writer.say(_BEFORE), unit, Align.RIGHT),
        *uncertainty,
        Column(writer.say(_AFTER), unit, Align.RIGHT),
        *uncertainty,
        Column(writer.say(Words(en="Change", de="Änderung")), unit, Align.RIGHT),
    )
    groups = tuple(
        RowGroup(
            tuple(_change(*each, writer, with_uncertainty=known) for each in _parameters(*pair)),
            pair[1].designation,
        )
        for pair in pairs
    )
    return Table(writer.say(_CHANGES), columns, groups)


def _change(
    before: Parameter | None, after: Parameter | None, writer: Writer, *, with_uncertainty: bool
) -> tuple[Cell, ...]:
    quantity = _either(before, after).quantity
    change = after.printed_value - before.printed_value if before and after else math.nan
    parts = 2 if with_uncertainty else 1
    return (
        Symbol(quantity.notation),
        writer.say(quantity.name),
        *(written(before, writer) if before else (NOTHING, NOTHING))[:parts],
        *(written(after, writer) if after else (NOTHING, NOTHING))[:parts],
        writer.deviation(change),
    )


def limits(pairs: Sequence[Pair], writer: Writer) -> Iterator[Table]:
    """Yield the table of what is stated of the limits before and after, where the job states any."""
    columns = (
        Column(writer.say(Words(en="Symbol", de="Zeichen"))),
        Column(
            writer.say(Words(en="Limit", de="Grenzwert")) + writer.marks.after("evaluate.tolerances"),
            writer.deviation_unit.symbol,
            Align.RIGHT,
        ),
        Column(writer.say(_BEFORE)),
        Column(writer.say(_AFTER)),
    )
    groups = tuple(
        RowGroup(
            tuple(
                _verdicts(before, after, writer)
                for before, after in _parameters(*pair)
                if _either(before, after).limit is not None
            ),
            pair[1].designation,
        )
        for pair in pairs
    )
    limited = tuple(group for group in groups if group.rows)
    if limited:
        yield Table(writer.say(_LIMITS), columns, limited)


def _verdicts(before: Parameter | None, after: Parameter | None, writer: Writer) -> tuple[Cell, ...]:
    either = _either(before, after)
    return (
        Symbol(either.quantity.notation),
        limit(either, writer),
        conformity.verdict(before, writer) if before else NOTHING,
        conformity.verdict(after, writer) if after else NOTHING,
    )


def _parameters(before: Evaluation, after: Evaluation) -> Iterator[tuple[Parameter | None, Parameter | None]]:
    """Yield each parameter that either measurement defines, in the standard's order."""
    for parameter in after.parameters:
        yield before.parameter(parameter.quantity.symbol), parameter
    for parameter in before.parameters:
        if after.parameter(parameter.quantity.symbol) is None:
            yield parameter, None


def _either(before: Parameter | None, after: Parameter | None) -> Parameter:
    """Return one of two parameters that are alike but for their values; one of the two is there."""
    return cast("Parameter", after or before)
