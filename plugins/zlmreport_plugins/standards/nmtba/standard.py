"""The NMTBA recommendation as a standard that a job can name."""

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
    Words,
    both_directions,
    no_missing_readings,
    number_of_runs,
    positions_in_words,
    positions_over_travel,
    spacing_against_periods,
)
from zlmreport_plugins.standards.nmtba import figures, formulas, words


class Nmtba:
    """The NMTBA recommendation of 1972."""

    identifier = "nmtba"
    designation = "NMTBA (1972)"
    position_index = "j"
    title = Words(
        "Positioning accuracy of numerically controlled machine tools",
        "Positioniergenauigkeit numerisch gesteuerter Werkzeugmaschinen",
    )
    options = Options
    quantities = words.PARAMETERS
    position_quantities = words.BY_POSITION
    notes = words.NOTES

    def requirements(self, measurements: MeasurementSet, options: Options) -> Iterable[Finding]:  # noqa: ARG002 - no keys of its own
        """Hold the requirements against the test."""
        return findings(measurements)

    def arithmetic(self, statistics: PositionStatistics, options: Options) -> Arithmetic:  # noqa: ARG002 - no keys of its own
        """Return the parameters, and X̄_j and P_sj by position."""
        mean = formulas.mean_deviation(statistics)
        spread = formulas.position_spread(statistics, mean)
        return Arithmetic(formulas.parameters(mean, spread), {"X": mean, "Ps": spread})

    def figures(self, evaluation: Evaluation, options: Options) -> Iterable[Figure]:  # noqa: ARG002 - no keys of its own
        """Return the two diagrams."""
        return figures.figures(evaluation)


_RUNS_FOR_A_SCATTER = 2
_ONE_DIRECTION_ONLY = Words(
    "the formulas pool both: here the readings of this direction alone are the sample",
    "die Formeln fassen beide zusammen: hier bilden die Messwerte dieser Richtung allein die Stichprobe",
)


def findings(measurements: MeasurementSet) -> Iterator[Finding]:
    """Yield the requirements, held against the test.

    The recommendation's own numbers have not been read; only what its formulas need is asked.
    """
    yield both_directions(measurements, _ONE_DIRECTION_ONLY, Basis.PUBLISHED)
    yield number_of_runs(measurements, _RUNS_FOR_A_SCATTER, Basis.APPLIED)
    yield _number_of_positions(measurements)
    yield no_missing_readings(measurements)
    yield positions_over_travel(measurements)
    yield from spacing_against_periods(measurements, Basis.APPLIED)


def _number_of_positions(measurements: MeasurementSet) -> Finding:
    """Return the open finding on the number of positions, for which no number is known."""
    requirement = Words(
        "Number of target positions as the recommendation asks",
        "Anzahl der Sollpositionen nach der Empfehlung",
    )
    found = Words(
        "{positions}; no number known to hold them against",
        "{positions}; keine Zahl bekannt, an der sie zu messen wären",
    )
    number = len(measurements.target_positions)
    return Finding(requirement, found.given(positions=positions_in_words(number)), met=None)
