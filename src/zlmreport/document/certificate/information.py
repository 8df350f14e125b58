"""What a standard wants reported with a test (temperature, compensation …), held against what the job states.

Nothing is refused for it: what the job does not tell is an open finding of the standard.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from enum import Enum
from typing import TYPE_CHECKING

from zlmreport.evaluation.correction.compensated import find_compensated_by_instrument
from zlmreport.evaluation.evaluation import Finding
from zlmreport.evaluation.uncertainty.budget import Budget, NoBudget
from zlmreport.evaluation.uncertainty.reasons import is_placeholder, is_reference
from zlmreport.language import PhraseRow, Words
from zlmreport.measurement.measurand import STRAIGHTNESS
from zlmreport.measurement.units import MICROMETRE, MICROMETRE_PER_METRE_KELVIN

if TYPE_CHECKING:
    from zlmreport.job.job import Job
    from zlmreport.measurement.measurement_set import MeasurementSet


class Information(Enum):
    """Information on a test that a standard may want reported."""

    MOTION = "motion"
    PATH = "path"
    MEASURING_LINE = "measuring line"
    COMPENSATION = "compensation"
    TEMPERATURES = "temperatures"
    REFERENCE_TEMPERATURE = "reference temperature"
    INSTRUMENT = "instrument"
    STRAIGHTNESS_REFERENCE = "straightness reference"


_REQUIREMENTS: Mapping[Information, Words] = {
    Information.MOTION: Words("Feed, dwell at each target and warm-up reported"),
    Information.PATH: Words("Feed, place of the circle in the machine and warm-up reported"),
    Information.MEASURING_LINE: Words("Measuring line, or where the other axes stood, reported"),
    Information.COMPENSATION: Words("Compensations of the machine that were active reported"),
    Information.TEMPERATURES: Words("Temperatures reported, and where they were measured"),
    Information.REFERENCE_TEMPERATURE: Words(
        "Results for 20 °C: measured there, corrected to it, or within 1 K of it with the expansion in U"
    ),
    Information.INSTRUMENT: Words("Measuring instrument, its calibration and its compensation reported"),
    Information.STRAIGHTNESS_REFERENCE: Words(
        "Reference of the straightness reported: a calibrated body, one that was turned over, or a beam"
    ),
}
_STATED = Words("stated")
_LACKING = Words("not stated: {lacking}")
_IN_U = Words("not corrected; U holds the expansion whole")
_FAR_IN_U = Words("{difference} K from 20 °C, and not corrected; U holds the expansion whole")
#: Instruments that have a straight line of their own.
_BEAM = re.compile(r"laser|interf\w*met|autoco?l+imat|telescop|fernrohr|lunette|cannocchiale", re.IGNORECASE)
_LEFT_BY_INSTRUMENT = Words("{corrected}; the machine has {stated} µm/(m·K), and {left} µm are left")
#: Distance from 20 °C up to which an expansion that is counted in U may stand for a correction, K.
_NEAR = 1.0
_AT_REFERENCE = Words("measured at 20 °C")
_CORRECTED = Words("corrected by α = {coefficient} µm/(m·K)")


def check_information(
    asked: Iterable[Information], job: Job, measurements: MeasurementSet, budget: Budget | NoBudget
) -> Iterator[Finding]:
    """Yield what a standard asks to be reported, held against the job.

    `measurements`: Its readings, with the temperatures that were logged beside them.
    `budget`: Of their uncertainty: it knows the thermal expansion that is not corrected.
    """
    for each in asked:
        if each is Information.PATH and job.axis.circle is None:
            continue
        if each is Information.STRAIGHTNESS_REFERENCE and job.axis.measurand is not STRAIGHTNESS:
            continue
        if each is not Information.REFERENCE_TEMPERATURE:
            lacking = tuple(_list_lacking(each, job, measurements))
            found = _LACKING.given(lacking=PhraseRow(lacking)) if lacking else _STATED
            yield Finding(_REQUIREMENTS[each], found, met=None if lacking else True)
        elif job.axis.has_length:
            yield _check_reference_temperature(job, measurements, budget)


def _check_reference_temperature(
    job: Job, measurements: MeasurementSet, budget: Budget | NoBudget
) -> Finding:
    requirement = _REQUIREMENTS[Information.REFERENCE_TEMPERATURE]
    coefficient = _find_used_coefficient(job)
    if coefficient is not None:
        return Finding(requirement, _CORRECTED.given(coefficient=coefficient), met=True)
    if budget.uncorrected_expansion is None:
        return Finding(requirement, Words("the temperature or the coefficient is not known"), met=None)
    by_instrument = find_compensated_by_instrument(job, measurements).material
    if by_instrument is not None:
        coefficient = float(f"{by_instrument / MICROMETRE_PER_METRE_KELVIN:.6g}")
        return Finding(requirement, *_judge_compensation(coefficient, job, budget))
    if not budget.uncorrected_expansion:
        return Finding(requirement, _AT_REFERENCE, met=True)
    if not isinstance(budget, Budget):
        return Finding(requirement, Words("not at 20 °C, and not corrected"), met=False)
    is_near = abs(budget.difference) <= _NEAR
    difference = float(f"{budget.difference:.3g}")
    return Finding(requirement, _IN_U if is_near else _FAR_IN_U.given(difference=difference), met=is_near)


def _judge_compensation(coefficient: float, job: Job, budget: Budget | NoBudget) -> tuple[Words, bool]:
    """Return what is said of a length that the instrument took to 20 °C, and whether it did.

    `coefficient`: By which it did, µm/(m·K). What another one of the machine leaves counts as so many kelvins
    of an expansion that nobody has corrected.
    """
    found = Words("corrected by the instrument, by α = {coefficient} µm/(m·K)").given(coefficient=coefficient)
    stated = job.keys.environment.expansion_coefficient if job.keys.environment else None
    if not isinstance(stated, float) or not stated or not isinstance(budget, Budget):
        return found, True
    if abs(budget.difference * (1 - coefficient / stated)) <= _NEAR:
        return found, True
    left = float(f"{abs(MICROMETRE.from_si(budget.uncorrected_expansion or 0.0)):.3g}")
    return _LEFT_BY_INSTRUMENT.given(corrected=found, stated=stated, left=left), False


def _find_used_coefficient(job: Job) -> float | None:
    """Return the coefficient by which readings are corrected to 20 °C, µm/(m·K); None where they are not."""
    material = job.keys.corrections.material if job.keys.corrections else None
    if material is None:
        return None
    stated = job.keys.environment.expansion_coefficient if job.keys.environment else None
    return material.expansion_coefficient or (stated if isinstance(stated, float) else None)


def _list_lacking(asked: Information, job: Job, measurements: MeasurementSet) -> Iterator[Words]:
    """Yield what of the information the job does not state."""
    keys = job.keys
    measurement, instrument, environment = keys.measurement, keys.instrument, keys.environment
    logged = {name for line in measurements.lines for name in line.conditions}
    circle = keys.circle
    length = environment and (environment.axis_temperature or environment.material_temperature)
    stated: Mapping[Information, tuple[tuple[Words, object], ...]] = {
        Information.MOTION: (
            (Words("feed"), measurement.feed),
            (Words("dwell at each target"), measurement.dwell),
            (Words("warm-up"), measurement.warm_up),
        ),
        Information.PATH: (
            (Words("feed"), circle and circle.feed),
            (Words("centre of the circle"), circle and "centre" in circle.model_fields_set),
            (Words("warm-up"), measurement.warm_up),
        ),
        Information.MEASURING_LINE: (
            (Words("measuring line"), measurement.line or measurement.at or measurement.tests),
        ),
        Information.COMPENSATION: (
            (Words("state of the compensation"), measurement.compensation or keys.axis.compensation_table),
        ),
        Information.TEMPERATURES: (
            (
                Words("temperature of the air"),
                (environment and environment.air_temperature) or "air_temperature" in logged,
            ),
            (
                Words("temperature of the machine"),
                length or logged & {"axis_temperature", "material_temperature"},
            ),
            (Words("sensor locations"), environment and environment.sensors),
        ),
        Information.INSTRUMENT: (
            (Words("instrument"), instrument),
            (Words("its calibration"), instrument and is_reference(instrument.certificate or "")),
            (
                Words("its compensation"),
                instrument
                and (
                    instrument.compensation
                    or instrument.compensates
                    or (keys.corrections and keys.corrections.air)
                ),
            ),
        ),
        Information.STRAIGHTNESS_REFERENCE: (
            (Words("reference of the straightness"), _has_straightness_reference(job, measurements)),
        ),
    }
    for name, value in stated[asked]:
        if not value or (isinstance(value, str) and is_placeholder(value)):
            yield name


def _has_straightness_reference(job: Job, measurements: MeasurementSet) -> bool:
    """Return whether the job says what a line was straight against: a body with a certificate, or a beam."""
    named = any(is_reference(each.certificate or "") for each in job.keys.uncertainty.contributions)
    instrument = job.keys.instrument
    is_beam = instrument is not None and bool(_BEAM.search(instrument.name))
    return named or is_beam or measurements.artefact_is_reversed
