"""Readings that a job sets aside: as if they had not been taken, and named with the reason."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from zlmreport.errors import InputError, Problem
from zlmreport.job.job import Job
from zlmreport.job.measurement_keys import ExclusionKeys
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.provenance import Exclusion
from zlmreport.quantities.arrays import read_only_floats
from zlmreport.quantities.formatting import general_number

#: Target positions nearer to each other than this share of their unit are the same.
_SAME = 1e-6
_KEY = "measurement.excluded"


def without_excluded(measurements: MeasurementSet, job: Job) -> MeasurementSet:
    """Return readings without those that a job sets aside.

    A reading that is set aside is missing from the set, and stands in its provenance with its value.

    Raises
    ------
    InputError
        For each that there is not, that is missing already, or that is named twice.
    """
    keys = job.keys.measurement.excluded
    if not keys:
        return measurements
    problems: list[Problem] = []
    found: dict[int, Exclusion] = {}
    for index, each in enumerate(keys):
        place = job.place_of(f"{_KEY}.{index}")
        try:
            reading = _reading(each, measurements)
        except LookupError as error:
            problems.append(Problem(place, f"{_KEY}: {error.args[0]}"))
            continue
        if reading in found:
            problems.append(Problem(place, f"{_KEY}: this reading stands in the list twice; once is enough"))
        found[reading] = Exclusion(
            reading,
            float(measurements.target_positions[measurements.target[reading]]),
            Approach(int(measurements.approach[reading])),
            int(measurements.run[reading]),
            float(measurements.deviation[reading]),
            each.reason,
        )
    if problems:
        raise InputError(problems)
    deviation = measurements.deviation.copy()
    deviation[list(found)] = np.nan
    provenance = replace(measurements.provenance, exclusions=tuple(found.values()))
    return replace(measurements, deviation=read_only_floats(deviation), provenance=provenance)


def _reading(key: ExclusionKeys, measurements: MeasurementSet) -> int:
    """Return the place of the reading that a key names; raise `LookupError` saying why there is none."""
    axis = measurements.axis
    unit = axis.position_unit
    targets = unit.from_si(measurements.target_positions)
    nearest = int(np.argmin(np.abs(targets - key.target)))
    if abs(float(targets[nearest]) - key.target) > _SAME:
        raise LookupError(
            f"there is no target {_position(axis, key.target)}; the nearest is "
            f"{_position(axis, float(targets[nearest]))}"
        )
    approach = Approach.POSITIVE if key.direction == "+" else Approach.NEGATIVE
    at_target = (measurements.target == nearest) & (measurements.approach == approach)
    found = np.flatnonzero(at_target & (measurements.run == key.run))
    where = f"{_position(axis, key.target)} {approach.arrow}"
    if not found.size:
        runs: Sequence[int] = sorted(set(measurements.run[at_target].tolist()))
        there = f"runs there: {', '.join(map(str, runs))}" if runs else "nothing was read there"
        raise LookupError(f"there is no reading of run {key.run} at {where}; {there}")
    if np.isnan(measurements.deviation[found[0]]):
        raise LookupError(
            f"the reading of run {key.run} at {where} is missing already; take it out of the list"
        )
    return int(found[0])


def _position(axis: Axis, value: float) -> str:
    return f"{general_number(value)} {axis.position_unit.symbol}"
