"""A checked job and its evaluations become a document."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from zlmreport.certificate import (
    conditions,
    cover,
    origin,
    readings,
    results,
    uncertainty,
)
from zlmreport.certificate.attachments import sources
from zlmreport.certificate.conditions import Described
from zlmreport.certificate.cover import lines
from zlmreport.certificate.document import Certificate, Graph, Letterhead, PageWords, Party, Section
from zlmreport.certificate.logo import Logo, read_logo
from zlmreport.certificate.statements import document_title, opinion_sections, running_title
from zlmreport.evaluation.likely_units import doubts
from zlmreport.language import Words
from zlmreport.presenting.marks import Marks
from zlmreport.presenting.writer import Writer
from zlmreport.version import __version__

if TYPE_CHECKING:
    from zlmreport.certificate.linked import Linked
    from zlmreport.certificate.model_annex import Modelled
    from zlmreport.certificate.results import Evaluated
    from zlmreport.certificate.standard_layout import Pages
    from zlmreport.figures.figure import Figure
    from zlmreport.job.document_keys import Laboratory
    from zlmreport.job.job import Job
    from zlmreport.measurement.measurement_set import MeasurementSet

GENERATOR = f"zlmreport {__version__}"

_SUBTITLE = Words(en="Positioning accuracy of axis {axis}", de="Positioniergenauigkeit der Achse {axis}")
_DESCRIPTION = Words(
    en="Positioning accuracy of axis {axis}, evaluated by {standards}",
    de="Positioniergenauigkeit der Achse {axis}, ausgewertet nach {standards}",
)


def build(  # noqa: PLR0913, PLR0917 - what a document is made of
    job: Job,
    evaluated: tuple[Evaluated, ...],
    plugins: Mapping[str, str],
    modelled: Modelled | None = None,
    as_found: tuple[Evaluated, ...] = (),
    describe: Callable[[Writer], Sequence[Described]] = lambda _: (),
) -> Certificate:
    """Build the document.

    Parameters
    ----------
    job
        The checked job.
    evaluated
        At least one evaluation; all are of the same measurements.
    plugins
        Identifier and version of every plugin that took part.
    modelled
        The error model, studied; None where the job names none.
    as_found
        Evaluations of the axis before it was adjusted, by the same standards; empty where it was not.
    describe
        Returns what extensions say of their groups of job keys.
    """
    certificate = job.keys.certificate
    measurements = evaluated[0].evaluation.measurements
    writer = Writer.of(measurements, certificate.language, Marks.of(job.keys))
    if not certificate.readings_on_graphs:
        evaluated, as_found = map(_without_readings, (evaluated, as_found))
    designations = tuple(each.evaluation.designation for each in evaluated)
    logo = _logo(job)
    read = (measurements, *(each.evaluation.measurements for each in as_found[:1]))
    described = describe(writer)
    pages = _pages(job, evaluated, writer)
    files = [file for each in read for file in each.provenance.files]
    made_from = sources(job, files, logo.file if logo else None)
    doubtful = doubts(job, [each.evaluation for each in evaluated])
    return Certificate(
        number=certificate.number,
        title=writer.say(document_title(certificate)),
        subtitle=writer.say(_SUBTITLE.given(axis=job.axis.name)),
        language=certificate.language,
        issued=certificate.issued,
        paper=certificate.paper,
        letterhead=_letterhead(job.keys.laboratory, logo),
        cover=cover.blocks(job, measurements, evaluated, doubtful, writer, pages, described),
        sections=(
            *_conditions(job, measurements, described, pages, writer),
            *_results(job, evaluated, as_found, pages, writer),
            *_in_common(pages, writer),
            *_uncertainty(job, evaluated, as_found, pages, writer),
            *(
                replace(each, new_page=each.new_page and pages is None)
                for each in _readings(job, measurements, as_found, writer)
            ),
            origin.section(made_from, read, GENERATOR, plugins, writer),
            *opinion_sections(job.keys, writer),
            *_model(modelled, writer),
        ),
        page_words=PageWords(
            number=writer.say(running_title(certificate)),
            page=writer.say(Words(en="page", de="Seite")),
            of=writer.say(Words(en="of", de="von")),
            end=writer.say(Words(en="End of document", de="Ende des Dokuments")),
            figure=writer.say(Words(en="Figure", de="Bild")),
            table=writer.say(Words(en="Table", de="Tabelle")),
        ),
        description=writer.say(_DESCRIPTION.given(axis=job.axis.name, standards=", ".join(designations))),
        measurements=measurements,
        evaluations=tuple(each.evaluation for each in evaluated),
        evaluations_as_found=tuple(each.evaluation for each in as_found),
        generator=GENERATOR,
        keywords=designations,
        plugins=plugins,
        diagnosis=modelled.diagnosis if modelled else None,
        linked=_linked(job, modelled, writer),
        budget=evaluated[0].budget,
        job=job,
        sources=made_from,
        is_compact=pages is not None,
        doubts=doubtful,
    )


def _pages(job: Job, evaluated: tuple[Evaluated, ...], writer: Writer) -> Pages | None:
    """Return which evaluations share a page; None where each has a chapter."""
    if job.keys.certificate.layout != "standard":
        return None
    from zlmreport.certificate.standard_layout import together  # noqa: PLC0415 - of those that ask for it

    return together(evaluated, writer)


def _in_common(pages: Pages | None, writer: Writer) -> Iterator[Section]:
    """Yield what is said once for all standards, where each has no chapter."""
    if pages is None:
        return iter(())
    from zlmreport.certificate.standard_layout import in_common  # noqa: PLC0415 - of those that ask for it

    return in_common(pages, writer)


def _without_graphs(section: Section) -> Section:
    """Return a section whose table says what its bars repeat: that of the uncertainty."""
    return replace(section, blocks=tuple(each for each in section.blocks if not isinstance(each, Graph)))


def _conditions(
    job: Job,
    measurements: MeasurementSet,
    described: Sequence[Described],
    pages: Pages | None,
    writer: Writer,
) -> Iterator[Section]:
    """Yield the conditions; where the cover holds them, what is said besides."""
    section = conditions.section(job, measurements, described, writer)
    besides = tuple(conditions.besides(measurements, described, writer))
    if pages is None:
        yield section
    elif besides:
        yield replace(section, blocks=besides)


def _results(
    job: Job,
    evaluated: tuple[Evaluated, ...],
    as_found: tuple[Evaluated, ...],
    pages: Pages | None,
    writer: Writer,
) -> Iterator[Section]:
    """Yield the results by each standard; of an axis that was adjusted, those before, after, and compared."""
    keys = job.keys.as_found
    if pages is None:
        sections = (results.section(each, writer) for each in evaluated)
        page = results.section
    else:
        from zlmreport.certificate import standard_layout  # noqa: PLC0415 - of those that ask for it

        sections = (standard_layout.page(each, writer) for each in pages)
        page = standard_layout.page_of_one
    if keys is None:
        return sections
    from zlmreport.certificate.as_found import beside_as_found  # noqa: PLC0415 - of the few that need it

    return beside_as_found(keys, sections, as_found, evaluated, writer, page)


def _uncertainty(
    job: Job,
    evaluated: tuple[Evaluated, ...],
    as_found: tuple[Evaluated, ...],
    pages: Pages | None,
    writer: Writer,
) -> Iterator[Section]:
    """Yield the uncertainty budget; of an axis that was adjusted, that of both measurements."""
    sections = iter([uncertainty.section(evaluated[0].budget, job.axis, writer)])
    if job.keys.as_found:
        from zlmreport.certificate.as_found import uncertainty_beside_as_found  # noqa: PLC0415

        sections = uncertainty_beside_as_found(job.keys.as_found, as_found, evaluated, writer)
    return sections if pages is None else map(_without_graphs, sections)


def _model(modelled: Modelled | None, writer: Writer) -> Iterator[Section]:
    """Yield what the error model says, if the job names one."""
    if modelled:
        from zlmreport.certificate.model_annex import section  # noqa: PLC0415 - brings the error model

        yield section(modelled, writer)


def _linked(job: Job, modelled: Modelled | None, writer: Writer) -> Linked | None:
    """Return the readings beside the model, one by one; nothing where single readings are not to be shown."""
    if modelled is None or job.keys.agreement.simplified or not job.keys.certificate.readings_on_graphs:
        return None
    from zlmreport.certificate.model_annex import linked_graphs  # noqa: PLC0415 - brings the error model

    return linked_graphs(modelled, writer)


def _readings(
    job: Job, measurements: MeasurementSet, as_found: tuple[Evaluated, ...], writer: Writer
) -> Iterator[Section]:
    """Yield the readings, unless the customer agreed to a document without them."""
    if job.keys.agreement.simplified:
        return
    yield readings.section(measurements, writer)
    if job.keys.as_found:
        from zlmreport.certificate.as_found import readings_as_found  # noqa: PLC0415

        yield readings_as_found(job.keys.as_found, as_found, writer)


def _without_readings(evaluated: tuple[Evaluated, ...]) -> tuple[Evaluated, ...]:
    """Return evaluations whose figures lack the single readings behind their curves."""
    return tuple(
        replace(each, figures=tuple(map(_figure_without_readings, each.figures))) for each in evaluated
    )


def _figure_without_readings(figure: Figure) -> Figure:
    return replace(figure, panels=tuple(replace(panel, readings=()) for panel in figure.panels))


def _logo(job: Job) -> Logo | None:
    laboratory = job.keys.laboratory
    if laboratory is None or laboratory.logo is None:
        return None
    return read_logo(laboratory.logo, job.place_of("laboratory.logo"))


def _letterhead(laboratory: Laboratory | None, logo: Logo | None) -> Letterhead | None:
    if laboratory is None:
        return None
    return Letterhead(
        Party(laboratory.name, lines(laboratory.address)),
        laboratory.accreditation or "",
        logo.file.content if logo else None,
        logo.media_type if logo else "",
    )
