"""The two diagrams of the guidelines: means with spread and reversal, and the overall parameters."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from zlmreport.plugin import (
    MEAN_ROLES,
    Approach,
    Arrow,
    Band,
    Bracket,
    Curve,
    Diagram,
    Evaluation,
    Figure,
    Panel,
    Role,
    Words,
    alternative_text,
    diagram_panel,
    graph_in_words,
    marks_in_words,
    range_in_words,
    worst_position,
)
from zlmreport_plugins.standards.vdi import formulas

_MEAN = Words("Mean deviation", "Mittlere Abweichung")


def figures(evaluation: Evaluation) -> Iterator[Figure]:
    """Yield both diagrams, as far as the test defines what they show."""
    graphs = _Graphs(evaluation)
    yield graphs.means()
    yield graphs.overall()


class _Graphs:
    """The diagrams of one evaluation; the band about the mean is formed once."""

    def __init__(self, evaluation: Evaluation) -> None:
        self.evaluation = evaluation
        self.diagram = Diagram(evaluation)
        self.statistics = evaluation.statistics
        self.bidirectional = self.diagram.is_bidirectional
        self.mean = formulas.mean_deviation(self.statistics)
        self.reversal, self.spread = evaluation.column("U"), evaluation.column("Ps")
        self.half = formulas.half_width(self.reversal, self.spread, self.statistics)

    def means(self) -> Figure:
        """Return means, reversal and spread by position, with U_j/2 and P_sj/2 where the band is widest."""
        title = Words(
            "Axis {axis}: mean deviations, reversal span and position spread",
            "Achse {axis}: mittlere Abweichungen, Umkehrspanne und Positionsstreubreite",
        )
        if not self.bidirectional:
            title = Words(
                "Axis {axis}: mean deviations and position spread",
                "Achse {axis}: mittlere Abweichungen und Positionsstreubreite",
            )
        shown = diagram_panel(
            bands=[self._spread_band(), self._reversal_band()],
            readings=self.diagram.readings(),
            curves=self._curves(),
            arrows=self._arrows(),
        )
        return self._figure("means", title, shown)

    def overall(self) -> Figure:
        """Return P, P_a and U_max at the places where they arise."""
        title = Words(
            "Axis {axis}: position uncertainty, position deviation and reversal span where they arise",
            "Achse {axis}: Positionsunsicherheit, Positionsabweichung und Umkehrspanne, wo sie entstehen",
        )
        if not self.bidirectional:
            title = Words(
                "Axis {axis}: position uncertainty and position deviation where they arise",
                "Achse {axis}: Positionsunsicherheit und Positionsabweichung, wo sie entstehen",
            )
        shown = diagram_panel(
            bands=[self._spread_band()],
            curves=self._curves(),
            brackets=[
                self.diagram.bracket("P", self.mean - self.half, self.mean + self.half),
                self.diagram.bracket("Pa", self.mean, self.mean),
                self._largest_reversal(),
            ],
        )
        return self._figure("overall", title, shown)

    def _curves(self) -> list[Curve | None]:
        by_direction = [
            self.diagram.curve(f"x̄_{{j}}{each.arrow}", MEAN_ROLES[each], self.statistics.mean[each.index])
            for each in Approach
        ]
        if not self.bidirectional:
            return list(by_direction)
        return [*by_direction, self.diagram.curve("x̄_{j}", Role.MEAN_BIDIRECTIONAL, self.mean)]

    def _reversal_band(self) -> Band | None:
        half = self.reversal / 2
        return self.diagram.band("x̄_{j} ± ½U_{j}", Role.REVERSAL, self.mean - half, self.mean + half)

    def _spread_band(self) -> Band | None:
        notation = "x̄_{j} ± ½(U_{j} + P_{sj})" if self.bidirectional else "x̄_{j} ± ½P_{sj}"
        return self.diagram.band(notation, Role.SPREAD, self.mean - self.half, self.mean + self.half)

    def _arrows(self) -> list[Arrow | None]:
        """Return U_j/2 upwards from the mean and P_sj/2 upwards from there, at the widest place."""
        if not self.bidirectional:
            return [
                self.diagram.arrow("P_{sj}/2", worst_position(self.spread), self.mean, self.mean + self.half)
            ]
        at = worst_position(self.half)
        reversal_end = self.mean + self.reversal / 2
        return [
            self.diagram.arrow(
                "U_{j}/2", worst_position(self.reversal) if at is None else at, self.mean, reversal_end
            ),
            self.diagram.arrow("P_{sj}/2", at, reversal_end, self.mean + self.half),
        ]

    def _largest_reversal(self) -> Bracket | None:
        at = worst_position(self.reversal)
        if at is None:
            return None
        only_there = np.where(np.arange(self.reversal.size) == at, self.statistics.mean, np.nan)
        return self.diagram.bracket("U_max", only_there, only_there)

    def _figure(self, key: str, title: Words, shown: Panel) -> Figure:
        axis = self.diagram.axis
        alternative = alternative_text(
            graph_in_words(self.evaluation),
            range_in_words(axis, _MEAN, self.mean),
            marks_in_words(axis, (*shown.arrows, *shown.brackets)),
        )
        return self.diagram.figure(key, title.given(axis=axis.name), alternative, (shown,))
