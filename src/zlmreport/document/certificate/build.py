"""Builds the document of a job: its layout, its sections in order, title, letterhead, who made it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from zlmreport.document.certificate.attachments import list_sources
from zlmreport.document.certificate.conditions import Described
from zlmreport.document.certificate.cover import split_address
from zlmreport.document.certificate.digest import digest_of
from zlmreport.document.certificate.document import Certificate, Letterhead, Look, PageWords, Party
from zlmreport.document.certificate.material import LaidOut, Material, lay_out_in_full
from zlmreport.document.certificate.measured_lines import say_of_each
from zlmreport.document.certificate.own_words import arrange_sections, fill_in
from zlmreport.document.certificate.statements import (
    name_subject_of,
    write_document_title,
    write_running_title,
)
from zlmreport.document.writer import Marks, Writer
from zlmreport.evaluation import traceability
from zlmreport.evaluation.disagreements import find_contradicting_limits, find_disagreements
from zlmreport.evaluation.evidence import find_as_left_once_more, find_evidence, find_lines_read_twice
from zlmreport.language import Words
from zlmreport.version import __version__

if TYPE_CHECKING:
    from zlmreport.document.certificate.document import Linked
    from zlmreport.document.certificate.own_look import Logo
    from zlmreport.document.certificate.results import Evaluated, Tested
    from zlmreport.document.figures.figure import Figure
    from zlmreport.document.subjects.annex import Modelled
    from zlmreport.job.document_keys import Laboratory
    from zlmreport.job.job import Job
    from zlmreport.measurement.measurement_set import MeasurementSet

GENERATOR = f"zlmreport {__version__}"

_DESCRIPTION = Words("{subject}, evaluated in accordance with {standards}")


def build(  # noqa: PLR0913, PLR0917 - what a document is made of
    job: Job,
    evaluated: tuple[Evaluated, ...],
    plugins: Mapping[str, str],
    doubtful: tuple[Words, ...] = (),
    interpretation: Modelled | None = None,
    as_found: tuple[Evaluated, ...] = (),
    describe: Callable[[Writer], Sequence[Described]] = lambda _: (),
    generator: str = GENERATOR,
    tests: tuple[Tested, ...] = (),
    *,
    is_part: bool = False,
    is_laid_out: bool = True,
) -> Certificate:
    """Build the document.

    `evaluated`: At least one evaluation; all are of the same measurements.
    `doubtful`: Sentences on values that seem to be in another unit.
    `interpretation`: By an error model; None where the job names none.
    `as_found`: Evaluations of the axis before it was adjusted, by the same standards; empty where it was not.
    `tests`: Of several measured lines that are evaluated together, each by itself; empty of most documents.
    `is_part`: Whether it is one of several that make one document: what all share stands there.
    `is_laid_out`: Whether it has pages; its data alone otherwise, which need no figures of the evaluations.
    """
    certificate = job.keys.certificate
    measurements = evaluated[0].evaluation.measurements
    writer = Writer.of(measurements, certificate.language, Marks.of(job.keys))
    designations = tuple(each.evaluation.designation for each in evaluated)
    laboratory = job.keys.laboratory
    logo, style = None, certificate.style
    look = Look(style.accent, style.logo)
    if laboratory and laboratory.logo:
        from zlmreport.document.certificate.own_look import read_logo  # noqa: PLC0415 - brings the typeface

        logo = read_logo(laboratory.logo, job.place_of("laboratory.logo"))
    if style.typeface or style.templates:
        from zlmreport.document.certificate.own_look import read_own_look  # noqa: PLC0415 - likewise

        look = read_own_look(look, job)
    sessions = interpretation.sessions if interpretation else ()
    read = (measurements, *(each.evaluation.measurements for each in as_found[:1]), *sessions)
    files = [file for each in read for file in each.provenance.files]
    made_from = list_sources(job, files, logo.file if logo else None)
    lines = [(each.name, each.job, each.measurements) for each in tests] or [("", job, measurements)]
    of_lines = [(name, _collect_shown(line, of_line)) for name, line, of_line in lines]
    said = tuple(say_of_each(of_lines))
    shown = (
        *said,
        *(_collect_shown_together(job, measurements, said) if tests else ()),
        *traceability.find_other_capability(job),
        *(words for each in evaluated for words in find_contradicting_limits(each.evaluation)),
    )
    if as_found:
        of_all = [one for _, of_line in of_lines for one in of_line]
        shown += tuple(_collect_shown_as_found(job, measurements, as_found, of_all))
    letterhead, title = (
        make_letterhead(laboratory, logo),
        writer.say(write_document_title(certificate)),
    )
    results = tuple(each.evaluation for each in evaluated)
    results_as_found = tuple(each.evaluation for each in as_found)
    digest = digest_of(certificate.number, (*results, *results_as_found))
    laid_out, linked = LaidOut((), ()), None
    if is_laid_out:
        material = Material(
            job,
            evaluated,
            as_found,
            doubtful,
            shown,
            interpretation,
            describe(writer),
            made_from,
            generator,
            plugins,
            letterhead,
            title,
            digest,
            writer,
            tests,
            is_part,
        )
        laid_out = _lay_out(material if certificate.readings_on_graphs else _drop_readings(material))
        linked = _link_readings(job, interpretation, writer) if interpretation else None
    sections = laid_out.sections
    if certificate.sections is not None:
        sections = arrange_sections(sections, certificate.sections, job)
    return Certificate(
        number=certificate.number,
        title=title,
        subtitle=writer.say(name_subject_of(job)),
        language=certificate.language,
        issued=certificate.issued,
        paper=certificate.paper,
        letterhead=letterhead,
        cover=laid_out.cover,
        sections=sections,
        page_words=PageWords.in_language(
            certificate.language,
            writer.say(write_running_title(certificate)),
            head=fill_in(style.header, job, "certificate.style.header") if style.header else "",
            foot=fill_in(style.footer, job, "certificate.style.footer") if style.footer else "",
        ),
        description=writer.say(
            _DESCRIPTION.given(subject=name_subject_of(job), standards=", ".join(designations))
        ),
        measurements=measurements,
        evaluations=results,
        evaluations_as_found=results_as_found,
        digest=digest,
        budget_as_found=as_found[0].budget if as_found else None,
        generator=generator,
        keywords=designations,
        plugins=plugins,
        diagnosis=interpretation.diagnosis if interpretation else None,
        linked=linked if linked and linked.section in {each.key for each in sections} else None,
        budget=evaluated[0].budget,
        job=job,
        sources=made_from,
        is_compact=laid_out.is_compact,
        head=laid_out.head,
        look=look,
        doubts=doubtful,
        evidence=shown,
        tests=tests,
    )


def _collect_shown(job: Job, measurements: MeasurementSet) -> tuple[Words, ...]:
    """Return what readings, days and calibrations of a measurement show that its job does not say."""
    return (
        *find_evidence(job, measurements),
        *find_disagreements(job, measurements),
        *traceability.find_doubts(job, measurements),
    )


def _collect_shown_together(
    job: Job, measurements: MeasurementSet, said: Collection[Words]
) -> Iterator[Words]:
    """Yield the same of several lines together, but for what is said of one of them."""
    yield from (each for each in traceability.find_doubts_of_artefacts(job) if each not in said)
    yield from find_lines_read_twice(measurements.tests)


def _collect_shown_as_found(
    job: Job, measurements: MeasurementSet, as_found: Sequence[Evaluated], said: Sequence[Words]
) -> Iterator[Words]:
    """Yield the same of the measurement before an adjustment, but for what is said of the one after it."""
    before = job.as_found
    if before is None or job.keys.as_found is None:
        return
    from zlmreport.document.certificate.as_found import NAMES  # noqa: PLC0415 - of the few that need it

    earlier = as_found[0].evaluation.measurements
    found = (*_collect_shown(before, earlier), *find_as_left_once_more(earlier, measurements))
    name = NAMES[job.keys.as_found.work][0]
    yield from say_of_each([(name, [each for each in found if each not in said])])


def _lay_out(material: Material) -> LaidOut:
    """Return the parts of the document in the layout that the job asks for."""
    match material.job.keys.certificate.layout:
        case "sheet":
            from zlmreport.document.certificate.sheet_layout import lay_out  # noqa: PLC0415 - of those that ask for it
        case "standard":
            from zlmreport.document.certificate.standard_layout import lay_out  # noqa: PLC0415
        case _:
            lay_out = lay_out_in_full
    return lay_out(material)


def _link_readings(job: Job, interpretation: Modelled, writer: Writer) -> Linked | None:
    """Return the readings beside the model, one by one; nothing where single readings are not to be shown."""
    keys = job.keys
    is_shown = keys.certificate.readings_on_graphs and keys.certificate.layout != "sheet"
    if keys.agreement.simplified or not is_shown:
        return None
    return interpretation.list_linked(writer)


def _drop_readings(material: Material) -> Material:
    """Return what a document is made of, with figures that lack the single readings behind their curves."""

    def bare(figure: Figure) -> Figure:
        return replace(figure, panels=tuple(replace(panel, readings=()) for panel in figure.panels))

    def drop(evaluated: tuple[Evaluated, ...]) -> tuple[Evaluated, ...]:
        return tuple(replace(each, figures=tuple(map(bare, each.figures))) for each in evaluated)

    return replace(
        material,
        evaluated=drop(material.evaluated),
        as_found=drop(material.as_found),
        tests=tuple(replace(each, evaluated=drop(each.evaluated)) for each in material.tests),
    )


def make_letterhead(laboratory: Laboratory | None, logo: Logo | None) -> Letterhead | None:
    """Return the letterhead of a laboratory, with its logo if it has one."""
    if laboratory is None:
        return None
    return Letterhead(
        Party(laboratory.name, split_address(laboratory.address)),
        laboratory.accreditation or "",
        logo.file.content if logo else None,
        logo.media_type if logo else "",
    )
