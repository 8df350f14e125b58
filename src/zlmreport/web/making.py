"""Makes files of the job in a process of their own, as a command on the terminal does, and hands them out.

Pages of a PDF are handed out as pictures: a preview beside the graphs, for the policy of the page allows no
frame.
"""

from __future__ import annotations

import io
import json
import subprocess
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from threading import Lock, Thread
from typing import Any

import pypdfium2

from zlmreport.errors import Place, Problem
from zlmreport.web.processes import ENDED, start_command

#: Pixels for each point of the page: 108 to the inch, for a screen.
_SCALE = 1.5
#: The library behind is not made for several threads.
_ONE_AT_A_TIME = Lock()
_PDF = ".pdf"
#: Under which name a sheet is asked for: no file has it, for files have suffixes.
_SHEET = "sheet"


@dataclass(frozen=True, slots=True)
class CommandResult:
    """What a command came to."""

    files: tuple[Path, ...] = ()  #: What it wrote.
    problems: tuple[str, ...] = ()  #: What stood against it, each with its place.
    values: dict[str, Any] = field(default_factory=dict)  #: What else it says, as its JSON has it.
    #: The sheet beside a certificate, to be looked at first; None where there is none.
    sheet: Path | None = None

    def list_pages(self) -> dict[str, Path]:
        """Return what can be looked at page by page, in this order: the sheet first."""
        sheet = {_SHEET: self.sheet} if self.sheet else {}
        return sheet | {each.name: each for each in self.files if each.suffix == _PDF}


def make_documents(output: str, complaints: str) -> CommandResult:
    """Return what ``zlmreport JOB.yaml [SHEET.yaml] --json`` came to, by what it printed.

    A sheet that does not hold the certificate is none.
    """
    try:
        job, *sheets = json.loads(output)["jobs"]
    except (ValueError, KeyError, TypeError):
        return CommandResult(problems=_list_lines(complaints))
    problems = map(_write_problem, job["problems"])
    sheet = next((Path(name) for each in sheets for name in each["files"] if name.endswith(_PDF)), None)
    return CommandResult(tuple(map(Path, job["files"])), tuple(problems), sheet=sheet)


def _write_problem(problem: dict[str, Any]) -> str:
    """Return a mistake of a summary as a terminal has it: not every mistake has a line."""
    place = Place(problem["file"], problem["line"] or 0, problem["column"] or 0)
    return str(Problem(place, problem["message"]))


def make_values(output: str, complaints: str) -> CommandResult:
    """Return what another command came to, by the values that it printed; what it wrote is among them."""
    try:
        found = json.loads(output)
    except ValueError:
        return CommandResult(problems=_list_lines(complaints))
    return CommandResult(tuple(map(Path, found.get("files", ()))), (), found)


def _list_lines(complaints: str) -> tuple[str, ...]:
    return tuple(complaints.splitlines()) or (ENDED,)


@dataclass(slots=True)
class Making:
    """One command of a job, run from its page."""

    read: Callable[
        [str, str], CommandResult
    ]  #: Returns what the command came to, by its output and its complaints.
    plugins: Sequence[Path] = ()  #: Files that are plugins, from the command line.
    _process: subprocess.Popen[str] | None = None
    _stamp: str = ""
    _began: float = 0.0
    _made: CommandResult | None = None
    _lock: Lock = field(default_factory=Lock)

    def begin(self, stamp: str, *arguments: str) -> None:
        """Begin a command on a state of the job, unless one is under way.

        `arguments`: As on the terminal; ``--json`` is added.
        """
        with self._lock:
            if self._process is not None:
                return
            self._stamp, self._began, self._made = stamp, time.monotonic(), None
            self._process = start_command(*arguments, "--json", plugins=self.plugins)
            Thread(target=self._listen, args=(self._process,), daemon=True).start()

    def describe_state(self) -> dict[str, Any]:
        """Return how far the command is, what it came to, and of which state of the job."""
        with self._lock:
            if self._process is not None:
                return {"state": "making", "seconds": round(time.monotonic() - self._began, 1)}
            made = self._made
            if made is None:
                return {"state": "none"}
            return {
                "state": "failed" if made.problems else "made",
                "files": sorted(each.name for each in made.files),
                "pages": {name: _count_pages(path) for name, path in made.list_pages().items()},
                "problems": list(made.problems),
                "values": made.values,
                "stamp": self._stamp,
            }

    def find_file(self, name: str) -> Path | None:
        """Return where a file lies that the command wrote; None for any other name."""
        with self._lock:
            made = self._made or CommandResult()
            return (made.list_pages() | {each.name: each for each in made.files}).get(name)

    def end(self) -> None:
        """End the process, if there is one."""
        with self._lock:
            process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.wait()

    def _listen(self, process: subprocess.Popen[str]) -> None:
        output, complaints = process.communicate()
        with self._lock:
            if process is not self._process:
                return
            self._process = None
            self._made = self.read(output, complaints)


def draw_page(path: Path, number: int) -> bytes | None:
    """Return a page of a PDF as PNG, counted from 1; None where there is no such page."""
    with _ONE_AT_A_TIME, pypdfium2.PdfDocument(path) as document:
        if not 0 < number <= len(document):
            return None
        content = io.BytesIO()
        document[number - 1].render(scale=_SCALE).to_pil().save(content, "PNG")
        return content.getvalue()


def _count_pages(path: Path) -> int:
    with _ONE_AT_A_TIME, pypdfium2.PdfDocument(path) as document:
        return len(document)
