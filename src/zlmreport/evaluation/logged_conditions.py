"""Warnings on logs beside the readings: gaps, a late begin, an early end, sensors that contradict."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations, pairwise

import numpy as np

from zlmreport.evaluation.correction.corrections import find_condition_at_readings
from zlmreport.job.job import Job
from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.measurement_set import CONDITION_NAMES, CONDITIONS, MeasurementSet

_GAP = Words(
    "{name}: between two readings at which it was logged lie {count} at which it was not; there it is taken "
    "to change evenly"
)
_BEGINS_LATE = Words(
    "{name}: not logged at the first {count} readings, for which the first value that was logged is taken"
)
_ENDS_EARLY = Words(
    "{name}: not logged at the last {count} readings, for which the last value that was logged is taken"
)
_STOOD = Words(
    "{name}: the same in every digit over {hours} h, at {count} readings: its sensor may have stood still"
)
_TEMPERATURES = Words("{one}: {first} °C; {other}: {second} °C")
_APART = Words("{temperatures}: they lie {difference} K apart")
_RECKONED = Words("{temperatures}: the expansion is reckoned with {used} °C")

#: A gap of a log has more readings than this, and more than so many times as many as lie between two others.
_FEWEST, _OF_USUAL = 5, 3
#: Kelvins by which the scale and the workpiece may differ, and by which the air and the machine may.
_ALIKE, _OF_AIR = 1.0, 5.0
#: Readings and seconds over which the air does not stand still in every digit.
_FEWEST_STEADY, _LONG = 30, 4 * 3600.0


def find_gaps(measurements: MeasurementSet) -> Iterator[Words]:
    """Yield the conditions of which the log has a gap among readings, begins late or ends early."""
    for name, logged in measurements.conditions.items():
        there = np.isfinite(logged)
        if name not in CONDITIONS or there.all() or not there.any():
            continue
        known = np.flatnonzero(there)
        between = [int(after - before) - 1 for before, after in pairwise(known)]
        most = max(_FEWEST, _OF_USUAL * float(np.median(between)) if between else 0.0)
        for words, count in (
            (_BEGINS_LATE, int(known[0])),
            (_GAP, max(between, default=0)),
            (_ENDS_EARLY, len(logged) - 1 - int(known[-1])),
        ):
            if count > most:
                yield words.given(name=CONDITION_NAMES[name], count=count)


def find_silent_sensors(measurements: MeasurementSet) -> Iterator[Words]:
    """Yield the temperatures that did not move in a digit over hours in which everything was recorded."""
    if measurements.time is None or not measurements.axis.measurand.is_continuous:
        return
    for name, logged in measurements.conditions.items():
        there = np.isfinite(logged) & np.isfinite(measurements.time)
        if not name.endswith("temperature") or there.sum() < _FEWEST_STEADY or np.ptp(logged[there]):
            continue
        seconds = float(np.ptp(measurements.time[there]))
        if seconds >= _LONG and name in CONDITION_NAMES:
            hours = float(f"{seconds / 3600:.3g}")
            yield _STOOD.given(name=CONDITION_NAMES[name], hours=hours, count=int(there.sum()))


def find_temperatures_apart(job: Job, measurements: MeasurementSet) -> Iterator[Words]:
    """Yield temperatures so different that one of them hardly holds for the length, stated or logged."""
    if not job.axis.has_length:
        return
    names = ("axis_temperature", "material_temperature", "air_temperature")
    known: dict[str, FloatArray] = {}
    for name in names:
        at_readings = find_condition_at_readings(name, job, measurements)
        if at_readings is not None and len(at_readings):
            known[name] = at_readings
    material = job.keys.corrections.material if job.keys.corrections else None
    reckoned = material.temperature if material else next(iter(known), names[0])
    for (one, first), (other, second) in combinations(known.items(), 2):
        apart, of_air = np.abs(first - second), other == "air_temperature"
        told = apart > (_OF_AIR if of_air else _ALIKE)
        if 2 * int(told.sum()) <= told.size:  # not of most readings
            continue
        both = _TEMPERATURES.given(
            one=CONDITION_NAMES[one],
            first=_write_median(one, first),
            other=CONDITION_NAMES[other],
            second=_write_median(other, second),
        )
        if of_air or reckoned not in known:
            difference = float(f"{float(np.median(apart)):.3g}")
            yield _APART.given(temperatures=both, difference=difference)
        else:
            yield _RECKONED.given(temperatures=both, used=_write_median(reckoned, known[reckoned]))


def _write_median(name: str, values: FloatArray) -> float:
    return float(f"{CONDITIONS[name].unit.from_si(float(np.median(values))):.4g}")
