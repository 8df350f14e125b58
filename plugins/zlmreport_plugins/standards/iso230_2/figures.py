"""The graphs of ISO 230-2: bidirectional with and without the parameters, and each direction by itself."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from zlmreport.plugin import Approach, Evaluation, Figure, Words
from zlmreport.plugin.standard import (
    APPROACH_TITLES,
    LIMIT_ROLES,
    MEAN_ROLES,
    Arrow,
    Band,
    Curve,
    Diagram,
    Panel,
    Role,
    alternative_text,
    diagram_panel,
    graph_in_words,
    marks_in_words,
    range_in_words,
    worst_position,
)
from zlmreport_plugins.standards.iso230_2 import formulas
from zlmreport_plugins.standards.iso230_2.editions import Edition

_SYMBOLS = {Approach.POSITIVE: ("A_fwd", "E_fwd", "R_fwd"), Approach.NEGATIVE: ("A_bwd", "E_bwd", "R_bwd")}
_MEAN = {
    Approach.POSITIVE: Words("Mean of the positive direction"),
    Approach.NEGATIVE: Words("Mean of the negative direction"),
}
#: What the graph of means shows, by whether there are limits, and both directions.
_OF_MEANS = {
    (True, True): Words(
        "Axis {axis}: mean deviations, limits at {k} standard deviations, largest reversal and repeatability"
    ),
    (True, False): Words("Axis {axis}: mean deviations, limits at {k} standard deviations"),
    (False, True): Words("Axis {axis}: mean deviations, largest reversal"),
    (False, False): Words("Axis {axis}: mean deviations"),
}


def draw_figures(edition: Edition, evaluation: Evaluation) -> Iterator[Figure]:
    """Yield the edition's graphs, as far as the test defines what they show."""
    graphs = _Graphs(edition, evaluation)
    yield graphs.draw_means()
    if graphs.diagram.is_bidirectional:
        yield graphs.draw_overall()
    yield graphs.draw_unidirectional()


class _Graphs:
    """The graphs of one evaluation; limits and reversal by position are formed once."""

    def __init__(self, edition: Edition, evaluation: Evaluation) -> None:
        statistics = evaluation.statistics
        self.k, self.i = edition.coverage_factor, f"_{{{edition.position_index}}}"
        self.evaluation = evaluation
        self.diagram = Diagram(evaluation)
        self.mean = statistics.mean
        self.mean_bidirectional = statistics.mean_bidirectional
        self.upper = formulas.upper_limit(statistics, self.k)
        self.lower = formulas.lower_limit(statistics, self.k)
        self.worst_reversal = worst_position(np.abs(statistics.reversal_value))
        self.worst_repeatability = worst_position(evaluation.column("R"))

    def draw_means(self) -> Figure:
        """Return the means and limits of both directions, with B_i and R_i where they are largest."""
        shown = diagram_panel(
            bands=[self._draw_limits(approach) for approach in Approach],
            readings=self.diagram.readings(),
            curves=self._draw_all_means(),
            arrows=self._draw_bidirectional_arrows(f"B{self.i}", f"R{self.i}"),
        )
        title = _OF_MEANS[bool(shown.bands), self.diagram.is_bidirectional]
        return self._make_figure("means", title.given(k=self.k), shown)

    def draw_overall(self) -> Figure:
        """Return the bidirectional parameters at the places where they arise."""
        shown = diagram_panel(
            bands=[self._draw_limits(approach) for approach in Approach],
            curves=self._draw_all_means(),
            arrows=self._draw_bidirectional_arrows("B", "R"),
            brackets=[
                self.diagram.bracket("A", self.lower, self.upper),
                self.diagram.bracket("E", self.mean, self.mean),
                self.diagram.bracket("M", self.mean_bidirectional, self.mean_bidirectional),
            ],
        )
        title = Words("Axis {axis}: bidirectional parameters and where they arise")
        return self._make_figure("overall", title, shown)

    def draw_unidirectional(self) -> Figure:
        """Return a panel for each direction that was measured, with its own parameters."""
        panels = [self._draw_direction(approach) for approach in self.diagram.approaches]
        title = Words("Axis {axis}: unidirectional parameters and where they arise")
        if not any(panel.arrows or panel.brackets for panel in panels):
            title = Words("Axis {axis}: mean deviations by direction")
        return self._make_figure("unidirectional", title, *panels)

    def _draw_direction(self, approach: Approach) -> Panel:
        accuracy, systematic, repeatability = _SYMBOLS[approach]
        lower, upper, mean = (array[approach.index] for array in (self.lower, self.upper, self.mean))
        return diagram_panel(
            APPROACH_TITLES[approach],
            bands=[self._draw_limits(approach)],
            readings=self.diagram.readings(approach),
            curves=[self._draw_mean(approach)],
            arrows=[
                self.diagram.arrow(
                    f"R{approach.arrow}", worst_position(self.evaluation.column(repeatability)), lower, upper
                )
            ],
            brackets=[
                self.diagram.bracket(accuracy, lower, upper),
                self.diagram.bracket(systematic, mean, mean),
            ],
        )

    def _draw_mean(self, approach: Approach) -> Curve | None:
        notation = f"x̄{self.i}{approach.arrow}"
        return self.diagram.curve(notation, MEAN_ROLES[approach], self.mean[approach.index])

    def _draw_all_means(self) -> list[Curve | None]:
        both = self.diagram.curve(f"x̄{self.i}", Role.MEAN_BIDIRECTIONAL, self.mean_bidirectional)
        return [*map(self._draw_mean, Approach), both]

    def _draw_limits(self, approach: Approach) -> Band | None:
        arrow = approach.arrow
        return self.diagram.band(
            f"x̄{self.i}{arrow} ± {self.k}s{self.i}{arrow}",
            LIMIT_ROLES[approach],
            self.lower[approach.index],
            self.upper[approach.index],
        )

    def _draw_bidirectional_arrows(self, reversal: str, repeatability: str) -> list[Arrow | None]:
        positive, negative = (self.mean[approach.index] for approach in Approach)
        # R_i is the width of the two directions' limits taken together: its three cases are the choices
        # of the direction that gives the upper and of the one that gives the lower end.
        lower, upper = self.lower.min(axis=0), self.upper.max(axis=0)
        return [
            self.diagram.arrow(reversal, self.worst_reversal, negative, positive),
            self.diagram.arrow(repeatability, self.worst_repeatability, lower, upper),
        ]

    def _make_figure(self, key: str, title: Words, *panels: Panel) -> Figure:
        axis = self.diagram.axis
        alternative = alternative_text(
            graph_in_words(self.evaluation),
            *(
                range_in_words(axis, _MEAN[approach], self.mean[approach.index])
                for approach in self.diagram.approaches
            ),
            marks_in_words(axis, [mark for each in panels for mark in each.arrows]),
            marks_in_words(axis, [mark for each in panels for mark in each.brackets]),
        )
        return self.diagram.figure(key, title.given(axis=axis.name), alternative, panels)
