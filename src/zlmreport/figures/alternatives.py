"""What a graph shows, in sentences with values, for those who cannot see it."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from zlmreport.evaluation.checks import deviation_in_words, position_in_words, positions_in_words
from zlmreport.evaluation.evaluation import Evaluation
from zlmreport.figures.figure import Arrow, Bracket
from zlmreport.language import Words
from zlmreport.measurement.axis import Axis
from zlmreport.quantities.arrays import FloatArray
from zlmreport.quantities.formatting import plain


def text(*sentences: Words | None) -> Words:
    """Return the sentences as one text; None is left out."""
    return _joined([sentence for sentence in sentences if sentence is not None], " ")


def graph_of(evaluation: Evaluation) -> Words:
    """Return the sentence that says what is drawn over what."""
    targets = evaluation.measurements.target_positions
    axis = evaluation.measurements.axis
    return Words(
        "Graph of the deviation over the target position for axis {axis}: {positions}, {first} to {last}.",
        "Diagramm der Abweichung über der Sollposition für Achse {axis}: {positions}, {first} bis {last}.",
    ).given(
        axis=axis.name,
        positions=positions_in_words(len(targets)),
        first=position_in_words(axis, float(targets[0])),
        last=position_in_words(axis, float(targets[-1])),
    )


def range_of(axis: Axis, name: Words, values: FloatArray) -> Words | None:
    """Return the sentence on where values (m or rad) lie; None where none is defined."""
    if not np.isfinite(values).any():
        return None
    return Words("{name} from {low} to {high}.", "{name} von {low} bis {high}.").given(
        name=name,
        low=deviation_in_words(axis, float(np.nanmin(values))),
        high=deviation_in_words(axis, float(np.nanmax(values))),
    )


def marks(axis: Axis, found: Iterable[Arrow | Bracket]) -> Words | None:
    """Return the sentence on arrows and brackets: symbol, length, place; None where there are none."""
    written = [_arrow(axis, mark) if isinstance(mark, Arrow) else _bracket(axis, mark) for mark in found]
    return Words("{marks}.", "{marks}.").given(marks=_joined(written, "; ")) if written else None


def _arrow(axis: Axis, arrow: Arrow) -> Words:
    return Words("{symbol} = {length} at {x}", "{symbol} = {length} bei {x}").given(
        symbol=plain(arrow.notation),
        length=_printed_length(axis, arrow.high - arrow.low),
        x=_printed_position(axis, arrow.x),
    )


def _bracket(axis: Axis, bracket: Bracket) -> Words:
    if bracket.low_at == bracket.high_at:
        return _arrow(axis, Arrow(bracket.notation, bracket.low_at, bracket.low, bracket.high))
    return Words(
        "{symbol} = {length}, from its lowest point at {low_at} to its highest at {high_at}",
        "{symbol} = {length}, vom tiefsten Punkt bei {low_at} bis zum höchsten bei {high_at}",
    ).given(
        symbol=plain(bracket.notation),
        length=_printed_length(axis, bracket.high - bracket.low),
        low_at=_printed_position(axis, bracket.low_at),
        high_at=_printed_position(axis, bracket.high_at),
    )


def _printed_length(axis: Axis, value: float) -> Words:
    return deviation_in_words(axis, axis.deviation_unit.to_si(value))


def _printed_position(axis: Axis, value: float) -> Words:
    return position_in_words(axis, axis.position_unit.to_si(value))


def _joined(phrases: list[Words], between: str) -> Words:
    pattern = between.join(f"{{part{number}}}" for number in range(len(phrases)))
    return Words(pattern, pattern, {f"part{number}": phrase for number, phrase in enumerate(phrases)})
