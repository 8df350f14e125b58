"""What the provenance says of how readings were captured."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from zlmreport.plugin import (
    Axis,
    CaptureEnded,
    CaptureResumed,
    DatumHolds,
    DatumMoved,
    JournalHistory,
    Words,
    ZeroLost,
)
from zlmreport_plugins.sources.serial_interferometer.attempts import Part, Taken


def remarks(
    history: JournalHistory, taken: Mapping[int, Taken], parts: Sequence[Part], axis: Axis
) -> Iterator[Words]:
    """Yield what a reader of the results must know of a capture."""
    header = history.header
    yield Words(
        en="Captured live with {instrument} ({tool}). A reading is the mean over {dwell} s in which the axis "
        "stood still within {stability} {fine}, at most {tolerance} {unit} from the target.",
        de="Live erfasst mit {instrument} ({tool}). Ein Messwert ist das Mittel über {dwell} s, in denen die "
        "Achse innerhalb von {stability} {fine} stillstand, höchstens {tolerance} {unit} vom Sollwert.",
    ).given(
        instrument=str(header.instrument.get("plugin", "")),
        tool=header.tool,
        dwell=header.settings.dwell,
        stability=axis.deviation_unit.from_si(header.settings.stability),
        fine=axis.deviation_unit.symbol,
        tolerance=axis.position_unit.from_si(header.settings.tolerance),
        unit=axis.position_unit.symbol,
    )
    yield _datum(header.datum, axis)
    yield from _interruptions(history, axis)
    yield from _repetitions(parts)
    missing = len(header.visits) - len(taken)
    if missing:
        yield Words(
            en="{missing} of {all} visits of the plan have no reading.",
            de="{missing} von {all} geplanten Messpunkten haben keinen Messwert.",
        ).given(missing=missing, all=len(header.visits))
    if any(isinstance(entry.event, CaptureEnded) for entry in history.entries):
        yield Words(
            en="The operator closed the test before the plan was done.",
            de="Die Messung wurde beendet, bevor der Plan abgearbeitet war.",
        )


def _datum(datum: float | None, axis: Axis) -> Words:
    if datum is None:
        return Words(
            en="Positions are counted from the instrument's own zero.",
            de="Positionen zählen vom Nullpunkt des Messgeräts.",
        )
    return Words(
        en="The reading at {position} {unit} was taken for that position: deviations are relative to it.",
        de="Die Anzeige bei {position} {unit} wurde dieser Position gleichgesetzt: Abweichungen sind auf sie "
        "bezogen.",
    ).given(position=axis.position_unit.from_si(datum), unit=axis.position_unit.symbol)


def _interruptions(history: JournalHistory, axis: Axis) -> Iterator[Words]:
    events = [entry.event for entry in history.entries]
    lost = sum(isinstance(event, ZeroLost | DatumMoved) for event in events)
    resumed = sum(isinstance(event, CaptureResumed) for event in events)
    if resumed > lost:
        yield Words(
            en="The capture was interrupted and went on (interruptions: {count}).",
            de="Die Erfassung wurde unterbrochen und fortgesetzt (Unterbrechungen: {count}).",
        ).given(count=resumed - lost)
    held = [abs(event.difference) for event in events if isinstance(event, DatumHolds)]
    if held:
        yield Words(
            en="After an interruption the datum was held against an earlier reading; largest difference: "
            "{difference} {unit}.",
            de="Nach einer Unterbrechung wurde der Bezug an einem früheren Messwert geprüft; größte "
            "Differenz: {difference} {unit}.",
        ).given(difference=axis.deviation_unit.from_si(max(held)), unit=axis.deviation_unit.symbol)
    if lost:
        yield Words(
            en="The instrument's zero was lost (times: {count}). What it showed from then on, until the "
            "datum was taken anew, is not used.",
            de="Der Nullpunkt des Messgeräts ging verloren (Anzahl: {count}). Was es von da an bis zum neuen "
            "Bezug anzeigte, ist nicht verwendet.",
        ).given(count=lost)


def _repetitions(parts: Sequence[Part]) -> Iterator[Words]:
    for part in parts:
        if part.attempts > 1:
            yield Words(
                en="Part {part} of the test (a run, or all of it) was taken {attempts} times, each "
                "time from a datum of its own; attempt {attempt}, the most complete, counts; {left_out} "
                "readings of the others stay in the journal.",
                de="Teil {part} der Messung (ein Durchlauf oder die ganze) wurde {attempts}-mal aufgenommen, "
                "jedes Mal mit eigenem Bezug; Versuch {attempt}, der vollständigste, zählt; {left_out} "
                "Messwerte der anderen bleiben im Protokoll.",
            ).given(part=part.number, attempts=part.attempts, attempt=part.attempt, left_out=part.left_out)
