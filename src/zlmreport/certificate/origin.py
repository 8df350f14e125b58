"""Where the numbers of a document come from: files, programs, and what the reader of them should know."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from zlmreport.certificate.attachments import Role, Source
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
from zlmreport.language import Words

if TYPE_CHECKING:
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.presenting.writer import Writer

_TITLE = Words(en="Origin of the results", de="Herkunft der Ergebnisse")


def section(
    sources: Sequence[Source],
    measurements: Sequence[MeasurementSet],
    generator: str,
    plugins: Mapping[str, str],
    writer: Writer,
) -> Section:
    """Return the section that lets anyone evaluate again: files with digests, program and plugins.

    `measurements`: What was read: the axis as left, and as found if it was adjusted.
    """
    programs = Facts(
        (
            (writer.say(Words(en="Program", de="Programm")), generator),
            (
                writer.say(Words(en="Plugins", de="Plugins")),
                ", ".join(f"{name} {version}" for name, version in sorted(plugins.items())),
            ),
        ),
        writer.say(Words(en="Evaluated with", de="Ausgewertet mit")),
    )
    deviation = _INDICATED if measurements[0].is_indication else _ACTUAL
    blocks: list[Block] = [
        *(Paragraph(writer.say(words)) for words in (_READING_AID, _SIGNS.given(deviation=deviation))),
        _files(sources, measurements, writer),
        programs,
    ]
    remarks = tuple(remark for each in measurements for remark in each.provenance.remarks)
    if remarks:
        blocks.append(_remarks(remarks, writer))
    return Section("origin", writer.say(_TITLE), tuple(blocks))


#: Above the files of each measurement: of the axis as left, and as found if it was adjusted.
_READINGS = (
    Words(en="Readings, read by {source}", de="Messwerte, gelesen mit {source}"),
    Words(
        en="Readings as found, read by {source}",
        de="Messwerte im vorgefundenen Zustand, gelesen mit {source}",
    ),
)
_READING_AID = Words(
    en="Values were computed from the unrounded readings, and limits are compared with unrounded values; "
    "only what is printed is rounded: a value with its uncertainty, any other to the decimals of the "
    "readings.",
    de="Gerechnet wurde mit ungerundeten Messwerten, und Grenzwerte werden mit ungerundeten Werten "
    "verglichen; "
    "gerundet ist nur, was gedruckt steht: ein Wert mit seiner Unsicherheit, jeder andere auf die "
    "Dezimalstellen der Messwerte.",
)
_SIGNS = Words(
    en="Signs: deviation = {deviation}; reversal value B = mean of the positive approach ↑ − mean of the "
    "negative approach ↓.",
    de="Vorzeichen: Abweichung = {deviation}; Umkehrspanne B = Mittel der positiven Anfahrrichtung ↑ − "
    "Mittel der negativen Anfahrrichtung ↓.",
)
_ACTUAL = Words(en="actual − target position", de="Istposition − Sollposition")
_INDICATED = Words(en="indicated − calibrated position", de="angezeigte − kalibrierte Position")


def _remarks(remarks: Iterable[Words], writer: Writer) -> Table:
    """Return what the reader of the files has to say of them."""
    heading = writer.say(
        Words(en="How the readings were understood", de="Wie die Messwerte verstanden wurden")
    )
    rows = tuple((said,) for said in dict.fromkeys(map(writer.say, remarks)))
    return Table(writer.say(Words(en="Remarks", de="Bemerkungen")), (Column(heading),), (RowGroup(rows),))


def _files(sources: Sequence[Source], measurements: Sequence[MeasurementSet], writer: Writer) -> Table:
    columns = (
        Column(writer.say(Words(en="File", de="Datei"))),
        Column("Bytes", align=Align.RIGHT),
        Column("SHA-256"),
    )
    readings = [source for source in sources if source.role is Role.READINGS]
    groups = [
        RowGroup(
            tuple(_row(source) for source in readings if source.file in each.provenance.files),
            writer.say(heading.given(source=each.provenance.source)),
        )
        for heading, each in zip(_READINGS, measurements, strict=False)
    ]
    others = tuple(_row(source) for source in sources if source not in readings)
    groups.append(RowGroup(others, writer.say(Words(en="Job", de="Auftrag"))))
    return Table(
        writer.say(Words(en="Files", de="Dateien")),
        columns,
        tuple(group for group in groups if group.rows),
        dense=True,
    )


def _row(source: Source) -> tuple[str, str, str]:
    return source.name, str(source.file.size), source.file.sha256
