"""Corrections for air, dead path, expansion to 20 °C; conditions between those logged; exclusions.

The instrument counts half wavelengths. From its datum on it has counted n·(Dp + D) − n₀·Dp in vacuum
units: n is the index of the air now, n₀ that when it was set to zero, Dp the dead path, D the displacement.
It displayed the count over the index nₐ that it assumed. Solved for D:

    D = (nₐ/n)·(displayed displacement) − Dp·(n − n₀)/n.

At the end stands what a job asks for: which corrections, and which readings are set aside.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from zlmreport.errors import InputError, Problem, count_in_words
from zlmreport.evaluation.correction.compensated import find_compensated_by_instrument
from zlmreport.job.job import Job
from zlmreport.job.measurement_keys import AirKeys, DeadPathKeys, ExclusionKeys, MaterialKeys
from zlmreport.language import Words
from zlmreport.language.formatting import write_stated_number
from zlmreport.language.numbers import number_words
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.measurement_set import CONDITIONS, STATE_OF_AIR, MeasurementSet, find_step
from zlmreport.measurement.provenance import Correction, Exclusion
from zlmreport.measurement.refractive_index import compute_standard_index, refractive_index
from zlmreport.measurement.units import MICROMETRE_PER_METRE_KELVIN, compute_above_reference, with_unit

#: Target positions nearer to each other than this share of their unit are the same.
_SAME = 1e-6
_KEY = "measurement.excluded"


def correct_displacement_in_air(displayed: FloatArray, index: FloatArray, assumed_index: float) -> FloatArray:
    """Return the displacement by the true wavelength, D·nₐ/n.

    `displayed`, (N,): Displacement from the datum as the instrument displayed it, m.
    `index`, (N,): n at each reading.
    `assumed_index`: nₐ.
    """
    return displayed * (assumed_index / index)


def compute_dead_path_error(index: FloatArray, index_at_datum: float, dead_path: float) -> FloatArray:
    """Return how far the air along the dead path has moved the datum, Dp·(n − n₀)/n, m.

    `index`, (N,): n at each reading.
    `index_at_datum`: n₀, when the instrument was set to zero.
    `dead_path`: Dp, m.
    """
    return dead_path * (index - index_at_datum) / index


_AIR = Words("Refractive index of air")
_AIR_METHOD = Words("updated Edlén equation (Birch and Downs 1993, 1994); D·nₐ/n")
_DEAD_PATH = Words("Dead path")
_DEAD_PATH_METHOD = Words("change of the index since the first reading; Dp·(n − n₀)/n")
_MATERIAL = Words("Thermal expansion, to 20 °C")
_MATERIAL_METHOD = Words("D·(1 − α·(T − 20 °C))")


@dataclass(frozen=True, slots=True)
class Air:
    """The refractive index of the air."""

    index: FloatArray  #: (N,): n at each reading.
    assumed_index: float  #: That by which the instrument turned counts into lengths.


@dataclass(frozen=True, slots=True)
class MaterialExpansion:
    """The expansion of the material."""

    coefficient: float  #: α, 1/K.
    temperature: FloatArray  #: (N,): T at each reading, K.


@dataclass(frozen=True, slots=True)
class Corrections:
    """What the readings of a test are corrected for; None for what they are not."""

    datum: float  #: Position at which the instrument was set to zero, m.
    #: air and expansion: See there.
    air: Air | None = None
    #: From the interferometer to the reflector at the datum, m; negative where the measured path shrinks
    #: while the position rises. It needs the index of the air.
    dead_path: float | None = None
    expansion: MaterialExpansion | None = None


def correct(measurements: MeasurementSet, corrections: Corrections) -> MeasurementSet:
    """Return a new set of readings, corrected, with every correction in its provenance.

    The displacement from the datum is corrected; a target position is what the axis was commanded to, and
    stays as it is.
    """
    target = measurements.target_positions[measurements.target]
    displacement = target + measurements.deviation - corrections.datum
    applied: list[Correction] = []
    if corrections.air is not None:
        displacement, found = _correct_for_air(displacement, corrections.air)
        applied.append(found)
        if corrections.dead_path is not None:
            displacement, found = _correct_dead_path(displacement, corrections.air, corrections.dead_path)
            applied.append(found)
    if corrections.expansion is not None:
        displacement, found = _correct_to_20_degrees(displacement, corrections.expansion)
        applied.append(found)
    deviation = read_only_floats(displacement + corrections.datum - target)
    step = measurements.axis.deviation_unit.to_si(find_step(measurements))
    provenance = replace(measurements.provenance, corrections=tuple(applied), step=step)
    return replace(measurements, deviation=deviation, provenance=provenance)


def _correct_for_air(displayed: FloatArray, air: Air) -> tuple[FloatArray, Correction]:
    displacement = correct_displacement_in_air(displayed, air.index, air.assumed_index)
    inputs = Words("n from {low} to {high}; the instrument assumed {assumed}").given(
        low=number_words(float(air.index.min()), 8),
        high=number_words(float(air.index.max()), 8),
        assumed=number_words(float(air.assumed_index), 8),
    )
    return displacement, Correction(_AIR, _AIR_METHOD, inputs, _find_largest(displacement - displayed))


def _correct_dead_path(displacement: FloatArray, air: Air, dead_path: float) -> tuple[FloatArray, Correction]:
    error = compute_dead_path_error(air.index, float(air.index[0]), dead_path)
    inputs = Words("Dp = {length} mm").given(length=1e3 * abs(dead_path))
    return displacement - error, Correction(_DEAD_PATH, _DEAD_PATH_METHOD, inputs, _find_largest(error))


def _correct_to_20_degrees(
    displacement: FloatArray, expansion: MaterialExpansion
) -> tuple[FloatArray, Correction]:
    difference = compute_above_reference(expansion.temperature)
    change = -displacement * expansion.coefficient * difference
    inputs = Words("α = {alpha} µm/(m·K), T − 20 °C from {low} to {high} K").given(
        alpha=1e6 * expansion.coefficient, low=float(difference.min()), high=float(difference.max())
    )
    return displacement + change, Correction(_MATERIAL, _MATERIAL_METHOD, inputs, _find_largest(change))


def _find_largest(change: FloatArray) -> float:
    """Return the change of the largest amount, with its sign; 0 where there are no readings."""
    known = change[np.isfinite(change)]
    return float(known[np.argmax(np.abs(known))]) if len(known) else 0.0


def drop_excluded(measurements: MeasurementSet, job: Job) -> MeasurementSet:
    """Return readings without those that a job sets aside.

    A reading that is set aside is missing from the set, and stands in its provenance with its value.

    Raises `InputError` for each that there is not, that is missing already, or that is named twice.
    """
    keys = job.keys.measurement.excluded
    if not keys:
        return measurements
    problems: list[Problem] = []
    found: dict[int, Exclusion] = {}
    for index, each in enumerate(keys):
        place = job.place_of(f"{_KEY}.{index}")
        try:
            reading = _find_reading(each, measurements)
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


def _find_reading(key: ExclusionKeys, measurements: MeasurementSet) -> int:
    """Return the place of the reading that a key names; raise `LookupError` saying why there is none."""
    axis = measurements.axis
    unit = axis.position_unit
    targets = unit.from_si(measurements.target_positions)
    nearest = int(np.argmin(np.abs(targets - key.target)))
    if abs(float(targets[nearest]) - key.target) > _SAME:
        raise LookupError(
            f"there is no target {_write_position(axis, key.target)}; the nearest is "
            f"{_write_position(axis, float(targets[nearest]))}"
        )
    approach = Approach.POSITIVE if key.direction == "+" else Approach.NEGATIVE
    at_target = (measurements.target == nearest) & (measurements.approach == approach)
    found = np.flatnonzero(at_target & (measurements.run == key.run))
    where = f"{_write_position(axis, key.target)} {approach.arrow}"
    if not found.size:
        runs: Sequence[int] = sorted(set(measurements.run[at_target].tolist()))
        there = f"runs there: {', '.join(map(str, runs))}" if runs else "nothing was read there"
        raise LookupError(f"there is no reading of run {key.run} at {where}; {there}")
    if np.isnan(measurements.deviation[found[0]]):
        raise LookupError(
            f"the reading of run {key.run} at {where} is missing already; take it out of the list"
        )
    return int(found[0])


def _write_position(axis: Axis, value: float) -> str:
    return with_unit(write_stated_number(value), axis.position_unit.symbol)


_NANOMETRE = 1e-9


def find_corrections_of(job: Job, measurements: MeasurementSet) -> Corrections | None:
    """Return what a job corrects its readings for; None where it asks for nothing.

    Raises `InputError` with everything that a correction needs and neither the readings nor the job tell.
    """
    keys = job.keys.corrections
    if keys is None or not (keys.air or keys.dead_path or keys.material):
        return None
    problems = list(_find_corrected_already(job, measurements))
    if not job.axis.has_length:
        message = "corrections of lengths do not apply to a rotary axis: take corrections out"
        problems.append(Problem(job.place_of("corrections"), message))
    if keys.dead_path and not keys.air:
        message = "corrections.dead_path needs the index of the air: add corrections.air"
        problems.append(Problem(job.place_of("corrections.dead_path"), message))
    air = _make_air(keys.air, job, measurements, problems) if keys.air else None
    expansion = _make_expansion(keys.material, job, measurements, problems) if keys.material else None
    if problems:
        raise InputError(problems)
    to_si = job.axis.position_unit.to_si
    return Corrections(
        datum=measurements.zero if keys.datum is None else to_si(keys.datum),
        air=air,
        dead_path=_sign_dead_path(keys.dead_path, to_si(keys.dead_path.length)) if keys.dead_path else None,
        expansion=expansion,
    )


def _find_corrected_already(job: Job, measurements: MeasurementSet) -> Iterator[Problem]:
    """Yield the corrections that the instrument has made before: nothing is corrected twice."""
    keys, done = job.keys.corrections, find_compensated_by_instrument(job, measurements)
    for name, asked, made in (
        ("material", keys and keys.material, done.material),
        ("air", keys and keys.air, done.air),
    ):
        if asked and made:
            stated = job.keys.instrument and job.keys.instrument.compensates
            where = f"instrument.compensates.{name}" if stated else "the file"
            message = f"corrections.{name}: {where} says that the instrument has done this; take it out"
            yield Problem(job.place_of(f"corrections.{name}"), message)


def find_condition_at_readings(name: str, job: Job, measurements: MeasurementSet) -> FloatArray | None:
    """Return a condition at each reading, SI: as logged, or as the job states it; None where neither tells.

    Between readings at which it was not logged it is taken to change evenly.
    """
    logged = measurements.conditions.get(name)
    stated = getattr(job.keys.environment, name, None)
    if logged is not None and (known := np.isfinite(logged)).any():
        order = np.arange(len(logged))
        return np.interp(order, order[known], logged[known])
    if isinstance(stated, float):
        return np.full(len(measurements.deviation), CONDITIONS[name].unit.to_si(stated))
    return None


def _make_air(keys: AirKeys, job: Job, measurements: MeasurementSet, problems: list[Problem]) -> Air | None:
    wavelength = keys.wavelength * _NANOMETRE
    conditions = _find_conditions(STATE_OF_AIR, "corrections.air", job, measurements, problems)
    if conditions is None:
        return None
    temperature, pressure, humidity = conditions
    index = refractive_index(temperature, pressure, humidity, wavelength)
    if isinstance(keys.assumed, float):
        return Air(index, keys.assumed)
    if keys.assumed == "vacuum":
        return Air(index, 1.0)
    return Air(index, compute_standard_index(wavelength))


def _make_expansion(
    keys: MaterialKeys, job: Job, measurements: MeasurementSet, problems: list[Problem]
) -> MaterialExpansion | None:
    environment = job.keys.environment
    coefficient = keys.expansion_coefficient or (environment and environment.expansion_coefficient)
    if not isinstance(coefficient, float):
        message = (
            "corrections.material needs the expansion coefficient: add corrections.material."
            "expansion_coefficient, µm/(m·K)"
        )
        problems.append(Problem(job.place_of("corrections.material"), message))
    conditions = _find_conditions((keys.temperature,), "corrections.material", job, measurements, problems)
    if conditions is None or not isinstance(coefficient, float):
        return None
    return MaterialExpansion(coefficient * MICROMETRE_PER_METRE_KELVIN, conditions[0])


def _find_conditions(
    names: Iterable[str], key: str, job: Job, measurements: MeasurementSet, problems: list[Problem]
) -> list[FloatArray] | None:
    """Return each condition at each reading, SI: as it was logged, or as the job states it for all."""
    found = []
    for name in names:
        logged = measurements.conditions.get(name)
        stated = getattr(job.keys.environment, name, None)
        if logged is not None:
            missing = np.flatnonzero(np.isnan(logged))
            if missing.size:
                message = (
                    f"{key}: {name} was not logged at {missing.size} of "
                    f"{count_in_words(len(logged), 'reading')}, the first is number {missing[0] + 1}; "
                    f"log it there, too, or state environment.{name} and leave the column out"
                )
                problems.append(Problem(job.place_of(key), message))
            found.append(logged)
        elif isinstance(stated, float):
            in_si = CONDITIONS[name].unit.to_si(stated)
            found.append(np.full(len(measurements.deviation), in_si))
        else:
            message = (
                f"{key} needs {name}: log it beside the readings (column {name}), or state "
                f"environment.{name} as a number"
            )
            problems.append(Problem(job.place_of(key), message))
    return None if problems else found


def _sign_dead_path(keys: DeadPathKeys, length: float) -> float:
    """Return the dead path, negative where positions rise towards the interferometer."""
    return length if keys.measured_path == "grows" else -length
