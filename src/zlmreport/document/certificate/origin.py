"""The section on origin: files with digests, programs, and remarks of sources on what they read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from zlmreport.document.blocks import Align, Block, Column, Facts, Paragraph, RowGroup, Section, Table
from zlmreport.document.certificate.attachments import Source, SourceRole
from zlmreport.document.certificate.measured_lines import say_of_each
from zlmreport.language import Language, Words

if TYPE_CHECKING:
    from zlmreport.document.certificate.document import Certificate
    from zlmreport.document.certificate.material import Material
    from zlmreport.document.writer import Writer
    from zlmreport.measurement.measurement_set import MeasurementSet

_TITLE = Words("Origin of the results")


def lay_out_origin(of: Material) -> Section:
    """Return the section that lets anyone evaluate again: files with digests, program and plugins."""
    measurements, writer = of.read, of.writer
    axis = measurements[0].axis
    deviation = _INDICATED if measurements[0].is_indication else axis.measurand.sign_of(axis.letter)
    signs = (_SIGN if axis.measurand.joins_tests or axis.measurand.is_closed else _SIGNS).given(
        deviation=deviation, reversal=axis.measurand.reversal
    )
    named = [
        (name, _OF_LINE if name else heading, line)
        for heading, each in zip(_READINGS, measurements, strict=False)
        for name, line in (each.tests or {"": each}).items()
    ]
    blocks: list[Block] = [
        *(Paragraph(writer.say(words)) for words in (_READING_AID, *_say_whose_terms(writer), signs)),
        _lay_out_files(of.document.sources, named, writer),
        _list_programs(of.document, writer),
    ]
    remarks = tuple(
        say_of_each(
            (name, line.provenance.remarks)
            for each in measurements
            for name, line in (each.tests or {"": each}).items()
        )
    )
    if remarks:
        blocks.append(_lay_out_remarks(remarks, writer))
    return Section("origin", writer.say(_TITLE), tuple(blocks))


def lay_out_origin_of_several(document: Certificate, writer: Writer) -> Section:
    """Return the section of a document of several measurements, by what they are called."""
    found = [
        (f"{name} {line}".strip(), readings)
        for name, part in document.parts.items()
        for line, readings in (part.measurements.tests or {"": part.measurements}).items()
    ]
    named = [(name, _OF_LINE, each) for name, each in found]
    blocks: list[Block] = [
        *(Paragraph(writer.say(words)) for words in (_READING_AID, *_say_whose_terms(writer))),
        _lay_out_files(document.sources, named, writer),
        _list_programs(document, writer),
    ]
    if remarks := tuple(say_of_each((name, each.provenance.remarks) for name, each in found)):
        blocks.append(_lay_out_remarks(remarks, writer))
    return Section("origin", writer.say(_TITLE), tuple(blocks))


#: Above the files of each measurement: of the axis as left, and as found if it was adjusted.
_READINGS = (Words("Readings, read by {source}"), Words("Readings as found, read by {source}"))
_OF_LINE = Words("Readings of {name}, read by {source}")
_READING_AID = Words(
    "Values were computed from the unrounded readings, and limits are compared with unrounded values; "
    "only what is printed is rounded: a value with its uncertainty, any other to the decimals of the "
    "readings, in the tables by position to one more at most."
)
_TERMS = Words(
    "Parameters and requirements are named by this program's translation of the English editions; a national "
    "edition may word them otherwise."
)
_SIGNS = Words(
    "Signs: deviation = {deviation}; {reversal} B = mean of the positive approach ↑ − mean of the "
    "negative approach ↓."
)
_SIGN = Words("Sign: {deviation}.")
_INDICATED = Words("indicated − calibrated position")


def _say_whose_terms(writer: Writer) -> Iterator[Words]:
    """Yield whose the terms are, where they are not those of the editions that were read."""
    if writer.language is not Language.ENGLISH:
        yield _TERMS


def _lay_out_remarks(remarks: Iterable[Words], writer: Writer) -> Table:
    """Return what the reader of the files has to say of them."""
    heading = writer.say(Words("How the readings were understood"))
    rows = tuple((said,) for said in dict.fromkeys(map(writer.say, remarks)))
    return Table(writer.say(Words("Remarks")), (Column(heading),), (RowGroup(rows),))


def _list_programs(document: Certificate, writer: Writer) -> Facts:
    return Facts(
        (
            (writer.say(Words("Program")), document.generator),
            (
                writer.say(Words("Plugins")),
                ", ".join(f"{name} {version}" for name, version in sorted(document.plugins.items())),
            ),
        ),
        writer.say(Words("Evaluated with")),
    )


def _lay_out_files(
    sources: Sequence[Source], named: Sequence[tuple[str, Words, MeasurementSet]], writer: Writer
) -> Table:
    """Return the files of what was measured, under its names and what is said of them; once those of several.

    `named`: Name, heading of its files, and what was measured.
    """
    columns = (
        Column(writer.say(Words("File"))),
        Column(writer.say(Words("Bytes")), align=Align.RIGHT),
        Column("SHA-256"),
    )
    readings = [source for source in sources if source.role is SourceRole.READINGS]
    names_of: dict[tuple[str, str, tuple[tuple[str, str, str], ...]], list[str]] = {}
    for name, heading, line in named:
        rows = tuple(_lay_out_row(source) for source in readings if source.file in line.provenance.files)
        names_of.setdefault((heading.en, line.provenance.source, rows), []).append(name)
    headings = {heading.en: heading for _, heading, _ in named}
    groups = [
        RowGroup(rows, writer.say(headings[heading].given(name=", ".join(names), source=source)))
        for (heading, source, rows), names in names_of.items()
    ]
    others = tuple(_lay_out_row(source) for source in sources if source not in readings)
    groups.append(RowGroup(others, writer.say(Words("Job"))))
    return Table(
        writer.say(Words("Files")), columns, tuple(group for group in groups if group.rows), dense=True
    )


def _lay_out_row(source: Source) -> tuple[str, str, str]:
    return source.name, str(source.file.size), source.file.sha256
