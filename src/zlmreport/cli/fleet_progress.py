"""How far a night is: a bar with the rate and the time that is left, where a terminal shows it."""

from __future__ import annotations

import shutil
import time
from typing import TextIO

from zlmreport.cli.fleet_log import duration

_BAR, _USUAL_WIDTH = 30, 80


class Progress:
    """A bar in the last line of a terminal; on any other stream there is none.

    Parameters
    ----------
    stream
        Of the terminal.
    total
        Number of certificates that are due.
    """

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
