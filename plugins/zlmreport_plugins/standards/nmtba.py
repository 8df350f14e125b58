"""The NMTBA recommendation of 1972 for machine tools.

All readings at a position form one sample, whatever their direction: the reversal is inside the spread,
and there is no parameter for it. A test in one direction has the readings of this direction for its
sample. Every function takes the statistics of one test or of a stack of tests; NaN stands for what is not
defined: in a test of both directions, a position that lacks one of them. Positions are counted by j,
cycles by i.

Source: the ZLM Position manual, G 1.3; the bar over X that its formulas of the parameters lack is set.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from zlmreport.plugin import Evaluation, Figure, FloatArray, MeasurementSet, Options, Words, hookimpl
from zlmreport.plugin.standard import (
    MEAN_ROLES,
    Arithmetic,
    Arrow,
    Band,
    Basis,
    Curve,
    Diagram,
    Finding,
    Level,
    Panel,
    PositionQuantity,
    PositionStatistics,
    Quantity,
    QuantityGroup,
    Role,
    Standard,
    alternative_text,
    both_directions,
    deviation_in_words,
    diagram_panel,
    graph_in_words,
    largest_over_positions,
    marks_in_words,
    mean_over_positions,
    no_missing_readings,
    number_of_runs,
    positions_in_words,
    positions_over_travel,
    range_in_words,
    range_over_positions,
    smallest_over_positions,
    spacing_against_periods,
    span_over_positions,
    worst_position,
)

_MEAN = "X̄_{j}"
_HALF_SPREAD = "½P_{sj}"
_SPREAD = f"P_{{sj}} = 6√(∑[(x_{{ij}}↑ − {_MEAN})² + (x_{{ij}}↓ − {_MEAN})²] / (2z − 1))"

#: The parameters of the axis in the order of the results table.
PARAMETERS: tuple[Quantity, ...] = (
    Quantity(
        "P",
        "P",
        Words("Position uncertainty"),
        QuantityGroup.COMPOSITE,
        f"max[{_MEAN} + {_HALF_SPREAD}] − min[{_MEAN} − {_HALF_SPREAD}]",
        Words(
            "The largest error, systematic and random together, that positioning is expected to bring into a "
            "dimension of a part, whichever the direction of approach."
        ),
        never_below=("Pa", "Ps_max"),
    ),
    Quantity(
        "Pa",
        "P_{a}",
        Words("Position deviation"),
        QuantityGroup.SYSTEMATIC,
        f"max[{_MEAN}] − min[{_MEAN}], {_MEAN} = 1/(2z) · ∑(x_{{ij}}↑ + x_{{ij}}↓)",
        Words("The largest error of a dimension that remains on average over many like parts."),
    ),
    Quantity(
        "Ps_max",
        "P_{s max}",
        Words("Largest position spread"),
        QuantityGroup.RANDOM,
        f"max[P_{{sj}}], {_SPREAD}",
        Words(
            "The scatter to expect of a feature's place among like parts, the effect of the direction of "
            "approach included, at the position where it is largest."
        ),
        never_below=("Ps_mean",),
    ),
    Quantity(
        "Ps_mean",
        "P_{s mit}",
        Words("Mean position spread"),
        QuantityGroup.RANDOM,
        "(1/n) · ∑ P_{sj}",
        Words(
            "The scatter to expect of a feature's place among like parts, the effect of the direction of "
            "approach included, averaged over the positions."
        ),
    ),
    Quantity(
        "O",
        "O",
        Words("Offset"),
        QuantityGroup.SYSTEMATIC,
        f"−½(max[{_MEAN} + {_HALF_SPREAD}] + min[{_MEAN} − {_HALF_SPREAD}])",
        Words(
            "What to add to every deviation so that parts scatter evenly about the intended place: the band "
            "is then ± P/2."
        ),
    ),
)

#: The columns that the recommendation adds to the table by position.
BY_POSITION: tuple[PositionQuantity, ...] = (
    PositionQuantity("X", _MEAN, Words("Mean of all readings")),
    PositionQuantity("Ps", "P_{sj}", Words("Position spread")),
)

#: What a reader of the results must know.
NOTES: tuple[Words, ...] = (
    Words(
        "P is the full width of the band; the recommendation quotes accuracy as ± P/2 after the offset O. "
        "The limits lie three standard deviations to either side of the mean of all readings."
    ),
    Words(
        "The readings of both directions form one sample (2z − 1 degrees of freedom): the reversal is part "
        "of the spread and has no parameter of its own."
    ),
    Words("The index “mit” marks a mean over the positions."),
    Words(
        "Formulas as in the manual of the program ZLM Position, G 1.3; corrected: bar over X in the formulas "
        "of the parameters."
    ),
)

#: The same of a test in one direction, of which the formulas for both do not hold.
NOTES_OF_ONE_DIRECTION: tuple[Words, ...] = (
    Words(
        "This test has readings of one direction only, and they alone are the sample: the mean deviation is "
        "that of these z readings, the position spread six times their standard deviation (z − 1), without "
        "any reversal. The formulas above are those for both directions."
    ),
    NOTES[0],
    *NOTES[2:],
)

_MEAN_DEVIATION = Words("Mean deviation")
_RUNS_FOR_A_SCATTER = 2
_ONE_DIRECTION_ONLY = Words(
    "the formulas pool both: here the readings of this direction alone are the sample"
)


class Nmtba:
    """The NMTBA recommendation of 1972."""

    identifier = "nmtba"
    designation = "NMTBA (1972)"
    position_index = "j"
    title = Words("Positioning accuracy of numerically controlled machine tools")
    options = Options
    quantities = PARAMETERS
    position_quantities = BY_POSITION
    notes = NOTES
    notes_of_one_direction = NOTES_OF_ONE_DIRECTION

    def requirements(self, measurements: MeasurementSet, options: Options) -> Iterator[Finding]:  # noqa: ARG002 - no keys of its own
        """Yield the requirements, held against the test.

        The recommendation's own numbers have not been read; only what its formulas need is asked.
        """
        yield both_directions(measurements, _ONE_DIRECTION_ONLY, Basis.APPLIED)
        yield number_of_runs(measurements, _RUNS_FOR_A_SCATTER, Basis.APPLIED)
        yield _check_number_of_positions(measurements)
        yield no_missing_readings(measurements)
        yield positions_over_travel(measurements)
        yield from spacing_against_periods(measurements, Basis.APPLIED)

    def arithmetic(self, statistics: PositionStatistics, options: Options) -> Arithmetic:  # noqa: ARG002 - no keys of its own
        """Return the parameters, and X̄_j and P_sj by position."""
        mean = mean_deviation(statistics)
        spread = position_spread(statistics, mean)
        return Arithmetic(parameters(mean, spread), {"X": mean, "Ps": spread})

    def figures(self, evaluation: Evaluation, options: Options) -> Iterator[Figure]:  # noqa: ARG002 - no keys of its own
        """Yield both diagrams, as far as the test defines what they show."""
        graphs = _Graphs(evaluation)
        yield graphs.draw_means()
        yield graphs.draw_overall()


def _check_number_of_positions(measurements: MeasurementSet) -> Finding:
    """Return the open finding on the number of positions, for which no number is known."""
    requirement = Words("Number of target positions as the recommendation asks")
    found = Words("{positions}; no number known to hold them against")
    number = len(measurements.target_positions)
    return Finding(requirement, found.given(positions=positions_in_words(number)), met=None)


def mean_deviation(statistics: PositionStatistics) -> FloatArray:
    """X̄_j, the mean of all readings at a position, shape (..., position).

    X̄_j = 1/(2z) · Σ(x_ij↑ + x_ij↓); with readings missing, their sum by their number.
    """
    count = statistics.count
    total = np.where(count > 0, count * statistics.mean, 0.0).sum(axis=-2)
    with np.errstate(invalid="ignore"):
        mean = total / count.sum(axis=-2)
    lacks_a_direction = np.any(count == 0, axis=-2) & statistics.is_bidirectional[..., np.newaxis]
    return np.where(lacks_a_direction, np.nan, mean)


def position_spread(statistics: PositionStatistics, mean: FloatArray) -> FloatArray:
    """P_sj = 6·√(Σ_i[(x_ij↑ − X̄_j)² + (x_ij↓ − X̄_j)²] / (2z − 1)), shape (..., position).

    The sum of squares about X̄_j is taken as that about the mean of each direction and that of these means
    about X̄_j: two sums of squares, in which nothing cancels.

    `mean`, (..., position): X̄_j.
    """
    count = statistics.count
    degrees_of_freedom = count.sum(axis=-2) - 1
    within = np.where(count > 1, (count - 1) * statistics.standard_deviation**2, 0.0)
    between = np.where(count > 0, count * (statistics.mean - mean[..., np.newaxis, :]) ** 2, 0.0)
    squares = (within + between).sum(axis=-2)
    spread: FloatArray = 6 * np.sqrt(squares / np.where(degrees_of_freedom > 0, degrees_of_freedom, np.nan))
    return spread


def parameters(mean: FloatArray, spread: FloatArray) -> dict[str, FloatArray]:
    """Return the parameters of the axis by symbol, each of shape (...).

    `mean`, `spread`, (..., position): X̄_j and P_sj.
    """
    upper, lower = mean + spread / 2, mean - spread / 2
    return {
        "P": range_over_positions(upper, lower),
        "Pa": span_over_positions(mean),
        "Ps_max": largest_over_positions(spread),
        "Ps_mean": mean_over_positions(spread),
        "O": offset(upper, lower),
    }


def offset(upper: FloatArray, lower: FloatArray) -> FloatArray:
    """O = −½·(max[X̄_j + P_sj/2] + min[X̄_j − P_sj/2]): what centres the band on zero. Shape (...)."""
    return -(largest_over_positions(upper) + smallest_over_positions(lower)) / 2


class _Graphs:
    """The diagrams of one evaluation; the limits are formed once."""

    def __init__(self, evaluation: Evaluation) -> None:
        self.evaluation = evaluation
        self.diagram = Diagram(evaluation)
        self.mean, self.spread = evaluation.column("X"), evaluation.column("Ps")
        self.upper, self.lower = self.mean + self.spread / 2, self.mean - self.spread / 2
        self.offset = evaluation.value("O")

    def draw_means(self) -> Figure:
        """Return means and limits by position, with P_sj/2 where the spread is largest."""
        shown = diagram_panel(
            bands=[self._draw_band()],
            readings=self.diagram.readings(),
            curves=[self._draw_curve()],
            arrows=[self.diagram.arrow("P_{sj}/2", worst_position(self.spread), self.mean, self.upper)],
        )
        title = Words("Axis {axis}: mean deviations and position spread")
        return self._make_figure("means", title, shown, marks_in_words(self.diagram.axis, shown.arrows))

    def draw_overall(self) -> Figure:
        """Return P and P_a at the places where they arise, and the offset O that centres the band."""
        shown = diagram_panel(
            bands=[self._draw_band()],
            curves=[self._draw_curve()],
            arrows=[self._draw_offset_arrow()],
            brackets=[
                self.diagram.bracket("P", self.lower, self.upper),
                self.diagram.bracket("Pa", self.mean, self.mean),
            ],
            levels=[self._draw_middle()],
        )
        title = Words("Axis {axis}: position uncertainty, position deviation and offset")
        sentences = marks_in_words(self.diagram.axis, shown.brackets), self._say_offset()
        return self._make_figure("overall", title, shown, *sentences)

    def _draw_curve(self) -> Curve | None:
        approaches = self.diagram.approaches
        role = MEAN_ROLES[approaches[0]] if len(approaches) == 1 else Role.MEAN_BIDIRECTIONAL
        return self.diagram.curve(_MEAN, role, self.mean)

    def _draw_band(self) -> Band | None:
        return self.diagram.band(f"{_MEAN} ± {_HALF_SPREAD}", Role.SPREAD, self.lower, self.upper)

    def _draw_middle(self) -> Level | None:
        """Return the line in the middle of the band, which lies at −O."""
        return None if self.offset is None else self.diagram.level("−O", Role.BAND_LIMIT, -self.offset)

    def _draw_offset_arrow(self) -> Arrow | None:
        """Return the arrow from zero to the middle of the band, at the first target."""
        if self.offset is None:
            return None
        middle = np.full_like(self.mean, -self.offset)
        return self.diagram.arrow("O", 0, np.zeros_like(middle), middle)

    def _say_offset(self) -> Words | None:
        if self.offset is None:
            return None
        return Words("The band's middle lies at {middle}, so that O = {offset}.").given(
            middle=deviation_in_words(self.diagram.axis, -self.offset),
            offset=deviation_in_words(self.diagram.axis, self.offset),
        )

    def _make_figure(self, key: str, title: Words, shown: Panel, *sentences: Words | None) -> Figure:
        axis = self.diagram.axis
        alternative = alternative_text(
            graph_in_words(self.evaluation), range_in_words(axis, _MEAN_DEVIATION, self.mean), *sentences
        )
        return self.diagram.figure(key, title.given(axis=axis.name), alternative, (shown,))


@hookimpl
def zlmreport_standards() -> tuple[Standard, ...]:
    """Return the one recommendation."""
    return (Nmtba(),)
