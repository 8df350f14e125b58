"""The capture of a job from its page: the command, steered, in a process of its own; its last lines.

What the process prints is the present moment; what was taken is read from the journal, as after any other
capture. So the page may be closed and opened, and a busy server delays what is seen and nothing that is read.
"""

from __future__ import annotations

import json
import subprocess
from collections import deque
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from threading import Lock, Thread
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from zlmreport.errors import InputError
from zlmreport.live.capture.records import Record
from zlmreport.web.bench import PLACE
from zlmreport.web.processes import ENDED, start_command

#: Lines on what happened that the page shows.
_KEPT_LINES = 30
#: How long a process may take to write its last line, s; then it is killed, which loses nothing.
_PATIENCE = 10.0
#: Exit code of a command that was interrupted.
_INTERRUPTED = 130


class CaptureAction(StrEnum):
    """What a click on the page asks for."""

    BEGIN = "begin"  #: Take readings, from the beginning or where they ended.
    RETAKE = "retake"  #: The same, but first take visits again.
    ORDER = "order"  #: What would be typed at the terminal; empty for "done".
    STOP = "stop"  #: End for now.
    CLOSE = "close"  #: End for good: what was not taken is missing.


class CaptureRequest(BaseModel):
    """A click on the page of a capture."""

    model_config = ConfigDict(extra="forbid", strict=True)

    step: CaptureAction
    text: str = Field("", max_length=300, pattern=r"^[^\r\n]*$")


@dataclass(slots=True)
class CaptureProcess:
    """The process that captures, and what it said last."""

    path: Path  #: The job.
    plugins: Sequence[Path] = ()  #: Files that are plugins, from the command line.
    _process: subprocess.Popen[str] | None = None
    _lock: Lock = field(default_factory=Lock)
    _now: Record | None = None
    _asked: Record | None = None
    _events: deque[Record] = field(default_factory=lambda: deque(maxlen=_KEPT_LINES))
    _problems: list[str] = field(default_factory=list)

    def carry_out(self, request: CaptureRequest, *, has_begun: bool) -> None:
        """Do what a click asks for.

        `has_begun`: Whether the journal holds readings: then it is gone on with.

        Raises `InputError` where there is no capture to order something, or one is under way already.
        """
        match request.step:
            case CaptureAction.BEGIN:
                self._begin("--steered", *(["--resume"] if has_begun else []))
            case CaptureAction.RETAKE:
                self._begin("--steered", "--resume", "--retake", request.text)
            case CaptureAction.CLOSE:
                self._begin("--end")
            case CaptureAction.ORDER:
                self._order(request.text)
            case CaptureAction.STOP:
                self.end()

    def describe_state(self) -> dict[str, Any]:
        """Return whether it runs, the present moment, what it awaits, and what has happened, as records."""
        with self._lock:
            return {
                "runs": self._process is not None,
                "now": self._now,
                "asked": self._asked,
                "events": list(self._events),
                "problems": list(self._problems),
            }

    def end(self) -> None:
        """Let the process end as by Ctrl-C at a terminal: the journal says that it was interrupted."""
        with self._lock:
            process = self._process
            if process is None or process.stdin is None:
                return
            with suppress(OSError):  # it has just ended
                process.stdin.close()
        try:
            process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    def _begin(self, *arguments: str) -> None:
        with self._lock:
            if self._process is not None:
                raise InputError.at(PLACE, "a capture of this job is under way already")
            self._now, self._asked = None, None
            self._events.clear()
            self._problems.clear()
            self._process = start_command(
                "capture", str(self.path), *arguments, plugins=self.plugins, stdin=subprocess.PIPE
            )
            Thread(target=self._listen, args=(self._process,), daemon=True).start()

    def _order(self, text: str) -> None:
        with self._lock:
            if self._process is None or self._process.stdin is None:
                raise InputError.at(PLACE, "no capture is under way")
            self._asked = None
            try:
                self._process.stdin.write(f"{text}\n")
                self._process.stdin.flush()
            except OSError as error:  # it has just ended
                raise InputError.at(PLACE, "no capture is under way") from error

    def _listen(self, process: subprocess.Popen[str]) -> None:
        """Take in what a process says until it has ended."""
        complaints: list[str] = []
        with process:
            listener = Thread(target=lambda: complaints.extend(process.stderr or ()), daemon=True)
            listener.start()
            for line in process.stdout or ():
                self._hear(line)
            code = process.wait()
            listener.join()
        with self._lock:
            said = [each.strip() for each in complaints if each.strip()]
            self._problems = [] if code == _INTERRUPTED else said or ([ENDED] if code else [])
            self._process, self._now, self._asked = None, None, None

    def _hear(self, line: str) -> None:
        """Take in a line: a record, or a sentence of a command that prints none."""
        try:
            record = json.loads(line)
        except ValueError:
            record = {"record": "", "line": line.strip()}  # of a command that tells no events
        with self._lock:
            match record["record"]:
                case "now":
                    self._now = record
                case "awaits" | "asks":
                    self._asked = record
                case "refused":
                    self._events.append({"record": "", "line": record["message"]})
                case _ if record.get("line"):
                    self._events.append(record)
