"""Whether a budget is complete: every contributor of ISO/TR 230-9 stated, or negligible for a reason.

A report with an incomplete budget says so wherever it states U; a calibration certificate is refused, with
what is to be stated and how. So is one of a length whose temperature nobody knows.
"""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.errors import Problem
from zlmreport.job.job import Job
from zlmreport.job.keys import JobKeys
from zlmreport.measurement.axis import AxisKind
from zlmreport.measurement.measurement_set import STATE_OF_AIR
from zlmreport.uncertainty.budget import Budget, NoBudget

INSTRUMENT = "instrument"
_OF_EVERY_AXIS = ("environmental_variation", "resolution")
_OF_LENGTHS = (
    "misalignment",
    "machine_temperature",
    "device_temperature",
    "expansion_coefficient",
    "device_expansion_coefficient",
)
_HOW: dict[str, str] = {
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
    "environmental_variation": "state the range of the readings of the axis at rest over the time of a test",
    "resolution": "state the smallest step of the readings: corrected ones do not show it",
}


def demanded(keys: JobKeys) -> tuple[str, ...]:
    """Return the contributors that a job must state, by axis and set-up."""
    of_lengths = _OF_LENGTHS if keys.axis.kind is AxisKind.LINEAR else ()
    of_air = STATE_OF_AIR if keys.corrections and keys.corrections.air else ()
    return (INSTRUMENT, *of_lengths, *of_air, *_OF_EVERY_AXIS)


def refusals(job: Job, budget: Budget | NoBudget) -> Iterator[Problem]:
    """Yield what a calibration certificate must state of its uncertainty and does not.

    Parameters
    ----------
    job
        The job; a report may leave out what it says that it leaves out.
    budget
        Of the job.
    """
    if job.keys.certificate.kind != "certificate":
        return
    for name in budget.missing:
        key = "instrument.expanded_uncertainty" if name == INSTRUMENT else f"uncertainty.{name}"
        yield Problem(
            job.place_of(key),
            f"a calibration certificate needs {key}: {_HOW[name]}; or say why it is negligible: "
            f"uncertainty.negligible: {{{name}: reason}}",
        )
    if budget.uncorrected_expansion is None:
        yield Problem(
            job.place_of("environment"),
            "a calibration certificate needs the temperature of the measured length: state environment."
            "axis_temperature and environment.expansion_coefficient (the expansion then enters U), or "
            "correct the readings to 20 °C by corrections.material",
        )
