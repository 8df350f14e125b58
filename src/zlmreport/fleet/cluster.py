"""Workers of a Dask scheduler: the processes of many machines, which see the same files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any, Self

from zlmreport.errors import AccessError, InputError, Place, Problem
from zlmreport.fleet.making import Failed, Made, Task, work

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
    """

    scheduler: str
    named_at: Place
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
        from distributed import as_completed  # noqa: PLC0415 - as above

        waiting = iter(tasks)
        under_way: dict[str, Task] = {}
        done = as_completed(loop=self._client.loop, raise_errors=False)
        self._send(waiting, under_way, done)
        for future in done:
            task = under_way.pop(future.key)
            result = self._result(future)
            future.release()
            self._send(waiting, under_way, done)
            yield task, result

    def _send(self, waiting: Iterator[Task], under_way: dict[str, Task], done: Any) -> None:
        """Let no worker wait, and none have more than it needs: results are as large as documents."""
        most = _AHEAD * max(1, sum(self._client.nthreads().values()))
        while len(under_way) < most and (task := next(waiting, None)) is not None:
            future = self._client.submit(work, task, pure=False)
            under_way[future.key] = task
            done.add(future)

    def _result(self, future: Any) -> Made | Failed | _Lost:
        if future.status == "finished":
            result: Made | Failed = future.result()
            return result
        if future.status == "error":
            return _Lost(str(future.exception()))
        raise AccessError.at(self.named_at, f"the scheduler {self.scheduler} is gone")
