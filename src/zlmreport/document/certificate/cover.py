"""The first page: who, for whom, what, when, the results in brief, and warnings under their headings."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from zlmreport.document.blocks import Block, Facts, Notice, Paragraph, RowGroup, Symbol, Table
from zlmreport.document.certificate import conditions, conformity, measured_lines, statements, uncertainty
from zlmreport.document.certificate.circumstances import Fact, select_stated_facts, write_date, write_days
from zlmreport.document.certificate.conditions import (
    describe_axis,
    list_groups_beside_identification,
    name_machine_kind,
    say_measured_of,
    say_no_influence,
)
from zlmreport.document.certificate.digest import DIGEST
from zlmreport.document.certificate.readings import list_missing_readings
from zlmreport.document.certificate.results import (
    NO_PARAMETER,
    Evaluated,
    list_subscripted,
    make_section_key,
)
from zlmreport.document.certificate.statements import make_amendment_notice, write_person
from zlmreport.document.certificate.values import Values, tell_columns_apart
from zlmreport.evaluation.evaluation import QuantityGroup
from zlmreport.job.document_keys import Location
from zlmreport.language import Words, named, same

if TYPE_CHECKING:
    from zlmreport.document.certificate.document import Certificate
    from zlmreport.document.certificate.material import Material
    from zlmreport.document.writer import Writer
    from zlmreport.evaluation.evaluation import EvaluatedParameter, Evaluation
    from zlmreport.job.job import Job
    from zlmreport.job.keys import JobKeys


@dataclass(frozen=True, slots=True)
class Behind:
    """What of the first page stands behind it, because it has no room."""

    conditions: frozenset[str] = frozenset()  #: Groups of conditions, by their job keys.
    explains_uncertainty: bool = False  #: What U means.
    results: bool = False  #: The results in brief: below all else, and as far as they go.


_IN_SECTION = Words("In section “{title}”: {what}.")
_MEANING_OF_U = Words("what U means, and what it is made of")


def lay_out_cover(
    of: Material, pages: Sequence[tuple[Evaluated, ...]] | None = None, behind: Behind = Behind()
) -> tuple[Block, ...]:
    """Return the blocks under the title.

    Where standards share `pages`, they share their results in brief, and the conditions stand here too, but
    for what stands `behind`.
    """
    if of.is_part:
        return tuple(_lay_out_part(of))
    job, measurements, evaluated, writer = of.job, of.measurements, of.evaluated, of.writer
    evaluations = tuple(each.evaluation for each in evaluated)
    facts = select_stated_facts(list_identity(of, evaluations), writer)
    if pages is None:
        first: tuple[Block, ...] = (Facts(facts),)
    else:
        further = list_groups_beside_identification(job, measurements, of.described, writer)
        first = (
            Facts(facts, writer.say(statements.WORK[job.keys.certificate.kind])),
            *(group for key, group in further if key not in behind.conditions),
            *say_no_influence(job, measurements, writer),
        )
    in_brief = _lay_out_results(pages or [(each,) for each in evaluated], writer, dense=pages is not None)
    of_uncertainty = uncertainty.say_uncertainty(evaluated[0].budget, evaluations, writer)
    return (
        *make_amendment_notice(job.keys.certificate, writer),
        *first,
        *(() if behind.results else (in_brief,)),
        *(each for each in of_uncertainty if isinstance(each, Notice) or not behind.explains_uncertainty),
        *conformity.say_rule(job.keys.decision_rule, evaluations, writer),
        *_say_elsewhere(of, behind),
        *list_unlikely(of.document, writer, evaluations),
        *list_missing_readings(measurements, writer),
        *measured_lines.list_notices(of.tests, writer),
        *_list_shortfalls(evaluations, writer, in_a_line=pages is not None),
        *_say_as_found(job, writer),
        *statements.list_notices(job.keys, writer),
        *statements.lay_out_paragraphs(job, writer, measurements),
        *((in_brief,) if behind.results else ()),
    )


def _say_elsewhere(of: Material, behind: Behind) -> Iterator[Paragraph]:
    """Yield where that stands for which the page has no room."""
    writer = of.writer
    if behind.conditions:
        groups = conditions.list_groups(of.job, of.measurements, of.described, writer)
        headings = ", ".join(group.heading for key, group in groups if key in behind.conditions)
        yield Paragraph(writer.say(_IN_SECTION.given(title=conditions.TITLE, what=headings)))
    if behind.explains_uncertainty:
        yield Paragraph(writer.say(_IN_SECTION.given(title=uncertainty.TITLE, what=_MEANING_OF_U)))


#: Keys of the facts that one of several measurements has of its own.
OF_MEASUREMENT = {"evaluate.standard", "measurement.date", "as_found.measurement.date"}


def _lay_out_part(of: Material) -> Iterator[Block]:
    """Yield what one of several measurements has of its own on the first page of their document."""
    job, measurements, writer = of.job, of.measurements, of.writer
    evaluations = tuple(each.evaluation for each in of.evaluated)
    own = [each for each in list_identity(of, evaluations) if set(each.keys) & OF_MEASUREMENT]
    yield Facts(select_stated_facts(own, writer), writer.say(statements.WORK[job.keys.certificate.kind]))
    for key, group in conditions.list_groups(job, measurements, of.described, writer):
        if key != "machine":
            yield group
    yield from uncertainty.say_uncertainty(of.evaluated[0].budget, evaluations, writer)
    yield from list_unlikely(of.document, writer, evaluations)
    yield from list_missing_readings(measurements, writer)
    yield from measured_lines.list_notices(of.tests, writer)
    yield from _say_as_found(job, writer)
    yield from statements.list_notices(job.keys, writer)


_UNUSUAL = Words("Values that are unusual in the unit in which they are stated")
EVIDENCE = Words("What readings, dates and calibrations show")


def list_unlikely(
    of: Certificate, writer: Writer, evaluations: Sequence[Evaluation] = ()
) -> Iterator[Notice]:
    """Yield what seems to be in another unit, and what readings or calibrations show to be doubtful."""
    for heading, sentences in ((_UNUSUAL, of.doubts), (EVIDENCE, of.evidence)):
        if sentences:
            told = tuple(map(writer.say, sentences))
            yield Notice(writer.say(heading), told, symbols=list_subscripted(evaluations))


def _say_as_found(job: Job, writer: Writer) -> Iterator[Block]:
    """Yield which of two measurements the first page shows, if there are two."""
    if job.keys.as_found:
        from zlmreport.document.certificate.as_found import say_on_cover  # noqa: PLC0415 - of the few that need it

        yield say_on_cover(job.keys.as_found, writer)


def _lay_out_results(
    pages: Sequence[tuple[Evaluated, ...]], writer: Writer, *, dense: bool
) -> Table | Paragraph:
    """Return the results in brief; where no standard gives any, that it is so."""
    pages = [page for page in pages if page[0].evaluation.parameters]
    if not pages:
        return Paragraph(writer.say(NO_PARAMETER))
    values = Values.of((page[0].evaluation for page in pages), writer)
    columns = tuple(values.list_columns())
    groups = tuple(
        RowGroup(
            tuple(
                (
                    Symbol(parameter.quantity.notation),
                    writer.say(parameter.quantity.name),
                    *values.list_cells(parameter),
                )
                for parameter in _choose_in_brief(page[0].evaluation)
            ),
            ", ".join(each.evaluation.designation for each in page),
            section=make_section_key(page[0].evaluation),
        )
        for page in pages
    )
    caption = Words("Results in brief")
    shown = (each.quantity for page in pages for each in _choose_in_brief(page[0].evaluation))
    told, symbols = tell_columns_apart(caption, shown, has_uncertainty=values.has_uncertainty, writer=writer)
    return Table(told, columns, groups, dense, symbols)


def _choose_in_brief(evaluation: Evaluation) -> tuple[EvaluatedParameter, ...]:
    """Return what a customer looks for: what has a limit, else the composite parameters, else all."""
    limited = tuple(parameter for parameter in evaluation.parameters if parameter.limit is not None)
    composite = tuple(
        parameter
        for parameter in evaluation.parameters
        if parameter.quantity.group is QuantityGroup.COMPOSITE
    )
    return limited or composite or evaluation.parameters


def list_shortfalls_of_parts(parts: Mapping[str, Sequence[Evaluation]], writer: Writer) -> Iterator[Notice]:
    """Yield which requirements the measurements of one document do not meet, by what these are called."""
    items = [
        writer.say(_IN_A_PART.given(name=name, designation=each.designation, count=unmet))
        for name, evaluations in parts.items()
        for each in evaluations
        if (unmet := sum(finding.met is False for finding in each.findings))
    ]
    if items:
        yield Notice(writer.say(_NOT_MET), tuple(items))


_IN_A_PART = Words("{name}, {designation}: {count} not met; see its section")
_NOT_MET = Words("Requirements that the test does not meet")


def _list_shortfalls(
    evaluations: tuple[Evaluation, ...], writer: Writer, *, in_a_line: bool
) -> Iterator[Notice]:
    one = Words("{designation}: {count} not met; see its section")
    items = tuple(
        writer.say(one.given(designation=evaluation.designation, count=unmet))
        for evaluation in evaluations
        if (unmet := sum(finding.met is False for finding in evaluation.findings))
    )
    if in_a_line and len(items) > 1:
        found = (each.designation for each in evaluations if any(one.met is False for one in each.findings))
        words = Words("{designations}; see their sections")
        items = (writer.say(words.given(designations=", ".join(found))),)
    if items:
        yield Notice(writer.say(_NOT_MET), items)


def list_identity(of: Material, evaluations: Sequence[Evaluation]) -> Iterator[Fact]:
    """Yield the facts, in the order of the page; `evaluations` are those of the page."""
    job, keys, writer = of.job, of.job.keys, of.writer
    yield from list_facts_of_item(job, writer)
    yield Fact(say_measured_of(job), describe_axis(job, writer), ("axis.name", "axis.kind"))
    yield from list_facts_of_work(keys, evaluations, writer)
    if keys.as_found:
        yield Fact(
            Words("Date of measurement as found"),
            write_days(keys.as_found.measurement, writer),
            ("as_found.measurement.date", "as_found.measurement.end"),
        )
    yield Fact(
        Words("Date of measurement"),
        write_days(keys.measurement, writer),
        ("measurement.date", "measurement.end"),
    )
    yield from list_facts_of_issue(keys, writer)
    if not of.is_part:
        yield Fact(DIGEST, of.document.digest)


def list_facts_of_item(job: Job, writer: Writer) -> Iterator[Fact]:
    """Yield for whom the document is, and on what."""
    machine, customer = job.keys.machine, job.keys.customer
    if customer:
        address = ", ".join(split_address(customer.address))
        yield Fact(
            Words("Customer"),
            ", ".join(filter(None, (customer.name, address))),
            ("customer.name", "customer.address"),
        )
    kind = name_machine_kind(job, writer)
    yield Fact(
        statements.ITEM[job.keys.certificate.kind],
        f"{machine.type} ({kind})" if machine.type else kind,
        ("machine.manufacturer", "machine.model", "machine.kind"),
    )
    yield Fact(Words("Serial number"), machine.serial, ("machine.serial",))


def list_facts_of_work(keys: JobKeys, evaluations: Iterable[Evaluation], writer: Writer) -> Iterator[Fact]:
    """Yield by which standards it was evaluated, where it was measured, and when it came there."""
    designations = dict.fromkeys(each.designation for each in evaluations)
    yield Fact(Words("Evaluated in accordance with"), ", ".join(designations), ("evaluate.standard",))
    place = place_of_work(keys)
    if place:
        yield Fact(Words("Place of the work"), writer.say(place.words), place.keys)
    yield Fact(Words("Received"), write_date(keys.dates.received, writer), ("dates.received",))


def list_facts_of_issue(keys: JobKeys, writer: Writer) -> Iterator[Fact]:
    """Yield when the document was issued and by whom, and when the next one is due."""
    person = keys.certificate.authorised_by
    yield Fact(Words("Date of issue"), write_date(keys.certificate.issued, writer))
    if keys.next_due:
        yield Fact(statements.NEXT_DUE[keys.certificate.kind], writer.date(keys.next_due.date))
    if person:
        yield Fact(Words("Authorised by"), write_person(person))


def split_address(address: str | None) -> tuple[str, ...]:
    """Part an address into lines, at its commas or line breaks."""
    if not address:
        return ()
    return tuple(
        part for piece in address.split("\n") for part in (part.strip() for part in piece.split(",")) if part
    )


@dataclass(frozen=True, slots=True)
class PlaceOfWork:
    """A place of work."""

    kind: str  #: ``laboratory``, ``customer``, ``laboratory branch``, ``customer branch`` or ``other``.
    address: str  #: In one line or several; empty where the job states none.
    words: Words  #: What the page says: whose place it is, and its address.
    keys: tuple[str, ...]  #: The job keys that state it.


_KINDS = {
    "laboratory": Words("in the laboratory"),
    "customer": Words("at the customer's"),
    "laboratory branch": Words("at a branch of the laboratory"),
    "customer branch": Words("at a branch of the customer"),
}
_WHERE_IT_STANDS = Words("where the machine stands: {location}")


def place_of_work(keys: JobKeys) -> PlaceOfWork | None:
    """Return where the work was done: the place that is stated, or where the machine is said to stand."""
    match keys.location:
        case Location(kind=kind, address=stated):
            party = keys.laboratory if kind == "laboratory" else keys.customer
            address = stated or (party and party.address) or ""
            words, line = _KINDS.get(kind), _write_in_a_line(address)
            if words is None:
                words = same(line)
            elif address:
                words = named(words, line)
            return PlaceOfWork(kind, address, words, ("location",))
        case str(location):
            return PlaceOfWork("other", location, same(_write_in_a_line(location)), ("location",))
    if keys.machine.location:
        words = _WHERE_IT_STANDS.given(location=keys.machine.location)
        return PlaceOfWork("other", keys.machine.location, words, ("machine.location",))
    return None


def _write_in_a_line(address: str) -> str:
    return ", ".join(line.strip().removesuffix(",") for line in address.splitlines() if line.strip())
