"""Directions, runs, and readings that are missing."""

from __future__ import annotations

import numpy as np

from zlmreport.evaluation import printed
from zlmreport.evaluation.requirements import Basis, Finding
from zlmreport.language import Words
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.measurement_set import MeasurementSet

_MEASURED = {
    (Approach.POSITIVE, Approach.NEGATIVE): Words("both directions", "beide Richtungen"),
    (Approach.POSITIVE,): Words("positive direction only", "nur positive Richtung"),
    (Approach.NEGATIVE,): Words("negative direction only", "nur negative Richtung"),
    (): Words("no reading at all", "kein einziger Messwert"),
}

_ONE_SIDED = Words(
    "each target in one direction only; what needs both directions at one target is not reported",
    "jede Sollposition nur in einer Richtung; was beide Richtungen an einer Sollposition braucht, ist nicht "
    "angegeben",
)

_RELATIVE = Words(
    "both directions, brought together by means of the readings themselves: reversal values are relative to "
    "their mean",
    "beide Richtungen, durch die Messwerte selbst zusammengeführt: Umkehrspannen sind relativ zu ihrem "
    "Mittel",
)


def measured_approaches(measurements: MeasurementSet) -> tuple[Approach, ...]:
    """Return the directions in which there is a reading, the positive one first.

    A direction that a file names without a single reading is not among them.
    """
    present = np.isfinite(measurements.deviation)
    return tuple(each for each in Approach if np.any(measurements.approach[present] == each))


def both_directions(measurements: MeasurementSet, consequence: Words, basis: Basis) -> Finding:
    """Ask that the targets are approached from both directions.

    Parameters
    ----------
    measurements
        The test.
    consequence
        What becomes of the standard's parameters where only one direction was measured.
    basis
        Where the requirement is known from.
    """
    requirement = Words(
        "Targets approached in the positive and in the negative direction",
        "Anfahren der Sollpositionen in positiver und in negativer Richtung",
    )
    approaches = measured_approaches(measurements)
    measured = _MEASURED[approaches]
    if measurements.one_sided_targets:
        return Finding(requirement, _ONE_SIDED, met=False, basis=basis)
    if measurements.reversal_is_relative:
        return Finding(requirement, _RELATIVE, met=False, basis=basis)
    if len(approaches) == len(Approach):
        return Finding(requirement, measured, met=True, basis=basis)
    found = Words("{measured}; {consequence}", "{measured}; {consequence}")
    given = found.given(measured=measured, consequence=consequence)
    return Finding(requirement, given, met=False, basis=basis)


def number_of_runs(measurements: MeasurementSet, minimum: int, basis: Basis) -> Finding:
    """Ask for a number of runs in each direction that was measured."""
    number = fewest_runs(measurements)
    requirement = Words("At least {runs} in each direction", "Mindestens {runs} je Richtung")
    return Finding(
        requirement.given(runs=printed.runs(minimum)), printed.runs(number), number >= minimum, basis
    )


def fewest_runs(measurements: MeasurementSet) -> int:
    """Return the number of runs with a reading, in that of the measured directions which has fewer."""
    present = ~np.isnan(measurements.deviations())
    taken = np.count_nonzero(np.any(present, axis=1), axis=-1)
    return min((int(taken[each.index]) for each in measured_approaches(measurements)), default=0)


def no_missing_readings(measurements: MeasurementSet) -> Finding:
    """Ask for a reading at every target in every run; a gap lowers n at its position only."""
    requirement = Words(
        "A reading at every target in every run", "Ein Messwert je Sollposition und Durchlauf"
    )
    missing = len(measurements.missing())
    present = ~np.isnan(measurements.deviations())
    total = int(np.count_nonzero(present)) + missing
    if not missing:
        complete = Words("all {total} readings", "alle {total} Messwerte").given(total=total)
        return Finding(requirement, complete, met=True)
    count = np.count_nonzero(present, axis=-1)[[approach.index for approach in measurements.approaches]]
    found = Words(
        "{missing} of {total} missing; n from {least} to {most}, evaluated by what is there",
        "{missing} von {total} fehlen; n von {least} bis {most}, ausgewertet wird, was vorliegt",
    )
    given = found.given(missing=missing, total=total, least=int(count.min()), most=int(count.max()))
    return Finding(requirement, given, met=False)
