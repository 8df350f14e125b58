"""A capture that a program shows and steers: JSON lines out, orders in as they are typed at a terminal."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from contextlib import suppress
from queue import Empty, SimpleQueue
from threading import Thread
from typing import Any

from zlmreport.cli.capture_display import JsonLines, order_of, visit_named, write_terminal_line
from zlmreport.errors import InputError, Place
from zlmreport.job.job import Job
from zlmreport.live.capture.events import Event, Order, TooSlow, Unclear
from zlmreport.live.capture.follower import Follower
from zlmreport.live.capture.of_job import Assignment
from zlmreport.live.capture.operator_texts import list_what_to_do, say_halted
from zlmreport.live.capture.progress import Progress
from zlmreport.live.capture.records import MOMENTARY, to_record
from zlmreport.live.capture.visits import ListedVisit
from zlmreport.live.ports.reading import LiveReading

#: How often the present moment is told, s of the readings' clock.
_BEAT = 0.2
_PLACE = Place("zlmreport capture --steered")


class SteeredLines(JsonLines):
    """Prints what happens, the present moment and what is asked, and takes orders from the standard input.

    An event is printed as the journal has it, with the line that a terminal shows. Four records more are of
    the moment and in no journal: ``to-do`` and ``now``, ``awaits`` (something is to be done, and then an
    empty line to be sent), ``asks`` (a visit is to be named, or none) and ``refused`` (a line that is no
    order). An order is what is typed at a terminal.
    """

    def __init__(self, job: Job, assignment: Assignment) -> None:
        super().__init__(job, assignment)
        self._due = float("-inf")
        self._orders: SimpleQueue[str | None] = SimpleQueue()
        Thread(target=self._listen, daemon=True).start()

    def begin(self, follower: Follower) -> None:
        """Print what is to be done before readings are taken."""
        self._say("to-do", steps=list_what_to_do(follower.progress, self._writer))

    def tell(self, event: Event) -> None:
        """Print an event."""
        if not isinstance(event, MOMENTARY):
            self._print(
                {**to_record(event), "line": write_terminal_line(event, self._assignment, self._writer)}
            )

    def show(self, follower: Follower, reading: LiveReading) -> Iterator[Order]:
        """Print the present moment, five times a second at most; yield what was ordered and can be done."""
        if reading.time < self._due:
            return
        for line in self._list_orders():
            try:
                yield order_of(line, follower.progress)
            except InputError as error:
                self._say("refused", message=error.problems[0].message)
        self._due = reading.time + _BEAT
        status = follower.status
        self._say(
            "now",
            position=status.position,
            still=status.still,
            range=status.range if status.still > 0 else None,
            message=reading.message if not reading.is_usable else "",
        )

    def see_to(self, event: Event | None, progress: Progress) -> None:
        """Print what is wrong and what to do, and wait for an empty line."""
        if isinstance(event, TooSlow):  # nothing that is done at the machine helps
            super().see_to(event, progress)
        steps = list_what_to_do(progress, self._writer, event)
        happened = None if event is None else to_record(event)
        self._say("awaits", message=say_halted(event, self._writer), steps=steps, event=happened)
        while self._answer():
            self._say("refused", message=f"first {steps[0]}; then send an empty line")

    def ask(self, question: Unclear, progress: Progress) -> ListedVisit | None:
        """Print what may be answered, and wait for an answer that is one."""
        while True:
            self._say("asks", message=say_halted(question, self._writer), event=to_record(question))
            try:
                return visit_named(self._answer(), progress, Place("answer"))
            except InputError as error:
                self._say("refused", message=error.problems[0].message)

    def _answer(self) -> str:
        """Wait for a line; the end of the input is that of the capture."""
        line = self._orders.get()
        if line is None:
            raise KeyboardInterrupt
        return line

    def _list_orders(self) -> Iterator[str]:
        """Yield the lines that have come since; an empty one orders nothing."""
        with suppress(Empty):
            while True:
                line = self._orders.get_nowait()
                if line is None:
                    raise KeyboardInterrupt
                if line:
                    yield line

    def _listen(self) -> None:
        for line in sys.stdin:
            self._orders.put(line.strip())
        self._orders.put(None)

    def _say(self, record: str, **values: Any) -> None:
        self._print({"record": record, **values})

    def _print(self, record: dict[str, Any]) -> None:
        self._write_line(json.dumps(record, ensure_ascii=False, allow_nan=False))
