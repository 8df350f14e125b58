"""``zlmreport fleet``: a night, with its log (text or JSON), progress, forecast, summary and exit code."""

from __future__ import annotations

import contextlib
import datetime as dt
import json
import math
import shutil
import signal
import sys
import time
from argparse import Namespace
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self, TextIO

from zlmreport.cli.terminal import collect_problem, make_visible, print_json, show_path, write_duration
from zlmreport.errors import INCOMPLETE, AccessError, InputError, Place
from zlmreport.files import confine
from zlmreport.fleet.issuing import Happened, What
from zlmreport.fleet.night import Order, foretell, read_steady_clock, spend_night
from zlmreport.fleet.plan import Due, PlannedJob
from zlmreport.fleet.records import NightNotice
from zlmreport.job.fleet import FleetFile, load_fleet
from zlmreport.language import Language
from zlmreport.measurement.units import SECONDS_PER_MINUTE
from zlmreport.plugin.registry import find_plugins
from zlmreport.version import __version__

SCHEMA = "zlmreport/night/1"

INTERRUPTED = 128 + signal.SIGINT
#: What the bar counts: jobs that were due.
_COUNTED = frozenset(What) - {What.UNCHANGED, What.VANISHED, What.OVERDUE, What.LEFT}
#: What there should be, and is not.
_NOT_DONE = (What.FAILED, What.SET_ASIDE, What.VANISHED, What.LEFT)


def run(options: Namespace) -> int:
    """Make what is due of a fleet, or say what that is, and return the exit code."""
    fleet = load_fleet(options.fleet, extensions=lambda: find_plugins(files=options.plugin).extensions)
    if options.workers and fleet.keys.executor.kind == "dask":
        raise InputError.at(Place("zlmreport fleet --workers"), "a scheduler has the workers that it has")
    with confine(fleet.keys.confine):
        return _run(fleet, options)


def _run(fleet: FleetFile, options: Namespace) -> int:
    plugins = tuple(options.plugin)
    if options.dry_run:
        return _foretell(fleet, plugins, options)
    with _open_logs(fleet, options) as logs:
        watcher = _Watcher(fleet, logs, options)
        seconds = math.inf if options.max_time is None else SECONDS_PER_MINUTE * options.max_time
        with _let_signals_interrupt(), watcher:
            spend_night(fleet, Order(plugins, options.workers, seconds), watcher)
    if options.json:
        print_json(_summarise(fleet, watcher, watcher.exit_code))
    return watcher.exit_code


@contextlib.contextmanager
def _let_signals_interrupt() -> Iterator[None]:
    """Let a signal to end be an interruption, so that the night still says what it came to."""

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


class _Watcher:
    """Writes the logs, shows the bar, and counts."""

    def __init__(self, fleet: FleetFile, logs: Sequence[TextLog | JsonLog], options: Namespace) -> None:
        self.counts: Counter[What] = Counter()
        self.jobs: list[dict[str, Any]] = []
        self.priors: list[str] = []
        self._fleet = fleet
        self._logs = logs
        self._options = options
        self._begun = read_steady_clock()
        self.notices: list[NightNotice] = []
        self._progress = NightProgress(sys.stderr, 0)

    @property
    def exit_code(self) -> int:
        """What the shell is told."""
        return INCOMPLETE if self.notices or any(self.counts[what] for what in _NOT_DONE) else 0

    def note_notice(self, notice: NightNotice) -> None:
        self.notices.append(notice)
        self._progress.hide()
        for log in self._logs:
            log.write_notice(notice)
        if self._options.quiet or self._options.json:
            print(make_visible(f"{self._fleet.path}: {notice.english}"), file=sys.stderr)

    def note_priors(self, file: Path) -> None:
        self.priors.append(show_path(file))
        self._progress.hide()
        for log in self._logs:
            log.write_priors(show_path(file))

    def note_plan(self, jobs: Sequence[PlannedJob]) -> None:
        due = sum(each.due is not Due.NOTHING for each in jobs)
        for log in self._logs:
            log.write_beginning(self._fleet.name, due, len(jobs))
        if not self._options.quiet:
            self._progress = NightProgress(sys.stderr, due)

    def note_happened(self, happened: Happened) -> None:
        self.counts[happened.what] += 1
        if self._options.json:
            self.jobs.append({"what": happened.what.value, **_collect_of_job(happened)})
        if happened.what is What.UNCHANGED:
            return
        self._progress.hide()
        for log in self._logs:
            log.write_happened(happened)
        if self._options.quiet or self._options.json:
            for problem in happened.problems:
                print(make_visible(str(problem)), file=sys.stderr)
        if happened.what in _COUNTED:
            self._progress.advance(failed=happened.what is What.FAILED)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Take the bar away, and say what the night came to, even if it was told to end."""
        self._progress.hide()
        is_interrupted = isinstance(error, KeyboardInterrupt)
        for log in self._logs if error is None or is_interrupted else ():
            log.write_end(self.counts, read_steady_clock() - self._begun, is_interrupted=is_interrupted)
        if is_interrupted and self._options.json:
            print_json(_summarise(self._fleet, self, INTERRUPTED))


@contextlib.contextmanager
def _open_logs(fleet: FleetFile, options: Namespace) -> Iterator[Sequence[TextLog | JsonLog]]:
    """Yield the logs: one for whoever is there, and that of the fleet file."""
    logs: list[TextLog | JsonLog] = []
    if options.log_json:
        logs.append(JsonLog(sys.stderr if options.json else sys.stdout))
    elif not (options.quiet or options.json):
        logs.append(TextLog(sys.stdout))
    keys = fleet.keys.log
    if keys is None:
        yield logs
        return
    try:
        keys.file.parent.mkdir(parents=True, exist_ok=True)
        file = keys.file.open("a", encoding="utf-8")
    except OSError as error:
        raise AccessError.at(
            fleet.place_of("log", "file"), f"{keys.file} cannot be written: {error.strerror or error}"
        ) from error
    with file:
        yield [*logs, JsonLog(file) if keys.format == "json" else TextLog(file)]


def _summarise(fleet: FleetFile, watcher: _Watcher, code: int) -> dict[str, Any]:
    """Return what became of every job, for programs."""
    return {
        "schema": SCHEMA,
        "zlmreport": __version__,
        "fleet": fleet.name,
        "exit_code": code,
        "counts": _count_by_word(watcher.counts),
        "jobs": watcher.jobs,
        "notices": [{"about": each.about.value, "message": each.english} for each in watcher.notices],
        "priors": watcher.priors,
    }


_FORETOLD = {
    Due.CERTIFICATE: "would be made",
    Due.COMPARISON: "would be made anew, and be a draft if it differs from what was issued",
    Due.REFUSAL: "would fail",
    Due.SET_ASIDE: "is set aside, and would not be tried",
}


def _foretell(fleet: FleetFile, plugins: tuple[Path, ...], options: Namespace) -> int:
    planned = foretell(fleet, plugins)
    due = [each for each in planned if each.due is not Due.NOTHING]
    if options.json:
        jobs = [
            {
                "due": each.due.value,
                "job": each.job,
                "number": each.number or None,
                "why": each.why or None,
                "problems": [collect_problem(problem) for problem in each.problems],
            }
            for each in planned
        ]
        print_json({"schema": SCHEMA, "zlmreport": __version__, "fleet": fleet.name, "due": jobs})
        return 0
    for each in due:
        number = f"{each.number}  " if each.number else ""
        print(make_visible(f"{number}{each.job}: {each.why}; {_FORETOLD[each.due]}"))
        for problem in each.problems:
            print(make_visible(f"  {problem}"))
    if not options.quiet:
        print(f"{_count_due(len(due), len(planned))}; nothing was made")
    return 0


_WORD = 9
_BAR, _USUAL_WIDTH = 30, 80


def _count_due(number: int, jobs: int) -> str:
    jobs_are = "1 job is" if jobs == 1 else f"{jobs} jobs are"
    return f"{number} of {jobs_are} due"


class TextLog:
    """Lines for people."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._upgraded = 0

    def write_beginning(self, fleet: str, due: int, jobs: int) -> None:
        """Write what is due."""
        self._write_line(f"{fleet}: {_count_due(due, jobs)}")

    def write_happened(self, happened: Happened) -> None:
        """Write what happened to a job; nothing of one that is as it was, also after a new release."""
        if happened.is_upgrade:
            self._upgraded += 1
        if happened.what is What.UNCHANGED or happened.is_upgrade:
            return
        why = f": {happened.why}" if happened.why else ""
        number = f"{happened.number}  " if happened.number else ""
        limits = "; a limit is not met" if happened.conforms is False else ""
        self._write_line(f"{happened.what.value:{_WORD}} {number}{happened.job}{why}{limits}")
        for each in (*happened.problems, *(doubt.in_language(Language.ENGLISH) for doubt in happened.doubts)):
            self._write_line(f"{'':{_WORD}}   {each}")

    def write_notice(self, notice: NightNotice) -> None:
        """Write what concerns the whole night."""
        self._write_line(notice.english)

    def write_priors(self, file: str) -> None:
        """Write which file of priors is new."""
        self._write_line(f"{'learned':{_WORD}} {file}: for model.priors of the next tests")

    def write_end(self, counts: Counter[What], seconds: float, *, is_interrupted: bool = False) -> None:
        """Write what the night came to."""
        done = "interrupted after" if is_interrupted else "done in"
        if self._upgraded:
            self._write_line(
                f"programs changed: {self._upgraded} made again, and none of their values changed"
            )
        self._write_line(f"{done} {write_duration(seconds)}: {', '.join(_tell_counted(counts)) or 'no jobs'}")

    def _write_line(self, text: str) -> None:
        moment = dt.datetime.now().astimezone().isoformat(sep=" ", timespec="seconds")
        print(f"{moment}  {make_visible(text)}", file=self._stream, flush=True)


class JsonLog:
    """Lines of JSON."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write_beginning(self, fleet: str, due: int, jobs: int) -> None:
        """Write what is due."""
        self._write_line({"event": "begun", "fleet": fleet, "due": due, "jobs": jobs})

    def write_happened(self, happened: Happened) -> None:
        """Write what happened to a job; nothing of one that is as it was."""
        if happened.what is not What.UNCHANGED:
            self._write_line({"event": happened.what.value, **_collect_of_job(happened)})

    def write_notice(self, notice: NightNotice) -> None:
        """Write what concerns the whole night."""
        self._write_line({"event": "noticed", "about": notice.about.value, "message": notice.english})

    def write_priors(self, file: str) -> None:
        """Write which file of priors is new."""
        self._write_line({"event": "learned", "file": file})

    def write_end(self, counts: Counter[What], seconds: float, *, is_interrupted: bool = False) -> None:
        """Write what the night came to."""
        event = "interrupted" if is_interrupted else "ended"
        self._write_line({"event": event, "seconds": round(seconds, 1), "counts": _count_by_word(counts)})

    def _write_line(self, content: Mapping[str, Any]) -> None:
        moment = dt.datetime.now(dt.UTC).isoformat(timespec="milliseconds")
        print(json.dumps({"time": moment, **content}), file=self._stream, flush=True)


def _collect_of_job(happened: Happened) -> dict[str, Any]:
    """Return what happened to a job, for programs."""
    return {
        "job": happened.job,
        "number": happened.number or None,
        "why": happened.why or None,
        "files": list(happened.files),
        "conforms": happened.conforms,
        "doubts": [each.in_language(Language.ENGLISH) for each in happened.doubts],
        "problems": [collect_problem(each) for each in happened.problems],
    }


def _count_by_word(counts: Counter[What]) -> dict[str, int]:
    """Return how often each thing happened, the rarest too."""
    return {what.value: counts[what] for what in What}


def _tell_counted(counts: Counter[What]) -> Iterator[str]:
    """Yield how often each thing happened, for people."""
    words = {What.DRAFT: "drafts"}
    for what in What:
        if counts[what]:
            word = words.get(what, what.value) if counts[what] > 1 else what.value
            yield f"{counts[what]} {word}"


class NightProgress:
    """A bar in the last line of a terminal; on any other stream there is none."""

    def __init__(self, stream: TextIO, total: int) -> None:
        self._stream = stream
        self._total = total
        self._done = self._failed = 0
        self._begun = time.monotonic()
        self._is_shown = stream.isatty() and total > 0
        self._draw()

    def hide(self) -> None:
        """Make room for a line."""
        if self._is_shown:
            print("\r\x1b[K", end="", file=self._stream, flush=True)

    def advance(self, *, failed: bool) -> None:
        """Count a certificate, and show the bar again."""
        self._done += 1
        self._failed += failed
        self._draw()

    def _draw(self) -> None:
        if self._is_shown:
            width = shutil.get_terminal_size((_USUAL_WIDTH, 0)).columns
            line = draw_bar(self._done, self._total, self._failed, time.monotonic() - self._begun)
            print(f"\r\x1b[K{line[: width - 1]}", end="", file=self._stream, flush=True)


def draw_bar(done: int, total: int, failed: int, seconds: float) -> str:
    """Return the bar.

    >>> draw_bar(30, 120, 1, 10.0)
    ' 30/120 [#######.......................]  3.0/s, 30 s left, 1 failed'
    """
    filled = done * _BAR // total
    text = f"{done:>{len(str(total))}}/{total} [{'#' * filled}{'.' * (_BAR - filled)}]"
    if done and seconds > 0:
        rate = done / seconds
        text += f"  {rate:.{1 if rate >= 1 else 2}f}/s, {write_duration((total - done) / rate)} left"
    return f"{text}, {failed} failed" if failed else text
