"""From the readings of a file to a measurement set: the checks that all data sources share."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from zlmreport.errors import InputError, Place, Problem
from zlmreport.language import Words
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.measurement.checks import problems_of
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.provenance import Provenance
from zlmreport.quantities.arrays import FloatArray, IntArray, read_only_floats, read_only_integers

#: Problems of one file that are named one by one.
MOST_NAMED = 20

#: Relative to the largest target position: positions closer than this are one target, computed twice.
_NOISE = 1e-9
#: Metres or radians; no axis goes so far.
_FARTHEST = 1e4
_MOST_RUNS = 1_000_000

_NO_TIMES = Words(
    en="No times were logged: drift and warm-up cannot be judged from the readings.",
    de="Es wurden keine Zeiten aufgezeichnet: Drift und Warmlauf sind an den Messwerten nicht zu erkennen.",
)
_MODULO = Words(
    en="Whole turns were taken off {count} readings: positions were displayed modulo 360°.",
    de="Von {count} Messwerten wurden ganze Umdrehungen abgezogen: Die Positionen waren modulo 360° "
    "angezeigt.",
)


@dataclass(frozen=True, slots=True)
class Reading:
    """One reading as a data source hands it on, in SI.

    Attributes
    ----------
    place
        Where it stands in its file.
    target_position
        m or rad.
    approach
        Direction of approach.
    run
        Number of the run; what is no positive integer is refused.
    deviation
        x = actual − target, m or rad; NaN where the file names the reading and leaves it out.
    time
        Seconds from any fixed moment; NaN or None where it was not logged.
    conditions
        What was logged beside it, by name; NaN where it was not.
    """

    place: Place
    target_position: float
    approach: Approach
    run: float
    deviation: float
    time: float | None = None
    conditions: Mapping[str, float] = field(default_factory=dict)


def collect(
    readings: Iterable[Reading],
    axis: Axis,
    provenance: Provenance,
    *,
    place: Place,
    problems: Iterable[Problem] = (),
) -> MeasurementSet:
    """Return the measurement set of the readings, checked.

    Parameters
    ----------
    readings
        In the order in which they were taken.
    axis
        The axis under test.
    provenance
        Where the readings come from; a remark is added if they carry no times.
    place
        The file, for what has no line of its own.
    problems
        What the data source found wrong while it read: reported together with what is found here.

    Raises
    ------
    InputError
        With every defect of the data, up to 20 of them one by one: no readings; target positions,
        deviations or conditions that cannot be; run numbers that are none; duplicates; targets that no
        other run has; times that fall.
    """
    found = list(problems)
    sound = []
    for reading in readings:
        wrong = list(_wrong_alone(reading))
        found.extend(wrong)
        if not wrong:
            sound.append(reading)
    if sound:
        measurements = _arranged(sound, axis, provenance)
        found.extend(problems_of(measurements, [reading.place for reading in sound]))
        if not found:
            return measurements
    elif not found:
        found.append(Problem(place, "holds no readings"))
    raise InputError(_capped(found))


def is_run(number: float) -> bool:
    """Whether a number can be that of a run."""
    return 1 <= number <= _MOST_RUNS and float(number).is_integer()


def no_run(number: float) -> str:
    """Return what to say of a number that cannot be that of a run."""
    return f"{number:.9g} is no number of a run; runs are counted 1, 2, 3 and so on"


def _wrong_alone(reading: Reading) -> Iterator[Problem]:
    """Yield what is wrong with a reading whatever the others are."""
    if not abs(reading.target_position) <= _FARTHEST:
        yield Problem(reading.place, "the target position is not on any axis; is its unit right?")
    if not is_run(reading.run):
        yield Problem(reading.place, no_run(reading.run))
    quantities = {"the deviation": reading.deviation, "the time": reading.time or 0.0, **reading.conditions}
    for name, value in quantities.items():
        if math.isinf(value):
            yield Problem(reading.place, f"{name} is infinite; a reading is a finite number")


def _arranged(readings: Sequence[Reading], axis: Axis, provenance: Provenance) -> MeasurementSet:
    """Return the readings as a measurement set that nobody has checked yet."""
    positions, target = _targets(np.array([reading.target_position for reading in readings]))
    deviation = np.array([reading.deviation for reading in readings])
    if axis.kind is AxisKind.ROTARY:
        deviation, wrapped = _unwrapped(deviation)
        if wrapped:
            remark = _MODULO.given(count=wrapped)
            provenance = replace(provenance, remarks=(*provenance.remarks, remark))
    names = list(dict.fromkeys(name for reading in readings for name in reading.conditions))
    conditions = {
        name: read_only_floats([reading.conditions.get(name, math.nan) for reading in readings])
        for name in names
    }
    times = np.array([math.nan if reading.time is None else reading.time for reading in readings])
    logged = times[~np.isnan(times)]
    if not logged.size:
        provenance = replace(provenance, remarks=(*provenance.remarks, _NO_TIMES))
    return MeasurementSet(
        axis=axis,
        target_positions=read_only_floats(positions),
        target=read_only_integers(target),
        approach=read_only_integers([reading.approach for reading in readings]),
        run=read_only_integers([int(reading.run) for reading in readings]),
        deviation=read_only_floats(deviation),
        time=read_only_floats(times - logged[0]) if logged.size else None,
        conditions={name: values for name, values in conditions.items() if not np.all(np.isnan(values))},
        provenance=provenance,
    )


def _unwrapped(deviation: FloatArray) -> tuple[FloatArray, int]:
    """Return deviations without the whole turns in them, and how many had some.

    A display that counts modulo 360° shows 359.99° for a target of 0°, and 0.01° for one of 360°.
    """
    turns = np.nan_to_num(np.round(deviation / (2 * math.pi)), posinf=0.0, neginf=0.0)
    return np.where(turns == 0, deviation, deviation - 2 * math.pi * turns), int(np.count_nonzero(turns))


def _targets(positions: FloatArray) -> tuple[FloatArray, IntArray]:
    """Return the distinct target positions, rising, and for each reading the index of its own.

    Positions that differ by the noise of a computation (0.3 and 0.1 + 0.2) are one target: the one that
    is written most often.
    """
    distinct, spelling, count = np.unique(positions + 0.0, return_inverse=True, return_counts=True)
    noise = _NOISE * np.max(np.abs(distinct))
    cluster = np.concatenate(([0], np.cumsum(np.diff(distinct) > noise)))
    by_frequency = np.lexsort((-count, cluster))
    _, first = np.unique(cluster[by_frequency], return_index=True)
    return distinct[by_frequency[first]], cluster[spelling]


def _capped(problems: Sequence[Problem]) -> list[Problem]:
    """Return the first problems in the order of the file, and how many more there are."""
    ordered = sorted(set(problems))
    named, more = ordered[:MOST_NAMED], ordered[MOST_NAMED:]
    if more:
        named.append(Problem(more[0].place, f"and {len(more)} more"))
    return named
