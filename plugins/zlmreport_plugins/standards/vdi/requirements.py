"""What the guidelines ask of a test: numbers of positions as in the ZLM Position manual, G 1.1."""

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
    positions_in_all,
    positions_over_travel,
    positions_per_metre,
    positions_per_scale_element,
    spacing_against_periods,
)
from zlmreport_plugins.standards.vdi.guidelines import Guideline

_RUNS = 5
_ONE_DIRECTION_ONLY = Words(
    "the guideline does not provide for this: P, Pa and Ps are formed from this direction, U does not exist",
    "in der Richtlinie nicht vorgesehen: P, Pa und Ps sind aus dieser Richtung gebildet, U entfällt",
)


def findings(guideline: Guideline, measurements: MeasurementSet) -> Iterator[Finding]:
    """Yield the guideline's requirements, held against the test."""
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
