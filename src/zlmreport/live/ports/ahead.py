"""Reads a port in a thread, so that no reading is lost while the program does something else."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from queue import Empty, SimpleQueue

from zlmreport.live.ports.reading import LiveReading

#: How often a wait for a reading looks whether the user wants to end it, s.
_LOOK = 0.2
#: How long who gives up waits for an instrument that is asked at that moment, s: it may keep silent.
_PATIENCE = 1.0


class ReadAhead(Iterator[LiveReading]):
    """Reads an instrument in a thread of its own, and hands its readings out as fast as they are asked for.

    Who asks may be late by any time, for the disk is slow or the computer has other work: nothing is lost
    by it, and each reading has the time at which it was taken. What the instrument fails with comes after
    all readings before it.

    It ends with the connection, or by `end`, after which another one may read the instrument.
    """

    def __init__(self, readings: Iterator[LiveReading]) -> None:
        self._stored: SimpleQueue[LiveReading | BaseException] = SimpleQueue()
        self._is_ended = False
        self._thread = threading.Thread(target=self._store, args=(readings,), daemon=True)
        self._thread.start()

    def _store(self, readings: Iterator[LiveReading]) -> None:
        try:
            for reading in readings:
                if self._is_ended:
                    return
                self._stored.put(reading)
            self._stored.put(StopIteration())
        except BaseException as error:  # noqa: BLE001 - it is raised where the readings are asked for
            self._stored.put(error)

    def __next__(self) -> LiveReading:
        """Return the next reading; raise what the instrument failed with, once there is none before it."""
        while True:
            try:
                found = self._stored.get(timeout=_LOOK)
            except Empty:
                continue
            if isinstance(found, BaseException):
                self._stored.put(found)  # who asks again is told again
                raise found
            return found

    def end(self) -> None:
        """Store nothing more, and wait until the instrument is let go."""
        self._is_ended = True
        self._thread.join()

    def give_up(self) -> None:
        """Store nothing more; an instrument that keeps silent is not waited for.

        Otherwise a thread would go on to ask it while the process ends, and what becomes of the standard
        streams then would be laid to the instrument.
        """
        self._is_ended = True
        self._thread.join(_PATIENCE)
