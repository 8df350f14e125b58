"""VDI/DGQ 3441 and VDI/VDE 2617: the same algebra with 3 and with 2 standard deviations.

k stands for the guideline's factor: 3 in VDI/DGQ 3441, 2 in VDI/VDE 2617. Every function takes the
statistics of one test or of a stack of tests; NaN stands for what is not defined. Positions are counted
by j, cycles by i.

In a test in one direction, for which the guidelines do not provide, x̄_j and s̄_j are those of this
direction, and there is no reversal span.

Source: the ZLM Position manual, G 1.3; of its limits x̄_j↑ + P_sj/2 and x̄_j↓ − P_sj/2, which hold only
where x̄_j↑ lies above x̄_j↓, the general form x̄_j ± ½(U_j + P_sj) is taken, as in its formula for P.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from zlmreport.plugin import (
    Approach,
    Evaluation,
    Figure,
    FloatArray,
    MeasurementSet,
    Options,
    Words,
    hookimpl,
)
from zlmreport.plugin.standard import (
    MEAN_ROLES,
    Arithmetic,
    Arrow,
    Band,
    Basis,
    Bracket,
    Curve,
    Diagram,
    Finding,
    Panel,
    PositionStatistics,
    Role,
    Standard,
    alternative_text,
    both_directions,
    diagram_panel,
    graph_in_words,
    largest_over_positions,
    marks_in_words,
    mean_over_positions,
    no_missing_readings,
    number_of_runs,
    positions_in_all,
    positions_over_travel,
    positions_per_metre,
    positions_per_scale_element,
    range_in_words,
    range_over_positions,
    spacing_against_periods,
    span_over_positions,
    worst_position,
)
from zlmreport_plugins.standards.vdi.guidelines import BY_POSITION, GUIDELINES, Guideline, list_quantities

_FULL_WIDTHS = Words("No parameter is a ± value: spreads and ranges are full widths.")
_SPREAD = Words(
    "The position spread is {k} times the sum of the standard deviations (n − 1) of both directions; the "
    "limits lie half the sum of reversal span and position spread to either side of the mean."
)
_NOT_ACCURACY = Words(
    "P averages the scatter of both directions and therefore differs from the A of ISO 230-2, even at the "
    "same number of standard deviations."
)
_ONE_DIRECTION = Words(
    "This test has readings of one direction only: the mean deviation is that of this direction, the "
    "position spread {times} times its standard deviation (n − 1), and the limits lie half of it to either "
    "side of the mean, without any reversal span. The formulas above are those for both directions."
)
_INDEX = Words(
    "The reversal span is an amount without sign. The index “mit” marks a mean over the positions."
)
_INDEX_OF_SPREAD = Words("The index “mit” marks a mean over the positions.")
_SOURCE = Words("Formulas as in the manual of the program ZLM Position, G 1.3.")

_MEAN = Words("Mean deviation")
_RUNS = 5
_ONE_DIRECTION_ONLY = Words(
    "the guideline does not provide for this: the parameters are formed from this direction alone; there is "
    "no reversal span"
)

#: What the graphs show, by whether there is a spread, and both directions.
_OF_MEANS = {
    (True, True): Words("Axis {axis}: mean deviations, reversal span and position spread"),
    (True, False): Words("Axis {axis}: mean deviations and position spread"),
    (False, True): Words("Axis {axis}: mean deviations and reversal span"),
    (False, False): Words("Axis {axis}: mean deviations"),
}
_OF_PARAMETERS = {
    (True, True): Words(
        "Axis {axis}: position uncertainty, position deviation and reversal span where they arise"
    ),
    (True, False): Words("Axis {axis}: position uncertainty and position deviation where they arise"),
    (False, True): Words("Axis {axis}: position deviation and reversal span where they arise"),
    (False, False): Words("Axis {axis}: position deviation where it arises"),
}

#: Notes that speak of parameters, with the symbols of which one must be reported.
_NOTES_ON: tuple[tuple[tuple[str, ...], Words], ...] = (
    (("P",), _NOT_ACCURACY),
    (("U_max", "U_mean", "Ps_mean"), _INDEX),
)


class VdiGuideline:
    """VDI/DGQ 3441 or VDI/VDE 2617."""

    position_index = "j"
    options = Options
    position_quantities = BY_POSITION

    def __init__(self, guideline: Guideline) -> None:
        self.guideline = guideline
        self.identifier = guideline.identifier
        self.designation = guideline.designation
        self.title = guideline.title
        self.quantities = list_quantities(guideline)
        spread = _SPREAD.given(k=guideline.factor)
        self.notes_on = (*_NOTES_ON, (("Ps_max",), spread))
        self.notes: tuple[Words, ...] = (_FULL_WIDTHS, spread, _NOT_ACCURACY, _INDEX, _SOURCE)
        #: Of a test in one direction the formulas for both do not hold.
        self.notes_of_one_direction: tuple[Words, ...] = (
            _ONE_DIRECTION.given(times=2 * guideline.factor),
            _INDEX_OF_SPREAD,
            _SOURCE,
        )

    def requirements(self, measurements: MeasurementSet, options: Options) -> Iterator[Finding]:  # noqa: ARG002 - no keys of its own
        """Yield the requirements, held against the test: the numbers as in ZLM Position, G 1.1."""
        guideline = self.guideline
        yield both_directions(measurements, _ONE_DIRECTION_ONLY, Basis.PUBLISHED)
        yield number_of_runs(measurements, _RUNS, Basis.APPLIED)
        if guideline.positions_in_all is not None:
            yield positions_in_all(measurements, guideline.positions_in_all, Basis.PUBLISHED)
        if guideline.positions_per_metre is not None:
            yield positions_per_metre(measurements, guideline.positions_per_metre, Basis.PUBLISHED, further=1)
        yield positions_per_scale_element(
            measurements, guideline.positions_per_scale_element, Basis.PUBLISHED
        )
        yield no_missing_readings(measurements)
        yield positions_over_travel(measurements)
        yield from spacing_against_periods(measurements, Basis.APPLIED)

    def arithmetic(self, statistics: PositionStatistics, options: Options) -> Arithmetic:  # noqa: ARG002 - no keys of its own
        """Return the guideline's parameters, and U_j and P_sj by position."""
        by_position = positions(statistics, self.guideline.factor)
        return Arithmetic(parameters(statistics, by_position), by_position)

    def figures(self, evaluation: Evaluation, options: Options) -> Iterator[Figure]:  # noqa: ARG002 - no keys of its own
        """Yield both diagrams, as far as the test defines what they show."""
        graphs = _Graphs(evaluation)
        yield graphs.draw_means()
        yield graphs.draw_overall()


def mean_deviation(statistics: PositionStatistics) -> FloatArray:
    """x̄_j = (x̄_j↑ + x̄_j↓)/2, shape (..., position)."""
    return statistics.mean_of_all_runs


def position_spread(statistics: PositionStatistics, k: int) -> FloatArray:
    """P_sj = k·(s_j↑ + s_j↓) = 2k·s̄_j, shape (..., position)."""
    both = k * (statistics.s_positive + statistics.s_negative)
    return statistics.of_both_or_single(both, 2 * k * statistics.standard_deviation)


def reversal_span(statistics: PositionStatistics) -> FloatArray:
    """U_j = abs(x̄_j↑ − x̄_j↓), shape (..., position); NaN where a direction is missing."""
    return np.abs(statistics.reversal_value)


def half_width(reversal: FloatArray, spread: FloatArray, statistics: PositionStatistics) -> FloatArray:
    """½(U_j + P_sj), half the width of the band about x̄_j; ½P_sj in one direction. Shape (..., position)."""
    bidirectional = statistics.is_bidirectional[..., np.newaxis]
    return np.where(bidirectional, reversal + spread, spread) / 2


def parameters(
    statistics: PositionStatistics, by_position: Mapping[str, FloatArray]
) -> dict[str, FloatArray]:
    """Return the parameters of the axis by symbol, each of shape (...).

    `by_position`: The columns, as from `positions`.
    """
    mean = mean_deviation(statistics)
    spread, reversal = by_position["Ps"], by_position["U"]
    half = half_width(reversal, spread, statistics)
    return {
        "P": range_over_positions(mean + half, mean - half),
        "Pa": span_over_positions(mean),
        "Ps_max": largest_over_positions(spread),
        "Ps_mean": mean_over_positions(spread),
        "U_max": largest_over_positions(reversal),
        "U_mean": mean_over_positions(reversal),
    }


def positions(statistics: PositionStatistics, k: int) -> dict[str, FloatArray]:
    """Return the columns by position, each of shape (..., position)."""
    return {"U": reversal_span(statistics), "Ps": position_spread(statistics, k)}


class _Graphs:
    """The diagrams of one evaluation; the band about the mean is formed once."""

    def __init__(self, evaluation: Evaluation) -> None:
        self.evaluation = evaluation
        self.diagram = Diagram(evaluation)
        self.statistics = evaluation.statistics
        self.bidirectional = self.diagram.is_bidirectional
        self.mean = mean_deviation(self.statistics)
        self.reversal, self.spread = evaluation.column("U"), evaluation.column("Ps")
        self.has_spread = bool(np.isfinite(self.spread).any())
        self.half = half_width(self.reversal, self.spread, self.statistics)

    def draw_means(self) -> Figure:
        """Return means, reversal and spread by position, with U_j/2 and P_sj/2 where the band is widest."""
        title = _OF_MEANS[self.has_spread, self.bidirectional]
        shown = diagram_panel(
            bands=[self._draw_spread_band(), self._draw_reversal_band()],
            readings=self.diagram.readings(),
            curves=self._draw_curves(),
            arrows=self._draw_arrows(),
        )
        return self._make_figure("means", title, shown)

    def draw_overall(self) -> Figure:
        """Return P, P_a and U_max at the places where they arise."""
        title = _OF_PARAMETERS[self.has_spread, self.bidirectional]
        shown = diagram_panel(
            bands=[self._draw_spread_band()],
            curves=self._draw_curves(),
            brackets=[
                self.diagram.bracket("P", self.mean - self.half, self.mean + self.half),
                self.diagram.bracket("Pa", self.mean, self.mean),
                self._draw_largest_reversal(),
            ],
        )
        return self._make_figure("overall", title, shown)

    def _draw_curves(self) -> list[Curve | None]:
        by_direction = [
            self.diagram.curve(f"x̄_{{j}}{each.arrow}", MEAN_ROLES[each], self.statistics.mean[each.index])
            for each in Approach
        ]
        if not self.bidirectional:
            return list(by_direction)
        return [*by_direction, self.diagram.curve("x̄_{j}", Role.MEAN_BIDIRECTIONAL, self.mean)]

    def _draw_reversal_band(self) -> Band | None:
        half = self.reversal / 2
        return self.diagram.band("x̄_{j} ± ½U_{j}", Role.REVERSAL, self.mean - half, self.mean + half)

    def _draw_spread_band(self) -> Band | None:
        notation = "x̄_{j} ± ½(U_{j} + P_{sj})" if self.bidirectional else "x̄_{j} ± ½P_{sj}"
        return self.diagram.band(notation, Role.SPREAD, self.mean - self.half, self.mean + self.half)

    def _draw_arrows(self) -> list[Arrow | None]:
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

    def _draw_largest_reversal(self) -> Bracket | None:
        at = worst_position(self.reversal)
        if at is None:
            return None
        only_there = np.where(np.arange(self.reversal.size) == at, self.statistics.mean, np.nan)
        return self.diagram.bracket("U_max", only_there, only_there)

    def _make_figure(self, key: str, title: Words, shown: Panel) -> Figure:
        axis = self.diagram.axis
        alternative = alternative_text(
            graph_in_words(self.evaluation),
            range_in_words(axis, _MEAN, self.mean),
            marks_in_words(axis, (*shown.arrows, *shown.brackets)),
        )
        return self.diagram.figure(key, title.given(axis=axis.name), alternative, (shown,))


@hookimpl
def zlmreport_standards() -> tuple[Standard, ...]:
    """Return the two guidelines."""
    return tuple(VdiGuideline(guideline) for guideline in GUIDELINES)
