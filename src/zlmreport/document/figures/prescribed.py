"""The graphs that a standard prescribes, and as found beside as left; with their alternative texts.

A standard says which curves, bands, arrows and brackets it wants and hands over values in SI; a `Diagram`
brings them into the units of the page and leaves out what this test does not define. So a graph of a
unidirectional test, or of a single run, shows what exists.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from zlmreport.document.figures.figure import (
    Arrow,
    Band,
    Bracket,
    Curve,
    Figure,
    Level,
    Panel,
    PlottedReadings,
    Role,
)
from zlmreport.evaluation.checks import deviation_in_words, position_in_words, positions_in_words
from zlmreport.evaluation.evaluation import Evaluation
from zlmreport.language import PartRow, Words
from zlmreport.language.formatting import write_plain
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import BoolArray, FloatArray, read_only_floats
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.units import say_stated, say_with_unit

Mark = TypeVar("Mark")

#: What the curve of the mean of each approach is drawn as.
MEANS = {Approach.POSITIVE: Role.MEAN_POSITIVE, Approach.NEGATIVE: Role.MEAN_NEGATIVE}
#: What the limits of the scatter of each approach are drawn as.
LIMITS = {Approach.POSITIVE: Role.LIMIT_POSITIVE, Approach.NEGATIVE: Role.LIMIT_NEGATIVE}
#: What the graph of each approach is called.
DIRECTIONS = {
    Approach.POSITIVE: Words("Positive direction of approach ↑"),
    Approach.NEGATIVE: Words("Negative direction of approach ↓"),
}
POSITION_TITLE = Words("Target position")
DEVIATION_TITLE = Words("Deviation")


def worst(values: FloatArray) -> int | None:
    """Return the index of the target position with the largest value; None where none is defined."""
    return int(np.nanargmax(values)) if np.isfinite(values).any() else None


@dataclass(frozen=True, slots=True)
class Diagram:
    """The graphs of one evaluation.

    All values go in as m or rad and NaN where not defined; positions are indices of targets. What is not
    defined anywhere gives None, and `panel` leaves it out.

    Attributes
    ----------
    evaluation
        What the graphs show.
    """

    evaluation: Evaluation

    @property
    def axis(self) -> Axis:
        """The axis under test."""
        return self.evaluation.measurements.axis

    @property
    def approaches(self) -> tuple[Approach, ...]:
        """The directions in which there is a reading, the positive one first."""
        return tuple(each for each in Approach if self.evaluation.statistics.is_measured[each.index])

    @property
    def is_bidirectional(self) -> bool:
        """Whether there are readings in both directions."""
        return len(self.approaches) == len(Approach)

    @property
    def positions(self) -> FloatArray:
        """The target positions in the unit of the page, shape (m,)."""
        return read_only_floats(
            self.axis.position_unit.from_si(self.evaluation.measurements.target_positions)
        )

    def curve(self, notation: str, role: Role, values: FloatArray) -> Curve | None:
        """Return a line through one value at each target, shape (m,)."""
        if not np.isfinite(values).any():
            return None
        shown = self._select_shown(values)
        return Curve(
            notation, role, read_only_floats(self.positions[shown]), self._convert_to_printed(values[shown])
        )

    def band(self, notation: str, role: Role, lower: FloatArray, upper: FloatArray) -> Band | None:
        """Return the area between two limits, each of shape (m,)."""
        if not (np.isfinite(lower) & np.isfinite(upper)).any():
            return None
        shown = self._select_shown(lower + upper)
        return Band(
            notation,
            role,
            read_only_floats(self.positions[shown]),
            self._convert_to_printed(lower[shown]),
            self._convert_to_printed(upper[shown]),
        )

    def readings(self, *approaches: Approach) -> tuple[PlottedReadings, ...]:
        """Return the single readings of each approach that was measured; of all approaches by default."""
        measurements = self.evaluation.measurements
        present = np.isfinite(measurements.deviation)
        found = []
        for approach in approaches or tuple(Approach):
            of_approach = present & (measurements.approach == approach)
            if of_approach.any():
                x = self.positions[measurements.target[of_approach]]
                y = self._convert_to_printed(measurements.deviation[of_approach])
                found.append(PlottedReadings(approach, read_only_floats(x), y))
        return tuple(found)

    def arrow(self, notation: str, at: int | None, low: FloatArray, high: FloatArray) -> Arrow | None:
        """Return an arrow at one target between two of the values of shape (m,), given in any order."""
        if at is None or not (np.isfinite(low[at]) and np.isfinite(high[at])):
            return None
        ends = sorted((float(self._convert_to_printed(low)[at]), float(self._convert_to_printed(high)[at])))
        return Arrow(notation, float(self.positions[at]), ends[0], ends[1])

    def bracket(self, symbol: str, lower: FloatArray, upper: FloatArray) -> Bracket | None:
        """Return a parameter of the axis as a bracket.

        Parameters
        ----------
        symbol
            Of a parameter of the evaluation; None is returned where this test does not define it.
        lower, upper : (m,) or (approach, m) arrays
            The parameter spans from the smallest of `lower` to the largest of `upper`; the bracket's
            extension lines lead to the targets at which these arise.
        """
        parameter = self.evaluation.parameter(symbol)
        if parameter is None:
            return None
        lowest, highest = int(np.nanargmin(lower)), int(np.nanargmax(upper))
        number = len(self.positions)
        return Bracket(
            parameter.quantity.notation,
            low=float(self._convert_to_printed(lower).flat[lowest]),
            high=float(self._convert_to_printed(upper).flat[highest]),
            low_at=float(self.positions[lowest % number]),
            high_at=float(self.positions[highest % number]),
        )

    def level(self, notation: str, role: Role, value: float) -> Level | None:
        """Return a horizontal line at a value."""
        if not np.isfinite(value):
            return None
        return Level(notation, role, float(self.axis.deviation_unit.from_si(value)))

    def figure(self, key: str, title: Words, alternative: Words, panels: Iterable[Panel]) -> Figure:
        """Return the figure: deviation over target position, in the units of the axis."""
        return Figure(
            key=key,
            title=title,
            alternative=alternative,
            x_title=POSITION_TITLE,
            y_title=DEVIATION_TITLE,
            x_unit=self.axis.position_unit.symbol,
            y_unit=self.axis.deviation_unit.symbol,
            panels=tuple(panels),
        )

    def _select_shown(self, values: FloatArray) -> BoolArray:
        """Return the positions that a line runs through: all, so that what is missing leaves a gap.

        But where each target can be reached in one direction only, a line runs from one of these to the next.
        """
        one_sided = self.evaluation.measurements.one_sided_targets
        shown: BoolArray = np.isfinite(values) if one_sided else np.ones(values.shape, dtype=np.bool_)
        return shown

    def _convert_to_printed(self, values: FloatArray) -> FloatArray:
        return read_only_floats(self.axis.deviation_unit.from_si(values))


def panel(  # noqa: PLR0913 - one for each kind of mark
    heading: Words | None = None,
    *,
    curves: Iterable[Curve | None] = (),
    bands: Iterable[Band | None] = (),
    readings: Iterable[PlottedReadings] = (),
    arrows: Iterable[Arrow | None] = (),
    brackets: Iterable[Bracket | None] = (),
    levels: Iterable[Level | None] = (),
) -> Panel:
    """Return a panel of what there is: None stands for what this test does not define."""
    return Panel(
        heading=heading,
        curves=_select_defined(curves),
        bands=_select_defined(bands),
        readings=tuple(readings),
        arrows=_select_defined(arrows),
        brackets=_select_defined(brackets),
        levels=_select_defined(levels),
    )


def _select_defined(marks: Iterable[Mark | None]) -> tuple[Mark, ...]:
    return tuple(mark for mark in marks if mark is not None)


_TITLE = Words("Mean deviations: {before} (above) and {after} (below), on one scale")
_NAME = Words("{measurement}, {direction}:")


def draw_comparison(before: Evaluation, after: Evaluation, names: tuple[Words, Words]) -> Figure:
    """Return the graph."""
    both = tuple(zip((before, after), names, strict=True))
    sentences = [graph_in_words(after)]
    for evaluation, name in both:
        sentences.extend(_name_ranges(evaluation, name))
    return Diagram(after).figure(
        "as-found-as-left",
        _TITLE.given(before=names[0], after=names[1]),
        alternative_text(*sentences),
        [_make_panel(evaluation, name) for evaluation, name in both],
    )


def _make_panel(evaluation: Evaluation, name: Words) -> Panel:
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


def _name_ranges(evaluation: Evaluation, name: Words) -> list[Words]:
    diagram = Diagram(evaluation)
    found = [
        range_in_words(
            diagram.axis,
            _NAME.given(measurement=name, direction=DIRECTIONS[approach]),
            evaluation.statistics.mean[approach.index],
        )
        for approach in diagram.approaches
    ]
    return [each for each in found if each is not None]


def alternative_text(*sentences: Words | None) -> Words:
    """Return the sentences as one text; None is left out."""
    said = {f"part{number}": each for number, each in enumerate(filter(None, sentences))}
    return Words(" ".join(f"{{{part}}}" for part in said), values=said)


def graph_in_words(evaluation: Evaluation) -> Words:
    """Return the sentence that says what is drawn over what."""
    targets = evaluation.measurements.target_positions
    axis = evaluation.measurements.axis
    return Words(
        "Graph of the deviation over the target position for axis {axis}: {positions}, {first} to {last}."
    ).given(
        axis=axis.name,
        positions=positions_in_words(len(targets)),
        first=position_in_words(axis, float(targets[0])),
        last=position_in_words(axis, float(targets[-1])),
    )


def range_in_words(axis: Axis, name: Words, values: FloatArray) -> Words | None:
    """Return the sentence on where values (m or rad) lie; None where none is defined."""
    if not np.isfinite(values).any():
        return None
    return Words("{name} from {low} to {high}.").given(
        name=name,
        low=deviation_in_words(axis, float(np.nanmin(values))),
        high=deviation_in_words(axis, float(np.nanmax(values))),
    )


def marks_in_words(axis: Axis, found: Iterable[Arrow | Bracket]) -> Words | None:
    """Return the sentence on arrows and brackets: symbol, length, place; None where there are none."""
    written = [
        _describe_arrow(axis, mark) if isinstance(mark, Arrow) else _describe_bracket(axis, mark)
        for mark in found
    ]
    return Words("{marks}.").given(marks=PartRow(tuple(written))) if written else None


def _describe_arrow(axis: Axis, arrow: Arrow) -> Words:
    return Words("{symbol} = {length} at {x}").given(
        symbol=write_plain(arrow.notation),
        length=say_with_unit(arrow.high - arrow.low, axis.deviation_unit.symbol),
        x=say_stated(arrow.x, axis.position_unit.symbol),
    )


def _describe_bracket(axis: Axis, bracket: Bracket) -> Words:
    if bracket.low_at == bracket.high_at:
        return _describe_arrow(axis, Arrow(bracket.notation, bracket.low_at, bracket.low, bracket.high))
    return Words("{symbol} = {length}, from its lowest point at {low_at} to its highest at {high_at}").given(
        symbol=write_plain(bracket.notation),
        length=say_with_unit(bracket.high - bracket.low, axis.deviation_unit.symbol),
        low_at=say_stated(bracket.low_at, axis.position_unit.symbol),
        high_at=say_stated(bracket.high_at, axis.position_unit.symbol),
    )
