"""What an instrument has corrected itself (air, expansion) before it displayed: by the job, or its file."""

from __future__ import annotations

import re

from zlmreport.job.job import Job
from zlmreport.measurement.measurement_set import Compensated, MeasurementSet
from zlmreport.measurement.units import MICROMETRE_PER_METRE_KELVIN

#: Names of instruments that count wavelengths; one that triangulates with a laser does not.
_INTERFEROMETER = re.compile(
    r"interf[eé]r[oó]m[eéè]t|\b(XL-?80|ML-?10|XD\s?L|XM-?60|5519\w?|5529\w?|5530|IDS\s?3010|LSP\s?30|HPI-?3D)\b|"
    r"\blaser(?!.*(triangul|sensor|scanner|distan|abstand))",
    re.IGNORECASE,
)
#: A part of what is said of an instrument's compensation: up to a comma, a semicolon, a bracket, an "and".
_PART = re.compile(r"[;,()]|\.\s|\b(?:and|but|only|und|aber|nur)\b", re.IGNORECASE)
_NOTHING = re.compile(r"\W*(none|no|off|nothing|without|keine?|aus|nichts|ohne)\b\W*", re.IGNORECASE)
_NOT = re.compile(
    r"\b(no|not|non|none|off|without|disabled|inactive|un-?compensated|uncorrected|fixed|kein\w*|nicht|aus|ohne|"
    r"un-?kompensiert|unkorrigiert|deaktiviert|inaktiv|fest\w*)\b",
    re.IGNORECASE,
)
_THE_AIR = re.compile(
    r"\baire?\b|\baria\b|luft|r[eéi]fra[cz]|brech|edl[eé]n|ciddor|wave-?length|wellenl|weather|wetter|environment|umwelt|"
    r"umgebung|ambient|atmos|\bindex\b|ind[ií]ce|m[eé]t[eé]o|\b(XC-?80|EC-?10)\b",
    re.IGNORECASE,
)
_ANYTHING_ELSE = re.compile(
    r"material|expansion|ausdehnung|werkstoff|temperat|dead|totstrecke", re.IGNORECASE
)


def find_compensated_by_instrument(job: Job, measurements: MeasurementSet) -> Compensated:
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
    return bool(said and counts_wavelengths(instrument.name) and _says_air_is_left(said))


def counts_wavelengths(name: str) -> bool:
    """Return whether the name of an instrument says that it is an interferometer.

    >>> counts_wavelengths("Interféromètre laser"), counts_wavelengths("Laser triangulation sensor")
    (True, False)
    """
    return bool(_INTERFEROMETER.search(name))


def speaks_of_air(said: str) -> bool:
    """Return whether words on an instrument's compensation say if the instrument looked at the air.

    >>> speaks_of_air("refractive index of the air"), speaks_of_air("none"), speaks_of_air("material only")
    (True, True, True)
    >>> speaks_of_air("automatic"), speaks_of_air("on"), speaks_of_air("")
    (False, False, False)
    """
    return bool(_THE_AIR.search(said)) or _says_air_is_left(said)


def _says_air_is_left(said: str) -> bool:
    """Return whether words on an instrument's compensation say that it did not look at the air.

    They do where they deny compensation, or name another one only, and do not say that the air was looked at.

    >>> _says_air_is_left("not compensated"), _says_air_is_left("material only")
    (True, True)
    >>> _says_air_is_left("refractive index of the air; no material temperature")
    False
    """
    parts = [part for part in _PART.split(said) if part.strip()]
    if any(_NOTHING.fullmatch(part) for part in parts):
        return True
    if any(_THE_AIR.search(part) and not _NOT.search(part) for part in parts):
        return False
    return any(_NOT.search(part) or _ANYTHING_ELSE.search(part) for part in parts)
