"""Notes which plugin is at work, so that it can be named if it ends the process.

A plugin can end its process, be ended by a signal, close what others write to, or fork. No exception tells of
that. So the boundary notes whom it calls in memory that another process may share, and looks after each call
whether this is still the same process, with its standard streams.
"""

from __future__ import annotations

import contextlib
import os
import select
import struct
import sys
import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeAlias

from zlmreport.errors import list_names

#: What is noted: who is at work, who was last, what is wrong with the process, each as a text of this room.
_ROOM = 500
_CALLED, _LAST, _WRONG = range(3)
SIZE = 3 * (_ROOM + 2)
#: For which a copy of the process that a plugin forked is waited for, s: one that comes back does so at once.
_PATIENCE = 1.0
_STREAMS = {1: "stdout", 2: "stderr"}
_Streams: TypeAlias = Mapping[int, tuple[int, int] | None]


@dataclass(frozen=True, slots=True)
class Before:
    """How it was before a plugin was asked: who was at work, in which process, with which streams."""

    called: bytes
    process: int
    streams: _Streams


class Presence:
    """Notes whom the boundary calls.

    `memory`: Of `SIZE` bytes; another process may read it by a `Presence` of its own.
    """

    def __init__(self, memory: memoryview) -> None:
        self._memory = memory
        self._called = b""
        self._copies: list[int] = []
        self._own_end: int | None = None

    def use(self, memory: memoryview) -> None:
        """Note in other memory from now on."""
        self._memory = memory

    def begin(self, asked: str) -> Before:
        """Note that a plugin is asked something; return how it was before, for `end`."""
        before = Before(self._called, os.getpid(), _find_identities())
        self._called = asked.encode("utf-8", "backslashreplace")[:_ROOM]
        self._write(_CALLED, self._called)
        return before

    def end(self, before: Before) -> str:
        """Note that it answered, whatever it answered; return what is wrong with the process since then.

        A copy of the process that comes back here instead of it ends.
        """
        called, self._called = self._called, before.called
        if os.getpid() != before.process:
            self._write(_WRONG, called + b" forked the process, and its copy came back")
            if self._own_end is not None:
                os.write(self._own_end, b".")
            os._exit(2)
        self._write(_LAST, called)
        self._write(_CALLED, before.called)
        wrong = _find_lost_streams(before.streams) or (self._has_come_back() if self._copies else "")
        if wrong:
            self._write(_WRONG, called + b" " + wrong.encode())
        return wrong

    @property
    def called(self) -> str:
        """Who is at work; empty for nobody."""
        return self._read(_CALLED)

    @property
    def last(self) -> str:
        """Who answered last."""
        return self._read(_LAST)

    @property
    def wrong(self) -> str:
        """What is wrong with the process, and by whom."""
        return self._read(_WRONG)

    def _write(self, which: int, text: bytes) -> None:
        place = which * (_ROOM + 2)
        text = text[:_ROOM]
        self._memory[place : place + 2 + len(text)] = struct.pack("<H", len(text)) + text

    def _read(self, which: int) -> str:
        place = which * (_ROOM + 2)
        (length,) = struct.unpack("<H", bytes(self._memory[place : place + 2]))
        return bytes(self._memory[place + 2 : place + 2 + length]).decode("utf-8", "replace")

    def prepare_fork(self) -> None:
        """Make a line on which a copy can tell that it came back; only a plugin's copy is of interest."""
        if self._called:
            self._copies.extend(os.pipe())

    def keep_end_of_copy(self) -> None:
        """Keep the end of the line that is the copy's."""
        if self._copies:
            self._own_end = self._copies[-1]
            self._copies.clear()

    def keep_other_end(self) -> None:
        """Keep the other end."""
        if self._called and self._copies:
            os.close(self._copies.pop())

    def _has_come_back(self) -> str:
        """Return whether a copy came back; one that works on, and one that has ended, did not."""
        until = time.monotonic() + _PATIENCE
        found = ""
        while self._copies:
            end = self._copies[0]
            ready, _, _ = select.select([end], [], [], max(0.0, until - time.monotonic()))
            with contextlib.suppress(OSError):
                if ready and os.read(end, 1):
                    found = "forked the process, and its copy came back"
                os.close(end)
            del self._copies[0]
        return found


def _find_identities() -> _Streams:
    """Return what each standard stream is, by its number; None for one that is closed."""
    found: dict[int, tuple[int, int] | None] = {}
    for number, name in _STREAMS.items():
        stream = getattr(sys, name)
        try:
            status = os.fstat(number)
        except OSError:
            found[number] = None
        else:
            is_closed = stream is not None and stream.closed
            found[number] = None if is_closed else (status.st_dev, status.st_ino)
    return found


def _find_lost_streams(before: _Streams) -> str:
    """Return which standard streams are not what they were; what is written to them goes nowhere then."""
    now = _find_identities()
    lost = [number for number in _STREAMS if now[number] != before[number]]
    for number in lost:
        sink = os.open(os.devnull, os.O_WRONLY)
        if sink != number:
            os.dup2(sink, number)
            os.close(sink)
        stream = getattr(sys, _STREAMS[number])
        if stream is not None and stream.closed:
            setattr(sys, _STREAMS[number], os.fdopen(number, "w", closefd=False))
    return f"closed or changed {list_names(_STREAMS[number] for number in lost)}" if lost else ""


#: Of this process.
PRESENCE = Presence(memoryview(bytearray(SIZE)))
if hasattr(os, "register_at_fork"):
    os.register_at_fork(
        before=PRESENCE.prepare_fork,
        after_in_child=PRESENCE.keep_end_of_copy,
        after_in_parent=PRESENCE.keep_other_end,
    )
