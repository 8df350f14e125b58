"""What the formulas of a budget take beside the stated figures: length, temperature, expansion."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from zlmreport.errors import Problem
from zlmreport.job.job import Job
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.quantities.temperature import ZERO_CELSIUS, above_reference
from zlmreport.quantities.units import MICROMETRE_PER_METRE_KELVIN

#: The temperature that the scale, and with it the measured length, has: the first that is known counts.
_TEMPERATURES = ("axis_temperature", "material_temperature")


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
        ΔT, the largest distance of the machine's temperature from 20 °C, K; the measuring device lies on the
        machine and is taken to share it.
    """

    length: float
    expansion: float | None
    device_expansion: float | None
    difference: float | None

    @classmethod
    def of(cls, job: Job, measurements: MeasurementSet) -> SetUp:
        """Return the circumstances that a job and its readings tell."""
        targets = measurements.target_positions
        environment, instrument = job.keys.environment, job.keys.instrument
        return cls(
            length=float(targets[-1] - targets[0]),
            expansion=_coefficient(environment.expansion_coefficient if environment else None),
            device_expansion=_coefficient(instrument.expansion_coefficient if instrument else None),
            difference=_difference(job, measurements),
        )

    def lacks(self, job: Job) -> Iterator[Problem]:
        """Yield the keys of the budget whose formula needs what is not known."""
        keys = job.keys.uncertainty
        in_environment = "environment.axis_temperature or environment.material_temperature"
        for key, stated, known, needed in (
            (
                "machine_temperature",
                keys.machine_temperature,
                self.expansion,
                "environment.expansion_coefficient",
            ),
            (
                "device_temperature",
                keys.device_temperature,
                self.device_expansion,
                "instrument.expansion_coefficient",
            ),
            ("expansion_coefficient", keys.expansion_coefficient, self.difference, in_environment),
            (
                "device_expansion_coefficient",
                keys.device_expansion_coefficient,
                self.difference,
                in_environment,
            ),
        ):
            if stated is not None and known is None:
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
            return abs(above_reference(stated + ZERO_CELSIUS))
        if stated is None and logged is not None and np.isfinite(logged).any():
            return float(np.nanmax(np.abs(above_reference(logged))))
    return None
