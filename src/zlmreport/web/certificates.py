"""Makes the job's documents in a process of their own, as ``zlmreport JOB.yaml`` does, and hands them out."""

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


@dataclass(slots=True)
class Certificates:
    """The documents of a job that were made from its page.

    Attributes
    ----------
    path
        The job file.
    plugins
        Files that are plugins, from the command line.
    """

    path: Path
    plugins: Sequence[Path] = ()
    _process: subprocess.Popen[str] | None = None
    _stamp: str = ""
    _began: float = 0.0
    _files: dict[str, Path] = field(default_factory=dict)
    _problems: tuple[str, ...] = ()
    _lock: Lock = field(default_factory=Lock)

    def make(self, stamp: str) -> None:
        """Begin to make the documents of a state of the job, unless that is under way."""
        with self._lock:
            if self._process is not None:
                return
            self._stamp, self._began = stamp, time.monotonic()
            self._files, self._problems = {}, ()
            plugins = (part for each in self.plugins for part in ("--plugin", str(each.resolve())))
            self._process = subprocess.Popen(  # noqa: S603 - this program itself
                [sys.executable, "-m", "zlmreport", str(self.path.resolve()), "--json", *plugins],
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                encoding="utf-8",
                start_new_session=True,  # Ctrl-C on the terminal is for the server, which ends this one
                env={**os.environ, "PYTHONIOENCODING": "utf-8"},
            )
            Thread(target=self._listen, args=(self._process,), daemon=True).start()

    def state(self) -> dict[str, Any]:
        """Return how far the documents are, and of which state of the job they are."""
        with self._lock:
            if self._process is not None:
                return {"state": "making", "seconds": round(time.monotonic() - self._began, 1)}
            return {
                "state": "made" if self._files else "failed" if self._problems else "none",
                "files": sorted(self._files),
                "problems": list(self._problems),
                "stamp": self._stamp,
            }

    def file(self, name: str) -> Path | None:
        """Return where a document lies that was made from the page; None for any other name."""
        with self._lock:
            return self._files.get(name)

    def end(self) -> None:
        """End the process, if there is one."""
        with self._lock:
            process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.wait()

    def _listen(self, process: subprocess.Popen[str]) -> None:
        output, _ = process.communicate()
        with self._lock:
            if process is not self._process:
                return
            self._process = None
            self._files, self._problems = _made(output)


def _made(output: str) -> tuple[dict[str, Path], tuple[str, ...]]:
    """Return the files that a summary names, and the problems."""
    try:
        (job,) = json.loads(output)["jobs"]
    except (ValueError, KeyError, TypeError):
        return {}, ("the documents could not be made: zlmreport ended unexpectedly",)
    problems = (f"{each['file']}:{each['line']}: {each['message']}" for each in job["problems"])
    return {Path(file).name: Path(file) for file in job["files"]}, tuple(problems)
