"""The log of a night, for people or for programs; and how far it is, where a terminal shows it."""

from __future__ import annotations

import datetime as dt
import json
import shutil
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from typing import Any, TextIO

from zlmreport.cli.terminal import problem_values, visible
from zlmreport.fleet.issuing import Happened, What
from zlmreport.fleet.records import Notice

_WORD = 9
_BAR, _USUAL_WIDTH = 30, 80


class TextLog:
    """Lines for people."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._upgraded = 0

    def begun(self, fleet: str, due: int, jobs: int) -> None:
        """Write what is due."""
        self._line(f"{fleet}: {due} of {jobs} jobs are due")

    def happened(self, happened: Happened) -> None:
        """Write what happened to a job; nothing of one that is as it was, also after a new release."""
        if happened.is_upgrade:
            self._upgraded += 1
        if happened.what is What.UNCHANGED or happened.is_upgrade:
            return
        why = f": {happened.why}" if happened.why else ""
        number = f"{happened.number}  " if happened.number else ""
        limits = "; a limit is not met" if happened.conforms is False else ""
        self._line(f"{happened.what.value:{_WORD}} {number}{happened.job}{why}{limits}")
        for problem in happened.problems:
            self._line(f"{'':{_WORD}}   {problem}")

    def noticed(self, notice: Notice) -> None:
        """Write what concerns the whole night."""
        self._line(notice.text)

    def learned(self, file: str) -> None:
        """Write which file of priors is new."""
        self._line(f"{'learned':{_WORD}} {file}: for model.priors of the next tests")

    def ended(self, counts: Counter[What], seconds: float, *, is_interrupted: bool = False) -> None:
        """Write what the night came to."""
        done = "interrupted after" if is_interrupted else "done in"
        if self._upgraded:
            self._line(f"programs changed: {self._upgraded} made again, and none of their values changed")
        self._line(f"{done} {duration(seconds)}: {', '.join(counted(counts)) or 'no jobs'}")

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

    def noticed(self, notice: Notice) -> None:
        """Write what concerns the whole night."""
        self._line({"event": "noticed", "about": notice.about.value, "message": notice.text})

    def learned(self, file: str) -> None:
        """Write which file of priors is new."""
        self._line({"event": "learned", "file": file})

    def ended(self, counts: Counter[What], seconds: float, *, is_interrupted: bool = False) -> None:
        """Write what the night came to."""
        event = "interrupted" if is_interrupted else "ended"
        self._line({"event": event, "seconds": round(seconds, 1), "counts": by_word(counts)})

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
        "problems": [problem_values(each) for each in happened.problems],
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


class Progress:
    """A bar in the last line of a terminal; on any other stream there is none."""

    def __init__(self, stream: TextIO, total: int) -> None:
        self._stream = stream
        self._total = total
        self._done = self._failed = 0
        self._begun = time.monotonic()
        self._is_shown = stream.isatty() and total > 0
        self._draw()

    def hide(self) -> None:
        """Make room for a line."""
        if self._is_shown:
            print("\r\x1b[K", end="", file=self._stream, flush=True)

    def advance(self, *, failed: bool) -> None:
        """Count a certificate, and show the bar again."""
        self._done += 1
        self._failed += failed
        self._draw()

    def _draw(self) -> None:
        if self._is_shown:
            width = shutil.get_terminal_size((_USUAL_WIDTH, 0)).columns
            line = bar(self._done, self._total, self._failed, time.monotonic() - self._begun)
            print(f"\r\x1b[K{line[: width - 1]}", end="", file=self._stream, flush=True)


def bar(done: int, total: int, failed: int, seconds: float) -> str:
    """Return the bar.

    >>> bar(30, 120, 1, 10.0)
    ' 30/120 [#######.......................]  3.0/s, 30 s left, 1 failed'
    """
    filled = done * _BAR // total
    text = f"{done:>{len(str(total))}}/{total} [{'#' * filled}{'.' * (_BAR - filled)}]"
    if done and seconds > 0:
        rate = done / seconds
        text += f"  {rate:.{1 if rate >= 1 else 2}f}/s, {duration((total - done) / rate)} left"
    return f"{text}, {failed} failed" if failed else text
