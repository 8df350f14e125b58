"""The mean deviations of an axis before and after it was adjusted, one above the other on one scale."""

from __future__ import annotations

from zlmreport.evaluation.evaluation import Evaluation
from zlmreport.figures import alternatives
from zlmreport.figures.figure import Figure, Panel
from zlmreport.figures.prescribed import DIRECTIONS, MEANS, Diagram, panel
from zlmreport.language import Words

_TITLE = Words(
    en="Mean deviations: {before} (above) and {after} (below), on one scale",
    de="Mittlere Abweichungen: {before} (oben) und {after} (unten), in einem Maßstab",
)
_NAME = Words(en="{measurement}, {direction}:", de="{measurement}, {direction}:")


def comparison_graph(before: Evaluation, after: Evaluation, names: tuple[Words, Words]) -> Figure:
    """Return the graph.

    Parameters
    ----------
    before, after
        Evaluations of the two measurements of one axis, by any standard.
    names
        What the two measurements are called.
    """
    both = tuple(zip((before, after), names, strict=True))
    sentences = [alternatives.graph_of(after)]
    for evaluation, name in both:
        sentences.extend(_ranges(evaluation, name))
    return Diagram(after).figure(
        "as-found-as-left",
        _TITLE.given(before=names[0], after=names[1]),
        alternatives.text(*sentences),
        [_panel(evaluation, name) for evaluation, name in both],
    )


def _panel(evaluation: Evaluation, name: Words) -> Panel:
    diagram = Diagram(evaluation)
    index = f"_{{{evaluation.position_index}}}"
    return panel(
        heading=name,
        curves=[
            diagram.curve(
                f"x̄{index}{approach.arrow}", MEANS[approach], evaluation.statistics.mean[approach.index]
            )
            for approach in diagram.approaches
        ],
    )


def _ranges(evaluation: Evaluation, name: Words) -> list[Words]:
    diagram = Diagram(evaluation)
    found = [
        alternatives.range_of(
            diagram.axis,
            _NAME.given(measurement=name, direction=DIRECTIONS[approach]),
            evaluation.statistics.mean[approach.index],
        )
        for approach in diagram.approaches
    ]
    return [each for each in found if each is not None]
