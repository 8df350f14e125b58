"""A checked job and its evaluations become a document."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from zlmreport import __version__
from zlmreport.certificate import conditions, cover, model_annex, origin, readings, results
from zlmreport.certificate.document import Certificate, Letterhead, PageWords, Party
from zlmreport.certificate.logo import read_logo
from zlmreport.certificate.model_annex import Modelled
from zlmreport.certificate.results import Evaluated
from zlmreport.certificate.scribe import Scribe
from zlmreport.figures.figure import Figure
from zlmreport.job.job import Job
from zlmreport.job.model import Laboratory
from zlmreport.language import Words

GENERATOR = f"zlmreport {__version__}"

_TITLES = {
    "certificate": Words(en="Calibration Certificate", de="Kalibrierschein"),
    "report": Words(en="Measuring Report", de="Messbericht"),
}
_SUBTITLE = Words(en="Positioning accuracy of axis {axis}", de="Positioniergenauigkeit der Achse {axis}")
_DESCRIPTION = Words(
    en="Positioning accuracy of axis {axis}, evaluated by {standards}",
    de="Positioniergenauigkeit der Achse {axis}, ausgewertet nach {standards}",
)


def build(
    job: Job,
    evaluated: tuple[Evaluated, ...],
    plugins: Mapping[str, str],
    modelled: Modelled | None = None,
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
    """
    certificate = job.keys.certificate
    measurements = evaluated[0].evaluation.measurements
    scribe = Scribe.of(measurements, certificate.language)
    if not certificate.readings_on_graphs:
        evaluated = tuple(
            replace(each, figures=tuple(map(_without_readings, each.figures))) for each in evaluated
        )
    title = scribe.say(_TITLES[certificate.kind])
    designations = tuple(each.evaluation.designation for each in evaluated)
    return Certificate(
        number=certificate.number,
        title=certificate.title or title,
        subtitle=scribe.say(_SUBTITLE.given(axis=job.axis.name)),
        language=certificate.language,
        issued=certificate.issued,
        paper=certificate.paper,
        letterhead=_letterhead(job.keys.laboratory, job),
        cover=cover.blocks(job, measurements, evaluated, scribe),
        sections=(
            conditions.section(job, measurements, scribe),
            *(results.section(each, scribe) for each in evaluated),
            readings.section(measurements, scribe),
            origin.section(job, measurements, GENERATOR, plugins, scribe),
            *([model_annex.section(modelled, scribe)] if modelled else []),
        ),
        page_words=PageWords(
            number=f"{title} {certificate.number}",
            page=scribe.say(Words(en="page", de="Seite")),
            of=scribe.say(Words(en="of", de="von")),
            end=scribe.say(Words(en="End of document", de="Ende des Dokuments")),
            figure=scribe.say(Words(en="Figure", de="Bild")),
            table=scribe.say(Words(en="Table", de="Tabelle")),
        ),
        description=scribe.say(_DESCRIPTION.given(axis=job.axis.name, standards=", ".join(designations))),
        measurements=measurements,
        evaluations=tuple(each.evaluation for each in evaluated),
        generator=GENERATOR,
        keywords=designations,
        plugins=plugins,
        diagnosis=modelled.diagnosis if modelled else None,
    )


def _without_readings(figure: Figure) -> Figure:
    """Return the figure without the single readings behind its curves."""
    return replace(figure, panels=tuple(replace(panel, readings=()) for panel in figure.panels))


def _letterhead(laboratory: Laboratory | None, job: Job) -> Letterhead | None:
    if laboratory is None:
        return None
    logo, logo_type = (
        read_logo(laboratory.logo, job.place_of("laboratory.logo")) if laboratory.logo else (None, "")
    )
    return Letterhead(
        Party(laboratory.name, cover.lines(laboratory.address)),
        laboratory.accreditation or "",
        logo,
        logo_type,
    )
