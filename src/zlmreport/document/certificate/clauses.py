"""What ISO/IEC 17025:2017 clause 7.8 makes mandatory, held against a job.

Not listed is what no job can lack: the title (7.8.2.1 a), the number (d), the standards evaluated by, as the
method (f), the results (m), and the fixed statements (l).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from zlmreport.document.certificate.cover import place_of_work
from zlmreport.document.certificate.own_words import find_left_out
from zlmreport.errors import InputError, Problem

if TYPE_CHECKING:
    from zlmreport.job.job import Job
    from zlmreport.job.keys import JobKeys


@dataclass(frozen=True, slots=True)
class MandatoryItem:
    """An item that a calibration certificate must show."""

    clause: str  #: Of ISO/IEC 17025:2017.
    key: str  #: The job key that states it.
    what: str  #: The item in words, as the message names it.
    stated: Callable[[JobKeys], object]  #: Whether a job states it, or need not.


MANDATORY_ITEMS = (
    MandatoryItem("7.8.2.1 b", "laboratory.name", "the laboratory's name", lambda job: job.laboratory),
    MandatoryItem(
        "7.8.2.1 b",
        "laboratory.address",
        "the laboratory's address",
        lambda job: job.laboratory and job.laboratory.address,
    ),
    MandatoryItem("7.8.2.1 c", "location", "where the work was done", place_of_work),
    MandatoryItem("7.8.2.1 e", "customer.name", "the customer's name", lambda job: job.customer),
    MandatoryItem(
        "7.8.2.1 e",
        "customer.address",
        "how to reach the customer",
        lambda job: job.customer and job.customer.address,
    ),
    MandatoryItem(
        "7.8.2.1 g",
        "machine.model",
        "what the machine is, by its manufacturer or its model",
        lambda job: job.machine.manufacturer or job.machine.model,
    ),
    MandatoryItem(
        "7.8.2.1 g",
        "machine.serial",
        "an unambiguous identification of the machine",
        lambda job: job.machine.serial,
    ),
    MandatoryItem(
        "7.8.2.1 i", "measurement.date", "the date of the measurement", lambda job: job.measurement.date
    ),
    MandatoryItem(
        "7.8.2.1 i",
        "as_found.measurement.date",
        "the date of the measurement before the adjustment",
        lambda job: job.as_found is None or job.as_found.measurement.date,
    ),
    MandatoryItem("7.8.2.1 j", "certificate.issued", "the date of issue", lambda job: job.certificate.issued),
    MandatoryItem(
        "7.8.2.1 o",
        "certificate.authorised_by",
        "the person who authorises the certificate",
        lambda job: job.certificate.authorised_by,
    ),
    MandatoryItem(
        "7.8.4.1 a",
        "instrument.expanded_uncertainty",
        "the measurement uncertainty of the instrument",
        lambda job: (
            job.instrument
            and (job.instrument.expanded_uncertainty or job.instrument.expanded_uncertainty_per_metre)
        ),
    ),
    MandatoryItem(
        "7.8.4.1 b",
        "environment",
        "the conditions that influence the results",
        lambda job: job.environment is not None,
    ),
    MandatoryItem(
        "7.8.4.1 c",
        "instrument.certificate",
        "the instrument's calibration certificate, for traceability",
        lambda job: job.instrument and job.instrument.certificate,
    ),
    MandatoryItem(
        "7.8.4.1 d",
        "as_found.adjustment",
        "what was adjusted or repaired between the two measurements",
        lambda job: job.as_found is None or job.as_found.adjustment,
    ),
)


def find_missing_items(job: Job) -> Iterator[Problem]:
    """Yield what a calibration certificate must state and does not; a measuring report may leave it out."""
    if job.keys.certificate.kind != "certificate":
        return
    yield from find_left_out(job)
    for item in MANDATORY_ITEMS:
        if not item.stated(job.keys):
            yield Problem(
                job.place_of(item.key),
                f"a calibration certificate must state {item.what} (ISO/IEC 17025:2017, {item.clause}): "
                f"add {item.key}, or make a measuring report by certificate.kind: report",
            )


def demand_mandatory_items(job: Job) -> None:
    """Refuse a calibration certificate that lacks mandatory items.

    Raises `InputError` with every missing item, its clause, and the key that states it.
    """
    missing = tuple(find_missing_items(job))
    if missing:
        raise InputError(missing)
