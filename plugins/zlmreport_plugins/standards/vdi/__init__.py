"""VDI/DGQ 3441 and VDI/VDE 2617: the same algebra with 3 and with 2 standard deviations."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from zlmreport.plugin import (
    Arithmetic,
    Basis,
    Evaluation,
    Figure,
    Finding,
    MeasurementSet,
    Options,
    PositionStatistics,
    Standard,
    Words,
    both_directions,
    hookimpl,
    no_missing_readings,
    number_of_runs,
    positions_in_all,
    positions_over_travel,
    positions_per_metre,
    positions_per_scale_element,
    spacing_against_periods,
)
from zlmreport_plugins.standards.vdi import figures, formulas
from zlmreport_plugins.standards.vdi.guidelines import BY_POSITION, GUIDELINES, Guideline, parameters

_WIDTHS = Words(
    "All parameters are full widths, not ± values. The position spread is {k} times the sum of the standard "
    "deviations (n − 1) of both directions; the limits lie half the sum of reversal span and position spread "
    "to either side of the mean.",
    "Alle Kenngrößen sind volle Breiten, keine ±-Werte. Die Positionsstreubreite ist das {k}-Fache der Summe "
    "der Standardabweichungen (n − 1) beider Richtungen; die Grenzen liegen um die halbe Summe aus "
    "Umkehrspanne und Positionsstreubreite beiderseits des Mittelwerts.",
)
_NOT_ACCURACY = Words(
    "P averages the scatter of both directions and therefore differs from the A of ISO 230-2, even at the "
    "same number of standard deviations.",
    "P mittelt die Streuung beider Richtungen und unterscheidet sich daher von A nach ISO 230-2, auch bei "
    "gleicher Anzahl von Standardabweichungen.",
)
_INDEX = Words(
    "The reversal span is an amount without sign. The index mit marks a mean over the positions.",
    "Die Umkehrspanne ist ein Betrag ohne Vorzeichen. Der Index mit (mittel) bezeichnet ein Mittel über die "
    "Positionen.",
)
_SOURCE = Words(
    "Formulas as in the manual of the program ZLM Position, G 1.3.",
    "Formeln nach dem Handbuch des Programms ZLM Position, G 1.3.",
)


def notes(guideline: Guideline) -> tuple[Words, ...]:
    """Return the notes of a guideline."""
    return (_WIDTHS.given(k=guideline.factor), _NOT_ACCURACY, _INDEX, _SOURCE)


class VdiGuideline:
    """VDI/DGQ 3441 or VDI/VDE 2617.

    Parameters
    ----------
    guideline
        A row of the table of guidelines.
    """

    position_index = "j"
    options = Options
    position_quantities = BY_POSITION

    def __init__(self, guideline: Guideline) -> None:
        self.guideline = guideline
        self.identifier = guideline.identifier
        self.designation = guideline.designation
        self.title = guideline.title
        self.quantities = parameters(guideline)
        self.notes = notes(guideline)

    def requirements(self, measurements: MeasurementSet, options: Options) -> Iterable[Finding]:  # noqa: ARG002 - no keys of its own
        """Hold the guideline's requirements against the test."""
        return findings(self.guideline, measurements)

    def arithmetic(self, statistics: PositionStatistics, options: Options) -> Arithmetic:  # noqa: ARG002 - no keys of its own
        """Return the guideline's parameters, and U_j and P_sj by position."""
        factor = self.guideline.factor
        return Arithmetic(formulas.parameters(statistics, factor), formulas.positions(statistics, factor))

    def figures(self, evaluation: Evaluation, options: Options) -> Iterable[Figure]:  # noqa: ARG002 - no keys of its own
        """Return the guideline's two diagrams."""
        return figures.figures(evaluation)


_RUNS = 5
_ONE_DIRECTION_ONLY = Words(
    "the guideline does not provide for this: P, Pa and Ps are formed from this direction, U does not exist",
    "in der Richtlinie nicht vorgesehen: P, Pa und Ps sind aus dieser Richtung gebildet, U entfällt",
)


def findings(guideline: Guideline, measurements: MeasurementSet) -> Iterator[Finding]:
    """Yield the guideline's requirements, held against the test: its numbers as in ZLM Position, G 1.1."""
    yield both_directions(measurements, _ONE_DIRECTION_ONLY, Basis.PUBLISHED)
    yield number_of_runs(measurements, _RUNS, Basis.APPLIED)
    if guideline.positions_in_all is not None:
        yield positions_in_all(measurements, guideline.positions_in_all, Basis.PUBLISHED)
    if guideline.positions_per_metre is not None:
        yield positions_per_metre(measurements, guideline.positions_per_metre, Basis.PUBLISHED, further=1)
    yield positions_per_scale_element(measurements, guideline.positions_per_scale_element, Basis.PUBLISHED)
    yield no_missing_readings(measurements)
    yield positions_over_travel(measurements)
    yield from spacing_against_periods(measurements, Basis.APPLIED)


@hookimpl
def zlmreport_standards() -> tuple[Standard, ...]:
    """Return the two guidelines."""
    return tuple(VdiGuideline(guideline) for guideline in GUIDELINES)
