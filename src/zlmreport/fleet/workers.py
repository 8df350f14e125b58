"""Workers that make certificates, on this machine or by Dask; their limits of time and memory.

The first are kept warm, renewed, missed when killed, stopped when late; the others see the same files.
"""

from __future__ import annotations

import contextlib
import signal
import tempfile
import time
from collections import deque
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from concurrent.futures import CancelledError
from dataclasses import dataclass, field
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from multiprocessing.synchronize import Event
from pathlib import Path
from typing import Any, Self

from zlmreport.errors import AccessError, InputError, Place, Problem
from zlmreport.fleet.making import BEAT, Failed, MadeCertificate, Task, make_certificate, report_late, warm
from zlmreport.presence import PRESENCE, SIZE, Presence

#: After its task should have been ended by the night, a worker ends itself, s: the night may be gone.
_GRACE = 60
#: Certificates after which a worker makes room for a new one: no library is trusted to leak nothing.
LIFE = 500


@dataclass(slots=True)
class _Worker:
    """A process, this end of the line to it, its task, and when that must be done."""

    process: BaseProcess
    line: Connection
    is_ready: Event  # whether it came so far that it waited for a task
    presence: Presence  # which plugin is at work in it
    task: Task | None = None
    deadline: float = 0.0
    done: int = 0


@dataclass(frozen=True, slots=True)
class _Ended:
    """How a worker ended that had a task."""

    code: int
    was_ready: bool
    called: str  # the plugin that was at work; empty for none

    def make_failure(self, task: Task) -> Failed:
        """Return the answer of a task that had two such workers, the second while nothing else was done."""
        code = self.code
        how = f"was killed by {signal.Signals(-code).name}" if code < 0 else f"ended with exit code {code}"
        when = "while it made this certificate, twice" if self.was_ready else "before it was ready, twice"
        if self.called:
            when = f"while this plugin was at work, twice: {self.called}"
        hint = "; the system may have run out of memory" if code == -signal.SIGKILL else ""
        problem = Problem(Place(str(task.job)), f"the worker process {how} {when}{hint}")
        return Failed((problem,), is_stopped=self.was_ready)


def _make_folder_aside() -> tempfile.TemporaryDirectory[str]:
    return tempfile.TemporaryDirectory(prefix="zlmreport-night-", ignore_cleanup_errors=True)


@dataclass(slots=True)
class Pool:
    """Workers on this machine; it is left as a context manager, which ends them.

    A worker has one task at a time, so that it is known which one ended it. Such a task is tried once more,
    alone, when all others are done: then nobody else can have taken its memory. One that exceeds its time is
    killed with its worker, and not tried again. What workers keep in temporary files goes when the pool is
    left, however they ended.
    """

    workers: int  #: How many.
    plugins: tuple[Path, ...] = ()  #: Plugins in files of their own.
    beat: Callable[[], None] = lambda: None  #: Is called every few seconds, whatever the workers do.
    _staff: list[_Worker] = field(default_factory=list)
    _aside: tempfile.TemporaryDirectory[str] = field(
        default_factory=lambda: tempfile.TemporaryDirectory(
            prefix="zlmreport-night-", ignore_cleanup_errors=True
        )
    )

    def __enter__(self) -> Self:
        """Start the workers: they load the plugins while the night is planned."""
        self._staff.extend(self._hire() for _ in range(self.workers))
        return self

    def __exit__(self, *_: object) -> None:
        for worker in self._staff:
            self._dismiss(worker)
        self._staff.clear()
        self._aside.cleanup()

    def make_all(self, tasks: Iterable[Task]) -> Iterator[tuple[Task, MadeCertificate | Failed]]:
        """Yield what became of each task, as it is done; tasks are taken as workers have time for them."""
        killers: list[Task] = []
        for task, result in self._work_through(iter(tasks), self.workers):
            if isinstance(result, Failed | MadeCertificate):
                yield task, result
            else:
                killers.append(task)
        for task in killers:
            for _, again in self._work_through(iter([task]), 1):
                yield task, again.make_failure(task) if isinstance(again, _Ended) else again

    def _work_through(
        self, tasks: Iterator[Task], most: int
    ) -> Iterator[tuple[Task, MadeCertificate | Failed | _Ended]]:
        """Yield each task with its result, or with how the worker that had it ended."""
        free = deque(self._staff)
        busy: dict[Connection, _Worker] = {}
        while True:
            while free and len(busy) < most and (task := next(tasks, None)) is not None:
                worker = free.popleft()
                self._give(worker, task)
                busy[worker.line] = worker
            if not busy:
                return
            for worker in self._await_answers(busy):
                del busy[worker.line]
                task, result = self._receive(worker)
                is_spent = not worker.process.is_alive() or worker.done >= LIFE
                follower = self._replace(worker) if is_spent else worker
                # The next task first, so that the worker need not wait for what is done with the result.
                if not free and len(busy) < most and (following := next(tasks, None)) is not None:
                    self._give(follower, following)
                    busy[follower.line] = follower
                else:
                    free.append(follower)
                yield task, result

    def _await_answers(self, busy: dict[Connection, _Worker]) -> list[_Worker]:
        """Wait for workers that answer or have ended; those whose time is over are killed, and count."""
        while True:
            first = min(worker.deadline for worker in busy.values())
            ready = wait(list(busy), timeout=max(0.0, min(first - time.monotonic(), BEAT)))
            self.beat()
            now = time.monotonic()
            found = [worker for line, worker in busy.items() if line in ready or worker.deadline <= now]
            for worker in found:
                if worker.line not in ready:
                    worker.process.kill()
            if found:
                return found

    def _give(self, worker: _Worker, task: Task) -> None:
        worker.task = task
        worker.deadline = time.monotonic() + task.limits.seconds
        with contextlib.suppress(OSError):  # one that is gone is noticed where its answer is awaited
            worker.line.send(task)

    def _receive(self, worker: _Worker) -> tuple[Task, MadeCertificate | Failed | _Ended]:
        """Return a worker's answer, or how it ended if it is gone."""
        task, worker.task = worker.task, None
        if task is None:
            raise RuntimeError("a worker answers that was asked nothing")
        try:
            result: MadeCertificate | Failed = worker.line.recv()
        except (EOFError, OSError):
            worker.process.join()
            if worker.deadline <= time.monotonic():
                return task, report_late(task)
            code, called = worker.process.exitcode or 0, worker.presence.wrong or worker.presence.called
            return task, _Ended(code, worker.is_ready.is_set(), called)
        worker.done += 1
        return task, result

    def _hire(self) -> _Worker:
        context = get_context("forkserver")
        context.set_forkserver_preload([_serve.__module__])  # what all need is loaded once, plugins apart
        ours, theirs = context.Pipe()
        is_ready, memory = context.Event(), context.RawArray("B", SIZE)
        told = theirs, is_ready, memory, self.plugins, self._aside.name
        process = context.Process(target=_serve, args=told, daemon=True)
        process.start()
        theirs.close()
        return _Worker(process, ours, is_ready, Presence(memoryview(memory).cast("B")))

    def _replace(self, worker: _Worker) -> _Worker:
        self._dismiss(worker)
        new = self._hire()
        self._staff[self._staff.index(worker)] = new
        return new

    def _dismiss(self, worker: _Worker) -> None:
        """End a worker; one with a task has no time to finish it."""
        worker.line.close()
        if worker.task is not None:
            worker.process.kill()
        worker.process.join()


def _serve(line: Connection, is_ready: Event, memory: Any, plugins: tuple[Path, ...], aside: str) -> None:
    """Answer tasks until the line is closed, by whatever end of the other side.

    `memory`: In which it notes which plugin is at work.
    `aside`: The folder of its temporary files.
    """
    tempfile.tempdir = aside
    PRESENCE.use(memoryview(memory).cast("B"))
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # of a terminal: the night decides what it means
    with contextlib.suppress(Exception):  # what is wrong with a plugin is said of each job
        warm(plugins)
    is_ready.set()
    with contextlib.suppress(EOFError, OSError):
        while True:
            task: Task = line.recv()
            _limit_memory(task.limits.megabytes * 10**6)
            with _end_after(task.limits.seconds + _GRACE):
                result = make_certificate(task)
            line.send(result)


@contextlib.contextmanager
def _end_after(seconds: float) -> Iterator[None]:
    """Let the system end this process after a time, whatever it does, where the system can."""
    if not hasattr(signal, "setitimer"):
        yield
        return
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)


def _limit_memory(size: int) -> None:
    """Let this process have no more data than that, bytes, where the system can hold it to that."""
    try:
        import resource  # noqa: PLC0415 - not on every system
    except ImportError:
        return
    _, hard = resource.getrlimit(resource.RLIMIT_DATA)
    soft = size if hard == resource.RLIM_INFINITY else min(size, hard)
    resource.setrlimit(resource.RLIMIT_DATA, (soft, hard))


#: For which a scheduler may be silent, and be without workers, s.
_PATIENCE = 30
#: Tasks on their way for each thread of the workers: one that is worked on, and one that waits.
_AHEAD = 2
_LONGEST_MESSAGE = 400


@dataclass(frozen=True, slots=True)
class _Lost:
    """No worker came back with a task; why, in the words of the scheduler."""

    reason: str

    def make_failure(self, task: Task) -> Failed:
        message = " ".join(f"no worker lived to make this certificate: {self.reason}".split())
        return Failed((Problem(Place(str(task.job)), message[:_LONGEST_MESSAGE]),))


@dataclass(slots=True)
class Cluster:
    """The workers of a scheduler; it is left as a context manager, which takes leave of them."""

    scheduler: str  #: Its address: ``tcp://scheduler:8786``.
    named_at: Place  #: Where the fleet file names it.
    beat: Callable[[], None] = lambda: None  #: Is called every few seconds, whatever the workers do.
    _client: Any = field(default=None)

    def __enter__(self) -> Self:
        """Find the scheduler and its workers; raise `AccessError` if they are not there."""
        try:
            from distributed import Client  # noqa: PLC0415 - an extra, and slow to load
        except ImportError as error:
            raise InputError.at(self.named_at, "dask is not installed; install zlmreport[cluster]") from error
        try:
            self._client = Client(self.scheduler, timeout=_PATIENCE, set_as_default=False)
            self._client.wait_for_workers(1, timeout=_PATIENCE)
        except (OSError, ValueError, TimeoutError) as error:
            self.__exit__()
            message = f"no scheduler with workers answers at {self.scheduler}: {' '.join(str(error).split())}"
            raise AccessError.at(self.named_at, message) from error
        return self

    def __exit__(self, *_: object) -> None:
        if self._client is not None:
            self._client.close()
            self._client = None

    def make_all(self, tasks: Iterable[Task]) -> Iterator[tuple[Task, MadeCertificate | Failed]]:
        """Yield what became of each task, as it is done; tasks are taken as workers have time for them.

        A worker that is killed takes with it what waited there, too, and a scheduler suspects them all. So
        each of them is tried once more, alone, when nothing else is under way.
        """
        suspected = []
        for task, result in self._work_through(tasks):
            if isinstance(result, _Lost):
                suspected.append(task)
            else:
                yield task, result
        for suspect in suspected:
            for task, result in self._work_through([suspect]):
                yield task, result.make_failure(task) if isinstance(result, _Lost) else result

    def _work_through(self, tasks: Iterable[Task]) -> Iterator[tuple[Task, MadeCertificate | Failed | _Lost]]:
        from distributed import wait as first_of  # noqa: PLC0415 - as above

        waiting = iter(tasks)
        under_way: dict[Any, tuple[Task, float]] = {}
        with self._watch_scheduler():
            self._send(waiting, under_way)
        while under_way:
            done: set[Any] = set()
            with self._watch_scheduler():
                with contextlib.suppress(TimeoutError), self._client.as_current():
                    done = first_of(list(under_way), timeout=BEAT, return_when="FIRST_COMPLETED").done
                ended = [(future, self._receive(future)) for future in done]
                ended += [(future, self._stop(future, task)) for future, task in _find_late(under_way, done)]
            self.beat()
            for future, result in ended:
                task, _ = under_way.pop(future)
                with self._watch_scheduler():
                    future.release()
                    self._send(waiting, under_way)
                yield task, result

    @contextlib.contextmanager
    def _watch_scheduler(self) -> Iterator[None]:
        """Say that the scheduler is gone where it is, whatever was asked of it."""
        try:
            yield
        except (CancelledError, OSError) as error:
            message = f"the scheduler {self.scheduler} is gone; the next night makes what is left"
            raise AccessError.at(self.named_at, message) from error

    def _send(self, waiting: Iterator[Task], under_way: dict[Any, tuple[Task, float]]) -> None:
        """Let no worker wait, and none have more than it needs: results are as large as documents."""
        most = _AHEAD * max(1, sum(self._client.nthreads().values()))
        while len(under_way) < most and (task := next(waiting, None)) is not None:
            future = self._client.submit(make_certificate, task, pure=False)
            under_way[future] = task, time.monotonic()

    def _stop(self, future: Any, task: Task) -> Failed:
        """Take a task away from its worker by starting that anew; what waited there is made once more."""
        workers = [address for address, keys in self._client.processing().items() if future.key in keys]
        future.cancel(force=True)
        with contextlib.suppress(Exception):  # one without a nanny cannot be started again
            self._client.restart_workers(workers, timeout=_PATIENCE)
        return report_late(task)

    def _receive(self, future: Any) -> MadeCertificate | Failed | _Lost:
        if future.status == "finished":
            result: MadeCertificate | Failed = future.result()
            return result
        if future.status == "error":
            return _Lost(str(future.exception()))
        if self._client.status == "running":  # a worker ended while its result was fetched
            return _Lost("its worker ended with the result")
        raise CancelledError


def _find_late(under_way: Mapping[Any, tuple[Task, float]], done: Collection[Any]) -> list[tuple[Any, Task]]:
    """Return what has been under way for too long; each may have waited for as many as are sent ahead."""
    now = time.monotonic()
    return [
        (future, task)
        for future, (task, begun) in under_way.items()
        if future not in done and now - begun > _AHEAD * task.limits.seconds
    ]
