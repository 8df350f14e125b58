"""A checked job and its evaluations become a document."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from zlmreport.certificate.attachments import sources
from zlmreport.certificate.conditions import Described
from zlmreport.certificate.cover import lines
from zlmreport.certificate.document import Certificate, Letterhead, PageWords, Party
from zlmreport.certificate.material import LaidOut, Material, in_full
from zlmreport.certificate.own_look import Logo, read_logo, read_look
from zlmreport.certificate.own_words import arranged, filled
from zlmreport.certificate.statements import document_title, running_title
from zlmreport.evaluation.likely_units import doubts
from zlmreport.language import Words
from zlmreport.presenting.writer import Marks, Writer
from zlmreport.version import __version__

if TYPE_CHECKING:
    from zlmreport.certificate.linked import Linked
    from zlmreport.certificate.model_annex import Modelled
    from zlmreport.certificate.results import Evaluated
    from zlmreport.figures.figure import Figure
    from zlmreport.job.document_keys import Laboratory
    from zlmreport.job.job import Job
    from zlmreport.measurement.measurement_set import MeasurementSet

_OF_A_RUN = Words("{statement}; {remedy}", "{statement}; {remedy}")

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
    generator: str = GENERATOR,
) -> Certificate:
    """Build the document.

    `evaluated`: At least one evaluation; all are of the same measurements.
    `modelled`: The error model, studied; None where the job names none.
    `as_found`: Evaluations of the axis before it was adjusted, by the same standards; empty where it was not.
    """
    certificate = job.keys.certificate
    measurements = evaluated[0].evaluation.measurements
    writer = Writer.of(measurements, certificate.language, Marks.of(job.keys))
    if not certificate.readings_on_graphs:
        evaluated, as_found = map(_without_readings, (evaluated, as_found))
    designations = tuple(each.evaluation.designation for each in evaluated)
    logo = _logo(job)
    sessions = modelled.study.sessions if modelled else ()
    read = (measurements, *(each.evaluation.measurements for each in as_found[:1]), *sessions)
    files = [file for each in read for file in each.provenance.files]
    made_from = sources(job, files, logo.file if logo else None)
    doubtful = (*doubts(job, [each.evaluation for each in evaluated]), *_of_runs(measurements))
    letterhead, title = _letterhead(job.keys.laboratory, logo), writer.say(document_title(certificate))
    material = Material(
        job,
        evaluated,
        as_found,
        doubtful,
        modelled,
        describe(writer),
        made_from,
        generator,
        plugins,
        letterhead,
        title,
        writer,
    )
    laid_out, style = _laid_out(material), certificate.style
    sections = arranged(laid_out.sections, job)
    linked = _linked(job, modelled, writer)
    return Certificate(
        number=certificate.number,
        title=title,
        subtitle=writer.say(_SUBTITLE.given(axis=job.axis.name)),
        language=certificate.language,
        issued=certificate.issued,
        paper=certificate.paper,
        letterhead=letterhead,
        cover=laid_out.cover,
        sections=sections,
        page_words=PageWords(
            number=writer.say(running_title(certificate)),
            page=writer.say(Words(en="page", de="Seite")),
            of=writer.say(Words(en="of", de="von")),
            end=writer.say(Words(en="End of document", de="Ende des Dokuments")),
            figure=writer.say(Words(en="Figure", de="Bild")),
            table=writer.say(Words(en="Table", de="Tabelle")),
            head=filled(style.header or "", job, "certificate.style.header"),
            foot=filled(style.footer or "", job, "certificate.style.footer"),
        ),
        description=writer.say(_DESCRIPTION.given(axis=job.axis.name, standards=", ".join(designations))),
        measurements=measurements,
        evaluations=tuple(each.evaluation for each in evaluated),
        evaluations_as_found=tuple(each.evaluation for each in as_found),
        budget_as_found=as_found[0].budget if as_found else None,
        generator=generator,
        keywords=designations,
        plugins=plugins,
        diagnosis=modelled.diagnosis if modelled else None,
        linked=linked if linked and linked.section in {each.key for each in sections} else None,
        budget=evaluated[0].budget,
        job=job,
        sources=made_from,
        is_compact=laid_out.is_compact,
        look=read_look(job),
        doubts=doubtful,
    )


def _of_runs(measurements: MeasurementSet) -> Iterator[Words]:
    """Yield a sentence for each run that seems to be in another unit than the others."""
    if not np.isfinite(measurements.deviation).any():
        return
    from zlmreport.model.faults import FaultKind, recorded_faults  # noqa: PLC0415 - brings the error model
    from zlmreport.model.observations import observations_of  # noqa: PLC0415 - likewise

    observed = observations_of(measurements)
    for each in recorded_faults(observed.design, observed.deviation):
        if each.kind is FaultKind.WRONG_UNIT and each.run is not None:
            yield _OF_A_RUN.given(statement=each.statement, remedy=each.remedy)


def _laid_out(material: Material) -> LaidOut:
    """Return the parts of the document in the layout that the job asks for."""
    match material.job.keys.certificate.layout:
        case "sheet":
            from zlmreport.certificate.sheet_layout import lay_out  # noqa: PLC0415 - of those that ask for it
        case "standard":
            from zlmreport.certificate.standard_layout import lay_out  # noqa: PLC0415
        case _:
            lay_out = in_full
    return lay_out(material)


def _linked(job: Job, modelled: Modelled | None, writer: Writer) -> Linked | None:
    """Return the readings beside the model, one by one; nothing where single readings are not to be shown."""
    keys = job.keys
    is_shown = keys.certificate.readings_on_graphs and keys.certificate.layout != "sheet"
    if modelled is None or keys.agreement.simplified or not is_shown:
        return None
    from zlmreport.certificate.model_annex import linked_graphs  # noqa: PLC0415 - brings the error model

    return linked_graphs(modelled, writer)


def _without_readings(evaluated: tuple[Evaluated, ...]) -> tuple[Evaluated, ...]:
    """Return evaluations whose figures lack the single readings behind their curves."""

    def bare(figure: Figure) -> Figure:
        return replace(figure, panels=tuple(replace(panel, readings=()) for panel in figure.panels))

    return tuple(replace(each, figures=tuple(map(bare, each.figures))) for each in evaluated)


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
