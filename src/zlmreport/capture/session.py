"""One sitting of a capture: readings in, events out, each on the disk before the next reading comes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from zlmreport.capture.events import Event
from zlmreport.capture.follower import Follower
from zlmreport.capture.journal import Journal
from zlmreport.capture.records import MOMENTARY
from zlmreport.live.reading import LiveReading


def captured(
    readings: Iterable[LiveReading],
    follower: Follower,
    journal: Journal,
    elapsed: Callable[[float], float],
    *,
    show: Callable[[LiveReading], None] = lambda _reading: None,
) -> Iterator[Event]:
    """Follow readings, write down what happens, and yield it; end when nothing more is taken.

    Parameters
    ----------
    readings
        Of the instrument.
    follower
        It begins with the progress of the journal.
    journal
        Where it is written down.
    elapsed
        From the time of a reading to s from the start of the capture.
    show
        Is called with each reading, when all that happened with it is on the disk.
    """
    for reading in readings:
        for event in follower.feed(reading):
            if not isinstance(event, MOMENTARY):
                journal.append(event, elapsed(reading.time))
            yield event
        show(reading)
        if follower.is_halted:
            return
