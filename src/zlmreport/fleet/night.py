"""A night of a fleet, from its plan to the last certificate: the only page that knows the whole order."""

from __future__ import annotations

import contextlib
import datetime as dt
import itertools
import math
import os
import time
from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

from zlmreport.errors import INCOMPLETE, AccessError, InputError, Place, Problem, ZlmreportError
from zlmreport.files import Document, find_confinement, write
from zlmreport.fleet.basis import CertificateBasis, Disk, find_program_versions, say_changes, write_path_in
from zlmreport.fleet.exports import make_priors, write_heartbeat
from zlmreport.fleet.issuing import Desk, Happened, What, tidy
from zlmreport.fleet.ledger import Ledger, Night, Standing
from zlmreport.fleet.making import Failed, Limits, Task, digest_defaults, find_plugins_once
from zlmreport.fleet.news import (
    Ways,
    find_news_of,
    find_news_of_job,
    find_news_of_night,
    find_ways_of,
    write_digest,
)
from zlmreport.fleet.notices import (
    find_left_documents,
    find_missing,
    find_vanished,
    list_notices,
    say_left,
    say_of_last,
)
from zlmreport.fleet.plan import Due, Evening, PlannedJob, find_reasons, plan
from zlmreport.fleet.printing import Names
from zlmreport.fleet.records import About, NewsKind, NightNotice, PastNight, State, compute_due_date
from zlmreport.fleet.state import Rules, describe_state
from zlmreport.fleet.workers import Cluster, Pool
from zlmreport.job.fleet import FleetFile, find_jobs, is_retired, list_job_files
from zlmreport.language import Words, same
from zlmreport.plugin.protocols import Occasion

#: A job may take so long, s, or so many times as long as it ever took.
_PATIENCE, _TIMES_LONGEST = 600.0, 10
_UNTAUGHT = Words("what the tests teach was not written: {problem}")
_MADE = frozenset({Due.CERTIFICATE, Due.COMPARISON})


class Watch(Protocol):
    """Whoever watches a night."""

    def note_plan(self, jobs: Sequence[PlannedJob]) -> None:
        """Take note of what is due."""

    def note_happened(self, happened: Happened) -> None:
        """Take note of what happened to a job."""

    def note_notice(self, notice: NightNotice) -> None:
        """Take note of something that concerns the whole night, and is not as it should be."""

    def note_priors(self, file: Path) -> None:
        """Take note of a new file of priors."""


def _prepare_evening(
    fleet: FleetFile, jobs: tuple[Path, ...], ledger: Ledger, plugins: tuple[Path, ...]
) -> Evening:
    now = CertificateBasis(
        files=(),
        programs=find_program_versions(files=plugins),
        formats=tuple(identifier for identifier, _ in fleet.formats),
        defaults=digest_defaults(fleet),
    )
    at_work = tuple(path for path in jobs if not is_retired(write_path_in(fleet.path.parent, path), fleet))
    return Evening(fleet, at_work, ledger.list_standings(), ledger.list_certificates(), now)


def foretell(fleet: FleetFile, plugins: tuple[Path, ...]) -> tuple[PlannedJob, ...]:
    """Return what a night would do; nothing is made or written."""
    jobs = list_job_files(fleet)
    with Ledger.open(fleet.ledger, fleet.name, create=False) as ledger:
        known = _prepare_evening(fleet, jobs, ledger, plugins)
    return plan(known, find_reasons(known))


class MissingError(AccessError):
    """Something is not there that was there in an earlier night, and nothing is done before it is."""

    exit_code = INCOMPLETE


@dataclass(frozen=True, slots=True)
class Order:
    """How a night is spent, beside what the fleet file says."""

    plugins: tuple[Path, ...] = ()  #: In files of their own.
    workers: int | None = None  #: Number of processes, instead of the fleet file's.
    seconds: float = math.inf  #: After which no job is begun any more.


def spend_night(fleet: FleetFile, order: Order, watch: Watch) -> None:
    """Make all that is due.

    Raises `InputError` if a pattern of jobs matches nothing; `AccessError` if the ledger or the scheduler
    cannot be used, or another night is at work; `MissingError` if the folder of certificates is gone, or most
    of the jobs.
    """
    plugins, start = order.plugins, read_steady_clock()
    ends = start + order.seconds
    jobs, unmatched = find_jobs(fleet)
    ways, language = find_ways_of(fleet, plugins), fleet.keys.language
    with Ledger.open(fleet.ledger, fleet.name, create=not unmatched) as ledger:
        if unmatched and not find_vanished(_prepare_evening(fleet, jobs, ledger, plugins)):
            raise InputError(unmatched)
        with ledger.hold_night(read_clock(), str(fleet.path)) as night, _show_alive(fleet):
            # What is known is read now: a night that was at work a moment ago may have ended since.
            last, known = night.before, _prepare_evening(fleet, jobs, ledger, plugins)
            gone = find_vanished(known)
            lacking = find_missing(known, gone)
            if lacking:
                place, notice = lacking
                noticed = (*say_of_last(night, last), notice)
                night.notice(noticed)
                night.report(tuple(find_news_of_night(noticed, language)), is_all=False)
                _tell(fleet, night, ways, watch, last)
                night.notice((*noticed, *ways.untold.values()))
                if not night.was_interrupted:  # else the next night still has to tidy up
                    night.end(_compute_end(night.began, start))
                raise MissingError.at(place, notice.english)
            mistakes = (NightNotice(About.JOBS, same(each.message)) for each in unmatched)
            noticed = (*list_notices(known, night, gone, last), *mistakes)
            night.notice(noticed)
            night.report(tuple(find_news_of_night(noticed, language)), is_all=False)  # it may be killed, too
            for notice in noticed:
                watch.note_notice(notice)
            witness = _Witness(watch, known, ways)
            for notice in _work_through(
                known, order, witness, _Work(night, gone, ends, ledger.list_longest_times())
            ):
                watch.note_notice(notice)
                noticed = (*noticed, notice)
            if witness.saw_something or night.was_interrupted or (last and last.notices):
                noticed = (*noticed, *_teach(fleet, ledger, watch))
            night.notice(noticed)
            if witness.saw_something or noticed or (last and (last.notices or not last.ended)):
                began = dt.datetime.fromisoformat(night.began)
                rules = Rules(fleet.keys.interval, lambda job: is_retired(job, fleet))
                names = [known.name_job(path) for path in known.jobs]
                now = PastNight(began, None, noticed)
                state = describe_state(fleet.name, ledger.list_entries(), names, now, rules)
                printed = _find_names(plugins) if state.trends else Names(())
                night.report(tuple(find_news_of(state, language, printed)))
            _tell(fleet, night, ways, watch, last)
            night.notice((*noticed, *ways.untold.values()))
            night.end(_compute_end(night.began, start))


def _compute_end(began: str, start: float) -> str:
    """Return when a night ends that began at `start` by the steady clock: the other may have been set."""
    took = dt.timedelta(seconds=read_steady_clock() - start)
    return (dt.datetime.fromisoformat(began) + took).isoformat(timespec="seconds")


def _find_names(plugins: tuple[Path, ...]) -> Names:
    """Return what standards print; plugins that cannot be loaded are said of each job, and stop no news."""
    try:
        return Names(find_plugins_once(plugins).standards)
    except ZlmreportError:
        return Names(())


@contextlib.contextmanager
def _show_alive(fleet: FleetFile) -> Iterator[None]:
    """Show that the night is at work, and then that it has ended."""
    _beat(fleet, is_at_work=True)
    try:
        yield
    finally:
        _beat(fleet, is_at_work=False)


def _beat(fleet: FleetFile, *, is_at_work: bool) -> None:
    """Write the sign of life; where it cannot be written, its age tells."""
    text = write_heartbeat(fleet.name, dt.datetime.fromisoformat(read_clock()), is_at_work=is_at_work)
    with contextlib.suppress(AccessError):
        write([Document(fleet.heartbeat, text.encode())])


@dataclass(slots=True)
class _Witness:
    """Passes on what happens, tells people of it, and remembers whether anything did."""

    watch: Watch
    known: Evening
    ways: Ways
    saw_something: bool = False

    def note_happened(self, happened: Happened) -> None:
        self.saw_something |= happened.what is not What.UNCHANGED
        self.watch.note_happened(happened)
        message = find_news_of_job(happened, self.known)
        if message:
            for way in self.ways.list_for(message.occasion):
                self.ways.tell(way, message, self.watch.note_notice)


def _teach(fleet: FleetFile, ledger: Ledger, watch: Watch) -> Iterator[NightNotice]:
    """Write what the tests of the fleet teach, where the fleet file has a folder for it."""
    if fleet.keys.priors is None:
        return
    try:
        for path in write(make_priors(ledger.list_lessons(), fleet.keys.priors)):
            watch.note_priors(path)
    except AccessError as error:
        notice = NightNotice(About.PRIORS, _UNTAUGHT.given(problem=str(error.problems[0])))
        watch.note_notice(notice)
        yield notice


def _tell(fleet: FleetFile, night: Night, ways: Ways, watch: Watch, last: PastNight | None) -> None:
    """Tell people what is new, each way once; what could not be told is told by the next night."""
    untold = [each.english for each in last.notices if each.about is About.UNTOLD] if last else []
    for way in ways.list_for(Occasion.DIGEST):
        news = night.list_untold(way.name, was_tried=any(way.name in each for each in untold))
        if news and ways.tell(way, write_digest(fleet, news), watch.note_notice):
            night.tell(way.name)


@dataclass(frozen=True, slots=True)
class _Work:
    """A night at work."""

    night: Night  #: In the ledger.
    gone: Sequence[str]  #: Jobs whose files are gone.
    ends: float  #: When no job is begun any more, by `read_steady_clock`.
    longest: Mapping[str, float]  #: The longest time that each job ever took, s.


def _tidy(known: Evening) -> None:
    """End what the night before left half done."""
    kept = [each.files for each in known.standings.values()]
    kept += [each.files for each in known.certificates.values()]
    tidy(known.fleet.output, itertools.chain.from_iterable(kept))


def _work_through(known: Evening, order: Order, witness: _Witness, work: _Work) -> Iterator[NightNotice]:
    """Make what is due, and yield what is to be said of the whole night at its end."""
    night = work.night
    if night.was_interrupted:
        _tidy(known)
    why = find_reasons(known)
    with contextlib.ExitStack() as stack:
        due = sum(map(bool, why.values()))
        executor = (
            make_executor(known.fleet, order, due, lambda: _write_sign_of_life(known.fleet, night))
            if due
            else None
        )
        stack.enter_context(executor or contextlib.nullcontext())
        planned = plan(known, why)
        witness.watch.note_plan(planned)
        desk, heirs = Desk(known, night), {each.number: each.job for each in planned if each.number}
        for happened in (
            *(desk.note_vanished(job, heirs) for job in work.gone),
            *_find_overdue(known, night.list_subjects(NewsKind.OVERDUE), night.began),
        ):
            witness.note_happened(happened)
        for each in planned:
            if each.due not in _MADE:
                witness.note_happened(_record_not_made(each, desk))
        tasks = {each.path.absolute(): each for each in planned if each.due in _MADE}
        remaining = [
            (each, _make_task(each, known, order.plugins, work)) for each in reversed(tasks.values())
        ]

        def waiting() -> Iterator[Task]:
            while remaining and read_steady_clock() < work.ends:
                yield remaining.pop()[1]

        if executor:
            for task, result in executor.make_all(waiting()):
                happened = desk.keep(tasks[task.job.absolute()], result)
                is_upgrade = task.stated is not None and happened.what is What.CONFIRMED
                witness.note_happened(replace(happened, is_upgrade=is_upgrade))
        work.night.leave([each.job for each, _ in reversed(remaining)])
        for each, _ in reversed(remaining):
            witness.note_happened(Happened(What.LEFT, each.job, each.number, each.why))
    yield from say_left(len(remaining), due)
    yield from find_left_documents(known, planned)


def _write_sign_of_life(fleet: FleetFile, night: Night) -> None:
    """Give a sign of life, to the ledger and to whoever watches files."""
    night.beat(read_clock())
    _beat(fleet, is_at_work=True)


def _record_not_made(planned: PlannedJob, desk: Desk) -> Happened:
    if planned.due is Due.NOTHING:
        return Happened(What.UNCHANGED, planned.job, planned.number)
    if planned.due is Due.SET_ASIDE:
        why = desk.known.standings[planned.job].message.partition(": ")[2]  # behind its place
        problem = Problem(Place(str(planned.path)), why)
        return Happened(What.SET_ASIDE, planned.job, planned.number, planned.why, problems=(problem,))
    return desk.note_failure(planned, Failed(planned.problems))


def _find_overdue(known: Evening, told: Container[str], now: str) -> Iterator[Happened]:
    """Yield the axes that should have been measured again, and of which no night told that."""
    latest: dict[tuple[str, str], tuple[str, Standing]] = {}
    for job, standing in sorted(known.standings.items()):
        subject = standing.subject
        if subject.measured and standing.state is State.MADE and not is_retired(job, known.fleet):
            axis = subject.axis_key
            if axis not in latest or latest[axis][1].subject.measured <= subject.measured:
                latest[axis] = job, standing
    for job, standing in latest.values():
        subject = standing.subject
        due = compute_due_date(subject.measured, subject.interval or known.fleet.keys.interval)
        if due and due < now[:10] and subject.name_term(due) not in told:
            why = (
                f"{subject.of_axis} was measured on {subject.measured}, and was to be measured again by {due}"
            )
            yield Happened(What.OVERDUE, job, standing.number, why)


def _make_task(planned: PlannedJob, known: Evening, plugins: tuple[Path, ...], work: _Work) -> Task:
    issued, limits = planned.issued, known.fleet.keys.limits
    patience = max(_PATIENCE, _TIMES_LONGEST * work.longest.get(planned.job, 0.0))
    is_elsewhere = known.fleet.keys.executor.kind == "dask"  # other machines work in other folders
    return Task(
        fleet=known.fleet.path.absolute() if is_elsewhere else known.fleet.path,
        content=known.fleet.content,
        job=planned.path.absolute() if is_elsewhere else planned.path,
        issued={file.role: file.sha256 for file in issued.files} if issued else {},
        folder=str(Path(issued.files[0].path).parent) if issued and issued.files else "",
        plugins=plugins,
        programs=known.now.programs,
        limits=Limits(limits.seconds or patience, limits.megabytes),
        stated=work.night.find_stated_parameters(planned.job) if _is_upgrade(planned, known) else None,
        confine=find_confinement(),
    )


def _is_upgrade(planned: PlannedJob, known: Evening) -> bool:
    """Whether nothing but programs changed since a certificate was issued."""
    standing = known.standings.get(planned.job)
    if standing is None or standing.basis is None or standing.state is not State.MADE:
        return False
    as_before = replace(known.now, programs=standing.basis.programs)
    return not any(say_changes(standing.basis, Disk(known.fleet.path.parent), as_before))


def make_executor(fleet: FleetFile, order: Order, due: int, beat: Callable[[], None]) -> Pool | Cluster:
    """Return who makes the certificates that are due: a scheduler's workers, or processes here."""
    keys = fleet.keys.executor
    if keys.kind == "dask":
        return Cluster(keys.scheduler or "", fleet.place_of("executor", "scheduler"), beat)
    wanted = order.workers or keys.workers or len(os.sched_getaffinity(0))
    return Pool(min(wanted, due), order.plugins, beat)


def read_steady_clock() -> float:
    """Return seconds by a clock that nobody sets, and that does not stand still while the computer sleeps."""
    steady: int | None = getattr(time, "CLOCK_BOOTTIME", getattr(time, "CLOCK_MONOTONIC", None))
    return time.monotonic() if steady is None else time.clock_gettime(steady)


def read_clock() -> str:
    """Return date and time; no document states them."""
    return dt.datetime.now(dt.UTC).isoformat(timespec="seconds")
