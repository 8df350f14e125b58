"""Who, for whom, what, where and when: the facts at the head of the first page."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from zlmreport.certificate.circumstances import date, days
from zlmreport.certificate.conditions import MACHINE_KINDS, axis_in_words
from zlmreport.certificate.facts import Fact
from zlmreport.certificate.opinions import in_a_line
from zlmreport.certificate.place import place_of_work
from zlmreport.language import Words

if TYPE_CHECKING:
    from zlmreport.evaluation.evaluation import Evaluation
    from zlmreport.job.job import Job
    from zlmreport.presenting.writer import Writer


def identity(job: Job, evaluations: tuple[Evaluation, ...], writer: Writer) -> Iterator[Fact]:
    """Yield the facts, in the order of the page."""
    keys = job.keys
    machine, customer, person = keys.machine, keys.customer, keys.certificate.authorised_by
    if customer:
        address = ", ".join(lines(customer.address))
        yield Fact(
            Words(en="Customer", de="Auftraggeber"),
            ", ".join(filter(None, (customer.name, address))),
            ("customer.name", "customer.address"),
        )
    named = " ".join(filter(None, (machine.manufacturer, machine.model)))
    kind = writer.say(MACHINE_KINDS[machine.kind])
    yield Fact(
        Words(en="Item calibrated", de="Gegenstand"),
        f"{named} ({kind})" if named else kind,
        ("machine.manufacturer", "machine.model", "machine.kind"),
    )
    yield Fact(Words(en="Serial number", de="Seriennummer"), machine.serial, ("machine.serial",))
    yield Fact(Words(en="Axis", de="Achse"), axis_in_words(job, writer), ("axis.name", "axis.kind"))
    yield Fact(
        Words(en="Evaluated by", de="Ausgewertet nach"),
        ", ".join(evaluation.designation for evaluation in evaluations),
        ("evaluate.standard",),
    )
    place = place_of_work(keys)
    if place:
        yield Fact(Words(en="Place of the work", de="Ort der Arbeiten"), writer.say(place.words), place.keys)
    received = date(keys.dates.received, writer)
    yield Fact(Words(en="Received", de="Eingang"), received, ("dates.received",))
    if keys.as_found:
        yield Fact(
            Words(en="Date of measurement as found", de="Datum der Messung vorher"),
            days(keys.as_found.measurement, writer),
            ("as_found.measurement.date", "as_found.measurement.end"),
        )
    yield Fact(
        Words(en="Date of measurement", de="Datum der Messung"),
        days(keys.measurement, writer),
        ("measurement.date", "measurement.end"),
    )
    yield Fact(Words(en="Date of issue", de="Ausstellungsdatum"), date(keys.certificate.issued, writer))
    if keys.next_due:
        yield Fact(
            Words(
                en="Next calibration due, as agreed with the customer",
                de="Nächste Kalibrierung, wie mit dem Auftraggeber vereinbart",
            ),
            writer.date(keys.next_due.date),
        )
    if person:
        yield Fact(Words(en="Authorised by", de="Freigegeben durch"), in_a_line(person))


def lines(address: str | None) -> tuple[str, ...]:
    """Part an address into lines, at its commas or line breaks."""
    if not address:
        return ()
    return tuple(
        part for piece in address.split("\n") for part in (part.strip() for part in piece.split(",")) if part
    )
