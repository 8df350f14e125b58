"""Keeps one diagnosis under way: of the job as it is now; one of a job that has changed is ended."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from threading import Lock, Thread
from typing import Any

_COMMAND = (sys.executable, "-m", "zlmreport.web.worker")


@dataclass(slots=True)
class Diagnoses:
    """The diagnosis of a job, made beside the pages.

    Attributes
    ----------
    path
        The job file.
    plugins
        Files that are plugins, from the command line.
    """

    path: Path
    plugins: Sequence[Path] = ()
    _worker: subprocess.Popen[str] | None = None
    _asked: str = ""
    _began: float = 0.0
    _answer: dict[str, Any] | None = None
    _lock: Lock = field(default_factory=Lock)

    def of(self, stamp: str) -> dict[str, Any]:
        """Return the diagnosis of a state of the job, or for how many seconds it has been under way."""
        with self._lock:
            if self._asked != stamp:
                self._ask(stamp)
            if self._answer is not None and self._answer["stamp"] != stamp:
                self._ask(stamp)  # the job changed while its files were read
            if self._answer is None:
                return {"seconds": round(time.monotonic() - self._began, 1)}
            return self._answer

    def end(self) -> None:
        """End the process."""
        with self._lock:
            self._end()

    def warm_up(self) -> None:
        """Start the process, so that the first diagnosis need not wait for it."""
        with self._lock:
            self._running()

    def _ask(self, stamp: str) -> None:
        if self._asked and self._answer is None:
            self._end()
        worker = self._running()
        self._asked, self._answer, self._began = stamp, None, time.monotonic()
        assert worker.stdin is not None  # noqa: S101 - opened as a pipe
        try:
            worker.stdin.write("\n")
            worker.stdin.flush()
        except BrokenPipeError:
            self._end()
            self._answer = {"stamp": stamp, "problems": ["the diagnosis ended unexpectedly"]}
            return
        Thread(target=self._listen, args=(worker, stamp), daemon=True).start()

    def _listen(self, worker: subprocess.Popen[str], stamp: str) -> None:
        assert worker.stdout is not None  # noqa: S101 - opened as a pipe
        line = worker.stdout.readline()
        with self._lock:
            if worker is not self._worker or stamp != self._asked:
                return
            if line:
                self._answer = json.loads(line)
            else:
                self._end()
                self._answer = {"stamp": stamp, "problems": ["the diagnosis ended unexpectedly"]}

    def _running(self) -> subprocess.Popen[str]:
        if self._worker is None:
            environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "PYTHONIOENCODING": "utf-8"}
            self._worker = subprocess.Popen(  # noqa: S603 - this program itself
                [*_COMMAND, str(self.path.resolve()), *(str(each.resolve()) for each in self.plugins)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                encoding="utf-8",
                start_new_session=True,  # Ctrl-C on the terminal is for the server, which ends this one
                env=environment,
            )
        return self._worker

    def _end(self) -> None:
        worker, self._worker = self._worker, None
        if worker is None:
            return
        worker.kill()
        worker.wait()
        for pipe in (worker.stdin, worker.stdout):
            if pipe is not None:
                pipe.close()
