"""Titles of documents; statements on validity, traceability, exclusions, amendments, next date, opinions."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from zlmreport.document.blocks import Block, Column, Notice, Paragraph, RowGroup, Section, Table
from zlmreport.document.writer import BY_CUSTOMER, EXTERNAL, NOTHING, Writer
from zlmreport.evaluation import traceability
from zlmreport.language import Words, named, same
from zlmreport.measurement.error_symbol import find_error_named
from zlmreport.measurement.units import with_unit

if TYPE_CHECKING:
    from zlmreport.job.document_keys import CertificateKeys, Person
    from zlmreport.job.job import Job
    from zlmreport.job.keys import JobKeys
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.measurement.provenance import Exclusion

#: What a document of each kind is about: a measuring report calibrates nothing.
ITEM = {"certificate": Words("Item calibrated"), "report": Words("Item measured")}
WORK = {"certificate": Words("Calibration"), "report": Words("Report")}
NEXT_DUE = {
    "certificate": Words("Next calibration due, as agreed with the customer"),
    "report": Words("Next measurement due, as agreed with the customer"),
}
_ONLY_THIS_ITEM = {
    "certificate": Words(
        "The results relate only to the item calibrated, in its condition at the time of the measurement."
    ),
    "report": Words(
        "The results relate only to the item measured, in its condition at the time of the measurement."
    ),
}
#: The statement of 7.8.4.1 c, and that of a document on what several instruments measured.
_TRACEABLE = Words(
    "The results are metrologically traceable through the calibration of the measuring instrument "
    "(calibration certificate {certificate})."
)
_TRACEABLE_BY_SEVERAL = Words(
    "The results are metrologically traceable through the calibrations of the measuring instruments "
    "(calibration certificates {certificates})."
)
_TRACEABLE_BY_ARTEFACTS = Words(
    "The results are metrologically traceable through the calibrations of what was measured with and against "
    "(calibration certificates {certificates})."
)
_ONLY_IN_FULL = Words(
    "This certificate may be reproduced only in full, unless the laboratory agrees in writing."
)
_SIMPLIFIED = Words(
    "By agreement with the customer{reference} the results are reported in a simplified way: the single "
    "readings are not printed. The laboratory keeps them available."
)
_SUPPLIED = Words(
    "{mark} Provided by the customer. The laboratory is not responsible for these data, which can affect "
    "the validity of the results."
)
_DEVIATIONS = Words("Additions to, deviations and exclusions from the method")
_ONE = Words("{count} reading was set aside and did not enter the results")
_SEVERAL = Words("{count} readings were set aside and did not enter the results")
_READING = Words("target {target} {arrow}, run {run}, read {deviation}: {reason}")
_EXCLUSION_STATED = Words("Set aside{mark}: target {target} {arrow}, run {run}: {reason}")
_STATED_AS_FOUND = Words("Set aside as found{mark}: target {target} {arrow}, run {run}: {reason}")
_KEY = "measurement.excluded"
_ARROWS = {"+": "↑", "-": "↓"}
#: Readings that the first page names one by one.
_MOST_NAMED = 6
_MORE = Words("Set aside besides: {count} more, see the section on the readings")
TITLES = {"certificate": Words("Calibration Certificate"), "report": Words("Measuring Report")}
_AMENDMENT = {
    "certificate": Words("Amendment to Calibration Certificate {number}"),
    "report": Words("Amendment to Measuring Report {number}"),
}

_AMENDS = Words("This document amends {number}, which remains valid in all that is not changed here")
_REPLACES = Words("This document replaces {number}, which is no longer valid")
_REASON = Words("Reason: {reason}")
_CHANGE = Words("Changed: {change}")
#: Above every opinion of a document.
OPINION = Words("Opinion and interpretation (ISO/IEC 17025:2017, 7.8.7), not a result of the measurement")
_RESTS = Words("Each is stated by an authorised person and rests on what is named as its basis.")


def list_notices(keys: JobKeys, writer: Writer, *, names_all: bool = False) -> Iterator[Notice]:
    """Yield what nobody may overlook: how the work departed from the method, and what others did.

    `names_all`: Whether every reading that was set aside is named, for no section on the readings names it.
    """
    deviations = keys.measurement.deviations_from_method
    most = None if names_all else _MOST_NAMED
    items = (*([deviations] if deviations else []), *_list_exclusions(keys, writer, most))
    if items:
        yield Notice(writer.say(_DEVIATIONS), items)
    if keys.external:
        yield Notice(
            writer.say(Words("{mark} Results from external providers").given(mark=EXTERNAL)),
            tuple(
                writer.say(named(each.results, ", ".join(filter(None, (each.provider, each.reference)))))
                for each in keys.external
            ),
        )


def say_traceable_through(job: Job, *measured: MeasurementSet) -> Words | None:
    """Return through which calibrations the results are traceable; None where the job does not show it.

    `measured`: Of each part of the job, in their order: nothing is said where an instrument is not calibrated
        for all that was measured with it.
    """
    if not all(map(traceability.is_within_calibrated_range, job.parts, measured)):
        return None
    chain = traceability.find_chain(job)
    if chain.of_artefacts:
        every = ", ".join((*chain.of_instruments, *chain.of_artefacts))
        return _TRACEABLE_BY_ARTEFACTS.given(certificates=every)
    if len(chain.of_instruments) > 1:
        return _TRACEABLE_BY_SEVERAL.given(certificates=", ".join(chain.of_instruments))
    return _TRACEABLE.given(certificate=chain.of_instruments[0]) if chain.of_instruments else None


def lay_out_paragraphs(job: Job, writer: Writer, *measured: MeasurementSet) -> Iterator[Block]:
    """Yield the statements in running text; what was `measured`, of each part of a job."""
    keys = job.keys
    if keys.provided_by_customer:
        yield Paragraph(writer.say(_SUPPLIED.given(mark=BY_CUSTOMER)))
    if keys.agreement.simplified:
        reference = keys.agreement.reference
        yield Paragraph(writer.say(_SIMPLIFIED.given(reference=same(f" ({reference})") if reference else "")))
    traceable = say_traceable_through(job, *measured)
    if traceable:
        yield Paragraph(writer.say(traceable))
    yield Paragraph(writer.say(_ONLY_THIS_ITEM[keys.certificate.kind]))
    if keys.certificate.kind == "certificate":
        yield Paragraph(writer.say(_ONLY_IN_FULL))


def make_exclusion_notice(measurements: MeasurementSet, writer: Writer, key: str = _KEY) -> Iterator[Notice]:
    """Yield the notice that names every reading that was set aside, with its value and the reason.

    `key`: The job key that names them: marked if that was the customer's decision.
    """
    exclusions = measurements.provenance.exclusions
    if exclusions:
        heading = (_ONE if len(exclusions) == 1 else _SEVERAL).given(count=len(exclusions))
        marked = writer.say(heading) + writer.marks.write_after(key)
        yield Notice(marked, tuple(_write_item(each, writer) for each in exclusions))


def _list_exclusions(keys: JobKeys, writer: Writer, most: int | None) -> tuple[str, ...]:
    """Return what the first page says of readings that were set aside: they depart from the method.

    `most`: Of so many; all of them if it is None.
    """
    found = [(_EXCLUSION_STATED, _KEY, each) for each in keys.measurement.excluded]
    if keys.as_found:
        found += [(_STATED_AS_FOUND, f"as_found.{_KEY}", each) for each in keys.as_found.measurement.excluded]
    items = [
        writer.say(
            words.given(
                mark=writer.marks.write_after(key),
                target=with_unit(writer.number(each.target), writer.position_unit.symbol),
                arrow=_ARROWS[each.direction],
                run=each.run,
                reason=each.reason,
            )
        )
        for words, key, each in found[:most]
    ]
    if len(found) > len(items):
        items.append(writer.say(_MORE.given(count=len(found) - len(items))))
    return tuple(items)


def _write_item(exclusion: Exclusion, writer: Writer) -> str:
    return writer.say(
        _READING.given(
            target=with_unit(writer.position(exclusion.target_position), writer.position_unit.symbol),
            arrow=exclusion.approach.arrow,
            run=exclusion.run,
            deviation=with_unit(writer.deviation(exclusion.deviation), writer.deviation_unit.symbol),
            reason=exclusion.reason,
        )
    )


def write_document_title(keys: CertificateKeys) -> Words:
    """Return the document's title: an amendment's names what it amends."""
    usual = TITLES[keys.kind]
    amends = keys.amends
    if amends is None or amends.kind == "replacement":
        return usual if keys.title is None else Words("{title}").given(title=keys.title)
    if keys.title is None:
        return _AMENDMENT[keys.kind].given(number=amends.number)
    return Words("Amendment to {title} {number}").given(title=keys.title, number=amends.number)


def name_subject_of(job: Job) -> Words:
    """Return what the document is about: ``Straightness error EYX of axis X``, in both notations if asked."""
    axis = job.axis
    if not axis.error or job.keys.measurement.symbols == "iso230-1":
        return axis.subject
    both = Words("{symbol} (VDI/VDE 2617-3: {vdi})").given(
        symbol=axis.error, vdi=find_error_named(axis.error).vdi
    )
    return axis.measurand.named(axis.name, both)


def write_running_title(keys: CertificateKeys) -> Words:
    """Return what stands on every page: what the document is, with its number."""
    if keys.amends and keys.amends.kind == "amendment":
        return Words("Amendment {number}").given(number=keys.number)
    return Words("{title} {number}").given(title=TITLES[keys.kind], number=keys.number)


def make_amendment_notice(keys: CertificateKeys, writer: Writer) -> Iterator[Notice]:
    """Yield what is said of the earlier document: which it is, what is changed, and why."""
    amends = keys.amends
    if amends is None:
        return
    heading = _AMENDS if amends.kind == "amendment" else _REPLACES
    yield Notice(
        writer.say(heading.given(number=amends.number)),
        (
            writer.say(_REASON.given(reason=amends.reason)),
            *(writer.say(_CHANGE.given(change=change)) for change in amends.changes),
        ),
    )


def lay_out_opinions(keys: JobKeys, writer: Writer) -> Section:
    """Return the section of a job's opinions."""
    apart = Notice(writer.say(OPINION), (writer.say(_RESTS),))
    columns = tuple(
        Column(writer.say(heading)) for heading in (Words("Opinion"), Words("Basis"), Words("Stated by"))
    )
    rows = tuple(
        (
            opinion.statement,
            opinion.basis,
            write_person(person) if (person := opinion.by or keys.certificate.authorised_by) else NOTHING,
        )
        for opinion in keys.opinions
    )
    title = writer.say(Words("Opinions and interpretations"))
    return Section("opinions", title, (apart, Table(title, columns, (RowGroup(rows),))))


def write_person(person: Person) -> str:
    """Return a person's name and function."""
    return ", ".join(filter(None, (person.name, person.function)))
