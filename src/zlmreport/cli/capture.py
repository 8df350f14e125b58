"""``zlmreport capture``: readings into a journal, on after a loss of line or datum; what ``check`` says."""

from __future__ import annotations

import datetime as dt
import json
import time
from argparse import Namespace
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain
from pathlib import Path

from zlmreport import pipeline
from zlmreport.cli.capture_display import (
    JsonLines,
    LiveDisplay,
    PlainLines,
    SteeredLines,
    is_watched,
    read_visit,
)
from zlmreport.cli.jobs import tell_requirements
from zlmreport.cli.terminal import Colour, make_visible, show_path
from zlmreport.document.certificate.clauses import demand_mandatory_items
from zlmreport.document.writer import Writer
from zlmreport.errors import AccessError, InputError, Place, count_in_words
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.language import Language
from zlmreport.live.capture.events import DatumMoved, Ended, Event, Interrupted, Resumed, Unclear, ZeroLost
from zlmreport.live.capture.follower import Follower
from zlmreport.live.capture.journal import (
    History,
    Journal,
    capture as captured,
    demand_at_rest,
    demand_nothing_captured,
    read_history,
)
from zlmreport.live.capture.of_job import (
    Assignment,
    demand_same_test,
    find_instrument_of,
    find_options_of,
    make_assignment_of,
    make_header_of,
)
from zlmreport.live.ports.ahead import ReadAhead
from zlmreport.live.ports.reading import LiveReading
from zlmreport.model.planning.plan import make_as_measured, propose
from zlmreport.plugin.extending import Happening, LiveRun
from zlmreport.plugin.protocols import Connection
from zlmreport.plugin.registry import Registry, find_plugins

_RETAKE = Place("--retake")
#: Within so many seconds two clocks are read together; how often it is tried.
_TOGETHER, _TRIES = 1e-3, 100


@dataclass(frozen=True, slots=True)
class TypedAnswers:
    """What the operator says beforehand, empty for nothing."""

    answer: str = ""  #: To the question that the last sitting ended with: the number of a visit, or ``none``.
    retake: str = ""  #: What is taken again: the number of a visit, or ``run`` and that of a run.


def run(options: Namespace) -> int:
    """Capture the test of a job, go on with it, or close it."""
    if options.end and options.resume:
        raise InputError.at(
            Place("zlmreport capture"), "--resume goes on and --end closes the capture: take one of them"
        )
    if options.end and options.retake:
        raise InputError.at(
            Place("zlmreport capture"), "--retake goes on and --end closes the capture: take one of them"
        )
    if options.answer and not options.resume:
        raise InputError.at(Place("zlmreport capture"), "--answer belongs to --resume: state both")
    registry = find_plugins(files=options.plugin)
    job = load(options.job, registry).line(options.test, Place("zlmreport capture --test"))
    for choice in job.extensions:
        live = registry.extension(choice.identifier).live(job, choice.options)
        if live:
            return _run_live(live, options)
    if options.journal:
        job = _replace_journal(job, options.journal)
    asked = _find_assignment(job, registry)
    if options.end:
        _close(job, asked, options.job)
        return 0
    display = _choose_display(options)(job, asked)
    resume = options.resume or bool(options.retake)
    words = TypedAnswers(options.answer, options.retake)
    capture(job, asked, registry, display, options.job, resume=resume, words=words)
    if not (options.json or options.steered):
        print(f"next: zlmreport {show_path(options.job)}")
    return 0


def _choose_display(options: Namespace) -> type[PlainLines]:
    if options.steered:
        return SteeredLines
    if options.json:
        return JsonLines
    return LiveDisplay if is_watched() else PlainLines


def _run_live(live: LiveRun, options: Namespace) -> int:
    """Let an extension take what is missing; the same command goes on where it ended."""
    wrong = next((name for name in ("end", "journal", "retake") if getattr(options, name)), None)
    if wrong:
        raise InputError.at(
            Place("zlmreport capture"), f"--{wrong} is of no use {live.without_journal}; leave it out"
        )
    if options.json:
        live.run(lambda happening: print(json.dumps(happening.values), flush=True))
        return 0
    print(live.heading, flush=True)
    result = live.run(_tell)
    print(show_path(result))
    print(f"next: zlmreport {show_path(options.job)}")
    return 0


def _tell(happening: Happening) -> None:
    line = make_visible(happening.line)
    print(f"  {Colour.YELLOW.set(happening.warning)}  {line}" if happening.warning else line, flush=True)


def _replace_journal(job: Job, journal: Path) -> Job:
    """Return a job with another journal; the data source says later if it has none."""
    options = find_options_of(job)
    if options is None:
        return job
    named = options.model_copy(update={"journal": journal})
    return replace(job, source=replace(job.source, options=named))


def _close(job: Job, asked: Assignment, path: Path) -> None:
    """Close the journal of a job; its instrument is not needed for that."""
    _demand_own_journal(job, asked)
    with Journal.resume(asked.options.journal) as journal:
        taken, visits = journal.progress.taken, len(journal.progress.visits)
        journal.append(Ended(), journal.elapsed)
    print(f"closed after {taken} of {count_in_words(visits, 'visit')}; what was not taken is missing")
    print(f"next: zlmreport {show_path(path)}")


def _find_assignment(job: Job, registry: Registry) -> Assignment:
    """Return what a job asks to be captured; raise `InputError` if it is nothing, or makes no sense."""
    return make_assignment_of(job, propose(job, pipeline.choose_standards(job, registry)).plan)


def awaits_capture(job: Job) -> bool:
    """Tell whether the readings of a job are captured live, and are not all there yet."""
    if find_options_of(job) is None:
        return False
    history = _read_history(job)
    return history is None or not history.progress.is_over


def demand_capturable(job: Job, registry: Registry) -> None:
    """Refuse a job whose certificate would lack something, or whose capture makes no sense."""
    demand_mandatory_items(job)
    _find_assignment(job, registry)
    find_instrument_of(job)


def tell_planned(path: Path, job: Job, registry: Registry) -> Iterator[str]:
    """Yield the lines on a job that awaits its capture: what its standards ask of the test as planned."""
    plan = _find_assignment(job, registry).plan
    test = make_as_measured(job.axis, plan.method, plan.targets, plan.runs)
    writer = Writer.of(test, Language.ENGLISH)
    yield f"{Colour.BOLD.set(str(path))}  the job is sound; its readings are still to be captured"
    for standard, options in pipeline.choose_standards(job, registry):
        yield from tell_requirements(standard.designation, standard.requirements(test, options), writer)
    history = _read_history(job)
    if history is not None and history.is_being_written:
        visits = count_in_words(len(history.progress.visits), "visit")
        yield f"  a capture is at work on it: {history.progress.taken} of {visits}"
        return
    yield f"  next: zlmreport capture {show_path(path)}{' --resume' if _has_begun(job) else ''}"


def capture_if_watched(job: Job, registry: Registry, path: Path) -> None:
    """Capture what a job awaits if somebody sits at the terminal; if not, its data source says what to do."""
    if not is_watched() or job.source.instrument is None or not awaits_capture(job):
        return
    asked = _find_assignment(job, registry)
    capture(job, asked, registry, LiveDisplay(job, asked), path, resume=_has_begun(job))


def _has_begun(job: Job) -> bool:
    history = _read_history(job)
    return history is not None and history.has_readings


def _read_history(job: Job) -> History | None:
    options = find_options_of(job)
    if options is None or not options.journal.exists():
        return None
    return read_history(options.journal)


def capture(  # noqa: PLR0913 - whom, what, with what, shown where, and how to go on
    job: Job,
    assignment: Assignment,
    registry: Registry,
    display: PlainLines,
    path: Path,
    *,
    resume: bool,
    words: TypedAnswers = TypedAnswers(),
) -> None:
    """Capture the test of a job to its end.

    Raises `AccessError` if the instrument or the journal fails, or there is no operator to see to something;
    with how to go on.
    """
    demand_at_rest(assignment.options.journal)  # before the instrument, which is in its hands
    if resume:
        _demand_own_journal(job, assignment, words)
        _demand_answer(assignment, words.answer)
    else:
        demand_nothing_captured(assignment.options.journal)
    choice = find_instrument_of(job)
    with registry.instrument(choice.identifier).open(choice.options) as connection:
        display.wait()
        readings = ReadAhead(connection.readings())
        first = next(readings)  # an instrument that is not there leaves no journal
        with _open_journal(job, assignment, resume=resume, words=words) as journal:
            try:
                _follow_sittings(readings, first, connection, assignment, journal, display)
            except KeyboardInterrupt:
                journal.append(Interrupted("ended by the user"), _measure_elapsed(journal))
                display.leave(f"ended; go on with: {_name_command_to_go_on(path, journal)}")
                raise
            except AccessError as error:
                problem = error.problems[0]
                journal.append(Interrupted(problem.message), _measure_elapsed(journal))
                message = f"{problem.message}; go on with: {_name_command_to_go_on(path, journal)}"
                raise AccessError.at(problem.place, message) from error


def _name_command_to_go_on(path: Path, journal: Journal) -> str:
    """Return what goes on with a capture; of one that has read nothing there is nothing to resume."""
    has_begun = journal.visited is not None or journal.progress.question is not None
    return f"zlmreport capture {show_path(path)}{' --resume' if has_begun else ''}"


def _demand_own_journal(job: Job, assignment: Assignment, words: TypedAnswers = TypedAnswers()) -> None:
    """Refuse to go on with a journal of another job, or with a capture that is over and stays so."""
    path = assignment.options.journal
    history = read_history(path)
    if history is None:
        return
    demand_same_test(history, job, assignment, Place(str(path)))
    if words.retake:
        history.progress.make_retake(words.retake, _RETAKE)
    elif history.progress.is_over:
        raise AccessError.at(
            Place(str(path)),
            "the capture is finished: there is nothing to go on with; --retake takes a visit or a run again",
        )


def _demand_answer(assignment: Assignment, answer: str) -> None:
    """Refuse an answer where there is no question, or that names no visit."""
    if not answer:
        return
    history = read_history(assignment.options.journal)
    if history is None or history.progress.question is None:
        raise InputError.at(Place("--answer"), "no question is open; leave it out")
    read_visit(answer, history.progress, Place("--answer"))


def _open_journal(job: Job, assignment: Assignment, *, resume: bool, words: TypedAnswers) -> Journal:
    path = assignment.options.journal
    if not resume:
        return Journal.begin(path, make_header_of(job, assignment, dt.datetime.now(dt.UTC)))
    journal = Journal.resume(path)
    if words.answer:
        visit = read_visit(words.answer, journal.progress, Place("--answer"))
        now = _measure_elapsed(journal)
        for event in Follower(journal.progress, assignment.settings).take_answer(visit, now - journal.asked):
            journal.append(event, now)
    journal.append(Resumed(), _measure_elapsed(journal))
    if words.retake:
        journal.append(journal.progress.make_retake(words.retake, _RETAKE), _measure_elapsed(journal))
    return journal


def _follow_sittings(  # noqa: PLR0913, PLR0917 - of what, where to begin, and who is told
    readings: ReadAhead,
    first: LiveReading,
    connection: Connection,
    assignment: Assignment,
    journal: Journal,
    display: PlainLines,
) -> None:
    """Follow the axis until the test is over; between two sittings the operator sees to what went wrong."""
    while not journal.progress.is_over:
        clock = _make_clock(journal)
        follower = Follower(journal.progress, assignment.settings, last=_find_last_visit(journal, clock))
        display.begin(follower)
        show = partial(display.show, follower)
        event: Event | None = None
        try:
            with display.take_keys():
                for event in captured(chain([first], readings), follower, journal, clock, show=show):
                    display.tell(event)
        except BaseException:
            readings.give_up()
            raise
        readings.end()  # what comes while the operator sees to something is of no matter
        if journal.progress.is_over:
            if isinstance(event, ZeroLost | DatumMoved):
                display.leave("the datum is gone; all visits were taken before, and their readings stay")
            return
        if isinstance(event, Unclear):
            for each in follower.take_answer(display.ask(event, journal.progress)):
                journal.append(each, _measure_elapsed(journal))
                display.tell(each)
            if journal.progress.is_over:
                return
        else:
            display.see_to(event, journal.progress.take_event(Resumed()))
        journal.append(Resumed(), _measure_elapsed(journal))
        readings = ReadAhead(connection.readings())
        first = next(readings)


def _find_last_visit(journal: Journal, clock: Callable[[float], float]) -> float | None:
    """Return when the last visit was, by the clock of the readings: the program may have run on since."""
    if journal.visited is None or journal.progress.zero is None:
        return None
    return journal.visited - clock(0.0)


def _make_clock(journal: Journal) -> Callable[[float], float]:
    """Return the way from the time of a reading to s from the start of the capture.

    Within a sitting it is the steady clock of the readings that counts: the clock of the computer may be set.
    Both clocks are read together: where the computer did something else in between, once more.
    """
    for _ in range(_TRIES):
        before = time.monotonic()
        elapsed = _measure_elapsed(journal)
        if time.monotonic() - before < _TOGETHER:
            break
    offset = elapsed - before
    return lambda moment: moment + offset


def _measure_elapsed(journal: Journal) -> float:
    return max(journal.elapsed, (dt.datetime.now(dt.UTC) - journal.header.started).total_seconds())
