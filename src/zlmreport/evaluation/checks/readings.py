"""Directions, runs, readings that are missing; positions against the periods of an axis.

Equal spacing can hide a periodic deviation.
"""

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


#: Phases that agree within this part of a period show the same point of a periodic deviation.
_SAME_PHASE = 0.01
#: Intervals that agree within this part are alike: their digits were rounded.
_ALIKE = 1e-6


def spacing_against_periods(measurements: MeasurementSet, basis: Basis) -> tuple[Finding, ...]:
    """Ask that the spacing is no integer multiple of a period of the axis; one finding for each period.

    Not met where all targets show the same phase of the period. Left open where the job states none.
    """
    axis = measurements.axis
    periods = (
        (Words("pitch", "Steigung"), axis.screw_pitch),
        (Words("signal period", "Signalperiode"), axis.signal_period),
    )
    stated = tuple(
        _spacing_against(measurements, name, period, basis) for name, period in periods if period is not None
    )
    if stated:
        return stated
    requirement = Words(
        "Spacing no integer multiple of a period of the axis",
        "Abstand kein ganzzahliges Vielfaches einer Periode der Achse",
    )
    return (Finding(requirement, Words("no period stated", "keine Periode angegeben"), None, basis),)


def _spacing_against(measurements: MeasurementSet, name: Words, period: float, basis: Basis) -> Finding:
    """Hold the spacing against one period: the phases of all targets, as seen from the first."""
    requirement = Words(
        "Spacing no integer multiple of the {name} ({period})",
        "Abstand kein ganzzahliges Vielfaches der {name} ({period})",
    ).given(name=name, period=printed.position(measurements.axis, period))
    turns = (measurements.target_positions - measurements.target_positions[0]) / period
    if len(turns) < 2:
        return Finding(requirement, Words("a single position", "eine einzige Position"), None, basis)
    from_first = np.abs(turns - np.rint(turns))
    if from_first.max() > _SAME_PHASE:
        found = Words("targets at differing phases", "Sollpositionen bei unterschiedlicher Phase")
        return Finding(requirement, found, met=True, basis=basis)
    found = Words(
        "all targets at the same phase: a deviation of this period stays hidden",
        "alle Sollpositionen bei gleicher Phase: eine Abweichung dieser Periode bleibt verborgen",
    )
    return Finding(requirement, found, met=False, basis=basis)


def random_fractions(measurements: MeasurementSet, formula: str, basis: Basis) -> Finding:
    """Ask that each target carries a random fraction; equal intervals show that none does.

    Parameters
    ----------
    measurements
        The test.
    formula
        How the standard writes its targets: ``P = N·p + r``.
    basis
        Where the requirement is known from.
    """
    axis = measurements.axis
    requirement = Words(
        "Targets {formula} with a random fraction r at each",
        "Sollpositionen {formula} mit zufälligem Anteil r",
    ).given(formula=formula)
    intervals = np.diff(measurements.target_positions)
    if len(intervals) < 2:
        too_few = Words("too few positions to tell", "zu wenige Positionen für eine Aussage")
        return Finding(requirement, too_few, met=None, basis=basis)
    shortest, longest = float(intervals.min()), float(intervals.max())
    if longest - shortest <= _ALIKE * longest:
        found = Words("all intervals alike: {interval}", "alle Abstände gleich: {interval}")
        found = found.given(interval=printed.position(axis, float(intervals.mean())))
        return Finding(requirement, found, met=False, basis=basis)
    found = Words("intervals from {shortest} to {longest}", "Abstände von {shortest} bis {longest}").given(
        shortest=printed.position(axis, shortest), longest=printed.position(axis, longest)
    )
    return Finding(requirement, found, met=True, basis=basis)


def mean_interval(measurements: MeasurementSet, limit: float, basis: Basis) -> Finding:
    """Ask for a mean interval between neighbouring targets of at most `limit`, m or rad."""
    axis, targets = measurements.axis, measurements.target_positions
    requirement = Words("Mean interval at most {limit}", "Mittlerer Abstand höchstens {limit}")
    requirement = requirement.given(limit=printed.position(axis, limit))
    interval = float(targets[-1] - targets[0]) / max(1, len(targets) - 1)
    return Finding(requirement, printed.position(axis, interval), interval <= limit * (1 + _ALIKE), basis)
