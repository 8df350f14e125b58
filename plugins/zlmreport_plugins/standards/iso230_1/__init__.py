"""ISO 230-1:2012, geometry of linear axes: straightness, angle, squareness and parallelism.

What is published of its text are definitions: the straightness error is the largest positive deviation from
the reference line plus the amount of the largest negative one, so a span and never ±; a deviation is positive
in the positive direction of the axis (ISO 841). The three reference lines, the plan of a test and the sign of
squareness errors are this program's reading. One standard evaluates all of it: as it evaluates one error, its
parameters bear that error's symbol.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np
from pydantic import Field

from zlmreport.plugin import (
    ANGLE,
    SQUARENESS,
    STRAIGHTNESS,
    ErrorSymbol,
    Evaluation,
    Figure,
    Measurand,
    MeasurementSet,
    Options,
    Words,
    hookimpl,
)
from zlmreport.plugin.extension import Contribution
from zlmreport.plugin.standard import (
    Arithmetic,
    Basis,
    Finding,
    Information,
    PositionStatistics,
    Standard,
    both_directions,
    no_missing_readings,
    positions_in_all,
    positions_over_travel,
    positions_per_metre,
    span_over_positions,
)
from zlmreport_plugins.standards.iso230_1 import between, figures, quantities
from zlmreport_plugins.standards.iso230_1.between import SquareKeys
from zlmreport_plugins.standards.iso230_1.quantities import PARALLELISM, find_measurand
from zlmreport_plugins.standards.iso230_1.reference_lines import (
    FEWEST_POSITIONS,
    LineName,
    local_straightness,
    residuals,
    slope_of_several,
    straightness,
)

_PER_METRE, _AT_LEAST = 5, 5
_MILLIMETRE = 1e-3


class LineOptions(Options):
    """Reference line, window, and the artefact that joins two lines."""

    of_the_measurement = ("square",)

    reference_line: LineName = Field(
        "least-squares", description="The line from which deviations of straightness are taken."
    )
    window: float = Field(
        300.0,
        ge=0,
        allow_inf_nan=False,
        description="Length of the parts whose straightness is evaluated too, mm; 0 for none.",
    )
    square: SquareKeys | None = Field(
        None,
        description="Of squareness: the square, or another artefact, that both lines were measured against.",
    )


class Iso230Part1:
    """ISO 230-1:2012 for one error; without one, as an axis of no name has it."""

    identifier = "iso230-1:2012"
    designation = "ISO 230-1:2012"
    adoptions = ("JIS B 6190-1:2016",)
    title = Words("Geometric accuracy of axes of linear motion")
    position_index = "i"
    options: type[Options] = LineOptions
    measurands = (STRAIGHTNESS, ANGLE, SQUARENESS, PARALLELISM)
    information = tuple(each for each in Information if each is not Information.REFERENCE_TEMPERATURE)

    def __init__(self, what: ErrorSymbol | Measurand = STRAIGHTNESS) -> None:
        self.what = what
        self.measurand = find_measurand(what)
        self.quantities, self.position_quantities = quantities.define_of(what)
        self.notes = tuple(_list_notes(what))

    def of_error(self, error: ErrorSymbol | Measurand) -> Iso230Part1:
        """Return the standard as it evaluates an error."""
        return Iso230Part1(error)

    def requirements(self, measurements: MeasurementSet, options: LineOptions) -> Iterator[Finding]:
        """Hold the plan of a test of one line, or what two lines need to have in common, against the test."""
        if measurements.tests:
            yield from between.check_requirements(self.what, measurements, options.square)
            return
        yield positions_in_all(measurements, FEWEST_POSITIONS, Basis.APPLIED)
        yield positions_per_metre(measurements, _PER_METRE, Basis.APPLIED, minimum=_AT_LEAST)
        yield both_directions(measurements, _ONE_DIRECTION, Basis.APPLIED)
        yield no_missing_readings(measurements)
        yield positions_over_travel(measurements)

    def arithmetic(self, statistics: PositionStatistics, options: LineOptions) -> Arithmetic:
        """Return the parameters of the error."""
        if self.measurand.joins_tests:
            values = between.compute_values(self.what, statistics, options.reference_line, options.square)
            return Arithmetic({each.symbol: values[each.symbol] for each in self.quantities})
        if self.measurand.identifier == ANGLE.identifier:
            return self._evaluate_angles(statistics)
        return self._evaluate_straightness(statistics, options)

    def _evaluate_straightness(self, statistics: PositionStatistics, options: LineOptions) -> Arithmetic:
        x, line, symbol = statistics.positions, options.reference_line, self.quantities[0].symbol
        mean = statistics.mean_of_all_runs
        of_each = straightness(x, statistics.mean, line)
        of_runs = straightness(x, np.moveaxis(statistics.deviations, -1, -2), line)
        local = local_straightness(x, mean, line, options.window * _MILLIMETRE) if options.window else np.nan
        parameters = {
            symbol: straightness(x, mean, line),
            f"{symbol}_fwd": of_each[..., 0],
            f"{symbol}_bwd": of_each[..., 1],
            f"{symbol}_run": np.fmax.reduce(of_runs, axis=(-2, -1), initial=np.nan),
            f"{symbol}_local": np.broadcast_to(local, mean.shape[:-1]),
            "slope": slope_of_several(x, mean, line),
        }
        deviations = residuals(x, statistics.mean, line)
        columns = {
            "d_fwd": deviations[..., 0, :],
            "d_bwd": deviations[..., 1, :],
            "d": residuals(x, mean, line),
        }
        return Arithmetic(parameters, columns)

    def _evaluate_angles(self, statistics: PositionStatistics) -> Arithmetic:
        symbol, mean = self.quantities[0].symbol, statistics.mean
        of_each, both = span_over_positions(mean), mean.reshape(*mean.shape[:-2], -1)
        over_both = np.where(statistics.is_bidirectional, span_over_positions(both), np.nan)
        return Arithmetic(
            {
                symbol: span_over_positions(statistics.mean_of_all_runs),
                f"{symbol}_fwd": of_each[..., 0],
                f"{symbol}_bwd": of_each[..., 1],
                f"{symbol}_both": over_both,
            }
        )

    def contributions(
        self, measurements: MeasurementSet, options: LineOptions
    ) -> Mapping[str, Sequence[Contribution]]:
        """Return what the artefact adds to the uncertainty of the second of two lines."""
        return between.list_contributions(self.what, measurements, options.square)

    def figures(self, evaluation: Evaluation, options: LineOptions) -> Iterable[Figure]:
        """Return the deviations from the reference line and the readings with it; of two lines, both."""
        if evaluation.measurements.tests:
            return between.draw_figures(self.what, evaluation, options.reference_line)
        if self.measurand.identifier == ANGLE.identifier:
            return figures.draw_angles(evaluation, self.quantities)
        return figures.draw_straightness(evaluation, self.quantities, options.reference_line)


_ONE_DIRECTION = Words("the error symbol then stands for this direction")
_SPAN = Words(
    "Straightness errors are spans: the largest positive deviation from the reference line plus the amount "
    "of the largest negative one, and not ±. The line is laid within the measured positions only; its "
    "slope is the alignment of the set-up."
)
_DIRECTIONS = Words(
    "Each direction has a reference line of its own; the graph shows both about the line of the mean of all "
    "runs."
)
_ANGLES = Words(
    "Angular errors are spans: no line is taken off, and where the instrument was set to zero has no "
    "influence."
)


def _list_notes(what: ErrorSymbol | Measurand) -> Iterator[Words]:
    measurand = find_measurand(what)
    if measurand.joins_tests:
        yield from between.list_notes(what)
    elif measurand.identifier == ANGLE.identifier:
        yield from (_ANGLES, Words("1″ = 4.848 µrad: on an arm of 100 mm 0.485 µm."))
    else:
        yield from (_SPAN, _DIRECTIONS)


@hookimpl
def zlmreport_standards() -> tuple[Standard, ...]:
    """Offer the standard."""
    return (Iso230Part1(),)
