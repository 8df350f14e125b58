"""The data source ``serial-interferometer``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from zlmreport.plugin import (
    AccessError,
    Axis,
    CaptureOptions,
    InputError,
    JournalHeader,
    JournalHistory,
    MeasurementSet,
    Options,
    Place,
    Provenance,
    Reading,
    SourceContext,
    Words,
    collect_readings,
    read_journal,
)
from zlmreport_plugins.sources.serial_interferometer.attempts import Taken, counted
from zlmreport_plugins.sources.serial_interferometer.remarks import remarks

_COMMAND = "zlmreport capture JOB.yaml"


class SerialInterferometer:
    """Readings that were captured live from an interferometer, a display or another instrument.

    The journal of ``zlmreport capture`` is read; the instrument is not. So a journal that was captured before
    is evaluated without one, on any computer.
    """

    identifier = "serial-interferometer"
    title = Words(en="Live capture from an instrument", de="Live-Erfassung von einem Messgerät")
    options: type[Options] = CaptureOptions

    def read(self, options: CaptureOptions, context: SourceContext) -> MeasurementSet:
        """Read a journal; raise `AccessError` for one that is damaged or not finished."""
        place = Place(str(options.journal))
        history = read_journal(options.journal)
        if history is None or not history.progress.is_over:
            raise AccessError.at(place, _unfinished(history))
        _demand_axis(history.header, context.axis, place)
        taken, parts = counted(history)
        provenance = Provenance(
            self.identifier, (history.file,), tuple(remarks(history, taken, parts, context.axis))
        )
        readings = _readings(history, taken, place)
        found = collect_readings(readings, context.axis, provenance, place=place)
        return replace(found, datum=history.header.datum)


def _unfinished(history: JournalHistory | None) -> str:
    if history is None:
        return f"holds nothing yet; '{_COMMAND}' begins the capture"
    progress = history.progress
    return (
        f"the capture is not finished: {progress.taken} of {len(progress.visits)} visits; "
        f"'{_COMMAND} --resume' goes on, '{_COMMAND} --end' closes it without the rest"
    )


def _demand_axis(header: JournalHeader, axis: Axis, place: Place) -> None:
    if (header.axis, header.kind) != (axis.name, axis.kind):
        raise InputError.at(
            place,
            f"is the journal of the {header.kind} axis {header.axis} ({header.number}), and the job is on "
            f"the {axis.kind} axis {axis.name}; name its own journal",
        )


def _readings(history: JournalHistory, taken: Mapping[int, Taken], place: Place) -> Iterator[Reading]:
    """Yield the visits of the test in their order; those that were not taken have no deviation."""
    for visit in history.header.visits:
        found = taken.get(visit.number)
        if found is None:
            yield Reading(place, visit.position, visit.approach, visit.run, float("nan"))
        else:
            yield Reading(
                Place(place.file, found.entry.line),
                visit.position,
                visit.approach,
                visit.run,
                found.event.deviation,
                found.entry.elapsed,
                found.event.mean.conditions,
            )
