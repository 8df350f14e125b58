"""What the page of a capture shows: the visits and their readings, the present moment, what is to be done."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from zlmreport import pipeline
from zlmreport.errors import InputError, ZlmreportError
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.language import Language
from zlmreport.language.formatting import write_percentage
from zlmreport.live.capture.events import Recorded, Resumed, Unclear
from zlmreport.live.capture.journal import History, read_history
from zlmreport.live.capture.of_job import Assignment, find_options_of, make_assignment_of
from zlmreport.live.capture.operator_texts import (
    WORTH_NAMING,
    AxisWriter,
    CaptureLine,
    list_what_to_do,
    say_halted,
    tell_event,
    write_candidate,
)
from zlmreport.live.capture.progress import Progress
from zlmreport.live.capture.records import Record, from_record
from zlmreport.measurement.units import SECONDS_PER_MINUTE
from zlmreport.model.planning.plan import propose
from zlmreport.plugin.registry import Registry
from zlmreport.web.bench import PLACE, Bench
from zlmreport.web.capturing import CaptureProcess, CaptureRequest
from zlmreport.web.watched import make_stamp_of


@dataclass(slots=True)
class CapturePage:
    """The capture of a job, as its page sees it."""

    path: Path  #: The job file.
    registry: Registry
    process: CaptureProcess
    _known: tuple[Job, Assignment] | None = None
    #: The files behind it, and their state when they were read.
    _watched: tuple[tuple[Path, ...], str] = ((), "")

    @classmethod
    def of(cls, bench: Bench, plugins: Sequence[Path] = ()) -> CapturePage:
        """Return the capture of the job on a bench, at rest."""
        return cls(bench.path, bench.registry, CaptureProcess(bench.path, plugins))

    def is_awaited(self) -> bool:
        """Tell whether the readings of the job come from a live instrument, and are not all there."""
        try:
            found = self._find_assignment()
        except ZlmreportError:
            return False  # what is wrong with the job is said where it is read
        return found is not None and not _find_progress(found[1], _read_history(found[1])).is_over

    def carry_out(self, request: CaptureRequest) -> None:
        """Do what a click asks for.

        Raises `InputError` if the job is not captured live, or there is nothing of that kind to do.
        """
        found = self._find_assignment()
        if found is None:
            raise InputError.at(PLACE, "the readings of this job are not captured from a live instrument")
        history = _read_history(found[1])
        self.process.carry_out(request, has_begun=history is not None and history.has_readings)

    def list_values(self, language: Language) -> dict[str, Any]:
        """Return what the page shows; only that nothing is captured, where the job names no instrument."""
        found = self._find_assignment()
        if found is None:
            return {"isCaptured": False}
        job, assignment = found
        history, state = _read_history(assignment), self.process.describe_state()
        progress, writer = _find_progress(assignment, history), AxisWriter(language, job.axis)
        rest = assignment.estimate_remaining_time(progress.taken)
        return {
            "isCaptured": True,
            "isOver": progress.is_over and not state["runs"],
            "hasBegun": history is not None and history.has_readings,
            "runs": state["runs"],
            "number": job.keys.certificate.number,
            "subject": job.axis.subject.in_language(language),
            "file": self.path.name,
            "journal": assignment.options.journal.name,
            "visits": list(_list_rows(progress, history, writer)),
            "next": None if progress.is_over or progress.has_all else progress.next.number,
            "taken": progress.taken,
            "minutes": round(rest / SECONDS_PER_MINUTE),
            "steps": []
            if progress.is_over
            else list(map(_write_sentence, list_what_to_do(progress, writer))),
            "moment": _show_moment(state["now"], progress, assignment, writer),
            "asked": _show_question(state["asked"], progress, writer),
            "lines": list(_list_lines(state["events"], progress, writer)),
            "problems": state["problems"],
        }

    def _find_assignment(self) -> tuple[Job, Assignment] | None:
        """Return the job and what it asks to be captured; None if it names no live instrument."""
        files, stamp = self._watched
        if self._known is None or make_stamp_of(files) != stamp:
            job = load(self.path, self.registry)
            if find_options_of(job) is None or job.source.instrument is None:
                return None
            plan = propose(job, pipeline.choose_standards(job, self.registry)).plan
            files = tuple(each.path for each in job.files if each.path is not None)
            self._watched = files, make_stamp_of(files)
            self._known = job, make_assignment_of(job, plan)
        return self._known


def _read_history(assignment: Assignment) -> History | None:
    path = assignment.options.journal
    return read_history(path) if path.exists() else None


def _find_progress(assignment: Assignment, history: History | None) -> Progress:
    return history.progress if history else Progress.begin(assignment.visits, assignment.datum)


def _list_rows(progress: Progress, history: History | None, writer: AxisWriter) -> Iterator[dict[str, Any]]:
    """Yield the visits in their order, each with the reading that counts."""
    events = [each.event for each in history.entries] if history else []
    read = {each.visit.number: each for each in events if isinstance(each, Recorded)}
    for visit in progress.visits:
        number = visit.number
        reading = read.get(number) if number in progress.filed else None
        yield {
            "number": number,
            "run": visit.run,
            "arrow": visit.approach.arrow,
            "target": writer.write_position(visit.position),
            "deviation": writer.write_deviation(reading.deviation) if reading else "",
            "range": writer.write_small_length(reading.mean.range) if reading else "",
            "state": _describe_state(number, progress, is_read=reading is not None),
        }


def _describe_state(number: int, progress: Progress, *, is_read: bool) -> str:
    if not (progress.is_over or progress.has_all) and number == progress.next.number:
        return "next"
    if is_read:
        return "taken"
    if number in progress.skipped:
        return "skipped"
    return "open" if number > progress.taken else "missed"


def _show_moment(
    now: dict[str, Any] | None, progress: Progress, assignment: Assignment, writer: AxisWriter
) -> dict[str, Any] | None:
    """Return what the instrument shows now; nothing as long as it does not run."""
    if now is None:
        return None
    # What is shown with a fault is no place of the axis.
    position, still = (None, 0.0) if now["message"] else (now["position"], now["still"])
    away = None if position is None else position - progress.destination
    is_near = away is not None and abs(away) <= assignment.settings.tolerance
    return {
        "position": None if position is None else writer.write_position(position, 4),
        "deviation": writer.write_deviation(away) if away is not None and is_near else None,
        "toGo": writer.write_position(-away) if away is not None and not is_near else None,
        "range": writer.write_small_length(now["range"]) if still and now["range"] is not None else None,
        "still": min(1.0, still / assignment.settings.still),
        "message": now["message"],
    }


def _list_lines(
    records: Iterable[Record], progress: Progress, writer: AxisWriter
) -> Iterator[dict[str, str]]:
    """Yield what has happened, each by its name and in words; a line of none that is known as it was said."""
    for record in records:
        try:
            line = tell_event(from_record(record, progress.visits), len(progress.visits), writer)
        except KeyError:
            line = CaptureLine("", str(record["line"]))
        if line is not None:
            yield {"name": line.name, "text": line.text}


def _show_question(asked: Record | None, progress: Progress, writer: AxisWriter) -> dict[str, Any] | None:
    """Return what the capture waits for, with the answers that may be given."""
    if asked is None:
        return None
    event = None if asked["event"] is None else from_record(asked["event"], progress.visits)
    is_question = isinstance(event, Unclear)
    return {
        "message": _write_sentence(say_halted(event, writer)),
        "steps": []
        if is_question
        else list(map(_write_sentence, list_what_to_do(progress.take_event(Resumed()), writer, event))),
        "choices": list(_list_choices(event, writer)) if isinstance(event, Unclear) else [],
    }


def _list_choices(question: Unclear, writer: AxisWriter) -> Iterator[dict[str, str]]:
    """Yield the visits that an unclear stop may be, and what is answered for each."""
    for visit, share in question.candidates:
        if share >= WORTH_NAMING:
            shown = write_percentage(share, writer.language.decimal_sign)
            label = writer.say(write_candidate(visit, shown))
            yield {"label": label, "answer": str(visit.number) if visit else "none"}


def _write_sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."
