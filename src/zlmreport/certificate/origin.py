"""Where the numbers of a document come from: files, programs, and what the reader of them should know."""

from __future__ import annotations

from collections.abc import Mapping

from zlmreport.certificate.document import (
    Align,
    Block,
    Column,
    Facts,
    Paragraph,
    RowGroup,
    Section,
    Table,
)
from zlmreport.certificate.scribe import Scribe
from zlmreport.job.job import Job
from zlmreport.language import Words
from zlmreport.measurement.measurement_set import MeasurementSet

_TITLE = Words(en="Origin of the results", de="Herkunft der Ergebnisse")


def section(
    job: Job, measurements: MeasurementSet, generator: str, plugins: Mapping[str, str], scribe: Scribe
) -> Section:
    """Return the section that lets anyone evaluate again: files with digests, program and plugins."""
    programs = Facts(
        (
            (scribe.say(Words(en="Program", de="Programm")), generator),
            *((name, version) for name, version in sorted(plugins.items())),
        ),
        scribe.say(Words(en="Evaluated with", de="Ausgewertet mit")),
    )
    blocks: list[Block] = [_files(job, measurements, scribe), programs]
    if measurements.provenance.remarks:
        blocks.append(_remarks(measurements, scribe))
    blocks.extend(Paragraph(scribe.say(words)) for words in _READING_AIDS)
    return Section("origin", scribe.say(_TITLE), tuple(blocks))


_READING_AIDS = (
    Words(
        en="Values were computed from the unrounded readings, and limits are compared with unrounded values; "
        "only what is printed is rounded, to the decimals of the readings.",
        de="Gerechnet wurde mit ungerundeten Messwerten, und Grenzwerte werden mit ungerundeten Werten "
        "verglichen; "
        "gerundet ist nur, was gedruckt steht, auf die Dezimalstellen der Messwerte.",
    ),
    Words(
        en="Signs: deviation = actual − target position; reversal value B = mean of the positive "
        "approach ↑ − mean of the negative approach ↓.",
        de="Vorzeichen: Abweichung = Istposition − Sollposition; Umkehrspanne B = Mittel der positiven "
        "Anfahrrichtung ↑ − Mittel der negativen Anfahrrichtung ↓.",
    ),
)


def _remarks(measurements: MeasurementSet, scribe: Scribe) -> Table:
    """Return what the reader of the files has to say of them."""
    heading = scribe.say(
        Words(en="How the readings were understood", de="Wie die Messwerte verstanden wurden")
    )
    rows = tuple((scribe.say(remark),) for remark in measurements.provenance.remarks)
    return Table(scribe.say(Words(en="Remarks", de="Bemerkungen")), (Column(heading),), (RowGroup(rows),))


def _files(job: Job, measurements: MeasurementSet, scribe: Scribe) -> Table:
    columns = (
        Column(scribe.say(Words(en="File", de="Datei"))),
        Column("Bytes", align=Align.RIGHT),
        Column("SHA-256"),
    )
    readings = tuple((file.name, str(file.size), file.sha256) for file in measurements.provenance.files)
    jobs = tuple((file.name, str(file.size), file.sha256) for file in job.files)
    groups = (
        RowGroup(
            readings,
            scribe.say(
                Words(en="Readings, read by {source}", de="Messwerte, gelesen mit {source}").given(
                    source=measurements.provenance.source
                )
            ),
        ),
        RowGroup(jobs, scribe.say(Words(en="Job", de="Auftrag"))),
    )
    return Table(
        scribe.say(Words(en="Files", de="Dateien")),
        columns,
        tuple(group for group in groups if group.rows),
        dense=True,
    )
