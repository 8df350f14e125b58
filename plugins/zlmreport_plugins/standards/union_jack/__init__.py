"""Flatness of a surface plate by the union jack: eight lines of slopes (J. C. Moody, 1955).

The recipe, the data and the largest closure are published; in the corrected form, in which the lowest height
is subtracted and every reading counts. Planes of least squares and of minimum zone are general; that the
diagonals should fit the edges to a tenth of their length is this program's demand.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np
from pydantic import Field

from zlmreport.plugin import (
    MILLIMETRE,
    Axis,
    Evaluation,
    Figure,
    JobPart,
    MeasurementSet,
    Options,
    Positive,
    TextLine,
    Words,
    hookimpl,
)
from zlmreport.plugin.extension import (
    STATED_COVERAGE_FACTOR,
    USUAL_CONTRIBUTIONS,
    Contribution,
    Distribution,
    calibration_in_words,
    expanded_uncertainty_in_words,
    of_the_reading,
)
from zlmreport.plugin.standard import (
    Arithmetic,
    Basis,
    Finding,
    Information,
    PositionQuantity,
    PositionStatistics,
    Standard,
    deviation_in_words,
    no_missing_readings,
    position_in_words,
    position_statistics,
    worst_of_lines,
)
from zlmreport_plugins.standards.union_jack.figures import draw_figures
from zlmreport_plugins.standards.union_jack.heights import Plate, find_plate_of
from zlmreport_plugins.standards.union_jack.planes import compute_least_squares_span, find_minimum_zone
from zlmreport_plugins.standards.union_jack.quantities import (
    MOST_CLOSURE,
    NOTES,
    QUANTITIES,
    make_closure_symbol,
)
from zlmreport_plugins.union_jack_lines import (
    ACROSS,
    ALONG,
    CENTRE_LINES,
    DIAGONALS,
    FLATNESS,
    LINES,
    list_lacking,
    put_in_one_order,
)

#: Of the length that a diagonal has by the edges.
_FITS = 0.1
_FEWEST = 4


class CarriageKeys(JobPart):
    """The carriage whose feet stand on the plate."""

    expanded_uncertainty: Positive | None = Field(
        None, description="Of the distance of its feet, k = 2, mm.", examples=[0.1]
    )
    certificate: TextLine | None = Field(None, description="Where that distance is known from.")


class PlateOptions(Options):
    """The carriage that all lines were measured with."""

    of_the_measurement = ("carriage",)

    carriage: CarriageKeys = Field(
        CarriageKeys(), description="The carriage that all lines were measured with."
    )


class UnionJack:
    """The union jack of eight lines."""

    identifier = "union-jack"
    designation = "Union jack (Moody 1955)"
    title = Words("Flatness of a surface plate by the union-jack method")
    position_index = "i"
    options: type[Options] = PlateOptions
    measurands = (FLATNESS,)
    information = (Information.TEMPERATURES, Information.INSTRUMENT)
    quantities = QUANTITIES
    position_quantities: tuple[PositionQuantity, ...] = ()
    notes: tuple[Words, ...] = NOTES

    def requirements(self, measurements: MeasurementSet, options: PlateOptions) -> Iterator[Finding]:  # noqa: ARG002 - of the plan no key says anything
        """Hold the plan of the lines, and how well they agree, against the test."""
        tests = measurements.tests
        yield _check_all_eight(tests)
        yield _check_stations(tests)
        if tests:
            yield worst_of_lines(tests, no_missing_readings)
        plate = find_plate_of(
            {
                name: position_statistics(each.deviations(), each.target_positions)
                for name, each in tests.items()
            }
        )
        if plate is not None:
            yield _check_lengths(tests)
            yield _check_closing(plate, measurements.axis)

    def arithmetic(self, statistics: PositionStatistics, options: PlateOptions) -> Arithmetic:  # noqa: ARG002 - heights need none
        """Return the flatness over the three planes, and the closures."""
        plate = find_plate_of(statistics.tests)
        if plate is None:
            return Arithmetic(
                {each.symbol: np.full(statistics.mean.shape[:-2], np.nan) for each in QUANTITIES}
            )
        closures = {make_closure_symbol(name): plate.closures[name] for name in CENTRE_LINES}
        return Arithmetic(
            {
                "t": np.asarray(np.ptp(plate.heights, axis=-1)),
                "t_LS": compute_least_squares_span(plate.points, plate.heights),
                "t_MZ": find_minimum_zone(plate.points, plate.heights),
                **closures,
            }
        )

    def contributions(
        self, measurements: MeasurementSet, options: PlateOptions
    ) -> Mapping[str, Sequence[Contribution]]:
        """Return what the distance of the feet adds: all heights are in proportion to it, on every line."""
        stated = options.carriage.expanded_uncertainty
        if stated is None:
            return {}
        said = expanded_uncertainty_in_words(stated, MILLIMETRE.symbol, STATED_COVERAGE_FACTOR)
        source = calibration_in_words(options.carriage.certificate)
        expanded = MILLIMETRE.to_si(stated)
        return {
            name: [
                Contribution(
                    name=USUAL_CONTRIBUTIONS[_FEET],
                    distribution=Distribution.NORMAL,
                    stated=said,
                    source=source,
                    contributor=_FEET,
                    **of_the_reading(expanded / STATED_COVERAGE_FACTOR / _find_foot(line), line, _FEET),
                )
            ]
            for name, line in measurements.tests.items()
        }

    def figures(self, evaluation: Evaluation, options: PlateOptions) -> Iterable[Figure]:  # noqa: ARG002 - likewise
        """Return the plate as a wire picture, and its plan with the heights in numbers."""
        return draw_figures(evaluation)


def _find_foot(line: MeasurementSet) -> float:
    """Return how far the feet stood apart, m: the front one of the first station from the beginning."""
    return float(line.target_positions[0])


def _check_all_eight(tests: Mapping[str, MeasurementSet]) -> Finding:
    missing = list_lacking(tests)
    if missing:
        return Finding(_EIGHT, _LACKING.given(names=", ".join(missing)), met=False)
    if len(tests) > len(LINES):
        return Finding(_EIGHT, _TWICE, met=None)
    return Finding(_EIGHT, _ALL, met=True)


def _check_stations(tests: Mapping[str, MeasurementSet]) -> Finding:
    fewest = min((len(each.target_positions) for each in tests.values()), default=0)
    number = Words("{number}").given(number=fewest)
    return Finding(_READINGS.given(number=_FEWEST), number, fewest >= _FEWEST, Basis.APPLIED)


def _check_lengths(tests: Mapping[str, MeasurementSet]) -> Finding:
    """Return whether the diagonals are as long as the edges make them."""
    lines = put_in_one_order(tests)
    length = {name: float(each.target_positions[-1]) for name, (_, each) in lines.items()}
    along, across = (np.mean([length[name] for name in names]) for names in (ALONG, ACROSS))
    nominal = math.hypot(along, across)
    name = max(DIAGONALS, key=lambda each: abs(length[each] - nominal))
    axis = lines[name][1].axis
    found = _DIAGONAL.given(
        name=name,
        measured=position_in_words(axis, float(f"{length[name]:.4g}")),
        nominal=position_in_words(axis, float(f"{nominal:.4g}")),
    )
    return Finding(_FIT, found, abs(length[name] - nominal) <= _FITS * nominal, Basis.APPLIED)


def _check_closing(plate: Plate, axis: Axis) -> Finding:
    """Return whether the centre lines meet the diagonals in the middle of the plate."""
    worst = max((float(abs(each)) for each in plate.closures.values()), default=math.nan)
    asked = _CLOSURE.given(most=deviation_in_words(axis, MOST_CLOSURE))
    if not math.isfinite(worst):
        return Finding(asked, _NOT_STATED, met=False)
    found = deviation_in_words(axis, float(f"{worst:.3g}"))
    return Finding(asked, found, worst <= MOST_CLOSURE, Basis.PUBLISHED)


_FEET = "foot_spacing"
_EIGHT = Words("Eight lines: diagonals, edges and centre lines")
_ALL = Words("all eight")
_LACKING = Words("{names} not measured; no height follows from the others")
_TWICE = Words("a line was measured both ways: that in the usual direction counts")
_NOT_STATED = Words("not defined")
_READINGS = Words("At least {number} readings on each line")
_FIT = Words("Diagonals as long as the edges make them, to a tenth")
_DIAGONAL = Words("{name}: {measured}, by the edges {nominal}")
_CLOSURE = Words("Closure of both centre lines up to {most}")


@hookimpl
def zlmreport_standards() -> tuple[Standard, ...]:
    """Offer the standard."""
    return (UnionJack(),)
