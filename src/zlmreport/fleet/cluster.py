"""Workers of a Dask scheduler: the processes of many machines, which see the same files."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from concurrent.futures import CancelledError
from dataclasses import dataclass, field
from typing import Any, Self

from zlmreport.errors import AccessError, InputError, Place, Problem
from zlmreport.fleet.making import BEAT, Failed, Made, Task, late, work

#: For which a scheduler may be silent, and be without workers, s.
_PATIENCE = 30
#: Tasks on their way for each thread of the workers: one that is worked on, and one that waits.
_AHEAD = 2
_LONGEST_MESSAGE = 400


@dataclass(frozen=True, slots=True)
class _Lost:
    """No worker came back with a task; why, in the words of the scheduler."""

    reason: str

    def failed(self, task: Task) -> Failed:
        message = " ".join(f"no worker lived to make this certificate: {self.reason}".split())
        return Failed((Problem(Place(str(task.job)), message[:_LONGEST_MESSAGE]),))


@dataclass(slots=True)
class Cluster:
    """The workers of a scheduler; it is left as a context manager, which takes leave of them.

    Attributes
    ----------
    scheduler
        Its address: ``tcp://scheduler:8786``.
    named_at
        Where the fleet file names it.
    beat
        Is called every few seconds, whatever the workers do.
    """

    scheduler: str
    named_at: Place
    beat: Callable[[], None] = lambda: None
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
        """Leave the scheduler."""
        if self._client is not None:
            self._client.close()
            self._client = None

    def results(self, tasks: Iterable[Task]) -> Iterator[tuple[Task, Made | Failed]]:
        """Yield what became of each task, as it is done; tasks are taken as workers have time for them.

        A worker that is killed takes with it what waited there, too, and a scheduler suspects them all. So
        each of them is tried once more, alone, when nothing else is under way.
        """
        suspected = []
        for task, result in self._done(tasks):
            if isinstance(result, _Lost):
                suspected.append(task)
            else:
                yield task, result
        for suspect in suspected:
            for task, result in self._done([suspect]):
                yield task, result.failed(task) if isinstance(result, _Lost) else result

    def _done(self, tasks: Iterable[Task]) -> Iterator[tuple[Task, Made | Failed | _Lost]]:
        from distributed import wait  # noqa: PLC0415 - as above

        waiting = iter(tasks)
        under_way: dict[Any, tuple[Task, float]] = {}
        with self._scheduler():
            self._send(waiting, under_way)
        while under_way:
            done: set[Any] = set()
            with self._scheduler():
                with contextlib.suppress(TimeoutError), self._client.as_current():
                    done = wait(list(under_way), timeout=BEAT, return_when="FIRST_COMPLETED").done
                ended = [(future, self._result(future)) for future in done]
                ended += [(future, self._stopped(future, task)) for future, task in _late(under_way, done)]
            self.beat()
            for future, result in ended:
                task, _ = under_way.pop(future)
                with self._scheduler():
                    future.release()
                    self._send(waiting, under_way)
                yield task, result

    @contextlib.contextmanager
    def _scheduler(self) -> Iterator[None]:
        """Say that the scheduler is gone where it is, whatever was asked of it."""
        try:
            yield
        except (CancelledError, OSError) as error:
            message = f"the scheduler {self.scheduler} is gone; the next night makes what is left"
            raise AccessError([*AccessError.at(self.named_at, message).problems]) from error

    def _send(self, waiting: Iterator[Task], under_way: dict[Any, tuple[Task, float]]) -> None:
        """Let no worker wait, and none have more than it needs: results are as large as documents."""
        most = _AHEAD * max(1, sum(self._client.nthreads().values()))
        while len(under_way) < most and (task := next(waiting, None)) is not None:
            future = self._client.submit(work, task, pure=False)
            under_way[future] = task, time.monotonic()

    def _stopped(self, future: Any, task: Task) -> Failed:
        """Take a task away from its worker by starting that anew; what waited there is made once more."""
        workers = [address for address, keys in self._client.processing().items() if future.key in keys]
        future.cancel(force=True)
        with contextlib.suppress(Exception):  # one without a nanny cannot be started again
            self._client.restart_workers(workers, timeout=_PATIENCE)
        return late(task)

    def _result(self, future: Any) -> Made | Failed | _Lost:
        if future.status == "finished":
            result: Made | Failed = future.result()
            return result
        if future.status == "error":
            return _Lost(str(future.exception()))
        if self._client.status == "running":  # a worker ended while its result was fetched
            return _Lost("its worker ended with the result")
        raise CancelledError


def _late(under_way: Mapping[Any, tuple[Task, float]], done: Collection[Any]) -> list[tuple[Any, Task]]:
    """Return what has been under way for too long; each may have waited for as many as are sent ahead."""
    now = time.monotonic()
    return [
        (future, task)
        for future, (task, begun) in under_way.items()
        if future not in done and now - begun > _AHEAD * task.limits.seconds
    ]
