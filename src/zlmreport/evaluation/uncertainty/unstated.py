"""Refuses a calibration certificate whose job leaves contributions to U unstated; says what to state.

A report with an incomplete budget says so wherever it states U. Refused is also a certificate of a length
whose temperature nobody knows, or whose expansion is most of its U.
"""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.errors import Problem, quoted
from zlmreport.evaluation.correction.compensated import is_blind_to_air
from zlmreport.evaluation.uncertainty.budget import Budget, NoBudget
from zlmreport.evaluation.uncertainty.reasons import says_something
from zlmreport.evaluation.uncertainty.round_the_circle import HOW
from zlmreport.evaluation.uncertainty.set_up import INSTRUMENT
from zlmreport.job.job import Job
from zlmreport.measurement.measurement_set import CONDITIONS, STATE_OF_AIR
from zlmreport.measurement.units import MICROMETRE, REFERENCE_TEMPERATURE

#: Distance from 20 °C from which an expansion that decides the uncertainty must be corrected, K.
_FAR_FROM_REFERENCE = 1.0
#: Distance from 20 °C that no machine has, K: the temperature is in another unit, and the first page says so.
_IN_NO_HALL = 60.0
_HOW: dict[str, str] = {
    **HOW,
    INSTRUMENT: "state instrument.expanded_uncertainty as a number (µm or ″, k = 2)",
    "misalignment": "state how far the measuring line departs from the axis over its length, mm",
    "machine_temperature": "state the range of error of the machine's measured temperature, K, and "
    "environment.expansion_coefficient",
    "device_temperature": "state the range of error of the measuring device's temperature, K, and "
    "instrument.expansion_coefficient",
    "expansion_coefficient": "state the range of the machine's coefficient, µm/(m·K), and "
    "environment.axis_temperature",
    "device_expansion_coefficient": "state the range of the measuring device's coefficient, µm/(m·K), and "
    "environment.axis_temperature",
    "air_temperature": "state the range of error of the measured air temperature, K",
    "air_pressure": "state the range of error of the measured air pressure, hPa",
    "relative_humidity": "state the range of error of the measured humidity, %",
    "square": "state the expanded uncertainty (k = 2) of the angle of the square, arc seconds",
    "foot_spacing": "state the expanded uncertainty (k = 2) of the distance of the carriage's feet, mm",
    "environmental_variation": "state the range of the readings of the axis at rest over the time of a test",
    "resolution": "state the smallest step of the readings: corrected ones do not show it",
}

#: What a job states elsewhere than under `uncertainty`.
_KEYS = {
    INSTRUMENT: "instrument.expanded_uncertainty",
    "square": "square.expanded_uncertainty",
    "foot_spacing": "carriage.expanded_uncertainty",
}


def find_unstated(job: Job, budget: Budget | NoBudget) -> Iterator[Problem]:
    """Yield what a calibration certificate must state of its uncertainty and does not.

    `job`: The job; a report may leave out what it says that it leaves out.
    """
    if job.keys.certificate.kind != "certificate":
        return
    for name in budget.missing:
        key = _KEYS.get(name, f"uncertainty.{name}")
        yield Problem(
            job.place_of(
                f"uncertainty.negligible.{name}" if name in job.keys.uncertainty.negligible else key
            ),
            f"a calibration certificate needs {key}{_say_found(name, job)}: "
            f"{_HOW[name]}{_say_silence(name, job)}; "
            f"or say why it is negligible: uncertainty.negligible: {{{name}: reason}}",
        )
    instrument = job.keys.instrument
    has_compensated = bool(instrument and instrument.compensates and instrument.compensates.material)
    if isinstance(budget, Budget) and job.axis.has_length and _is_deciding(budget) and not has_compensated:
        longer = MICROMETRE.from_si(budget.uncorrected_expansion or 0.0)
        yield Problem(
            job.place_of("corrections"),
            f"the measured length was {abs(longer):.3g} µm {'longer' if longer > 0 else 'shorter'} than at "
            f"20 °C ({budget.difference:+.3g} K), more than all other uncertainty together: correct the "
            "readings by corrections: {material: {temperature: axis_temperature}}; or state "
            "instrument.compensates: {material: …} if the instrument has corrected them"
            f"{_say_other_unit(budget.difference)}",
        )
    if budget.uncorrected_expansion is None:
        correct = ", or correct the readings to 20 °C by corrections.material" if job.axis.has_length else ""
        yield Problem(
            job.place_of("environment"),
            "a calibration certificate needs the temperature of the measured length: state environment."
            f"axis_temperature and environment.expansion_coefficient (the expansion then enters U){correct}",
        )


def _say_other_unit(difference: float) -> str:
    """Return what is to be said of a temperature that is usual in another unit only; empty of others."""
    kind = CONDITIONS["axis_temperature"]
    stated = float(f"{kind.unit.from_si(REFERENCE_TEMPERATURE + difference):.4g}")
    meant = kind.find_likely_unit(stated)
    if meant is None:
        return ""
    (other, would_be), usual = meant, kind.unit.symbol
    return (
        f". {stated:g} {usual} is unusual where machines are measured: if {other.symbol} is meant, it is "
        f"{would_be:g} {usual}; state it so, or the unit of a file under measurement.source.units"
    )


def _say_silence(name: str, job: Job) -> str:
    """Return what is to be said first of an instrument of which nobody says in which air it counted."""
    is_told = job.keys.corrections is not None and job.keys.corrections.air is not None
    if name not in STATE_OF_AIR or is_told or is_blind_to_air(job):
        return ""
    said = (job.keys.instrument.compensation if job.keys.instrument else None) or ""
    unclear = f" (instrument.compensation, {quoted(said)}, does not say)" if says_something(said) else ""
    return (
        ", and instrument.compensates: {air: false}; if the instrument knew the refractive index of the air"
        f"{unclear}, instrument.compensates: {{air: true}} is enough"
    )


def _say_found(name: str, job: Job) -> str:
    """Return what stands in the place of a statement and is none."""
    reason = {str(key): said for key, said in job.keys.uncertainty.negligible.items()}.get(name)
    if reason is not None:
        return f" ({reason!r} is no reason why it should be negligible)"
    return " (0 states nothing)" if getattr(job.keys.uncertainty, name, None) == 0 else ""


def _is_deciding(budget: Budget) -> bool:
    """Return whether an expansion that nobody took out of the readings is most of what U states."""
    expansion = abs(budget.uncorrected_expansion or 0.0)
    is_far = _FAR_FROM_REFERENCE < abs(budget.difference) < _IN_NO_HALL
    return is_far and expansion > 2 * budget.standard_uncertainty
