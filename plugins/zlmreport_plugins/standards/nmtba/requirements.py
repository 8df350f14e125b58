"""What is asked of a test that is evaluated by NMTBA.

The recommendation's own numbers have not been read; only what its formulas need is asked.
"""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.plugin import (
    Basis,
    Finding,
    MeasurementSet,
    Words,
    both_directions,
    no_missing_readings,
    number_of_runs,
    positions_in_words,
    positions_over_travel,
    spacing_against_periods,
)

_RUNS_FOR_A_SCATTER = 2
_ONE_DIRECTION_ONLY = Words(
    "the formulas pool both: here the readings of this direction alone are the sample",
    "die Formeln fassen beide zusammen: hier bilden die Messwerte dieser Richtung allein die Stichprobe",
)


def findings(measurements: MeasurementSet) -> Iterator[Finding]:
    """Yield the requirements, held against the test."""
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
