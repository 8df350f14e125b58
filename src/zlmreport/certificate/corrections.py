"""The corrections that were applied to the readings, or that none was."""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.certificate.document import Align, Block, Cell, Column, Paragraph, RowGroup, Table
from zlmreport.certificate.scribe import Scribe
from zlmreport.language import Words
from zlmreport.measurement.measurement_set import MeasurementSet

_CAPTION = Words(en="Corrections applied to the readings", de="An den Messwerten angebrachte Korrektionen")
_ALL_CORRECTED = Words(
    en="Every deviation in this document is a corrected one. The readings as they were displayed are in the"
    " files that the section on their origin names.",
    de="Jede Abweichung in diesem Dokument ist korrigiert. Die angezeigten Messwerte stehen in den Dateien,"
    " die der Abschnitt über ihre Herkunft nennt.",
)


def blocks(measurements: MeasurementSet, scribe: Scribe) -> Iterator[Block]:
    """Yield what was corrected, in its order; nothing where the readings are as they were read."""
    corrections = measurements.provenance.corrections
    if not corrections:
        return
    columns = (
        Column(scribe.say(Words(en="Correction", de="Korrektion"))),
        Column(scribe.say(Words(en="By", de="Nach"))),
        Column(scribe.say(Words(en="From", de="Aus")) + scribe.marks.after("environment", "corrections")),
        Column(scribe.say(Words(en="Largest", de="Größte")), scribe.deviation_unit.symbol, Align.RIGHT),
    )
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (
            scribe.say(each.name),
            scribe.say(each.method),
            scribe.say(each.inputs),
            scribe.deviation(each.largest),
        )
        for each in corrections
    )
    yield Table(scribe.say(_CAPTION), columns, (RowGroup(rows),))
    yield Paragraph(scribe.say(_ALL_CORRECTED))
