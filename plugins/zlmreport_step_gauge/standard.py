"""The evaluation of a step gauge as a standard that a job can name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from zlmreport.plugin import (
    LIMIT_ROLES,
    MEAN_ROLES,
    Approach,
    Arithmetic,
    Arrow,
    Band,
    Basis,
    Curve,
    Diagram,
    Evaluation,
    Figure,
    Finding,
    FloatArray,
    MeasurementSet,
    Options,
    PositionStatistics,
    Role,
    Words,
    alternative_text,
    diagram_panel,
    graph_in_words,
    largest_over_positions,
    marks_in_words,
    mean_over_positions,
    no_missing_readings,
    number_of_runs,
    range_in_words,
    span_over_positions,
    worst_position,
)
from zlmreport_step_gauge import equations
from zlmreport_step_gauge import quantities as words

_RUNS_FOR_A_SCATTER = 2


class StepGaugeEvaluation:
    """Linear displacement accuracy by step gauge, after Pahk and Kim, sections 4.1 and 4.2."""

    identifier = "step-gauge"
    designation = "Pahk & Kim 4.1, 4.2"
    is_method = True
    position_index = "i"
    title = Words(
        "Linear displacement accuracy by step gauge", "Längenabweichung nach Messung eines Stufenendmaßes"
    )
    options = Options
    quantities = words.PARAMETERS
    position_quantities = words.BY_POSITION
    notes = words.NOTES

    def requirements(self, measurements: MeasurementSet, options: Options) -> Iterable[Finding]:  # noqa: ARG002 - no keys of its own
        """Hold what the formulas need against the test."""
        return _findings(measurements)

    def arithmetic(self, statistics: PositionStatistics, options: Options) -> Arithmetic:  # noqa: ARG002 - no keys of its own
        """Return the parameters, and errors and reversal by position."""
        return arithmetic(statistics)

    def figures(self, evaluation: Evaluation, options: Options) -> Iterable[Figure]:  # noqa: ARG002 - no keys of its own
        """Return the graphs of errors and of the reversal."""
        return graphs(evaluation)


def _findings(measurements: MeasurementSet) -> Iterator[Finding]:
    yield number_of_runs(measurements, _RUNS_FOR_A_SCATTER, Basis.APPLIED)
    yield no_missing_readings(measurements)
    if measurements.is_bidirectional:
        yield _radius_from_elsewhere(measurements)


def _radius_from_elsewhere(measurements: MeasurementSet) -> Finding:
    """Ask that what parts the directions is the machine and not what was taken for the probe's radius."""
    requirement = Words(
        "An effective radius of the probe that is known from elsewhere, for the reversal error",
        "Ein anderweitig bekannter wirksamer Tastkugelradius, für die Umkehrabweichung",
    )
    if not measurements.reversal_is_relative:
        known = Words("known from elsewhere", "anderweitig bekannt")
        return Finding(requirement, known, met=True)
    found = Words(
        "determined from the blocks of the gauge: XR and B are relative to their mean within a block",
        "aus den Blöcken des Stufenendmaßes bestimmt: XR und B sind relativ zu ihrem Mittel innerhalb eines "
        "Blocks",
    )
    return Finding(requirement, found, met=False)


def arithmetic(statistics: PositionStatistics) -> Arithmetic:
    """Return every parameter and every column of one test or of a stack of tests (sections 4.1 and 4.2).

    Equations 4 to 7 are the statistics themselves; `zlmreport_step_gauge.equations` has the others. NaN
    stands for what is not defined: at the ends of the section there is no neighbour to interpolate with.
    """
    forward, backward = (
        equations.interpolated(each) for each in (statistics.mean_positive, statistics.mean_negative)
    )
    of_forward, of_backward = (
        2 * equations.interpolated(each) for each in (statistics.s_positive, statistics.s_negative)
    )
    reversal = equations.reversal_error(forward, backward)
    columns = {
        "XF": forward,
        "XB": backward,
        "XM": equations.mean_error(forward, backward),
        "S2F": of_forward,
        "S2B": of_backward,
        "XR": reversal,
        "B": -reversal,
    }
    return Arithmetic(_parameters(statistics, reversal), columns)


def _parameters(statistics: PositionStatistics, reversal: FloatArray) -> dict[str, FloatArray]:
    """Return the parameters of the axis; of what was measured, but for the reversal error."""
    forward, backward = statistics.mean_positive, statistics.mean_negative
    twice = 2 * statistics.standard_deviation
    both = np.concatenate([forward, backward], axis=-1)
    return {
        "W": np.where(statistics.is_bidirectional, span_over_positions(both), np.nan),
        "W_fwd": span_over_positions(forward),
        "W_bwd": span_over_positions(backward),
        "S2": largest_over_positions(np.fmax(twice[..., 0, :], twice[..., 1, :])),
        "S2_fwd": largest_over_positions(twice[..., 0, :]),
        "S2_bwd": largest_over_positions(twice[..., 1, :]),
        "XR": largest_over_positions(np.abs(reversal)),
        "XR_mean": mean_over_positions(reversal),
        "B_mean": -mean_over_positions(reversal),
    }


_MEAN = {
    Approach.POSITIVE: Words("Forward error", "Abweichung vorwärts"),
    Approach.NEGATIVE: Words("Backward error", "Abweichung rückwärts"),
}
_SYMBOLS = {Approach.POSITIVE: "F", Approach.NEGATIVE: "B"}


def graphs(evaluation: Evaluation) -> Iterator[Figure]:
    """Yield the graphs, as far as the test defines what they show."""
    drawn = _Graphs(evaluation)
    yield drawn.errors()
    if evaluation.parameter("XR"):
        yield drawn.reversal()


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
        shown = diagram_panel(
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
        alternative = alternative_text(
            graph_in_words(self.evaluation),
            *(
                range_in_words(self.diagram.axis, _MEAN[each], self.mean[each.index])
                for each in self.diagram.approaches
            ),
            marks_in_words(self.diagram.axis, shown.arrows),
            marks_in_words(self.diagram.axis, shown.brackets),
        )
        return self.diagram.figure("errors", title.given(axis=self.diagram.axis.name), alternative, [shown])

    def reversal(self) -> Figure:
        """Return the reversal error by position."""
        values = self.evaluation.column("XR")
        shown = diagram_panel(curves=[self.diagram.curve("XR_{i}", Role.MEAN_BIDIRECTIONAL, values)])
        title = Words(
            "Axis {axis}: reversal error XR = XB − XF",
            "Achse {axis}: Umkehrabweichung XR = XB − XF",
        )
        alternative = alternative_text(
            graph_in_words(self.evaluation),
            range_in_words(self.diagram.axis, Words("Reversal error", "Umkehrabweichung"), values),
        )
        return self.diagram.figure("reversal", title.given(axis=self.diagram.axis.name), alternative, [shown])

    def _curve(self, approach: Approach) -> Curve | None:
        return self.diagram.curve(
            f"X{_SYMBOLS[approach]}_{{i}}", MEAN_ROLES[approach], self.mean[approach.index]
        )

    def _limits(self, approach: Approach) -> Band | None:
        name = _SYMBOLS[approach]
        mean, twice = self.mean[approach.index], self.twice[approach.index]
        return self.diagram.band(
            f"X{name}_{{i}} ± 2S{name}_{{i}}", LIMIT_ROLES[approach], mean - twice, mean + twice
        )

    def _repeatability(self, approach: Approach) -> Arrow | None:
        mean, twice = self.mean[approach.index], self.twice[approach.index]
        return self.diagram.arrow(f"2S{approach.arrow}", worst_position(twice), mean, mean + twice)
