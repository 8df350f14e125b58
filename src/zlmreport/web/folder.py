"""The jobs and machines of a folder on one page: what fails, is due, is fine; each opens as a workbench."""

from __future__ import annotations

import datetime as dt
import hashlib
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from enum import IntEnum
from pathlib import Path
from threading import Lock, Thread
from typing import Any

from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request as HttpRequest
from starlette.responses import JSONResponse, Response
from starlette.routing import Mount, Route
from starlette.types import Receive, Scope, Send

from zlmreport import pipeline
from zlmreport.document.certificate.conformity import STATEMENTS
from zlmreport.document.certificate.results import Evaluated
from zlmreport.errors import AccessError, InputError, ZlmreportError
from zlmreport.job.contradictions import find_last_day
from zlmreport.job.days import SOON
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.job.parse import is_named_as_yaml
from zlmreport.language import Language, Words
from zlmreport.machines.reading import read_machine
from zlmreport.measurement.provenance import SourceFile
from zlmreport.plugin.registry import Registry
from zlmreport.verification.carrier import find_results_in
from zlmreport.web.answers import answer_with_file, answer_with_shell, find_language_of
from zlmreport.web.app import Workbench
from zlmreport.web.bench import PLACE, Bench
from zlmreport.web.guard import Door, DoorKeeper
from zlmreport.web.machine_app import MachineWorkbench
from zlmreport.web.texts import collect_texts
from zlmreport.web.watched import make_stamp_of

_SCHEMA = re.compile(r"^schema:\s*[\"']?zlmreport/(job|machine)/", re.MULTILINE)
_MACHINE = "machine"
#: The line that says what a file is stands among its first; comments may come before it.
_HEAD = 20_000
_MOST = 2_000
_NO_AXIS = Words("")
_WHOLE = Words("Machine, axes {chain}")


class JobState(IntEnum):
    """How a job stands, the worst first."""

    FAILS = 0
    NOT_MET = 1
    OVERDUE = 2
    UNDECIDED = 3
    SOON = 4
    FINE = 5
    EARLIER = 6  #: A later job tests the same error of the same axis.
    WAITS = 7  #: It is being looked at.


_WORDS = {
    JobState.FAILS: Words("failing"),
    JobState.NOT_MET: Words("limit not met"),
    JobState.OVERDUE: Words("overdue"),
    JobState.UNDECIDED: Words("not decided"),
    JobState.SOON: Words("due soon"),
    JobState.FINE: Words("nothing to do"),
    JobState.EARLIER: Words("earlier test"),
    JobState.WAITS: Words("being looked at …"),
}
#: What the decisions of a job come to, by the name of their mark.
_DECIDED = {"NOT_MET": JobState.NOT_MET, "OPEN": JobState.UNDECIDED}


@dataclass(frozen=True, slots=True)
class JobRow:
    """A job of the folder."""

    key: str  #: Names it in addresses: the same as long as it lies where it lies.
    name: str  #: Relative to the folder.
    state: JobState = JobState.WAITS
    number: str = ""  #: Of its certificate.
    machine: str = ""
    axis: Words = _NO_AXIS  #: With its name, as pages head it.
    #: The name of the axis, and the symbol of what was measured of it, or what that is called without one.
    tested: tuple[str, str] = ("", "")
    measured: dt.date | None = None
    due: dt.date | None = None  #: By when the axis is to be measured again; None where no interval is stated.
    problems: tuple[str, ...] = ()  #: Why it fails, each with its place.
    closed: str = ""  #: Why it has no page: no error model is of what it measures; empty where it opens.

    def date(self, today: dt.date, *, is_latest: bool) -> JobRow:
        """Return the job with what a day makes of it; an earlier test of an axis needs nobody."""
        if not is_latest and self.state is not JobState.FAILS:
            return replace(self, state=JobState.EARLIER, due=None)
        if self.due is None or self.state < JobState.OVERDUE:
            return self
        state = self.state
        if self.due < today:
            state = JobState.OVERDUE
        elif self.due <= today + SOON:
            state = min(state, JobState.SOON)
        return replace(self, state=state)


def find_jobs_in(folder: Path) -> tuple[Path, ...]:
    """Return the job and machine files below a folder, by their names; hidden folders are passed over.

    Raises `AccessError` if the folder cannot be read, `InputError` if there is none in it.
    """
    try:
        found = sorted(folder.rglob("*"))
    except OSError as error:
        raise AccessError.at(PLACE, f"{folder}: {(error.strerror or str(error)).lower()}") from error
    jobs = tuple(path for path in found if _is_job(path, folder))[:_MOST]
    if not jobs:
        raise InputError.at(
            PLACE, f"{folder}: no job or machine file lies here; one begins with 'schema: zlmreport/job/1'"
        )
    return jobs


def _is_job(path: Path, folder: Path) -> bool:
    hidden = any(part.startswith(".") for part in path.relative_to(folder).parts)
    if hidden or not is_named_as_yaml(path) or not path.is_file():
        return False
    try:
        return _read_schema(path) != ""
    except OSError:
        return True  # it is listed, with what is wrong


def is_machine(path: Path) -> bool:
    """Return whether a file is a machine file; one that cannot be read is none."""
    try:
        return _read_schema(path) == _MACHINE
    except OSError:
        return False


def _read_schema(path: Path) -> str:
    """Return whether a file says that it is a job or a machine; nothing for any other."""
    with path.open(encoding="utf-8", errors="replace") as file:
        found = _SCHEMA.search(file.read(_HEAD))
    return found[1] if found else ""


@dataclass(slots=True)
class JobFolder:
    """The jobs below a folder, looked at one after the other beside the page, and again when they change."""

    path: Path  #: The folder.
    registry: Registry  #: The installed plugins.
    today: Callable[[], dt.date]  #: Says the day: what is due depends on it.
    _known: dict[str, tuple[str, JobRow]] = field(default_factory=dict)
    _watched: dict[str, tuple[Path, ...]] = field(default_factory=dict)
    _lock: Lock = field(default_factory=Lock)
    _worker: Thread | None = None

    def list_paths(self) -> dict[str, Path]:
        """Return the job files by their keys."""
        return {self.make_key(each): each for each in find_jobs_in(self.path)}

    def make_key(self, job: Path) -> str:
        """Return what names a job in addresses."""
        return hashlib.sha256(job.relative_to(self.path).as_posix().encode()).hexdigest()[:12]

    def list_rows(self) -> list[JobRow]:
        """Return the jobs, the worst first; what is not known yet is looked at beside, and waits."""
        paths = self.list_paths()
        with self._lock:
            stale = [key for key in paths if key not in self._known or self._is_changed(key)]
            if stale and (self._worker is None or not self._worker.is_alive()):
                waiting = {key: paths[key] for key in stale}
                self._worker = Thread(target=self._look, args=(waiting,), daemon=True)
                self._worker.start()
            known = [
                self._known[key][1] if key in self._known else JobRow(key, self._name_job(path))
                for key, path in paths.items()
            ]
        return sorted(_date_rows(known, self.today()), key=lambda each: (each.state, each.name))

    def _name_job(self, path: Path) -> str:
        return path.relative_to(self.path).as_posix()

    def _is_changed(self, key: str) -> bool:
        return make_stamp_of(self._watched[key]) != self._known[key][0]

    def _look(self, waiting: dict[str, Path]) -> None:
        for key, path in waiting.items():
            row, files = look_at(JobRow(key, self._name_job(path)), path, self.registry)
            with self._lock:
                self._watched[key] = files
                self._known[key] = make_stamp_of(files), row


def look_at(row: JobRow, path: Path, registry: Registry) -> tuple[JobRow, tuple[Path, ...]]:
    """Return a job with all that its files say, and these files; a job that cannot be evaluated fails."""
    files = [path]
    if is_machine(path):
        return _describe_machine(row, path, registry)
    try:
        job = load(path, registry)
        row, files = _describe_row(row, job), _list_known_paths(job.files)
        evaluated: list[Evaluated] = []
        for part in job.parts:
            readings = pipeline.read(part, registry)
            files += _list_known_paths(readings.provenance.files)
            evaluated += pipeline.evaluate_all(part, readings, registry)
        row = replace(row, state=_find_state(evaluated))
    except ZlmreportError as error:
        return _describe_failing(row, files, error)
    try:
        Bench(path, registry).try_job(job)
    except ZlmreportError as error:
        row = replace(row, closed=error.problems[0].message)
    return row, tuple(dict.fromkeys(files))


def _describe_failing(
    row: JobRow, files: Sequence[Path], error: ZlmreportError
) -> tuple[JobRow, tuple[Path, ...]]:
    """Return a file that cannot be evaluated, and what is watched: those of its files that are named, too."""
    named = (Path(each.place.file) for each in error.problems)
    problems = tuple(str(each) for each in error.problems)
    return replace(row, state=JobState.FAILS, problems=problems), tuple(dict.fromkeys((*files, *named)))


def _describe_machine(row: JobRow, path: Path, registry: Registry) -> tuple[JobRow, tuple[Path, ...]]:
    """Return a machine file with all that it names."""
    try:
        machine = read_machine(path, registry, find_results_in)
    except ZlmreportError as error:
        return _describe_failing(row, [path], error)
    names = machine.file.keys.machine
    found = replace(
        row,
        state=JobState.FINE,
        number=machine.number,
        machine=" ".join(filter(None, (names.type, names.serial or ""))),
        axis=_WHOLE.given(chain=machine.machine.chain.letters),
    )
    return found, tuple(dict.fromkeys(_list_known_paths(machine.sources)))


def _list_known_paths(files: Sequence[SourceFile]) -> list[Path]:
    return [each.path for each in files if each.path is not None]


def _describe_row(row: JobRow, job: Job) -> JobRow:
    keys = job.keys
    measured = find_last_day(keys.measurement)
    interval = keys.fleet.interval if keys.fleet else None
    return replace(
        row,
        number=keys.certificate.number,
        machine=" ".join(filter(None, (keys.machine.type, keys.machine.serial))),
        axis=job.axis.heading,
        tested=(job.axis.name, job.axis.symbol or job.axis.measurand.identifier),
        measured=measured,
        due=measured + dt.timedelta(days=interval) if measured and interval else None,
    )


def _find_state(evaluated: Sequence[Evaluated]) -> JobState:
    """Return what the decisions on limits come to, the worst of them."""
    decisions = (one.decision for each in evaluated for one in each.evaluation.parameters)
    marks = (STATEMENTS[each.conformity][0].name for each in decisions if each is not None)
    return min((_DECIDED.get(each, JobState.FINE) for each in marks), default=JobState.FINE)


def _date_rows(rows: Sequence[JobRow], today: dt.date) -> Iterator[JobRow]:
    latest: dict[tuple[str, tuple[str, str]], dt.date] = {}
    for each in rows:
        if each.measured:
            subject = each.machine, each.tested
            latest[subject] = max(each.measured, latest.get(subject, dt.date.min))
    for each in rows:
        is_latest = each.measured is None or latest[each.machine, each.tested] == each.measured
        yield each.date(today, is_latest=is_latest)


def collect_row(row: JobRow, language: Language) -> dict[str, Any]:
    """Return a job as a page is told of it."""
    return {
        "key": row.key,
        "name": row.name,
        "state": row.state.name.lower().replace("_", "-"),
        "words": _WORDS[row.state].in_language(language),
        "number": row.number,
        "machine": row.machine,
        "axis": row.axis.in_language(language),
        "measured": row.measured.isoformat() if row.measured else "",
        "due": row.due.isoformat() if row.due else "",
        "problems": list(row.problems),
        "closed": row.closed,
    }


@dataclass(slots=True)
class FolderWorkbench:
    """The answers for a folder of jobs; the workbench of a job begins when it is opened."""

    folder: JobFolder
    registry: Registry
    plugins: Sequence[Path] = ()  #: Files that are plugins, from the command line.
    _opened: dict[str, tuple[Workbench | MachineWorkbench, Starlette]] = field(default_factory=dict)
    _lock: Lock = field(default_factory=Lock)

    def start_early(self) -> None:
        """Begin to look at the jobs, so that the page need not wait."""
        self.folder.list_rows()

    def end(self) -> None:
        """End what is under way beside, and take its files away."""
        with self._lock:
            opened, self._opened = self._opened, {}
        for workbench, _ in opened.values():
            workbench.end()

    def make_app(self, door: Door) -> DoorKeeper:
        """Return the application behind its guard."""
        routes = [
            Route("/", self.answer_page),
            Route("/files/{name}", answer_with_file),
            Route("/api/texts", self.answer_texts),
            Route("/api/folder", self.answer_jobs),
            Mount("/jobs/{key}", self.hand_on),
        ]
        return DoorKeeper(Starlette(routes=routes), door)

    async def answer_page(self, request: HttpRequest) -> Response:
        """Answer with the page of the folder; it fills itself."""
        return answer_with_shell(self._choose_language(request), self.folder.path.resolve().name)

    async def answer_texts(self, request: HttpRequest) -> Response:
        """Answer with the words of the page, and that it is one of a folder."""
        return JSONResponse(
            {**collect_texts(self._choose_language(request)), "folder": str(self.folder.path.resolve().name)}
        )

    async def answer_jobs(self, request: HttpRequest) -> Response:
        """Answer with the jobs, the worst first."""

        def list_jobs() -> dict[str, Any]:
            return {
                "jobs": [
                    collect_row(each, self._choose_language(request)) for each in self.folder.list_rows()
                ]
            }

        try:
            return JSONResponse(await run_in_threadpool(list_jobs))
        except ZlmreportError as error:
            return JSONResponse({"problems": [str(each) for each in error.problems]}, 422)

    async def hand_on(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Hand a request on to the workbench of a job."""
        answer = await run_in_threadpool(self._find_workbench, scope["path_params"]["key"])
        await (answer or Response(status_code=404))(scope, receive, send)

    def _find_workbench(self, key: str) -> Starlette | None:
        with self._lock:
            if key not in self._opened:
                path = self.folder.list_paths().get(key)
                if path is None:
                    return None
                kind = MachineWorkbench if is_machine(path) else Workbench
                workbench = kind.on(path, self.registry, self.plugins)
                self._opened[key] = workbench, workbench.make_unguarded_app()
            return self._opened[key][1]

    def _choose_language(self, request: HttpRequest) -> Language:
        return find_language_of(request) or Language.ENGLISH
