"""The corrections that were applied to the readings, or that none was."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from zlmreport.certificate.document import Align, Block, Cell, Column, Paragraph, RowGroup, Table
from zlmreport.language import Words

if TYPE_CHECKING:
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.presenting.writer import Writer

_CAPTION = Words(en="Corrections applied to the readings", de="An den Messwerten angebrachte Korrektionen")
_ALL_CORRECTED = Words(
    en="Every deviation in this document is a corrected one. The readings as they were displayed are in the"
    " files that the section on their origin names.",
    de="Jede Abweichung in diesem Dokument ist korrigiert. Die angezeigten Messwerte stehen in den Dateien,"
    " die der Abschnitt über ihre Herkunft nennt.",
)


def blocks(measurements: MeasurementSet, writer: Writer) -> Iterator[Block]:
    """Yield what was corrected, in its order; nothing where the readings are as they were read."""
    corrections = measurements.provenance.corrections
    if not corrections:
        return
    columns = (
        Column(writer.say(Words(en="Correction", de="Korrektion"))),
        Column(writer.say(Words(en="By", de="Nach"))),
        Column(writer.say(Words(en="From", de="Aus")) + writer.marks.after("environment", "corrections")),
        Column(writer.say(Words(en="Largest", de="Größte")), writer.deviation_unit.symbol, Align.RIGHT),
    )
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (
            writer.say(each.name),
            writer.say(each.method),
            writer.say(each.inputs),
            writer.deviation(each.largest),
        )
        for each in corrections
    )
    yield Table(writer.say(_CAPTION), columns, (RowGroup(rows),))
    yield Paragraph(writer.say(_ALL_CORRECTED))
