"""A world in which time stands still until somebody waits: emulated instruments at ports, in no time at all.

Ports, decoders and capture are the product's own. They touch the world at three places, the serial port and
the two functions of `time` below, and there alone it is another one.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest
import serial

from zlmreport.cli import capture
from zlmreport.plugin.instrument import Emulator, LiveReading

#: The name under which an emulated instrument is found.
PORT = "socket://emulated:1"


class World:
    """Time, and what stands at the port.

    Attributes
    ----------
    now, ends
        s from the start of the emulation; in the end the instrument is unplugged.

    Parameters
    ----------
    emulator
        The instrument.
    ends
        When it is unplugged, s.
    line
        Returns what arrives of what it sends at a moment; without it all arrives.
    """

    def __init__(
        self, emulator: Emulator, ends: float, line: Callable[[bytes, float], bytes] | None = None
    ) -> None:
        self.now = 0.0
        self.ends = ends
        self._emulator = emulator
        self._line = line or (lambda data, _: data)

    def monotonic(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += max(seconds, 0.0)

    def plugged(self, *_: Any, **__: Any) -> _Serial:
        """Stand in for `serial.serial_for_url`."""
        return _Serial(self, self._emulator, self._line)


class _Serial:
    """As much of pyserial's port as is used of it."""

    def __init__(self, world: World, emulator: Emulator, line: Callable[[bytes, float], bytes]) -> None:
        self._world = world
        self._emulator = emulator
        self._line = line
        self._answers = b""

    def read(self, _size: int) -> bytes:
        now = self._world.now
        if now > self._world.ends:
            raise OSError("unplugged")
        data = self._line(self._emulator.unasked(now) + self._answers, now)
        self._answers = b""
        return data

    def write(self, data: bytes) -> None:
        self._answers += self._emulator.answer(data, self._world.now)

    def close(self) -> None: ...


class InStep(Iterator[LiveReading]):
    """Stands in for `ReadAhead`: time goes on only where somebody waits, and so nobody may run ahead."""

    def __init__(self, readings: Iterator[LiveReading]) -> None:
        self._readings = readings

    def __next__(self) -> LiveReading:
        return next(self._readings)

    def end(self) -> None: ...

    def give_up(self) -> None: ...


@contextmanager
def inhabited(world: World) -> Iterator[World]:
    """Let everything happen in a world."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(time, "monotonic", world.monotonic)
        patch.setattr(time, "sleep", world.sleep)
        patch.setattr(serial, "serial_for_url", world.plugged)
        patch.setattr(capture, "ReadAhead", InStep)
        yield world
