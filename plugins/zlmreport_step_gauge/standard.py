"""The evaluation of a step gauge as a standard that a job can name, with its parameters and columns."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from zlmreport.plugin import Approach, Evaluation, Figure, FloatArray, MeasurementSet, Options, Words
from zlmreport.plugin.standard import (
    LIMIT_ROLES,
    MEAN_ROLES,
    Arithmetic,
    Arrow,
    Band,
    Basis,
    Curve,
    Diagram,
    Finding,
    PositionQuantity,
    PositionStatistics,
    Quantity,
    QuantityGroup,
    Role,
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

_BANDWIDTH = Words("The largest systematic error of a length between two positions of the line{condition}.")
_REPEATABILITY = Words(
    "How far repeated touches of one face scatter at the worst face{condition}: two standard deviations, to "
    "either side of the mean."
)
_NOTHING = Words("")
_FORWARD = Words(", touched forward")
_BACKWARD = Words(", touched backward")

#: The parameters of the line in the order of the results table.
PARAMETERS: tuple[Quantity, ...] = (
    Quantity(
        "W",
        "W",
        Words("Bandwidth"),
        QuantityGroup.SYSTEMATIC,
        "max(XF_{i}; XB_{i}) − min(XF_{i}; XB_{i})",
        _BANDWIDTH.given(condition=_NOTHING),
    ),
    Quantity(
        "W_fwd",
        "W↑",
        Words("Bandwidth, forward"),
        QuantityGroup.SYSTEMATIC,
        "max(XF_{i}) − min(XF_{i})",
        _BANDWIDTH.given(condition=_FORWARD),
    ),
    Quantity(
        "W_bwd",
        "W↓",
        Words("Bandwidth, backward"),
        QuantityGroup.SYSTEMATIC,
        "max(XB_{i}) − min(XB_{i})",
        _BANDWIDTH.given(condition=_BACKWARD),
    ),
    Quantity(
        "S2",
        "2S",
        Words("Repeatability"),
        QuantityGroup.RANDOM,
        "max(2SF_{i}; 2SB_{i})",
        _REPEATABILITY.given(condition=_NOTHING),
    ),
    Quantity(
        "S2_fwd",
        "2S↑",
        Words("Repeatability, forward"),
        QuantityGroup.RANDOM,
        "max(2SF_{i})",
        _REPEATABILITY.given(condition=_FORWARD),
    ),
    Quantity(
        "S2_bwd",
        "2S↓",
        Words("Repeatability, backward"),
        QuantityGroup.RANDOM,
        "max(2SB_{i})",
        _REPEATABILITY.given(condition=_BACKWARD),
    ),
    Quantity(
        "XR",
        "XR",
        Words("Largest reversal error"),
        QuantityGroup.SYSTEMATIC,
        "max(|XR_{i}|), XR_{i} = XB_{i} − XF_{i}",
        Words("The largest difference that the direction of probing makes to a position."),
    ),
    Quantity(
        "XR_mean",
        "X̄R",
        Words("Mean reversal error", context="step gauge"),
        QuantityGroup.SYSTEMATIC,
        "(1/m) · ∑ XR_{i}",
        Words("The difference that the direction of probing makes on average, with sign."),
        can_be_limited=False,
    ),
    Quantity(
        "B_mean",
        "B̄",
        Words("Mean reversal error with the sign of ISO 230-2"),
        QuantityGroup.SYSTEMATIC,
        "−X̄R",
        Words("The same as the mean of the positive minus that of the negative direction."),
        can_be_limited=False,
    ),
)

#: The columns of the table by position.
BY_POSITION: tuple[PositionQuantity, ...] = (
    PositionQuantity("XF", "XF_{i}", Words("Forward positional error")),
    PositionQuantity("XB", "XB_{i}", Words("Backward positional error")),
    PositionQuantity("XM", "XM_{i}", Words("Mean positional error")),
    PositionQuantity("S2F", "2SF_{i}", Words("Two standard deviations, forward")),
    PositionQuantity("S2B", "2SB_{i}", Words("Two standard deviations, backward")),
    PositionQuantity("XR", "XR_{i}", Words("Reversal error", context="step gauge")),
    PositionQuantity("B", "B_{i}", Words("Reversal error with the sign of ISO 230-2")),
)

#: What a reader of the results must know.
NOTES: tuple[Words, ...] = (
    Words(
        "Formulas as in H. Pahk and J. Kim, Development of computer aided calibration module for CMMs and "
        "machine tools using a compensated step gauge, Eq. 1 to 13. Bandwidth and repeatability are defined "
        "there by example only: the definitions above are those of this program."
    ),
    Words(
        "Where a target position is a face, and not a block, XF, SF at a back face and XB, SB at a front "
        "face are interpolated: the mean of the two neighbours (Eq. 8 to 11). In the table by position they "
        "stand where x̄ and s of that direction are missing; in the graph marks stand at measured values "
        "only. At the ends of the section nothing is extrapolated."
    ),
    Words(
        "S is a single standard deviation (n − 1); what is stated is twice that. XR = XB − XF has the sign "
        "opposite to that of the reversal value B of ISO 230-2, which stands beside it."
    ),
    Words(
        "All errors are relative to the first face of the section, where the forward error is zero by "
        "definition."
    ),
)


_RUNS_FOR_A_SCATTER = 2


class StepGaugeEvaluation:
    """Linear displacement accuracy by step gauge, after Pahk and Kim, sections 4.1 and 4.2."""

    identifier = "step-gauge"
    designation = "Pahk & Kim 4.1, 4.2"
    is_method = True
    position_index = "i"
    title = Words("Linear displacement accuracy by step gauge")
    options = Options
    quantities = PARAMETERS
    position_quantities = BY_POSITION
    notes = NOTES

    def requirements(self, measurements: MeasurementSet, options: Options) -> Iterator[Finding]:  # noqa: ARG002 - no keys of its own
        """Hold what the formulas need against the test."""
        yield number_of_runs(measurements, _RUNS_FOR_A_SCATTER, Basis.APPLIED)
        yield no_missing_readings(measurements)
        if measurements.is_bidirectional:
            yield _check_radius_from_elsewhere(measurements)

    def arithmetic(self, statistics: PositionStatistics, options: Options) -> Arithmetic:  # noqa: ARG002 - no keys of its own
        """Return the parameters, and errors and reversal by position."""
        return arithmetic(statistics)

    def figures(self, evaluation: Evaluation, options: Options) -> Iterable[Figure]:  # noqa: ARG002 - no keys of its own
        """Return the graphs of errors and of the reversal."""
        return draw_graphs(evaluation)


def _check_radius_from_elsewhere(measurements: MeasurementSet) -> Finding:
    """Ask that what parts the directions is the machine and not what was taken for the probe's radius."""
    requirement = Words(
        "An effective radius of the probe that is known from elsewhere, for the reversal error"
    )
    if not measurements.reversal_is_relative:
        known = Words("known from elsewhere")
        return Finding(requirement, known, met=True)
    found = Words(
        "determined from the blocks of the gauge: XR and B are relative to their mean within a block"
    )
    return Finding(requirement, found, met=False)


def arithmetic(statistics: PositionStatistics) -> Arithmetic:
    """Return every parameter and every column of one test or of a stack of tests (sections 4.1 and 4.2).

    Equations 4 to 7 are the statistics themselves; `zlmreport_step_gauge.deviations` has the others. NaN
    stands for what is not defined: at the ends of the section there is no neighbour to interpolate with.
    """
    forward, backward = (
        equations.interpolate(each) for each in (statistics.mean_positive, statistics.mean_negative)
    )
    of_forward, of_backward = (
        2 * equations.interpolate(each) for each in (statistics.s_positive, statistics.s_negative)
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
    return Arithmetic(_compute_parameters(statistics, reversal), columns)


def _compute_parameters(statistics: PositionStatistics, reversal: FloatArray) -> dict[str, FloatArray]:
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


_MEAN = {Approach.POSITIVE: Words("Forward error"), Approach.NEGATIVE: Words("Backward error")}
_SYMBOLS = {Approach.POSITIVE: "F", Approach.NEGATIVE: "B"}


def draw_graphs(evaluation: Evaluation) -> Iterator[Figure]:
    """Yield the graphs, as far as the test defines what they show."""
    drawn = _Graphs(evaluation)
    yield drawn.draw_errors()
    if evaluation.parameter("XR"):
        yield drawn.draw_reversal()


class _Graphs:
    """The graphs of one evaluation."""

    def __init__(self, evaluation: Evaluation) -> None:
        self.evaluation = evaluation
        self.diagram = Diagram(evaluation)
        statistics = evaluation.statistics
        self.mean, self.twice = statistics.mean, 2 * statistics.standard_deviation

    def draw_errors(self) -> Figure:
        """Return the means of both directions, their mean, and two standard deviations about them."""
        repeatability = [self._draw_repeatability(approach) for approach in Approach]
        shown = diagram_panel(
            bands=[self._draw_limits(approach) for approach in Approach],
            readings=self.diagram.readings(),
            curves=[
                *(self._draw_curve(approach) for approach in Approach),
                self.diagram.curve("XM_{i}", Role.MEAN_BIDIRECTIONAL, self.evaluation.column("XM")),
            ],
            arrows=repeatability,
            brackets=[self.diagram.bracket("W", self.mean, self.mean)],
        )
        title = Words("Axis {axis}: forward, backward and mean positional error with two standard deviations")
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

    def draw_reversal(self) -> Figure:
        """Return the reversal error by position."""
        values = self.evaluation.column("XR")
        shown = diagram_panel(curves=[self.diagram.curve("XR_{i}", Role.MEAN_BIDIRECTIONAL, values)])
        title = Words("Axis {axis}: reversal error XR = XB − XF")
        alternative = alternative_text(
            graph_in_words(self.evaluation),
            range_in_words(self.diagram.axis, Words("Reversal error", context="step gauge"), values),
        )
        return self.diagram.figure("reversal", title.given(axis=self.diagram.axis.name), alternative, [shown])

    def _draw_curve(self, approach: Approach) -> Curve | None:
        return self.diagram.curve(
            f"X{_SYMBOLS[approach]}_{{i}}", MEAN_ROLES[approach], self.mean[approach.index]
        )

    def _draw_limits(self, approach: Approach) -> Band | None:
        name = _SYMBOLS[approach]
        mean, twice = self.mean[approach.index], self.twice[approach.index]
        return self.diagram.band(
            f"X{name}_{{i}} ± 2S{name}_{{i}}", LIMIT_ROLES[approach], mean - twice, mean + twice
        )

    def _draw_repeatability(self, approach: Approach) -> Arrow | None:
        mean, twice = self.mean[approach.index], self.twice[approach.index]
        return self.diagram.arrow(f"2S{approach.arrow}", worst_position(twice), mean, mean + twice)
