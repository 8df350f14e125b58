"""The data source ``ecmc``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

from pydantic import AfterValidator, Field

from zlmreport.plugin import (
    Approach,
    InputError,
    JobPath,
    MeasurementSet,
    Options,
    Problem,
    Provenance,
    SourceContext,
    Unit,
    Words,
    collect_readings,
    known_encoding,
    position_units,
    read_text,
    unit_named,
)
from zlmreport_plugins.sources.ecmc.log import UNIT, Entry, Key, Log, entries

_USUAL_UNIT = "mm"

_ORDER = Words(
    en="The file does not tell the order of the readings: they are listed cycle by cycle, upwards and "
    "then downwards.",
    de="Die Datei nennt die Reihenfolge der Messwerte nicht: Sie sind Durchlauf für Durchlauf aufgeführt, "
    "erst aufwärts, dann abwärts.",
)
_EXCHANGED = Words(
    en="The directions of approach were exchanged against the file (FWD read as ↓, BWD as ↑), as the "
    "job states.",
    de="Die Anfahrrichtungen wurden gegenüber der Datei getauscht (FWD als ↓, BWD als ↑ gelesen), wie im "
    "Auftrag angegeben.",
)


class EcmcOptions(Options):
    """Where the file is, and what it does not say itself."""

    file: JobPath = Field(description="The .dat file, relative to the file that names it.")
    exchange_directions: bool = Field(
        default=False,
        description="Whether FWD means the negative approach: some tests label the directions so.",
    )
    encoding: Annotated[str, AfterValidator(known_encoding)] | None = Field(
        None, description="Encoding of the file, if it is not UTF-8: cp1252, gbk, utf-16."
    )


class Ecmc:
    """Logs of positioning tests with ecmc, an EtherCAT motion controller."""

    identifier = "ecmc"
    title = Words(en="ecmc test log (.dat)", de="ecmc-Messprotokoll (.dat)")
    options: type[Options] = EcmcOptions
    suffixes = (".dat",)

    def read(self, options: EcmcOptions, context: SourceContext) -> MeasurementSet:
        """Read a log; raise `InputError` with every defect and its place."""
        text = read_text(options.file, options.encoding)
        problems: list[Problem] = []
        found = entries(text, problems)
        if not found:
            raise InputError.at(text.place(), "holds no entry such as 'TGT_DATA[1]=-20'; is it an ecmc log?")
        log = Log(text.place(), found, problems)
        forward = Approach.NEGATIVE if options.exchange_directions else Approach.POSITIVE
        readings = list(log.readings(_unit(found, context), forward))
        remarks = (_ORDER, _EXCHANGED) if options.exchange_directions else (_ORDER,)
        provenance = Provenance(self.identifier, (text.source,), remarks)
        return collect_readings(readings, context.axis, provenance, place=text.place(), problems=problems)


def _unit(found: Mapping[Key, Entry], context: SourceContext) -> Unit:
    """Return the unit of all positions; raise InputError if it is none of the axis."""
    entry = found.get((UNIT, ()))
    try:
        return unit_named(entry.value if entry else _USUAL_UNIT, position_units(context.axis.kind))
    except ValueError as error:
        place = entry.place if entry else context.place
        raise InputError.at(place, f"UNIT: {error}; the axis is {context.axis.kind} (axis.kind)") from error
