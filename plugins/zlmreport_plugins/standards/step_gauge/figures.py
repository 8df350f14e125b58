"""The graphs: mean, forward and backward errors with two standard deviations, and the reversal error."""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.evaluation.evaluation import Evaluation
from zlmreport.figures import alternatives
from zlmreport.figures.figure import Arrow, Band, Curve, Figure, Role
from zlmreport.figures.prescribed import LIMITS, MEANS, Diagram, panel, worst
from zlmreport.language import Words
from zlmreport.measurement.approach import Approach

_MEAN = {
    Approach.POSITIVE: Words("Forward error", "Abweichung vorwärts"),
    Approach.NEGATIVE: Words("Backward error", "Abweichung rückwärts"),
}
_SYMBOLS = {Approach.POSITIVE: "F", Approach.NEGATIVE: "B"}


def figures(evaluation: Evaluation) -> Iterator[Figure]:
    """Yield the graphs, as far as the test defines what they show."""
    graphs = _Graphs(evaluation)
    yield graphs.errors()
    if evaluation.parameter("XR"):
        yield graphs.reversal()


class _Graphs:
    """The graphs of one evaluation."""

    def __init__(self, evaluation: Evaluation) -> None:
        self.evaluation = evaluation
        self.diagram = Diagram(evaluation)
        statistics = evaluation.statistics
        self.mean, self.twice = statistics.mean, 2 * statistics.standard_deviation

    def errors(self) -> Figure:
        """Return the means of both directions, their mean, and two standard deviations about them."""
        repeatability = [self._repeatability(approach) for approach in Approach]
        shown = panel(
            bands=[self._limits(approach) for approach in Approach],
            readings=self.diagram.readings(),
            curves=[
                *(self._curve(approach) for approach in Approach),
                self.diagram.curve("XM_{i}", Role.MEAN_BIDIRECTIONAL, self.evaluation.column("XM")),
            ],
            arrows=repeatability,
            brackets=[self.diagram.bracket("W", self.mean, self.mean)],
        )
        title = Words(
            "Axis {axis}: forward, backward and mean positional error with two standard deviations",
            "Achse {axis}: Abweichung vorwärts, rückwärts und im Mittel mit zwei Standardabweichungen",
        )
        alternative = alternatives.text(
            alternatives.graph_of(self.evaluation),
            *(
                alternatives.range_of(self.diagram.axis, _MEAN[each], self.mean[each.index])
                for each in self.diagram.approaches
            ),
            alternatives.marks(self.diagram.axis, shown.arrows),
            alternatives.marks(self.diagram.axis, shown.brackets),
        )
        return self.diagram.figure("errors", title.given(axis=self.diagram.axis.name), alternative, [shown])

    def reversal(self) -> Figure:
        """Return the reversal error by position."""
        values = self.evaluation.column("XR")
        shown = panel(curves=[self.diagram.curve("XR_{i}", Role.MEAN_BIDIRECTIONAL, values)])
        title = Words(
            "Axis {axis}: reversal error XR = XB − XF",
            "Achse {axis}: Umkehrabweichung XR = XB − XF",
        )
        alternative = alternatives.text(
            alternatives.graph_of(self.evaluation),
            alternatives.range_of(self.diagram.axis, Words("Reversal error", "Umkehrabweichung"), values),
        )
        return self.diagram.figure("reversal", title.given(axis=self.diagram.axis.name), alternative, [shown])

    def _curve(self, approach: Approach) -> Curve | None:
        return self.diagram.curve(f"X{_SYMBOLS[approach]}_{{i}}", MEANS[approach], self.mean[approach.index])

    def _limits(self, approach: Approach) -> Band | None:
        name = _SYMBOLS[approach]
        mean, twice = self.mean[approach.index], self.twice[approach.index]
        return self.diagram.band(
            f"X{name}_{{i}} ± 2S{name}_{{i}}", LIMITS[approach], mean - twice, mean + twice
        )

    def _repeatability(self, approach: Approach) -> Arrow | None:
        mean, twice = self.mean[approach.index], self.twice[approach.index]
        return self.diagram.arrow(f"2S{approach.arrow}", worst(twice), mean, mean + twice)
