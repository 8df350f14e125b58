"""The log of a night: lines for people, or lines of JSON for programs that gather logs."""

from __future__ import annotations

import datetime as dt
import json
from collections import Counter
from collections.abc import Iterator, Mapping
from typing import Any, TextIO

from zlmreport.cli.terminal import visible
from zlmreport.errors import Problem
from zlmreport.fleet.desk import Happened, What

_WORD = 9


class TextLog:
    """Lines for people."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def begun(self, fleet: str, due: int, jobs: int) -> None:
        """Write what is due."""
        self._line(f"{fleet}: {due} of {jobs} jobs are due")

    def happened(self, happened: Happened) -> None:
        """Write what happened to a job; nothing of one that is as it was."""
        if happened.what is What.UNCHANGED:
            return
        why = f": {happened.why}" if happened.why else ""
        number = f"{happened.number}  " if happened.number else ""
        limits = "; a limit is not met" if happened.conforms is False else ""
        self._line(f"{happened.what.value:{_WORD}} {number}{happened.job}{why}{limits}")
        for problem in happened.problems:
            self._line(f"{'':{_WORD}}   {problem}")

    def ended(self, counts: Counter[What], seconds: float) -> None:
        """Write what the night came to."""
        self._line(f"done in {duration(seconds)}: {', '.join(counted(counts)) or 'no jobs'}")

    def _line(self, text: str) -> None:
        moment = dt.datetime.now().astimezone().isoformat(sep=" ", timespec="seconds")
        print(f"{moment}  {visible(text)}", file=self._stream, flush=True)


class JsonLog:
    """Lines of JSON."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def begun(self, fleet: str, due: int, jobs: int) -> None:
        """Write what is due."""
        self._line({"event": "begun", "fleet": fleet, "due": due, "jobs": jobs})

    def happened(self, happened: Happened) -> None:
        """Write what happened to a job; nothing of one that is as it was."""
        if happened.what is not What.UNCHANGED:
            self._line({"event": happened.what.value, **of_job(happened)})

    def ended(self, counts: Counter[What], seconds: float) -> None:
        """Write what the night came to."""
        self._line({"event": "ended", "seconds": round(seconds, 1), "counts": by_word(counts)})

    def _line(self, content: Mapping[str, Any]) -> None:
        moment = dt.datetime.now(dt.UTC).isoformat(timespec="milliseconds")
        print(json.dumps({"time": moment, **content}), file=self._stream, flush=True)


def of_job(happened: Happened) -> dict[str, Any]:
    """Return what happened to a job, for programs."""
    return {
        "job": happened.job,
        "number": happened.number or None,
        "why": happened.why or None,
        "files": list(happened.files),
        "conforms": happened.conforms,
        "problems": [_problem(each) for each in happened.problems],
    }


def by_word(counts: Counter[What]) -> dict[str, int]:
    """Return how often each thing happened, the rarest too."""
    return {what.value: counts[what] for what in What}


def counted(counts: Counter[What]) -> Iterator[str]:
    """Yield how often each thing happened, for people."""
    words = {What.DRAFT: "drafts"}
    for what in What:
        if counts[what]:
            word = words.get(what, what.value) if counts[what] > 1 else what.value
            yield f"{counts[what]} {word}"


def duration(seconds: float) -> str:
    """Return a duration as people say it.

    >>> duration(4.2), duration(200), duration(7300)
    ('4 s', '3:20 min', '2:01 h')
    """
    if seconds < 60:
        return f"{seconds:.0f} s"
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes}:{rest:02} min" if minutes < 60 else f"{minutes // 60}:{minutes % 60:02} h"


def _problem(problem: Problem) -> dict[str, Any]:
    return {
        "file": problem.place.file,
        "line": problem.place.line or None,
        "column": problem.place.column or None,
        "message": problem.message,
    }
