"""ISO 230-2, positioning of numerically controlled axes: editions 1988, 1997, 2006 and 2014.

The editions are rows of one table, each with its words (`editions`); their formulas differ by the coverage
factor only (`formulas`).

The numbers of 1988 are those of the ZLM Position manual (G 1.1), and so published; those of the later
editions have not been read in the standard's own text and are applied as they are in use, but for the rule
on long axes: clause 6.2 of GOST ISO 230-2-2016, which is ISO 230-2:2014.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType

from zlmreport.plugin import (
    ANGLE,
    POSITIONING,
    Axis,
    AxisKind,
    ErrorSymbol,
    Evaluation,
    Figure,
    Measurand,
    MeasurementSet,
    Options,
    Words,
    hookimpl,
)
from zlmreport.plugin.standard import (
    Arithmetic,
    Basis,
    Finding,
    Information,
    PositionStatistics,
    Standard,
    both_directions,
    exceeds,
    fewest_runs,
    mean_interval,
    measured_length,
    no_missing_readings,
    number_of_runs,
    position_in_words,
    positions_by_angle,
    positions_over_travel,
    positions_per_metre,
    positions_per_scale_element,
    principal_angles,
    random_fractions,
    runs_in_words,
    spacing_against_periods,
)
from zlmreport_plugins.standards.iso230_2 import editions, figures, formulas
from zlmreport_plugins.standards.iso230_2.editions import EDITIONS, Edition

_RUNS = 5
_LONG = {AxisKind.LINEAR: 2.0, AxisKind.ROTARY: 2 * math.pi}
_POSITIONS_BY_ANGLE = {math.pi / 2: 3, math.pi: 5}
_POSITIONS_ABOVE = 8
_MEAN_INTERVAL_OF_LONG_AXIS = 0.25
#: What follows from standard deviations.
_OF_SCATTER = ("R", "R_fwd", "R_bwd", "A", "A_fwd", "A_bwd")

_ONE_DIRECTION_ONLY = Words("only the parameters of this direction exist")


def _find_axis_length(measurements: MeasurementSet) -> float:
    """Return the length of the axis, m or rad: its travel, or what was measured where none is stated."""
    travel = measurements.axis.travel
    measured = measured_length(measurements)
    return max(measured, abs(travel[1] - travel[0])) if travel else measured


def _is_long(measurements: MeasurementSet, length: float) -> bool:
    return exceeds(length, _LONG[measurements.axis.kind])


def _is_long_axis_test(measurements: MeasurementSet) -> bool:
    """Tell whether the test is one of a long axis, and not of a shorter zone with several runs."""
    if _is_long(measurements, measured_length(measurements)):
        return True
    return _is_long(measurements, _find_axis_length(measurements)) and fewest_runs(measurements) == 1


def _check_full_test(edition: Edition, measurements: MeasurementSet) -> Iterator[Finding]:
    """Yield the requirements on a test with several runs."""
    axis = measurements.axis
    if edition.long_axis is not None and _is_long(measurements, _find_axis_length(measurements)):
        yield _check_zone(axis, _find_axis_length(measurements), measured_length(measurements))
    yield number_of_runs(measurements, _RUNS, Basis.APPLIED)
    if axis.kind is AxisKind.ROTARY:
        yield positions_by_angle(measurements, _POSITIONS_BY_ANGLE, _POSITIONS_ABOVE, Basis.APPLIED)
        yield principal_angles(measurements, Basis.APPLIED)
        return
    basis = Basis.PUBLISHED if edition.long_axis is None else Basis.APPLIED
    yield positions_per_metre(measurements, 5, basis, minimum=5)
    if edition.long_axis is None:
        yield positions_per_scale_element(measurements, 1, basis)


def _check_zone(axis: Axis, length: float, measured: float) -> Finding:
    """Return the finding on a zone of a long axis that was tested in full."""
    requirement = Words("On an axis above {limit}, a full test of a shorter zone only as agreed").given(
        limit=position_in_words(axis, _LONG[axis.kind])
    )
    found = Words("{measured} of {length}").given(
        measured=position_in_words(axis, measured), length=position_in_words(axis, length)
    )
    return Finding(requirement, found, met=None)


def _check_long_axis(basis: Basis, measurements: MeasurementSet) -> Iterator[Finding]:
    """Yield the requirements on an axis above 2000 mm or 360°: one run, and no s, R, A."""
    axis, number = measurements.axis, fewest_runs(measurements)
    requirement = Words("Above {limit} one run in each direction; s, R and A are not evaluated").given(
        limit=position_in_words(axis, _LONG[axis.kind])
    )
    length = position_in_words(axis, _find_axis_length(measurements))
    if number == 1:
        found = Words("1 run on {length}; s, R and A are not evaluated")
        yield Finding(requirement, found.given(length=length), met=True, basis=basis)
    else:
        found = Words(
            "{runs} on {length}; the R and A that follow from them go beyond the standard, and nothing is "
            "decided on their limits"
        ).given(runs=runs_in_words(number), length=length)
        yield Finding(requirement, found, met=False, basis=basis, undecided=_OF_SCATTER)
    if axis.kind is AxisKind.LINEAR:
        yield mean_interval(measurements, _MEAN_INTERVAL_OF_LONG_AXIS, Basis.APPLIED)


_FULL_WIDTHS = Words("No parameter is a ± value: spreads and ranges are full widths.")
_LIMITS = Words("The limits lie {k} standard deviations (n − 1) to either side of the mean of one direction.")
_REPEATABILITY = Words(
    "R is the largest bidirectional repeatability of a position; it contains the reversal there and can "
    "exceed both R↑ and R↓."
)
_REVERSAL = Words(
    "The reversal at a position is the mean of the positive minus the mean of the negative direction. B is "
    "its largest amount, B̄ its mean over the positions with sign."
)
_OPPOSITE_REVERSAL = Words(
    "B̄ is printed with the sign of this edition: the mean of the negative minus the mean of the positive "
    "direction. The table by position and the results file take the positive minus the negative direction."
)
_NOT_COMPARABLE = Words(
    "Limits at 3 standard deviations make A and R larger than by the editions since 1997, which take 2: the "
    "values are not to be compared. This edition defines neither E nor M."
)
_SOURCE = Words(
    "Formulas as in the manual of the program ZLM Position, G 1.3; corrected: bars over the means of the "
    "mean reversal value, targets P = N·p + r."
)


_OF_ANGLES = Words(
    "This standard is on positioning: its formulas are applied to angles, as is usual, and nothing else of "
    "it."
)


def list_notes(edition: Edition) -> tuple[Words, ...]:
    """Return the notes of an edition."""
    general = (_FULL_WIDTHS, _LIMITS.given(k=edition.coverage_factor), _REPEATABILITY)
    if edition.prints_reversal_as_negative_minus_positive:
        return (*general, _OPPOSITE_REVERSAL, _NOT_COMPARABLE, _SOURCE)
    return (*general, _REVERSAL)


#: Notes that speak of parameters, with the symbols of which one must be reported.
_NOTES_ON: tuple[tuple[tuple[str, ...], Words], ...] = (
    (("R",), _REPEATABILITY),
    (("B", "B_mean"), _REVERSAL),
    (("B_mean",), _OPPOSITE_REVERSAL),
    (_OF_SCATTER, _NOT_COMPARABLE),
)


#: Names of the identical text, where it is published that it is.
_ADOPTIONS: Mapping[int, tuple[str, ...]] = MappingProxyType({2014: ("BS ISO 230-2:2014",)})


class Iso230Part2:
    """ISO 230-2 in one edition."""

    title = Words("Accuracy and repeatability of positioning of numerically controlled axes")
    options = Options
    information = tuple(Information)

    measurands = (POSITIONING, ANGLE)

    def __init__(self, edition: Edition, *, of_angle: bool = False) -> None:
        self.edition = edition
        self.identifier = f"iso230-2:{edition.year}"
        self.designation = f"ISO 230-2:{edition.year}"
        self.adoptions = _ADOPTIONS.get(edition.year, ())
        self.position_index = edition.position_index
        self.quantities = editions.list_parameters(edition, of_angle=of_angle)
        self.position_quantities = editions.list_by_position(edition)
        self.notes_on = (*_NOTES_ON, (_OF_SCATTER, _LIMITS.given(k=edition.coverage_factor)))
        self.notes = (*((_OF_ANGLES,) if of_angle else ()), *list_notes(edition))

    def of_error(self, error: ErrorSymbol | Measurand) -> Iso230Part2:
        """Return the edition as it evaluates an error: the angles of an axis by the same formulas."""
        measurand = error if isinstance(error, Measurand) else error.measurand
        of_angle = measurand.identifier == ANGLE.identifier
        return Iso230Part2(self.edition, of_angle=True) if of_angle else self

    def requirements(self, measurements: MeasurementSet, options: Options) -> Iterator[Finding]:  # noqa: ARG002 - no keys of its own
        """Yield the edition's requirements, held against the test."""
        of_long_axis = self.edition.long_axis
        yield both_directions(measurements, _ONE_DIRECTION_ONLY, Basis.PUBLISHED)
        if of_long_axis is not None and _is_long_axis_test(measurements):
            yield from _check_long_axis(of_long_axis, measurements)
        else:
            yield from _check_full_test(self.edition, measurements)
        yield no_missing_readings(measurements)
        yield positions_over_travel(measurements)
        yield from spacing_against_periods(measurements, Basis.APPLIED)
        if of_long_axis is None:
            yield random_fractions(measurements, "P = N·p + r", Basis.PUBLISHED)
        else:
            yield random_fractions(measurements, "P = (i − 1)·p + r", Basis.APPLIED)

    def arithmetic(self, statistics: PositionStatistics, options: Options) -> Arithmetic:  # noqa: ARG002 - no keys of its own
        """Return the edition's parameters and R_i by position."""
        k = self.edition.coverage_factor
        by_position = formulas.positions(statistics, k)
        parameters = formulas.parameters(statistics, k, by_position)
        reported = {quantity.symbol: parameters[quantity.symbol] for quantity in self.quantities}
        return Arithmetic(reported, by_position)

    def figures(self, evaluation: Evaluation, options: Options) -> Iterable[Figure]:  # noqa: ARG002 - no keys of its own
        """Return the bidirectional graphs and the graph of both directions one by one."""
        return figures.draw_figures(self.edition, evaluation)


@hookimpl
def zlmreport_standards() -> tuple[Standard, ...]:
    """Return the four editions, the oldest first."""
    return tuple(Iso230Part2(edition) for edition in EDITIONS)
