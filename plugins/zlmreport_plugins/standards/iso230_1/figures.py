"""The graphs of one measured line: deviations about the reference line, and the readings with it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from zlmreport.plugin import Approach, Evaluation, Figure, FloatArray, Words
from zlmreport.plugin.standard import (
    APPROACH_TITLES,
    MEAN_ROLES,
    Curve,
    Diagram,
    Level,
    Panel,
    Quantity,
    Role,
    alternative_text,
    diagram_panel,
    graph_in_words,
    marks_in_words,
    range_in_words,
)
from zlmreport_plugins.standards.iso230_1.reference_lines import (
    LineName,
    residuals,
)

#: How the reference lines are called in a sentence.
LINES: dict[LineName, Words] = {
    "least-squares": Words("least squares line"),
    "end-points": Words("line through the end points"),
    "minimum-zone": Words("minimum zone line"),
}
_STRAIGHT = Words(
    "Axis {axis}: {symbol}, deviations from the {line} of the mean of all runs, which is zero here"
)
_READINGS = Words("Axis {axis}: {symbol}, readings and the {line} of the mean of all runs")
_DIRECTIONS = Words("Axis {axis}: {symbol} of each direction about its own {line}")
_ANGLES = Words("Axis {axis}: {symbol}, mean deviations")
_MEAN = Words("Mean of all runs:")


def draw_straightness(
    evaluation: Evaluation, quantities: Sequence[Quantity], line: LineName
) -> Iterator[Figure]:
    """Yield the deviations about the line, the readings with it, and each direction about its own line."""
    symbol, diagram = quantities[0], Diagram(evaluation)
    x, statistics = evaluation.measurements.target_positions, evaluation.statistics
    mean = statistics.mean_of_all_runs
    about = residuals(x, mean, line)
    taken_off = mean - about
    directions = [
        diagram.curve(f"d̄_{{i}}{each.arrow}", MEAN_ROLES[each], statistics.mean[each.index] - taken_off)
        for each in Approach
    ]
    both = diagram.curve("d̄_{i}", Role.MEAN_BIDIRECTIONAL, about) if diagram.is_bidirectional else None
    bracket = diagram.bracket(symbol.symbol, about, about)
    shown = diagram_panel(
        curves=[*directions, both],
        levels=_list_limits(diagram, about) if bracket else (),
        brackets=[bracket],
    )
    yield _make_figure("straightness", _STRAIGHT.given(line=LINES[line]), diagram, symbol, [shown])
    with_line = diagram_panel(
        readings=diagram.readings(),
        curves=[
            *(
                diagram.curve(f"x̄_{{i}}{each.arrow}", MEAN_ROLES[each], statistics.mean[each.index])
                for each in Approach
            ),
            diagram.curve("y_{0} + m·P_{i}", Role.BAND_LIMIT, taken_off),
        ],
    )
    yield _make_figure("readings", _READINGS.given(line=LINES[line]), diagram, symbol, [with_line])
    if diagram.is_bidirectional:
        panels = [_draw_direction(diagram, each, quantities, line) for each in diagram.approaches]
        yield _make_figure("directions", _DIRECTIONS.given(line=LINES[line]), diagram, symbol, panels)


def draw_angles(evaluation: Evaluation, quantities: Sequence[Quantity]) -> Iterator[Figure]:
    """Yield the angles over position, with the spans of the mean and of each direction."""
    diagram, statistics = Diagram(evaluation), evaluation.statistics
    symbol, mean = quantities[0], statistics.mean_of_all_runs
    curves: list[Curve | None] = [
        diagram.curve(f"x̄_{{i}}{each.arrow}", MEAN_ROLES[each], statistics.mean[each.index])
        for each in Approach
    ]
    if diagram.is_bidirectional:
        curves.append(diagram.curve("x̄_{i}", Role.MEAN_BIDIRECTIONAL, mean))
    brackets = [diagram.bracket(symbol.symbol, mean, mean)]
    if diagram.is_bidirectional:
        brackets.append(diagram.bracket(f"{symbol.symbol}_both", statistics.mean, statistics.mean))
    shown = diagram_panel(readings=diagram.readings(), curves=curves, brackets=brackets)
    yield _make_figure("angles", _ANGLES, diagram, symbol, [shown])


def _draw_direction(
    diagram: Diagram, approach: Approach, quantities: Sequence[Quantity], line: LineName
) -> Panel:
    evaluation = diagram.evaluation
    own = evaluation.statistics.mean[approach.index]
    about = residuals(evaluation.measurements.target_positions, own, line)
    way = "fwd" if approach is Approach.POSITIVE else "bwd"
    bracket = diagram.bracket(f"{quantities[0].symbol}_{way}", about, about)
    return diagram_panel(
        APPROACH_TITLES[approach],
        curves=[diagram.curve(f"d̄_{{i}}{approach.arrow}", MEAN_ROLES[approach], about)],
        levels=_list_limits(diagram, about) if bracket else (),
        brackets=[bracket],
    )


def _list_limits(diagram: Diagram, about: FloatArray) -> list[Level | None]:
    """Return the two parallels to the reference line between which the deviations lie."""
    ends = float(np.nanmin(about)), float(np.nanmax(about))
    return [diagram.level("", Role.BAND_LIMIT, end) for end in ends]


def _make_figure(
    key: str, title: Words, diagram: Diagram, symbol: Quantity, panels: Sequence[Panel]
) -> Figure:
    axis, evaluation = diagram.axis, diagram.evaluation
    alternative = alternative_text(
        graph_in_words(evaluation),
        range_in_words(axis, _MEAN, evaluation.statistics.mean_of_all_runs),
        marks_in_words(axis, [mark for each in panels for mark in each.brackets]),
    )
    titled = title.given(axis=axis.name, symbol=symbol.symbol)
    return diagram.figure(key, titled, alternative, panels)
