"""One document of several measurements: a summary on the first page, and what was made of each behind it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from zlmreport.document.blocks import Block, Facts, Graph, Notice, RowGroup, Section, Symbol, Table
from zlmreport.document.certificate import columns, conformity, cover, origin, statements, uncertainty
from zlmreport.document.certificate.attachments import SourceRole, list_sources
from zlmreport.document.certificate.build import (
    describe_document,
    find_look,
    make_writer,
    write_page_words,
)
from zlmreport.document.certificate.circumstances import Fact, select_stated_facts, write_period
from zlmreport.document.certificate.digest import DIGEST, digest_of
from zlmreport.document.certificate.document import Certificate
from zlmreport.document.certificate.measured_lines import say_of_each
from zlmreport.document.certificate.own_words import arrange_sections
from zlmreport.document.certificate.readings import list_missing_readings
from zlmreport.document.certificate.standard_layout import fit_on_a_page
from zlmreport.document.certificate.statements import write_document_title
from zlmreport.document.certificate.values import Values
from zlmreport.document.writer import Writer
from zlmreport.evaluation.evidence import find_lines_read_twice
from zlmreport.evaluation.uncertainty.budget import join_budgets
from zlmreport.language import Words, named

if TYPE_CHECKING:
    from zlmreport.document.certificate.build import Programs
    from zlmreport.evaluation.evaluation import EvaluatedParameter, Evaluation
    from zlmreport.job.job import Job

_SUBJECT = Words("{count} measurements of {machine}")
_SUBJECT_OF_ONE = Words("One measurement of {machine}")
_SUMMARY = Words(
    "Summary: what has a limit, or else the first parameter of each measurement by each standard"
)
_GROUP = Words("{subject}, {designation}")


def collect_certificates(
    job: Job, parts: Mapping[str, Certificate], made_by: Programs, *, is_laid_out: bool
) -> Certificate:
    """Return one document of the certificates of several measurements, by what they are called.

    `is_laid_out`: Whether it and its parts have pages; their data alone otherwise.
    """
    certificate = job.keys.certificate
    generator, plugins = made_by
    first = next(iter(parts.values()))
    writer = make_writer(job, first.measurements)
    evaluations = tuple(each for part in parts.values() for each in part.evaluations)
    as_found = tuple(each for part in parts.values() for each in part.evaluations_as_found)
    files = [each for part in parts.values() for each in part.sources]
    logo = next((each.file for each in files if each.role is SourceRole.LOGO), None)
    machine = job.keys.machine.type or writer.say(Words("a machine"))
    subject = writer.say(
        (_SUBJECT if len(parts) > 1 else _SUBJECT_OF_ONE).given(count=len(parts), machine=machine)
    )
    designations = tuple(dict.fromkeys(each.designation for each in evaluations))
    document = replace(
        first,
        title=writer.say(write_document_title(certificate)),
        subtitle=subject,
        page_words=write_page_words(job, writer),
        description=describe_document(subject, designations, writer),
        evaluations=evaluations,
        evaluations_as_found=as_found,
        digest=digest_of(certificate.number, (*evaluations, *as_found)),
        budget=join_budgets({name: part.budget for name, part in parts.items() if part.budget}),
        budget_as_found=None,
        keywords=designations,
        generator=generator,
        plugins=plugins,
        diagnosis=None,
        linked=None,
        job=job,
        sources=list_sources(job, [each.file for each in files if each.role is SourceRole.READINGS], logo),
        look=find_look(job),
        doubts=tuple(say_of_each((name, part.doubts) for name, part in parts.items())),
        evidence=(
            *_find_read_twice(parts),
            *say_of_each((name, part.evidence) for name, part in parts.items()),
        ),
        tests=(),
        parts=dict(parts),
    )
    return _lay_out(document, job, writer) if is_laid_out else document


def _lay_out(document: Certificate, job: Job, writer: Writer) -> Certificate:
    """Return a document with its pages: those of its parts behind a first one of its own."""
    keys, certificate, parts = job.keys, job.keys.certificate, document.parts
    sections = [each for name, part in parts.items() for each in _lay_out_sections(name, part, writer)]
    if certificate.layout != "sheet":  # no sheet has it
        sections.append(origin.lay_out_origin_of_several(document, writer))
    if keys.opinions:
        sections.append(statements.lay_out_opinions(keys, writer))
    if certificate.sections is not None:
        sections = [*arrange_sections(sections, certificate.sections, job)]
    return replace(document, cover=tuple(_cover(document, job, writer)), sections=tuple(sections))


def _find_read_twice(parts: Mapping[str, Certificate]) -> Iterator[Words]:
    """Yield which parts have the same readings, but for those of one error of one axis."""
    readings = {name: each.measurements for name, each in parts.items()}
    last = {(each.axis.name, each.axis.error): name for name, each in readings.items()}
    yield from find_lines_read_twice({name: readings[name] for name in last.values()})


def _cover(document: Certificate, job: Job, writer: Writer) -> Iterator[Block]:
    """Yield the first page: who, what, when, and each measurement in a line."""
    keys, parts, evaluations, budget = job.keys, document.parts, document.evaluations, document.budget
    yield from statements.make_amendment_notice(keys.certificate, writer)
    facts = select_stated_facts(_list_identity(job, evaluations, document.digest, writer), writer)
    yield Facts(facts, writer.say(statements.WORK[keys.certificate.kind]))
    yield _lay_out_summary(parts, writer)
    if budget and budget.is_complete:
        yield from uncertainty.say_uncertainty(budget, (), writer)  # the summary has no interval of the axis
    yield from conformity.say_rule(keys.decision_rule, evaluations, writer)
    read_twice = tuple(map(writer.say, _find_read_twice(parts)))
    if read_twice:
        yield Notice(writer.say(cover.EVIDENCE), read_twice)
    yield from _gather_said_by_parts(parts, writer)
    yield from cover.list_shortfalls_of_parts(
        {name: part.evaluations for name, part in parts.items()}, writer
    )
    measured = (part.measurements for part in parts.values())
    yield from statements.lay_out_paragraphs(job, writer, *measured)


def _lay_out_summary(parts: Mapping[str, Certificate], writer: Writer) -> Table:
    """Return each measurement with what has a limit, or else its first parameter by each standard."""
    evaluations = [each for part in parts.values() for each in part.evaluations]
    values = replace(Values.of(evaluations, writer), is_mixed=True)
    groups = []
    for name, part in parts.items():
        for evaluation in part.evaluations:
            own = replace(values, writer=Writer.of(evaluation.measurements, writer.language, writer.marks))
            rows = tuple(
                (Symbol(each.quantity.notation), writer.say(each.quantity.name), *own.list_cells(each))
                for each in _choose_in_brief(evaluation)
            )
            heading = _GROUP.given(subject=part.subtitle, designation=evaluation.designation)
            groups.append(RowGroup(rows, writer.say(heading), section=_name_key_of_first(name, part)))
    return Table(
        writer.say(_SUMMARY),
        tuple(values.list_columns()),
        tuple(each for each in groups if each.rows),
        dense=True,
    )


def _choose_in_brief(evaluation: Evaluation) -> tuple[EvaluatedParameter, ...]:
    return (
        tuple(each for each in evaluation.parameters if each.limit is not None) or evaluation.parameters[:1]
    )


def _name_key_of_first(name: str, part: Certificate) -> str:
    return f"{name}-{part.sections[0].key}" if part.sections else ""


def _list_identity(
    job: Job, evaluations: Sequence[Evaluation], digest: str, writer: Writer
) -> Iterator[Fact]:
    """Yield who the document is for, on what, and when each part was measured."""
    yield from cover.list_facts_of_item(job, writer)
    yield from cover.list_facts_of_work(job.keys, evaluations, writer)
    yield Fact(Words("Dates of measurement"), _write_days(job, writer))
    yield from cover.list_facts_of_issue(job.keys, writer)
    yield Fact(DIGEST, digest)


def _write_days(job: Job, writer: Writer) -> str | None:
    """Write the first and the last day on which anything was measured."""
    stated = [
        day
        for part in job.parts
        for line in part.lines.values()
        for day in (line.keys.measurement.date, line.keys.measurement.end)
        if day
    ]
    if not stated:
        return None
    return write_period(min(stated), max(stated), writer)


def _gather_said_by_parts(parts: Mapping[str, Certificate], writer: Writer) -> Iterator[Block]:
    """Yield what nobody may overlook of any part, once, with the names of the parts that say it."""
    found: dict[Notice, list[str]] = {}
    for name, part in parts.items():
        for block in part.cover or _lay_out_on_sheet(part, writer):
            if isinstance(block, Notice):
                found.setdefault(block, []).append(name)
    for block, names in found.items():
        heading = writer.say(named(", ".join(names), block.heading))
        yield Notice(heading, block.items, symbols=block.symbols)


def _lay_out_on_sheet(part: Certificate, writer: Writer) -> Iterator[Block]:
    """Yield what the first page says of a part that has none of its own, but for what it does not meet."""
    own = Writer.of(part.measurements, writer.language, writer.marks)
    if part.budget:
        yield from uncertainty.say_uncertainty(part.budget, part.evaluations, writer)
    yield from cover.list_unlikely(part, own)
    yield from list_missing_readings(part.measurements, own)
    if part.job:
        yield from statements.list_notices(part.job.keys, own)


def _lay_out_sections(name: str, part: Certificate, writer: Writer) -> Iterator[Section]:
    """Yield the sections of a part, each with its name; the first begins a page."""
    first, *others = (each for each in part.sections if each.key != "origin")
    first = replace(first, blocks=(*_drop_said_in(first, part.cover), *first.blocks))
    if part.is_compact:
        first = fit_on_a_page(first, columns.PAGES[part.paper])
    for number, section in enumerate((first, *others)):
        yield replace(
            section,
            key=f"{name}-{section.key}",
            title=writer.say(named(name, section.title)) if number else part.subtitle,
            blocks=tuple(_name_block(block, name) for block in section.blocks),
            new_page=section.new_page or not number,
        )


def _drop_said_in(section: Section, blocks: Iterable[Block]) -> Iterator[Block]:
    """Yield blocks without the facts that the section below them states again."""
    said = {pair for block in section.blocks if isinstance(block, Facts) for pair in block.pairs}
    for block in blocks:
        if not isinstance(block, Facts):
            yield block
        elif pairs := tuple(pair for pair in block.pairs if pair not in said):
            yield replace(block, pairs=pairs)


def _name_block(block: Block, name: str) -> Block:
    """Return a block whose graph, and whose links to sections, are told from those of other parts."""
    match block:
        case Graph(figure):
            return Graph(replace(figure, key=f"{name}-{figure.key}"))
        case Table():
            groups = tuple(
                replace(each, section=f"{name}-{each.section}") if each.section else each
                for each in block.groups
            )
            return replace(block, groups=groups)
        case _:
            return block
