"""The circumstances of a test on which its uncertainty rests: length, expansion, how far from 20 °C.

By these, and by its axis, a job must state contributors: one that says nothing of them is incomplete.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from zlmreport.errors import Problem
from zlmreport.evaluation.correction.compensated import find_compensated_by_instrument, is_blind_to_air
from zlmreport.evaluation.correction.corrections import find_condition_at_readings
from zlmreport.evaluation.uncertainty.budget import Acts
from zlmreport.evaluation.uncertainty.round_the_circle import OF_A_RADIUS
from zlmreport.job.evaluation_keys import UNCERTAIN_LENGTHS
from zlmreport.job.job import Job
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.measurand import Coordinate
from zlmreport.measurement.measurement_set import STATE_OF_AIR, MeasurementSet
from zlmreport.measurement.units import MICROMETRE_PER_METRE_KELVIN, compute_above_reference

#: The temperature that the scale, and with it the measured length, has: the first that is known counts.
_TEMPERATURES = ("axis_temperature", "material_temperature")
#: What is printed as 20.0 °C is 20 °C, K.
_AT_REFERENCE = 0.05
INSTRUMENT = "instrument"
_RESOLUTION = "resolution"
_OF_EVERY_AXIS = ("environmental_variation", _RESOLUTION)


@dataclass(frozen=True, slots=True)
class SetUp:
    """The circumstances of a test, SI; None for what is not known as a number."""

    #: L, from the first target position to the last, m or rad; of a circle its radius where that counts, and
    #: 0 of what was read over time.
    length: float
    expansion: float | None  #: α of the machine, 1/K.
    device_expansion: float | None  #: α of the measuring device, 1/K.
    #: (N,): ΔT of the machine from 20 °C at each reading, K; the measuring device lies on the machine and is
    #: taken to share it.
    differences: FloatArray | None
    is_corrected: bool = False  #: Whether the readings are corrected to 20 °C by this program.
    compensated: float | None = None  #: α by which the instrument has corrected them already, 1/K.
    is_circle: bool = False  #: Whether two axes ran a circle together.
    is_over_time: bool = False  #: Whether nothing moved but with time.

    @property
    def acts_of_device(self) -> Acts:
        """Which readings share the constant part of the instrument's error, where a job does not say.

        Of an instrument that stands where it is, what is constant cancels: it errs by how it drifts.
        """
        if self.is_over_time:
            return Acts.IN_TIME
        return Acts.ROUND_THE_CIRCLE if self.is_circle else Acts.AT_EACH_POSITION

    @property
    def acts_of_length(self) -> Acts:
        """Which readings share an error of the length: in proportion to the distance, or of a radius all."""
        return Acts.AT_THE_DATUM if self.is_circle else Acts.ALONG_THE_LENGTH

    @classmethod
    def of(cls, job: Job, measurements: MeasurementSet) -> SetUp:
        """Return the circumstances that a job and its readings tell."""
        targets, circle = measurements.target_positions, job.axis.circle
        is_over_time = job.axis.measurand.coordinate is Coordinate.TIME
        length = 0.0 if is_over_time else float(targets[-1] - targets[0])
        if circle is not None:
            length = circle.radius if circle.is_calibrated else 0.0
        environment, instrument, corrections = job.keys.environment, job.keys.instrument, job.keys.corrections
        material = corrections.material if corrections else None
        stated = environment.expansion_coefficient if environment else None
        compensated = find_compensated_by_instrument(job, measurements).material
        return cls(
            length=length,
            expansion=_find_coefficient((material and material.expansion_coefficient) or stated),
            device_expansion=_find_coefficient(instrument.expansion_coefficient if instrument else None),
            differences=_find_temperature_differences(job, measurements),
            is_corrected=material is not None,
            compensated=compensated,
            is_circle=circle is not None,
            is_over_time=is_over_time,
        )

    @property
    def difference(self) -> float | None:
        """ΔT of the largest amount, K, with its sign."""
        if self.differences is None:
            return None
        return float(self.differences[np.argmax(np.abs(self.differences))])

    @property
    def warms_up(self) -> bool:
        """Whether ΔT moves from reading to reading."""
        return self.differences is not None and float(np.ptp(self.differences)) > 0.0

    @property
    def of_the_sensor(self) -> float | None:
        """α by which an error of the measured temperature becomes one of the length, 1/K."""
        return self.expansion if self.compensated is None else self.compensated

    @property
    def uncorrected_coefficient(self) -> float | None:
        """α of what is left in the readings, 1/K; None where it is not known.

        Of readings that the instrument corrected only by how far its coefficient is not the machine's.
        """
        if self.is_corrected:
            return 0.0
        if self.compensated is not None:
            return 0.0 if self.expansion is None else self.expansion - self.compensated
        return None if self.expansion is None else self.expansion - (self.device_expansion or 0.0)

    @property
    def uncorrected_expansion(self) -> float | None:
        """By how much the measured length was longer than at 20 °C, against the measuring device, m.

        0 where the readings are corrected to 20 °C, or were taken there; None where it is not known.
        """
        alpha, difference = self.uncorrected_coefficient, self.difference
        is_at_reference = difference is not None and abs(difference) < _AT_REFERENCE
        if is_at_reference or not (alpha is None or alpha):
            return 0.0
        return None if difference is None or alpha is None else alpha * difference * self.length

    def list_lacking(self, job: Job) -> Iterator[Problem]:
        """Yield the keys of the budget whose formula needs what is not known."""
        keys, named = job.keys.uncertainty, name_contributors_of_length(job)
        temperature = "environment.axis_temperature or environment.material_temperature"
        machine, device = "environment.expansion_coefficient", "instrument.expansion_coefficient"
        for key, known, needed in (
            ("machine_temperature", self.of_the_sensor, machine),
            ("device_temperature", self.device_expansion, device),
            ("expansion_coefficient", self.difference, temperature),
            ("device_expansion_coefficient", self.difference, temperature),
        ):
            if key in named and getattr(keys, key) and known is None:
                path = f"uncertainty.{key}"
                yield Problem(
                    job.place_of(path),
                    f"{path}: its part of the uncertainty cannot be computed without a number in {needed}",
                )


def _find_coefficient(stated: float | str | None) -> float | None:
    return stated * MICROMETRE_PER_METRE_KELVIN if isinstance(stated, float) else None


def _find_temperature_differences(job: Job, measurements: MeasurementSet) -> FloatArray | None:
    """Return ΔT at each reading, (N,), of the first temperature that was logged, or is stated as a number."""
    for key in _TEMPERATURES:
        known = find_condition_at_readings(key, job, measurements)
        if known is not None:
            return compute_above_reference(known)
    return None


def has_radius(job: Job) -> bool:
    """Return whether the radius of a circle counts, as its instrument's length is known."""
    return job.axis.circle is not None and job.axis.circle.is_calibrated


def name_contributors_of_length(job: Job) -> tuple[str, ...]:
    """Return the contributors of the length that was measured; none where it was none."""
    return UNCERTAIN_LENGTHS if job.axis.has_length else OF_A_RADIUS if has_radius(job) else ()


def list_demanded(job: Job, of_silence: tuple[str, ...]) -> tuple[str, ...]:
    """Return the contributors that a job must state, by axis and set-up.

    `of_silence`: Those that may act, for all that the job says of its instrument.
    """
    corrections = job.keys.corrections
    corrects_air = corrections is not None and corrections.air is not None
    of_air = STATE_OF_AIR if corrects_air or is_blind_to_air(job) else of_silence
    is_over_time = job.axis.measurand.coordinate is Coordinate.TIME
    of_all = (_RESOLUTION,) if is_over_time else _OF_EVERY_AXIS  # the environment is what is measured
    return (INSTRUMENT, *name_contributors_of_length(job), *of_air, *of_all)
