"""Builds the document of a job (title, letterhead, what is doubtful), and lays out its pages."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, TypeAlias

from zlmreport.document.certificate.attachments import list_sources
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
from zlmreport.errors import InputError
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
#: This program, and each plugin by its identifier, with their releases.
Programs: TypeAlias = tuple[str, Mapping[str, str]]

_DESCRIPTION = Words("{subject}, evaluated in accordance with {standards}")


def build(  # noqa: PLR0913, PLR0917 - what a document is made of
    job: Job,
    evaluated: tuple[Evaluated, ...],
    made_by: Programs,
    doubtful: tuple[Words, ...] = (),
    interpretation: Modelled | None = None,
    as_found: tuple[Evaluated, ...] = (),
    tests: tuple[Tested, ...] = (),
) -> Certificate:
    """Build the document without its pages.

    `evaluated`: At least one evaluation; all are of the same measurements.
    `doubtful`: Sentences on values that seem to be in another unit.
    `interpretation`: By an error model; None where the job names none.
    `as_found`: Evaluations of the axis before it was adjusted, by the same standards; empty where it was not.
    `tests`: Of several measured lines that are evaluated together, each by itself; empty of most documents.
    """
    certificate, laboratory = job.keys.certificate, job.keys.laboratory
    generator, plugins = made_by
    measurements = evaluated[0].evaluation.measurements
    writer = make_writer(job, measurements)
    designations = tuple(each.evaluation.designation for each in evaluated)
    logo = None
    if laboratory and laboratory.logo:
        from zlmreport.document.certificate.own_look import read_logo  # noqa: PLC0415 - brings the typeface

        logo = read_logo(laboratory.logo, job.place_of("laboratory.logo"))
    sessions = interpretation.sessions if interpretation else ()
    read = (measurements, *(each.evaluation.measurements for each in as_found[:1]), *sessions)
    files = [file for each in read for file in each.provenance.files]
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
    results = tuple(each.evaluation for each in evaluated)
    results_as_found = tuple(each.evaluation for each in as_found)
    subject = writer.say(name_subject_of(job))
    return Certificate(
        number=certificate.number,
        title=writer.say(write_document_title(certificate)),
        subtitle=subject,
        language=certificate.language,
        issued=certificate.issued,
        paper=certificate.paper,
        letterhead=make_letterhead(laboratory, logo),
        cover=(),
        sections=(),
        page_words=write_page_words(job, writer),
        description=describe_document(subject, designations, writer),
        measurements=measurements,
        evaluations=results,
        evaluations_as_found=results_as_found,
        digest=digest_of(certificate.number, (*results, *results_as_found)),
        budget_as_found=as_found[0].budget if as_found else None,
        generator=generator,
        keywords=designations,
        plugins=plugins,
        diagnosis=interpretation.diagnosis if interpretation else None,
        budget=evaluated[0].budget,
        job=job,
        sources=list_sources(job, files, logo.file if logo else None),
        look=find_look(job),
        doubts=doubtful,
        evidence=shown,
        tests=tests,
    )


def lay_out(material: Material) -> Certificate:
    """Return a document with its pages, in the layout and with the sections that its job asks for."""
    job, certificate = material.job, material.job.keys.certificate
    laid_out = _lay_out(material if certificate.readings_on_graphs else _drop_readings(material))
    sections = laid_out.sections
    if certificate.sections is not None:
        sections = arrange_sections(sections, certificate.sections, job)
    linked = _link_readings(material)
    return replace(
        material.document,
        cover=laid_out.cover,
        sections=sections,
        linked=linked if linked and linked.section in {each.key for each in sections} else None,
        is_compact=laid_out.is_compact,
        head=laid_out.head,
    )


def make_writer(job: Job, measurements: MeasurementSet) -> Writer:
    """Return the writer of a job's document on these readings."""
    return Writer.of(measurements, job.keys.certificate.language, Marks.of(job.keys))


def write_page_words(job: Job, writer: Writer) -> PageWords:
    """Return the words of the margins of a job's document."""
    certificate = job.keys.certificate
    number = writer.say(write_running_title(certificate))
    return PageWords.in_language(
        certificate.language,
        number,
        head=_fill_margin("certificate.style.header", certificate.style.header, job),
        foot=_fill_margin("certificate.style.footer", certificate.style.footer, job, number),
    )


def _fill_margin(key: str, text: str | None, job: Job, above: str = "") -> str:
    """Return a text of a margin; one for which there is no room, below another one, is refused."""
    if not text:
        return ""
    from zlmreport.document.certificate.columns import MARGIN_LINES, count_margin_lines  # noqa: PLC0415 - brings the typeface

    filled = fill_in(text, job, key)
    room = MARGIN_LINES - (count_margin_lines(above) if above else 0)
    if (needed := count_margin_lines(filled)) > room:
        below = ", or the number" if above else ""
        raise InputError.at(
            job.place_of(key),
            f"{key}: a text of {len(filled)} characters takes {needed} of a page's lines, and there is room "
            f"for {room}; shorten it{below}",
        )
    return filled


def describe_document(subject: str, designations: Iterable[str], writer: Writer) -> str:
    """Return what the metadata of a document say of it."""
    return writer.say(_DESCRIPTION.given(subject=subject, standards=", ".join(designations)))


def find_look(job: Job) -> Look:
    """Return the look that a job asks for."""
    style = job.keys.certificate.style
    look = Look(style.accent, style.logo)
    if not (style.typeface or style.templates):
        return look
    from zlmreport.document.certificate.own_look import read_own_look  # noqa: PLC0415 - brings the typeface

    return read_own_look(look, job)


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


def _link_readings(of: Material) -> Linked | None:
    """Return the readings beside the model, one by one; nothing where single readings are not to be shown."""
    keys = of.job.keys
    is_shown = keys.certificate.readings_on_graphs and keys.certificate.layout != "sheet"
    if of.interpretation is None or keys.agreement.simplified or not is_shown:
        return None
    return of.interpretation.list_linked(of.writer)


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
