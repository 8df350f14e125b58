"""Data source ``serial-interferometer``: readings captured live, from a journal; remarks on the capture."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from zlmreport.plugin import (
    ARCSECOND,
    DEGREE,
    AccessError,
    Axis,
    InputError,
    MeasurementSet,
    Options,
    Place,
    Unit,
    Words,
    counted,
    hookimpl,
)
from zlmreport.plugin.instrument import (
    BeamHeld,
    CaptureEnded,
    CaptureOptions,
    CaptureResumed,
    DatumClosed,
    DatumHolds,
    DatumMoved,
    DatumTaken,
    JournalEntry,
    JournalHeader,
    JournalHistory,
    OperatorCommented,
    OperatorRetake,
    OperatorSkipped,
    ReadingRecorded,
    ScaleChanged,
    VisitPresumed,
    ZeroLost,
    read_journal,
)
from zlmreport.plugin.source import DataSource, Provenance, Reading, SourceContext, collect_readings

_HELD = Words("At the end the axis came back to the datum; closure: {difference}.")
_SLIPPED = Words(
    "The datum slipped: at the end the axis read {difference} there. This marks the readings of the "
    "runs since it was taken: {runs}."
)


@dataclass(frozen=True, slots=True)
class Taken:
    """A reading that counts: its entry in the journal, and the event in it."""

    entry: JournalEntry
    event: ReadingRecorded


@dataclass(frozen=True, slots=True)
class Part:
    """A part of the test, which shares one datum."""

    number: int  #: Of the part, from 1.
    attempt: int  #: The attempt that counts, from 1.
    attempts: int  #: How many there were.
    left_out: int  #: How many readings the others have.


def _count_readings(history: JournalHistory) -> tuple[Mapping[int, Taken], tuple[Part, ...]]:
    """Return the readings that count, by the numbers of their visits, and what was left out.

    Readings of two attempts are not mixed, for each has a datum of its own. The attempt with the most
    readings counts, of equals the last: a rule that no reading's value has a part in.
    """
    by_part: dict[int, dict[int, list[Taken]]] = defaultdict(lambda: defaultdict(list))
    for taken in _select_taken(history.entries):
        by_part[taken.event.visit.part][taken.event.attempt].append(taken)
    readings: dict[int, Taken] = {}
    parts = []
    for number, attempts in sorted(by_part.items()):
        by_visit = {
            each: {taken.event.visit.number: taken for taken in some} for each, some in attempts.items()
        }
        attempt = max(by_visit, key=lambda each: (len(by_visit[each]), each))
        readings |= by_visit[attempt]  # of a visit that was read again, the last
        left_out = sum(len(others) for each, others in by_visit.items() if each != attempt)
        parts.append(Part(number, attempt, len(attempts), left_out))
    return readings, tuple(parts)


def _select_taken(entries: Iterable[JournalEntry]) -> Iterable[Taken]:
    return (Taken(entry, entry.event) for entry in entries if isinstance(entry.event, ReadingRecorded))


def list_remarks(
    history: JournalHistory, taken: Mapping[int, Taken], parts: Sequence[Part], axis: Axis
) -> Iterator[Words]:
    """Yield what a reader of the results must know of a capture."""
    header = history.header
    yield Words(
        "Captured live with {instrument} ({tool}). A reading is the mean over the last {averaged} s of a "
        "standstill of {still} s within {stability}, at most {tolerance} from the target."
    ).given(
        instrument=str(header.instrument.get("plugin", "")),
        tool=header.tool,
        averaged=header.settings.averaged,
        still=header.settings.still,
        stability=_say_in(axis.deviation_unit, header.settings.stability),
        tolerance=_say_in(axis.position_unit, header.settings.tolerance),
    )
    if header.settings.settle:
        yield Words(
            "The reading of a visit is the last standstill of at least {settle} s before the axis left."
        ).given(settle=header.settings.settle)
    yield _say_datum(header.datum, axis)
    held = sum(isinstance(entry.event, BeamHeld) for entry in history.entries)
    if held:
        yield Words(
            "The beam was broken for a moment once while the axis stood still; the display showed afterwards "
            "what it had shown before.",
            plural="The beam was broken for a moment {number} times while the axis stood still; each time "
            "the display showed afterwards what it had shown before.",
        ).given(number=held)
    yield from _say_failed_displays(history)
    yield from _say_interruptions(history, axis)
    yield from _say_closure(history, axis)
    yield from _say_repetitions(parts)
    yield from _say_orders(history)
    missing = len(header.visits) - len(taken)
    if missing:
        yield Words(
            "{number} of {all} visits of the plan has no reading.",
            plural="{number} of {all} visits of the plan have no reading.",
        ).given(number=missing, all=len(header.visits))
    if missing and any(isinstance(entry.event, CaptureEnded) for entry in history.entries):
        yield Words("The operator closed the test before the plan was done.")


def _say_in(unit: Unit, value: float) -> Words:
    """Return a value in its unit; the signs of angles touch their number."""
    blank = "" if unit in (DEGREE, ARCSECOND) else " "
    return Words(f"{{value}}{blank}{{unit}}").given(value=unit.from_si(value), unit=unit.symbol)


def _say_failed_displays(history: JournalHistory) -> Iterator[Words]:
    """Yield how often a display was switched, and how sure it was which visit a reading is."""
    events = [entry.event for entry in history.entries]
    switched = sum(isinstance(event, ScaleChanged) for event in events)
    if switched:
        yield Words(
            "The display was switched to another unit (times: {count}). What it showed then is not used."
        ).given(count=switched)
    shares = [event.share for event in events if isinstance(event, VisitPresumed)]
    if shares:
        yield Words(
            "Which visit a reading is was nearly certain by what went before (readings: {count}); of the "
            "least certain it was so to {share} %."
        ).given(count=len(shares), share=math.floor(1000 * min(shares)) / 10)


def _say_datum(datum: float | None, axis: Axis) -> Words:
    if datum is None:
        return Words("Positions are counted from the instrument's own zero.")
    return Words(
        "The reading at {position} was taken for that position: deviations are relative to it."
    ).given(position=_say_in(axis.position_unit, datum))


def _say_closure(history: JournalHistory, axis: Axis) -> Iterator[Words]:
    """Yield by how much the datum was another one at the end, and which readings that marks."""
    since: list[int] = []
    for entry in history.entries:
        event = entry.event
        if isinstance(event, DatumTaken):
            since = []
        elif isinstance(event, ReadingRecorded):
            since.append(event.visit.run)
        elif isinstance(event, DatumClosed):
            said = _HELD if event.holds else _SLIPPED
            yield said.given(
                difference=_say_in(axis.deviation_unit, event.difference),
                runs=", ".join(str(run) for run in sorted(set(since))),
            )


def _say_interruptions(history: JournalHistory, axis: Axis) -> Iterator[Words]:
    events = [entry.event for entry in history.entries]
    lost = sum(isinstance(event, ZeroLost | DatumMoved) for event in events)
    resumed = sum(isinstance(event, CaptureResumed) for event in events)
    if resumed > lost:
        yield Words("The capture was interrupted and went on (interruptions: {count}).").given(
            count=resumed - lost
        )
    held = [abs(event.difference) for event in events if isinstance(event, DatumHolds)]
    if held:
        yield Words(
            "After an interruption the datum was held against an earlier reading; largest difference: "
            "{difference}."
        ).given(difference=_say_in(axis.deviation_unit, max(held)))
    if lost:
        yield Words(
            "The instrument's zero was lost (times: {count}). What it showed from then on, until the "
            "datum was taken anew, is not used."
        ).given(count=lost)


def _say_repetitions(parts: Sequence[Part]) -> Iterator[Words]:
    for part in parts:
        if part.attempts > 1:
            yield Words(
                "Part {part} of the test (a run, or all of it) was taken {attempts} times, each "
                "time from a datum of its own; attempt {attempt}, the most complete, counts; what was "
                "read in the others stays in the journal (readings: {left_out})."
            ).given(part=part.number, attempts=part.attempts, attempt=part.attempt, left_out=part.left_out)


def _say_orders(history: JournalHistory) -> Iterator[Words]:
    """Yield what the operator ordered and said, for a choice among readings is nobody's secret."""
    visit = 0
    for entry in history.entries:
        match entry.event:
            case ReadingRecorded() as event:
                visit = event.visit.number
            case OperatorRetake(first=first, last=last):
                yield Words(
                    "Taken again as the operator ordered: visits {visits}; of each the last reading "
                    "counts, and the earlier ones stay in the journal."
                ).given(visits=f"{first.number}–{last.number}" if last != first else first.number)
            case OperatorSkipped(visit=skipped):
                yield Words("The operator left out visit {visit}.").given(visit=skipped.number)
            case OperatorCommented(text=text):
                yield Words("The operator after visit {visit}: {text}").given(visit=visit, text=text)


_COMMAND = "zlmreport capture JOB.yaml"


class SerialInterferometer:
    """Readings that were captured live from an interferometer, a display or another instrument.

    The journal of ``zlmreport capture`` is read; the instrument is not. So a journal that was captured before
    is evaluated without one, on any computer.
    """

    identifier = "serial-interferometer"
    title = Words("Live capture from an instrument")
    options: type[Options] = CaptureOptions

    def read(self, options: CaptureOptions, context: SourceContext) -> MeasurementSet:
        """Read a journal; raise `AccessError` for one that is damaged or not finished."""
        place = Place(str(options.journal))
        history = read_journal(options.journal)
        if history is None or not history.progress.is_over:
            raise AccessError.at(place, _say_unfinished(history))
        _demand_axis(history.header, context.axis, place)
        taken, parts = _count_readings(history)
        provenance = Provenance(
            self.identifier, (history.file,), tuple(list_remarks(history, taken, parts, context.axis))
        )
        readings = _list_readings(history, taken, place)
        found = collect_readings(readings, context.axis, provenance, place=place)
        return replace(found, datum=history.header.datum)


def _say_unfinished(history: JournalHistory | None) -> str:
    if history is None:
        return f"holds nothing yet; '{_COMMAND}' begins the capture"
    progress = history.progress
    far = f"the capture is not finished: {progress.taken} of {counted(len(progress.visits), 'visit')}"
    if history.is_being_written:
        return f"{far}, and it is at work; wait for its end"
    return f"{far}; '{_COMMAND} --resume' goes on, '{_COMMAND} --end' closes it without the rest"


def _demand_axis(header: JournalHeader, axis: Axis, place: Place) -> None:
    if (header.axis, header.kind) != (axis.name, axis.kind):
        raise InputError.at(
            place,
            f"is the journal of the {header.kind} axis {header.axis} ({header.number}), and the job is on "
            f"the {axis.kind} axis {axis.name}; name its own journal",
        )


def _list_readings(history: JournalHistory, taken: Mapping[int, Taken], place: Place) -> Iterator[Reading]:
    """Yield the visits in the order in which they were taken; those that were not have no deviation."""
    listed, moments, moment = history.header.visits, {}, 0.0
    for visit in listed:
        if visit.number in taken:
            moment = _find_moment(taken[visit.number])
        moments[visit.number] = moment
    for visit in sorted(listed, key=lambda visit: moments[visit.number]):
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
                moments[visit.number],
                found.event.mean.conditions,
            )


def _find_moment(taken: Taken) -> float:
    """Return when a reading was taken, s from the start of the capture."""
    return taken.entry.elapsed - taken.event.late


@hookimpl
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the reader of journals."""
    return [SerialInterferometer()]
