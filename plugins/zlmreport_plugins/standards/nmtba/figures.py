"""The two diagrams of the NMTBA recommendation: means with spread, and the overall parameters."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from zlmreport.plugin import (
    MEAN_ROLES,
    Arrow,
    Band,
    Curve,
    Diagram,
    Evaluation,
    Figure,
    Level,
    Panel,
    Role,
    Words,
    alternative_text,
    deviation_in_words,
    diagram_panel,
    graph_in_words,
    marks_in_words,
    range_in_words,
    worst_position,
)

_MEAN = Words("Mean deviation", "Mittlere Abweichung")


def figures(evaluation: Evaluation) -> Iterator[Figure]:
    """Yield both diagrams, as far as the test defines what they show."""
    graphs = _Graphs(evaluation)
    yield graphs.means()
    yield graphs.overall()


class _Graphs:
    """The diagrams of one evaluation; the limits are formed once."""

    def __init__(self, evaluation: Evaluation) -> None:
        self.evaluation = evaluation
        self.diagram = Diagram(evaluation)
        self.mean, self.spread = evaluation.column("X"), evaluation.column("Ps")
        self.upper, self.lower = self.mean + self.spread / 2, self.mean - self.spread / 2

    def means(self) -> Figure:
        """Return means and limits by position, with P_sj/2 where the spread is largest."""
        shown = diagram_panel(
            bands=[self._band()],
            readings=self.diagram.readings(),
            curves=[self._curve()],
            arrows=[self.diagram.arrow("P_{sj}/2", worst_position(self.spread), self.mean, self.upper)],
        )
        title = Words(
            "Axis {axis}: mean deviations and position spread",
            "Achse {axis}: mittlere Abweichungen und Positionsstreubreite",
        )
        return self._figure("means", title, shown, marks_in_words(self.diagram.axis, shown.arrows))

    def overall(self) -> Figure:
        """Return P and P_a at the places where they arise, and the offset O that centres the band."""
        shown = diagram_panel(
            bands=[self._band()],
            curves=[self._curve()],
            arrows=[self._offset_arrow()],
            brackets=[
                self.diagram.bracket("P", self.lower, self.upper),
                self.diagram.bracket("Pa", self.mean, self.mean),
            ],
            levels=[self._middle()],
        )
        title = Words(
            "Axis {axis}: position uncertainty, position deviation and offset",
            "Achse {axis}: Positionsunsicherheit, Positionsabweichung und Nullpunktverschiebung",
        )
        sentences = marks_in_words(self.diagram.axis, shown.brackets), self._offset_sentence()
        return self._figure("overall", title, shown, *sentences)

    def _curve(self) -> Curve | None:
        approaches = self.diagram.approaches
        role = MEAN_ROLES[approaches[0]] if len(approaches) == 1 else Role.MEAN_BIDIRECTIONAL
        return self.diagram.curve("X̄_{j}", role, self.mean)

    def _band(self) -> Band | None:
        return self.diagram.band("X̄_{j} ± ½P_{sj}", Role.SPREAD, self.lower, self.upper)

    def _middle(self) -> Level | None:
        """Return the line in the middle of the band, which lies at −O."""
        offset = self.evaluation.value("O")
        return None if offset is None else self.diagram.level("−O", Role.BAND_LIMIT, -offset)

    def _offset_arrow(self) -> Arrow | None:
        """Return the arrow from zero to the middle of the band, at the first target."""
        offset = self.evaluation.value("O")
        if offset is None:
            return None
        middle = np.full_like(self.mean, -offset)
        return self.diagram.arrow("O", 0, np.zeros_like(middle), middle)

    def _offset_sentence(self) -> Words | None:
        offset = self.evaluation.value("O")
        if offset is None:
            return None
        return Words(
            "The band's middle lies at {middle}, so that O = {offset}.",
            "Die Mitte des Bandes liegt bei {middle}, also ist O = {offset}.",
        ).given(
            middle=deviation_in_words(self.diagram.axis, -offset),
            offset=deviation_in_words(self.diagram.axis, offset),
        )

    def _figure(self, key: str, title: Words, shown: Panel, *sentences: Words | None) -> Figure:
        axis = self.diagram.axis
        alternative = alternative_text(
            graph_in_words(self.evaluation),
            range_in_words(axis, _MEAN, self.mean),
            *sentences,
        )
        return self.diagram.figure(key, title.given(axis=axis.name), alternative, (shown,))
