"""What an instrument has corrected before it displayed a reading: by the job, or by the file it wrote."""

from __future__ import annotations

import re

from zlmreport.job.job import Job
from zlmreport.measurement.measurement_set import Compensated, MeasurementSet
from zlmreport.measurement.units import MICROMETRE_PER_METRE_KELVIN

#: Names of instruments that count wavelengths; one that triangulates with a laser does not.
_INTERFEROMETER = re.compile(
    r"interferomet|\b(XL-?80|ML-?10|XD\s?L|XM-?60|5519\w?|5529\w?|5530|IDS\s?3010|LSP\s?30|HPI-?3D)\b|"
    r"\blaser(?!.*(triangul|sensor|scanner|distan|abstand))",
    re.IGNORECASE,
)
_NOTHING = re.compile(r"\W*(none|no|off|nothing|without|keine?|aus|nichts|ohne)\b\W*", re.IGNORECASE)


def compensated_by_instrument(job: Job, measurements: MeasurementSet) -> Compensated:
    """Return what the instrument has corrected itself; the job's word counts before the file's."""
    instrument = job.keys.instrument
    stated = instrument.compensates if instrument else None
    known = measurements.compensated or Compensated()
    if not job.axis.has_length:
        return Compensated()
    if stated is None:
        return known
    material = known.material if stated.material is None else stated.material * MICROMETRE_PER_METRE_KELVIN
    return Compensated(material or None, known.air if stated.air is None else stated.air)


def is_blind_to_air(job: Job) -> bool:
    """Return whether lengths were counted in wavelengths of an air that nobody looked at.

    The job says so by ``instrument.compensates: {air: false}``, or in words of an instrument whose name says
    that it is an interferometer.
    """
    keys = job.keys
    instrument = keys.instrument
    if instrument is None or not job.axis.has_length:
        return False
    if keys.corrections is not None and keys.corrections.air is not None:
        return False
    if instrument.compensates is not None and instrument.compensates.air is not None:
        return not instrument.compensates.air
    said = instrument.compensation
    return bool(said and _NOTHING.fullmatch(said) and _INTERFEROMETER.search(instrument.name))
