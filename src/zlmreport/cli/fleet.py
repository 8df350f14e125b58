"""A night of a fleet: what is due is made, and said."""

from __future__ import annotations

import contextlib
import math
import signal
import sys
import time
from argparse import Namespace
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from zlmreport.cli.fleet_log import JsonLog, Progress, TextLog, by_word, of_job
from zlmreport.cli.terminal import print_json, shown_path, visible
from zlmreport.errors import AccessError, InputError, Place
from zlmreport.files import confined
from zlmreport.fleet.issuing import Happened, What
from zlmreport.fleet.night import Order, foretell, spend
from zlmreport.fleet.plan import Due, Planned
from zlmreport.fleet.records import Notice
from zlmreport.job.fleet import FleetFile, load_fleet
from zlmreport.plugins import find_plugins
from zlmreport.version import __version__

SCHEMA = "zlmreport/night/1"

_FAILED = 4
_MINUTE = 60
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
    with confined(fleet.keys.confine):
        return _run(fleet, options)


def _run(fleet: FleetFile, options: Namespace) -> int:
    plugins = tuple(options.plugin)
    if options.dry_run:
        return _foretell(fleet, plugins, options)
    with _logs(fleet, options) as logs:
        watcher = _Watcher(fleet, logs, options)
        seconds = math.inf if options.max_time is None else _MINUTE * options.max_time
        with _told_to_end(), watcher:
            spend(fleet, Order(plugins, options.workers, seconds), watcher)
    if options.json:
        print_json(_summary(fleet, watcher, watcher.exit_code))
    return watcher.exit_code


@contextlib.contextmanager
def _told_to_end() -> Iterator[None]:
    """Let a signal to end be an interruption, so that the night still says what it came to."""

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, interrupted)
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
        self._begun = time.monotonic()
        self._notices: list[Notice] = []
        self._progress = Progress(sys.stderr, 0)

    @property
    def exit_code(self) -> int:
        """What the shell is told."""
        return _FAILED if self._notices or any(self.counts[what] for what in _NOT_DONE) else 0

    def noticed(self, notice: Notice) -> None:
        self._notices.append(notice)
        self._progress.hide()
        for log in self._logs:
            log.noticed(notice)
        if self._options.quiet or self._options.json:
            print(visible(f"{self._fleet.path}: {notice.text}"), file=sys.stderr)

    def learned(self, file: Path) -> None:
        self.priors.append(shown_path(file))
        self._progress.hide()
        for log in self._logs:
            log.learned(shown_path(file))

    def planned(self, jobs: Sequence[Planned]) -> None:
        due = sum(each.due is not Due.NOTHING for each in jobs)
        for log in self._logs:
            log.begun(self._fleet.name, due, len(jobs))
        if not self._options.quiet:
            self._progress = Progress(sys.stderr, due)

    def happened(self, happened: Happened) -> None:
        self.counts[happened.what] += 1
        if self._options.json:
            self.jobs.append({"what": happened.what.value, **of_job(happened)})
        if happened.what is What.UNCHANGED:
            return
        self._progress.hide()
        for log in self._logs:
            log.happened(happened)
        if self._options.quiet or self._options.json:
            for problem in happened.problems:
                print(visible(str(problem)), file=sys.stderr)
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
            log.ended(self.counts, time.monotonic() - self._begun, is_interrupted=is_interrupted)
        if is_interrupted and self._options.json:
            print_json(_summary(self._fleet, self, INTERRUPTED))


@contextlib.contextmanager
def _logs(fleet: FleetFile, options: Namespace) -> Iterator[Sequence[TextLog | JsonLog]]:
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


def _summary(fleet: FleetFile, watcher: _Watcher, code: int) -> dict[str, Any]:
    """Return what became of every job, for programs."""
    return {
        "schema": SCHEMA,
        "zlmreport": __version__,
        "fleet": fleet.name,
        "exit_code": code,
        "counts": by_word(watcher.counts),
        "jobs": watcher.jobs,
        "priors": watcher.priors,
    }


_FORETOLD = {
    Due.CERTIFICATE: "would be made",
    Due.COMPARISON: "would be made anew, and be a draft if it differs from what was issued",
    Due.REFUSAL: "would fail",
    Due.SET_ASIDE: "is set aside, and would not be tried",
}


def _foretell(fleet: FleetFile, plugins: tuple[Path, ...], options: Namespace) -> int:
    """Print what a night would do."""
    planned = foretell(fleet, plugins)
    due = [each for each in planned if each.due is not Due.NOTHING]
    if options.json:
        jobs = [
            {
                "due": each.due.value,
                "job": each.job,
                "number": each.number or None,
                "why": each.why or None,
                "problems": [str(problem) for problem in each.problems],
            }
            for each in planned
        ]
        print_json({"schema": SCHEMA, "zlmreport": __version__, "fleet": fleet.name, "due": jobs})
        return 0
    for each in due:
        number = f"{each.number}  " if each.number else ""
        print(visible(f"{number}{each.job}: {each.why}; {_FORETOLD[each.due]}"))
        for problem in each.problems:
            print(visible(f"  {problem}"))
    if not options.quiet:
        print(f"{len(due)} of {len(planned)} jobs are due; nothing was made")
    return 0
