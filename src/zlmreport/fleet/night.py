"""A night of a fleet, from its plan to the last certificate: the only page that knows the whole order."""

from __future__ import annotations

import contextlib
import datetime as dt
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Protocol

from zlmreport.fleet.basis import Basis, KnownFile, program_versions
from zlmreport.fleet.cluster import Cluster
from zlmreport.fleet.issuing import Desk, Happened, What, tidy
from zlmreport.fleet.ledger import Ledger
from zlmreport.fleet.making import Failed, Task, defaults_digest
from zlmreport.fleet.plan import Due, Evening, Planned, plan, reasons
from zlmreport.fleet.pool import Pool
from zlmreport.job.fleet import FleetFile, job_files

_MADE = frozenset({Due.CERTIFICATE, Due.COMPARISON})


class Watch(Protocol):
    """Whoever watches a night."""

    def planned(self, jobs: Sequence[Planned]) -> None:
        """Take note of what is due."""

    def happened(self, happened: Happened) -> None:
        """Take note of what happened to a job."""


def evening(fleet: FleetFile, jobs: tuple[Path, ...], ledger: Ledger, plugins: tuple[Path, ...]) -> Evening:
    """Return what is known before a night."""
    now = Basis(
        files=(),
        programs=program_versions(files=plugins),
        formats=tuple(identifier for identifier, _ in fleet.formats),
        defaults=defaults_digest(fleet),
    )
    return Evening(fleet, jobs, ledger.standings(), ledger.certificates(), now)


def foretell(fleet: FleetFile, plugins: tuple[Path, ...]) -> tuple[Planned, ...]:
    """Return what a night would do; nothing is made or written."""
    jobs = job_files(fleet)
    with Ledger.open(fleet.ledger, fleet.name, create=False) as ledger:
        known = evening(fleet, jobs, ledger, plugins)
    return plan(known, reasons(known))


def spend(fleet: FleetFile, plugins: tuple[Path, ...], watch: Watch, workers: int | None = None) -> None:
    """Make all that is due.

    Parameters
    ----------
    fleet
        The fleet file.
    plugins
        Plugins in files of their own.
    watch
        Is told what is due, and what happens.
    workers
        Number of processes, instead of the fleet file's.

    Raises
    ------
    InputError
        If a pattern of jobs matches nothing.
    AccessError
        If the ledger or the scheduler cannot be used, or another night is at work.
    """
    jobs = job_files(fleet)
    with Ledger.open(fleet.ledger, fleet.name) as ledger, ledger.night(_now(), str(fleet.path)) as night:
        known = evening(fleet, jobs, ledger, plugins)
        if night.was_interrupted:
            tidy(fleet.output, _files_in(known))
        why = reasons(known)
        with contextlib.ExitStack() as stack:
            due = sum(map(bool, why.values()))
            executor = _executor(fleet, plugins, workers, due) if due else None
            if executor:
                stack.enter_context(executor)
            planned = plan(known, why)
            watch.planned(planned)
            desk = Desk(fleet, night, known.standings)
            for each in planned:
                if each.due is Due.NOTHING:
                    watch.happened(Happened(What.UNCHANGED, each.job, each.number))
                elif each.due is Due.REFUSAL:
                    watch.happened(desk.failed(each, Failed(each.problems)))
            if executor:
                tasks = {each.path.absolute(): each for each in planned if each.due in _MADE}
                waiting = (_task(each, known, plugins) for each in tasks.values())
                for task, result in executor.results(waiting):
                    watch.happened(desk.kept(tasks[task.job.absolute()], result))
        night.end(_now())


def _task(planned: Planned, known: Evening, plugins: tuple[Path, ...]) -> Task:
    issued = planned.issued
    is_elsewhere = known.fleet.keys.executor.kind == "dask"  # other machines work in other folders
    return Task(
        fleet=known.fleet.path.absolute() if is_elsewhere else known.fleet.path,
        content=known.fleet.content,
        job=planned.path.absolute() if is_elsewhere else planned.path,
        issued={file.role: file.sha256 for file in issued.files} if issued else {},
        folder=str(Path(issued.files[0].path).parent) if issued and issued.files else "",
        plugins=plugins,
        programs=known.now.programs,
    )


def _executor(fleet: FleetFile, plugins: tuple[Path, ...], workers: int | None, due: int) -> Pool | Cluster:
    keys = fleet.keys.executor
    if keys.kind == "dask":
        return Cluster(keys.scheduler or "", fleet.place_of("executor", "scheduler"))
    wanted = workers or keys.workers or len(os.sched_getaffinity(0))
    return Pool(min(wanted, due), plugins)


def _files_in(known: Evening) -> Iterator[KnownFile]:
    """Yield all files that the ledger has taken over."""
    for standing in known.standings.values():
        yield from standing.files
    for certificate in known.certificates.values():
        yield from certificate.files


def _now() -> str:
    """Return date and time; no document states them."""
    return dt.datetime.now(dt.UTC).isoformat(timespec="seconds")
