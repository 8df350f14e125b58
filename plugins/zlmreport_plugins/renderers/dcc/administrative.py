"""The administrative data of a DCC: who, for whom, what, when; and every statement of the document.

The statements stand in the same words as on the pages. Values of the results stand as quantities with all
their digits, and not in the rounded tables of the pages.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from xml.etree import ElementTree as ET

from zlmreport.plugin import CONDITION_NAMES, InputError, Language, PartRow, Problem, Words, named
from zlmreport.plugin.extension import Job
from zlmreport.plugin.renderer import (
    DIGEST,
    Block,
    Cell,
    Certificate,
    Customer,
    Explained,
    Facts,
    Formulas,
    Laboratory,
    Notice,
    Paragraph,
    RowGroup,
    Symbol,
    Table,
    Verdict,
    address_lines,
    notation_spans,
    place_of_work,
    traceable_through,
)
from zlmreport_plugins.renderers.dcc.elements import (
    DEGREE_CELSIUS,
    HECTOPASCAL,
    MICROMETRE_PER_METRE_KELVIN,
    PERCENT,
    dcc,
    group,
    make_quantity,
    make_real,
)

#: The DCC's words for whose place it is.
_PLACES = {
    "laboratory": "laboratory",
    "customer": "customer",
    "laboratory branch": "laboratoryBranch",
    "customer branch": "customerBranch",
}
_AXIS = Words("Axis {axis}")
_AXIS_OF = Words("Axis {axis} of {machine}")
_SERIAL = Words("Serial number")


@dataclass(frozen=True, slots=True)
class AdministrativeWriter:
    """Writes texts in the language of one certificate."""

    language: Language  #: Of the certificate, the only one of its DCC.

    def make_content(self, words: Words | str) -> ET.Element:
        """Return a text as content: a phrase with its language, a user's own words as they stand."""
        if isinstance(words, str):
            return dcc("content", words)
        return dcc("content", words.in_language(self.language), lang=self.language.value)

    def make_named(self, element: str, words: Words | str) -> ET.Element:
        """Return an element that holds a text."""
        return dcc(element, self.make_content(words))


def make_software(certificate: Certificate, writer: AdministrativeWriter) -> ET.Element:
    """Return the program; its release with the letter that PTB's rules ask for."""
    name, _, release = certificate.generator.partition(" ")
    return dcc("software", writer.make_named("name", name), dcc("release", f"v{release or '0'}"))


def _make_serial_number(value: str, writer: AdministrativeWriter) -> ET.Element:
    """Return the identification by which a manufacturer tells one piece from another."""
    return dcc(
        "identification",
        dcc("issuer", "manufacturer"),
        dcc("value", value),
        writer.make_named("name", _SERIAL),
        refType="basic_serialNumber",
    )


def make_administrative_data(certificate: Certificate, job: Job) -> ET.Element:
    """Return the administrative data.

    Raises `InputError` with everything that a DCC must state and the job does not.
    """
    missing = list(_find_missing(job))
    if missing:
        raise InputError(missing)
    writer = AdministrativeWriter(certificate.language)
    keys = job.keys
    assert keys.laboratory is not None  # noqa: S101 - what is missing was refused above
    assert keys.customer is not None  # noqa: S101 - likewise
    return dcc(
        "administrativeData",
        dcc("dccSoftware", make_software(certificate, writer)),
        _make_core_data(certificate, job),
        dcc("items", _make_item(job, writer)),
        dcc(
            "calibrationLaboratory",
            _make_contact("contact", keys.laboratory, writer, keys.laboratory.country),
        ),
        _make_persons(job, writer),
        _make_contact("customer", keys.customer, writer),
        dcc("statements", *_make_statements(certificate)),
    )


def _find_missing(job: Job) -> Iterator[Problem]:
    """Yield what a DCC must state and the job leaves out."""
    keys = job.keys
    stated = {
        "laboratory.name": keys.laboratory is not None,
        "laboratory.country": keys.laboratory is not None and keys.laboratory.country,
        "customer.name": keys.customer is not None,
        "machine.serial": keys.machine.serial,
        "measurement.date": keys.measurement.date,
        "certificate.authorised_by": keys.certificate.authorised_by,
    }
    for key, value in stated.items():
        if not value:
            yield Problem(
                job.place_of(key), f"a digital calibration certificate (format dcc) must state {key}: add it"
            )


def _make_core_data(certificate: Certificate, job: Job) -> ET.Element:
    keys = job.keys
    taken = (keys.measurement, *([keys.as_found.measurement] if keys.as_found else []))
    days = [day for each in taken for day in (each.date, each.end) if day]
    assert keys.laboratory is not None  # noqa: S101 - what is missing was refused before
    place = place_of_work(keys)
    received, issued = keys.dates.received, certificate.issued
    language = certificate.language.value
    amended = keys.certificate.amends
    return dcc(
        "coreData",
        dcc("countryCodeISO3166_1", keys.laboratory.country),
        dcc("usedLangCodeISO639_1", language),
        dcc("mandatoryLangCodeISO639_1", language),
        dcc("uniqueIdentifier", certificate.number),
        _make_digest(certificate),
        dcc("receiptDate", received.isoformat()) if received else None,
        dcc("beginPerformanceDate", min(days).isoformat()),
        dcc("endPerformanceDate", max(days).isoformat()),
        dcc("performanceLocation", _PLACES.get(place.kind, "other") if place else "other"),
        dcc("issueDate", issued.isoformat()) if issued else None,
        dcc(
            "reportAmendedSubstituted",
            dcc("typeOfChange", "amended" if amended.kind == "amendment" else "substituted"),
            dcc("replacedUniqueIdentifier", amended.number),
        )
        if amended
        else None,
    )


def _make_digest(certificate: Certificate) -> ET.Element | None:
    """Return the digest of readings and results, by which paper and file are held together."""
    return group(
        "identifications",
        dcc(
            "identification",
            dcc("issuer", "calibrationLaboratory"),
            dcc("value", certificate.digest),
            AdministrativeWriter(certificate.language).make_named("name", DIGEST),
        ),
    )


def _make_item(job: Job, writer: AdministrativeWriter) -> ET.Element:
    machine = job.keys.machine
    of = {"axis": job.axis.name, "machine": machine.type}
    name = (_AXIS_OF if machine.type else _AXIS).given(**of)
    return dcc(
        "item",
        writer.make_named("name", name),
        dcc("manufacturer", writer.make_named("name", machine.manufacturer))
        if machine.manufacturer
        else None,
        dcc("model", machine.model) if machine.model else None,
        dcc(
            "identifications",
            _make_serial_number(machine.serial or "", writer),
            dcc(
                "identification",
                dcc("issuer", "other"),
                dcc("value", job.axis.name),
                writer.make_named("name", Words("Axis")),
            ),
        ),
    )


def _make_contact(
    element: str, party: Laboratory | Customer, writer: AdministrativeWriter, country: str | None = None
) -> ET.Element:
    """Return a party with its address line by line: the job does not tell a street from a town."""
    lines = [dcc("further", writer.make_content(line)) for line in address_lines(party.address) or ("–",)]
    location = dcc("location", dcc("countryCode", country) if country else None, *lines)
    return dcc(element, writer.make_named("name", party.name), location)


def _make_persons(job: Job, writer: AdministrativeWriter) -> ET.Element | None:
    person = job.keys.certificate.authorised_by
    if person is None:
        return None
    return group(
        "respPersons",
        dcc(
            "respPerson",
            dcc("person", writer.make_named("name", person.name)),
            dcc("role", person.function) if person.function else None,
            dcc("mainSigner", "true"),
        ),
    )


#: Conditions that a job may state: their units, and the DCC's word for their kind.
_CONDITIONS = {
    "air_temperature": (DEGREE_CELSIUS, "basic_temperature"),
    "material_temperature": (DEGREE_CELSIUS, "basic_temperature"),
    "axis_temperature": (DEGREE_CELSIUS, "basic_temperature"),
    "air_pressure": (HECTOPASCAL, ""),
    "relative_humidity": (PERCENT, "basic_humidityRelative"),
    "expansion_coefficient": (MICROMETRE_PER_METRE_KELVIN, ""),
}
_NAMES = {**CONDITION_NAMES, "expansion_coefficient": Words("Expansion coefficient of the machine")}
_STATES = {"before": Words("as found"), "after": Words("as left")}
_BY_CUSTOMER = Words("Provided by the customer")
_REMARKS = Words("Remarks on the environment")
_CALIBRATION = Words("Calibration certificate: {number}")


def make_equipment(job: Job, writer: AdministrativeWriter) -> ET.Element | None:
    """Return the measuring instrument with its calibration certificate; None where none is stated."""
    instrument = job.keys.instrument
    if instrument is None:
        return None
    number = instrument.certificate
    return dcc(
        "measuringEquipment",
        writer.make_named("name", instrument.name),
        dcc("description", writer.make_content(_CALIBRATION.given(number=number))) if number else None,
        dcc("manufacturer", writer.make_named("name", instrument.manufacturer))
        if instrument.manufacturer
        else None,
        dcc("identifications", _make_serial_number(instrument.serial, writer)) if instrument.serial else None,
    )


def make_state(when: str, work: str | None, writer: AdministrativeWriter) -> ET.Element | None:
    """Return whether the axis was measured before or after an adjustment or repair; None without one.

    `when`: ``before`` or ``after``.
    `work`: ``adjustment`` or ``repair``.
    """
    if work is None:
        return None
    return dcc(
        "influenceCondition",
        writer.make_named("name", Words("State of the axis")),
        dcc("status", f"{when}{work.capitalize()}"),
        dcc("data", dcc("text", writer.make_content(_STATES[when]))),
    )


def make_influences(job: Job, writer: AdministrativeWriter) -> Iterator[ET.Element]:
    """Yield the conditions that the job states."""
    environment = job.keys.environment
    if environment is None:
        return
    for key, (unit, kind) in _CONDITIONS.items():
        name, value = _NAMES[key], getattr(environment, key)
        if value is None:
            continue
        stated = (
            dcc("text", writer.make_content(value))
            if isinstance(value, str)
            else make_quantity(writer.make_named("name", name), make_real(value, unit))
        )
        whose = {"environment", f"environment.{key}"} & set(job.keys.provided_by_customer)
        yield _make_condition(name, stated, writer, kind, _BY_CUSTOMER if whose else None)
    for name, text in ((Words("Sensor locations"), environment.sensors), (_REMARKS, environment.remarks)):
        if text:
            yield _make_condition(name, dcc("text", writer.make_content(text)), writer)


def _make_condition(
    name: Words, stated: ET.Element, writer: AdministrativeWriter, kind: str = "", remark: Words | None = None
) -> ET.Element:
    return dcc(
        "influenceCondition",
        writer.make_named("name", name),
        writer.make_named("description", remark) if remark else None,
        dcc("data", stated),
        **({"refType": kind} if kind else {}),
    )


def _make_statements(certificate: Certificate) -> Iterator[ET.Element]:
    """Yield the statements, in the order of the pages and each once."""
    language = certificate.language
    of = certificate.parts.values() or [certificate]
    measured = (each.measurements for each in of)
    traceable = traceable_through(certificate.job, *measured) if certificate.job else None
    traceability = traceable and traceable.in_language(language)

    def content(text: str) -> ET.Element:
        return dcc("content", text, lang=language.value)

    def statement(name: str, text: str = "", items: tuple[str, ...] = ()) -> ET.Element:
        return dcc(
            "statement",
            dcc("name", content(name)) if name else None,
            dcc("traceable", "true") if text == traceability else None,
            dcc("declaration", content(text)) if text else None,
            dcc("data", *(dcc("text", content(each)) for each in items)) if items else None,
        )

    yield statement(certificate.title, certificate.subtitle)
    letterhead = certificate.letterhead
    if letterhead and letterhead.accreditation:
        yield statement(letterhead.laboratory.name, letterhead.accreditation)
    said: set[tuple[str, tuple[str, ...]]] = {("", ())}
    for title, blocks in _list_parts(certificate):
        for name, text, items in (each for block in blocks for each in _list_said(block, title, language)):
            if (text, items) not in said:
                said.add((text, items))
                yield statement(name, text, items)


def _list_parts(certificate: Certificate) -> Iterator[tuple[str, tuple[Block, ...]]]:
    """Yield the title and the blocks of each part, without the tables of results."""
    yield "", tuple(each for each in certificate.cover if not isinstance(each, Table))
    for section in certificate.sections:
        of_results = any(isinstance(each, Table) and _is_by_position(each) for each in section.blocks)
        blocks = section.blocks
        yield (
            section.title,
            tuple(each for each in blocks if not isinstance(each, Table)) if of_results else blocks,
        )


def _is_by_position(table: Table) -> bool:
    """Whether a table counts positions: its first column is headed by the symbol of their number."""
    return isinstance(table.columns[0].heading, Symbol)


def _list_said(block: Block, title: str, language: Language) -> Iterator[tuple[str, str, tuple[str, ...]]]:
    """Yield what a block says: name, text, items; a graph says nothing that a table does not."""
    match block:
        case Paragraph(text, verdict=verdict):
            yield title, named(verdict.word, text).in_language(language) if verdict else text, ()
        case Notice(heading, items):
            yield title, heading, items
        case Facts(pairs, heading):
            yield heading or title, "", tuple(named(*pair).in_language(language) for pair in pairs)
        case Formulas(caption, rows):
            yield (
                title,
                caption,
                tuple(f"{_write_cell(left)} = {_write_cell(right)} ({name})" for left, right, name in rows),
            )
        case Table(caption, columns, groups):
            headings = tuple(
                " ".join(filter(None, (_write_cell(each.heading), each.unit))) for each in columns
            )
            lines = (row for group in groups for row in _list_rows(group, headings, language))
            yield title, caption, tuple(lines)


def _list_rows(group: RowGroup, headings: tuple[str, ...], language: Language) -> Iterator[str]:
    before = named(group.heading, "").in_language(language) if group.heading else ""
    if group.note:
        yield before + group.note
    for row in group.rows:
        cells = ((heading, _write_cell(cell)) for heading, cell in zip(headings, row, strict=True))
        said = PartRow(tuple(named(heading, cell) for heading, cell in cells if cell))
        yield before + said.in_language(language)


def _write_cell(cell: Cell) -> str:
    match cell:
        case Symbol(notation):
            return "".join(span.text for span in notation_spans(notation))
        case Verdict(_, word):
            return word
        case Explained(name, meaning):
            return f"{name} ({meaning})" if meaning else name
        case str():
            return cell
