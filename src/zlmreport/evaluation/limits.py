"""Limits that contradict each other: a parameter that holds another one has the smaller limit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from zlmreport.evaluation.evaluation import Evaluation, Parameter
from zlmreport.language import Words
from zlmreport.language.formatting import write_plain
from zlmreport.measurement.units import with_unit

_EXCHANGED = Words(
    "{designation}: the limit of {part}, {larger}, is above that of {whole}, {smaller}, and {whole} is never "
    "smaller than {part}: nothing that conforms by {whole} can fail by {part}"
)


def find_contradicting_limits(evaluation: Evaluation) -> Iterator[Words]:
    """Yield the limits that can decide nothing beside that of a parameter that is never smaller."""
    limited = {each.quantity.symbol: each for each in evaluation.parameters if each.limit is not None}
    for whole in limited.values():
        parts = set(_list_parts(whole.quantity.never_below, evaluation))
        for symbol, part in limited.items():
            if symbol in parts and (part.limit or 0.0) > (whole.limit or 0.0):
                yield _EXCHANGED.given(
                    designation=evaluation.designation,
                    part=write_plain(part.quantity.notation),
                    whole=write_plain(whole.quantity.notation),
                    larger=_write_limit(part, evaluation),
                    smaller=_write_limit(whole, evaluation),
                )


def _list_parts(symbols: tuple[str, ...], evaluation: Evaluation) -> Iterator[str]:
    """Yield the symbols of parameters that are never larger, and those of which these say it."""
    known: Mapping[str, Parameter] = {each.quantity.symbol: each for each in evaluation.parameters}
    for symbol in symbols:
        yield symbol
        if symbol in known:
            yield from _list_parts(known[symbol].quantity.never_below, evaluation)


def _write_limit(parameter: Parameter, evaluation: Evaluation) -> Words:
    unit = parameter.quantity.unit_or(evaluation.measurements.axis.deviation_unit)
    limit = float(f"{unit.from_si(parameter.limit or 0.0):.6g}")
    return Words(with_unit("{limit}", unit.symbol)).given(limit=limit)
