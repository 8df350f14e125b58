"""The budget of a circular test: errors smooth over the angle, calibrated length, centring.

An instrument that is carried round a circle errs by its balls, its magnets and its scale: by curves that are
smooth over the angle, and alike in both senses. They are taken as made of the second to the fourth harmonic,
each with the same share of the variance. A constant would be an error of the length, which has a contribution
of its own, and the first harmonic is taken off with the centre: what is left is all an error of form.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from zlmreport.evaluation.uncertainty import wording
from zlmreport.evaluation.uncertainty.budget import Acts, Contribution, Distribution, from_range
from zlmreport.job.evaluation_keys import STATED_COVERAGE_FACTOR
from zlmreport.job.job import Job
from zlmreport.language import Words
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.circle import NominalCircle
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.measurement.units import MICROMETRE

#: Harmonics of the turn that an error smooth over the angle has.
_HARMONICS: Mapping[Acts, tuple[int, ...]] = {Acts.ROUND_THE_CIRCLE: (2, 3, 4), Acts.OFF_CENTRE: (1,)}
#: What a job must state of a circle whose radius counts.
OF_A_RADIUS = (
    "calibrated_length",
    "machine_temperature",
    "device_temperature",
    "expansion_coefficient",
    "device_expansion_coefficient",
    "centring",
)
_LEAST_RANGE = 1e-4  # µm
HOW = {
    "calibrated_length": "state the expanded uncertainty (k = 2) of the instrument's calibrated length, µm",
    "centring": "state the range of error of the centre on which an arc is measured, µm",
}


def smooth_curves(acts: Acts, angles: FloatArray, count: int, generator: np.random.Generator) -> FloatArray:
    """Return random curves over angles, rad, of root mean square 1 at each of them: (count, m).

    `acts`: Round the circle, or off its centre.
    """
    harmonics = np.array(_HARMONICS[acts])
    phases = np.multiply.outer(harmonics, angles)
    basis = np.concatenate([np.cos(phases), np.sin(phases)])
    drawn = generator.standard_normal((count, len(basis)))
    return np.asarray(drawn @ basis / np.sqrt(len(harmonics)))


def list_circle_contributions(
    job: Job, circle: NominalCircle, measurements: MeasurementSet
) -> Iterator[Contribution]:
    """Yield what only a circle has: its calibrated length, and what its centre leaves.

    The centre of a full turn is found from the readings, but for e²/(2R): a circle whose centre lies off by e
    is no circle over the angle by so much, and nobody knows whether angles are those of the path or of the
    instrument.
    """
    keys = job.keys.uncertainty
    if circle.is_calibrated and keys.calibrated_length:
        yield Contribution(
            name=wording.USUAL["calibrated_length"],
            standard_uncertainty=MICROMETRE.to_si(keys.calibrated_length) / STATED_COVERAGE_FACTOR,
            acts=Acts.AT_THE_DATUM,
            distribution=Distribution.NORMAL,
            stated=wording.say_expanded_uncertainty(
                keys.calibrated_length, MICROMETRE.symbol, STATED_COVERAGE_FACTOR
            ),
            source=wording.say_calibration(job.keys.instrument.certificate if job.keys.instrument else None),
            contributor="calibrated_length",
        )
    if keys.centring:
        centring, source, acts = MICROMETRE.to_si(keys.centring), wording.STATED, Acts.OFF_CENTRE
    elif is_round(measurements.target_positions):
        offset, acts = _fit_offset(measurements), Acts.ROUND_THE_CIRCLE
        centring = offset**2 / (2 * circle.radius)
        source = wording.SECOND_ORDER.given(offset=float(f"{round(MICROMETRE.from_si(offset), 3):.3g}"))
    else:
        return
    yield Contribution(
        name=wording.USUAL["centring"],
        standard_uncertainty=from_range(centring, Distribution.RECTANGULAR),
        acts=acts,
        distribution=Distribution.RECTANGULAR,
        stated=_say_range(MICROMETRE.from_si(centring)),
        source=source,
        contributor="centring",
    )


def _say_range(value: float) -> Words:
    """Return the range of the centring, µm; of one that nothing on a circle shows only that it is smaller."""
    if value < _LEAST_RANGE:
        return wording.say_range_below("R", _LEAST_RANGE, MICROMETRE.symbol)
    return wording.say_full_range("R", float(f"{value:.3g}"), MICROMETRE.symbol)


def is_round(angles: FloatArray) -> bool:
    """Return whether angles, rising, go all round, so that they tell the centre: no gap of a right angle."""
    return bool(np.diff(angles, append=angles[0] + 2 * np.pi).max() < np.pi / 2)


def _fit_offset(measurements: MeasurementSet) -> float:
    """Return how far the centre of the readings lies from that of the instrument, m: by least squares."""
    there = np.isfinite(measurements.deviation)
    angles = measurements.target_positions[measurements.target[there]]
    columns = np.column_stack([np.ones_like(angles), np.cos(angles), np.sin(angles)])
    found, *_ = np.linalg.lstsq(columns, measurements.deviation[there], rcond=None)
    return float(np.hypot(found[1], found[2]))
