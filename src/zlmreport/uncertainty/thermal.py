"""Temperature and expansion of a test: what is known of them, and what nobody corrected."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from zlmreport.errors import Problem
from zlmreport.job.job import Job
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.quantities.units import MICROMETRE_PER_METRE_KELVIN, ZERO_CELSIUS, above_reference

#: The temperature that the scale, and with it the measured length, has: the first that is known counts.
_TEMPERATURES = ("axis_temperature", "material_temperature")
#: What is printed as 20.0 °C is 20 °C, K.
_AT_REFERENCE = 0.05


@dataclass(frozen=True, slots=True)
class SetUp:
    """The circumstances of a test, SI; None for what is not known as a number.

    Attributes
    ----------
    length
        L, from the first target position to the last, m or rad.
    expansion
        α of the machine, 1/K.
    device_expansion
        α of the measuring device, 1/K.
    difference
        ΔT, the largest distance of the machine's temperature from 20 °C, K, with its sign; the measuring
        device lies on the machine and is taken to share it.
    is_corrected
        Whether the readings are corrected to 20 °C.
    """

    length: float
    expansion: float | None
    device_expansion: float | None
    difference: float | None
    is_corrected: bool = False

    @classmethod
    def of(cls, job: Job, measurements: MeasurementSet) -> SetUp:
        """Return the circumstances that a job and its readings tell."""
        targets = measurements.target_positions
        environment, instrument, corrections = job.keys.environment, job.keys.instrument, job.keys.corrections
        material = corrections.material if corrections else None
        stated = environment.expansion_coefficient if environment else None
        return cls(
            length=float(targets[-1] - targets[0]),
            expansion=_coefficient((material and material.expansion_coefficient) or stated),
            device_expansion=_coefficient(instrument.expansion_coefficient if instrument else None),
            difference=_difference(job, measurements),
            is_corrected=material is not None,
        )

    @property
    def is_at_reference(self) -> bool:
        """Whether the machine was at 20 °C."""
        return self.difference is not None and abs(self.difference) < _AT_REFERENCE

    @property
    def uncorrected_expansion(self) -> float | None:
        """By how much the measured length was longer than at 20 °C, against the measuring device, m.

        0 where the readings are corrected to 20 °C, or were taken there; None where it is not known.
        """
        if self.is_corrected or self.is_at_reference:
            return 0.0
        if self.difference is None or self.expansion is None:
            return None
        return (self.expansion - (self.device_expansion or 0.0)) * self.difference * self.length

    def lacks(self, job: Job) -> Iterator[Problem]:
        """Yield the keys of the budget whose formula needs what is not known."""
        keys = job.keys.uncertainty
        temperature = "environment.axis_temperature or environment.material_temperature"
        machine, device = "environment.expansion_coefficient", "instrument.expansion_coefficient"
        for key, known, needed in (
            ("machine_temperature", self.expansion, machine),
            ("device_temperature", self.device_expansion, device),
            ("expansion_coefficient", self.difference, temperature),
            ("device_expansion_coefficient", self.difference, temperature),
        ):
            if getattr(keys, key) is not None and known is None:
                path = f"uncertainty.{key}"
                yield Problem(
                    job.place_of(path),
                    f"{path}: its part of the uncertainty cannot be computed without a number in {needed}",
                )


def _coefficient(stated: float | str | None) -> float | None:
    return stated * MICROMETRE_PER_METRE_KELVIN if isinstance(stated, float) else None


def _difference(job: Job, measurements: MeasurementSet) -> float | None:
    """Return ΔT of the first temperature that the job states as a number, or that was logged."""
    for key in _TEMPERATURES:
        stated = getattr(job.keys.environment, key, None)
        logged = measurements.conditions.get(key)
        if isinstance(stated, float):
            return above_reference(stated + ZERO_CELSIUS)
        if stated is None and logged is not None and np.isfinite(logged).any():
            differences = above_reference(logged[np.isfinite(logged)])
            return float(differences[np.argmax(np.abs(differences))])
    return None
