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
from zlmreport.errors import InputError, Problem, quoted
from zlmreport.evaluation.uncertainty.reasons import is_placeholder, names_something
from zlmreport.job.types import list_values

if TYPE_CHECKING:
    from zlmreport.job.job import Job
    from zlmreport.job.keys import JobKeys


#: Groups of keys that a certificate prints.
_PRINTED = frozenset(
    {
        "certificate",
        "laboratory",
        "customer",
        "machine",
        "location",
        "procedure",
        "sampling",
        "measurement",
        "as_found",
        "instrument",
        "environment",
        "evaluate",
        "external",
        "opinions",
        "agreement",
        "uncertainty",
    }
)
#: Parts of them in which a sign has a meaning, or that are asked about or marked where they are read.
_TOLD_ELSEWHERE = frozenset({"source", "style", "excluded", "negligible", "thermometers"})
_TOLD_OF_INSTRUMENTS = ("instrument.certificate", "instrument.compensation")


@dataclass(frozen=True, slots=True)
class MandatoryItem:
    """An item that a calibration certificate must show."""

    clause: str  #: Of ISO/IEC 17025:2017.
    key: str  #: The job key that states it.
    what: str  #: The item in words, as the message names it.
    stated: Callable[[JobKeys], object]  #: Whether a job states it, or need not.


MANDATORY_ITEMS = (
    MandatoryItem(
        "7.8.2.1 b",
        "laboratory.name",
        "the laboratory's name",
        lambda job: job.laboratory and job.laboratory.name,
    ),
    MandatoryItem(
        "7.8.2.1 b",
        "laboratory.address",
        "the laboratory's address",
        lambda job: job.laboratory and job.laboratory.address,
    ),
    MandatoryItem("7.8.2.1 c", "location", "where the work was done", place_of_work),
    MandatoryItem(
        "7.8.2.1 e", "customer.name", "the customer's name", lambda job: job.customer and job.customer.name
    ),
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
        lambda job: job.certificate.authorised_by and job.certificate.authorised_by.name,
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
    if (wanted := job.keys.certificate.sections) is not None:
        yield from find_left_out(wanted, job)
    told = set()
    for item in MANDATORY_ITEMS:
        stated = item.stated(job.keys)
        empty = stated if isinstance(stated, str) and stated and not names_something(stated) else ""
        if empty or not stated:
            told.add(item.key)
            found = f" ({quoted(empty)} states nothing)" if empty else ""
            yield Problem(
                job.place_of(item.key),
                f"a calibration certificate must state {item.what} (ISO/IEC 17025:2017, {item.clause}): "
                f"add {item.key}{found}, or make a measuring report by certificate.kind: report",
            )
    yield from (each for key, each in _find_placeholders(job) if not told & {key, key.removesuffix(".name")})


def _find_placeholders(job: Job) -> Iterator[tuple[str, Problem]]:
    """Yield the keys that state nothing by a dash or the like, each with what is to be done."""
    for key, text in list_values(job.keys):
        if not isinstance(text, str):
            continue
        parts = key.split(".")
        is_told = _TOLD_ELSEWHERE.intersection(parts) or key.endswith(_TOLD_OF_INSTRUMENTS)
        if parts[0] in _PRINTED and not is_told and is_placeholder(text):
            yield (
                key,
                Problem(
                    job.place_of(key),
                    f"{key}: {quoted(text)} states nothing, and a calibration certificate would print it; "
                    "state what is so, or leave the key out",
                ),
            )


def demand_mandatory_items(job: Job) -> None:
    """Refuse a calibration certificate that lacks mandatory items.

    Raises `InputError` with every missing item, its clause, and the key that states it.
    """
    missing = tuple(find_missing_items(job))
    if missing:
        raise InputError(missing)
