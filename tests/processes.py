"""Programs that tests start: each leads a process group that dies with its block, and no wait is endless."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from subprocess import CompletedProcess
from typing import Any, TypeVar

Found = TypeVar("Found")

#: The longest that is waited for a program, s: far longer than any takes on a busy machine.
PATIENCE = 500.0
#: The same for one that was killed: it ends whatever it does, once its turn comes.
_DYING = 500.0
PYTHON = sys.executable
ZLMREPORT = (PYTHON, "-m", "zlmreport")


@contextmanager
def group(*command: Any, **settings: Any) -> Iterator[subprocess.Popen[Any]]:
    """Start a program, and kill it with all that it has started when the block is left, however that is."""
    process = subprocess.Popen(command, start_new_session=True, **settings)
    try:
        yield process
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait(_DYING)
        for stream in filter(None, (process.stdin, process.stdout, process.stderr)):
            stream.close()


def run(*command: Any, check: bool = False, **settings: Any) -> CompletedProcess[str]:
    """Run a program to its end, as `subprocess.run` does, and keep what it prints as text.

    With `check` it must succeed.
    """
    streams = {
        "stdin": subprocess.DEVNULL,
        "stdout": subprocess.PIPE,
        "stderr": subprocess.PIPE,
        "encoding": "utf-8",
    }
    with group(*command, **(streams | settings)) as process:
        output, errors = process.communicate(timeout=PATIENCE)
    status = process.returncode
    assert not check or status == 0, f"{command} ended with {status}:\n{output}{errors}"
    return CompletedProcess(command, status, output, errors)


@dataclass(slots=True)
class Program:
    """A program that runs, and what it prints."""

    process: subprocess.Popen[bytes]
    _arrived: bytes = b""

    def until(self, mark: str) -> str:
        """Return what is printed before a mark; fail if the program ends before it, or falls silent."""
        while mark.encode() not in self._arrived:
            assert self._hear(), f"{self.process.args} printed no {mark!r}: {self._arrived.decode()}"
        printed, _, self._arrived = self._arrived.partition(mark.encode())
        return printed.decode()

    def lines(self, count: int) -> list[str]:
        """Return the next lines; fail if the program ends before them, or falls silent."""
        return [f"{self.until(os.linesep)}\n" for _ in range(count)]

    def ended(self, by: signal.Signals = signal.SIGTERM) -> list[str]:
        """End the program by a signal, in good order, and return the lines that were left."""
        self.process.send_signal(by)
        assert self.process.wait(PATIENCE) == 0
        while self._hear():
            pass
        return self._arrived.decode().splitlines(keepends=True)

    def _hear(self) -> bool:
        assert self.process.stdout
        ready, _, _ = select.select([self.process.stdout], [], [], PATIENCE)
        more = os.read(self.process.stdout.fileno(), 65536) if ready else b""
        self._arrived += more
        return bool(more)


@contextmanager
def started(*command: Any, **settings: Any) -> Iterator[Program]:
    """Start a program whose output is read as it comes."""
    with group(*command, stdout=subprocess.PIPE, **settings) as process:
        yield Program(process)


def awaited(found: Callable[[], Found | None]) -> Found:
    """Return what is found in the end, as soon as it is; fail if that takes too long."""
    until = time.monotonic() + PATIENCE
    while not (result := found()):
        assert time.monotonic() < until, "it does not come"
        time.sleep(0.02)
    return result
