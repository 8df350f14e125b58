"""Which contributors a job must state, by axis and set-up: one that says nothing of them is incomplete."""

from __future__ import annotations

from zlmreport.evaluation.correction.compensated import is_blind_to_air
from zlmreport.evaluation.uncertainty.round_the_circle import OF_A_RADIUS
from zlmreport.job.job import Job
from zlmreport.measurement.measurand import Coordinate
from zlmreport.measurement.measurement_set import STATE_OF_AIR

INSTRUMENT = "instrument"
_RESOLUTION = "resolution"
_OF_EVERY_AXIS = ("environmental_variation", _RESOLUTION)
_OF_LENGTHS = (
    "misalignment",
    "machine_temperature",
    "device_temperature",
    "expansion_coefficient",
    "device_expansion_coefficient",
)


def has_radius(job: Job) -> bool:
    """Return whether the radius of a circle counts, as its instrument's length is known."""
    return job.axis.circle is not None and job.axis.circle.is_calibrated


def name_contributors_of_length(job: Job) -> tuple[str, ...]:
    """Return the contributors of the length that was measured; none where it was none."""
    return _OF_LENGTHS if job.axis.has_length else OF_A_RADIUS if has_radius(job) else ()


def list_demanded(job: Job, of_silence: tuple[str, ...] = ()) -> tuple[str, ...]:
    """Return the contributors that a job must state, by axis and set-up.

    `of_silence`: Those that may act, for all that the job says of its instrument.
    """
    corrections = job.keys.corrections
    corrects_air = corrections is not None and corrections.air is not None
    of_air = STATE_OF_AIR if corrects_air or is_blind_to_air(job) else of_silence
    is_over_time = job.axis.measurand.coordinate is Coordinate.TIME
    of_all = (_RESOLUTION,) if is_over_time else _OF_EVERY_AXIS  # the environment is what is measured
    return (INSTRUMENT, *name_contributors_of_length(job), *of_air, *of_all)
