"""What an operator, or a program that steers, is told of a capture, and the orders of both; bell, bar."""

from __future__ import annotations

import json
import os
import re
import select
import shutil
import sys
import textwrap
from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from queue import Empty, SimpleQueue
from threading import Thread
from typing import Any

from zlmreport.cli.terminal import Colour, hold_values, lay_out_heading, make_visible, write_duration
from zlmreport.errors import AccessError, InputError, Place, count_in_words
from zlmreport.job.job import Job
from zlmreport.language import Language
from zlmreport.language.formatting import HELD
from zlmreport.live.capture.events import (
    Commented,
    Elsewhere,
    Event,
    Frozen,
    Missed,
    NotNext,
    Order,
    Recorded,
    Skipped,
    TooSlow,
    TrackLost,
    Unclear,
    WrongDirection,
)
from zlmreport.live.capture.follower import Follower
from zlmreport.live.capture.of_job import Assignment
from zlmreport.live.capture.operator_texts import SIDES, AxisWriter, list_what_to_do, say_halted, tell_event
from zlmreport.live.capture.progress import Progress
from zlmreport.live.capture.records import MOMENTARY, to_record
from zlmreport.live.capture.visits import ListedVisit
from zlmreport.live.ports.reading import LiveReading

#: How often the present moment is shown, s: nobody reads it more often.
_BEAT = 0.1
_BELL = "\a"
#: What an operator looks at.
_WRONG = (Missed, WrongDirection, NotNext, TrackLost, Frozen, Unclear)
#: An answer: the stop is no visit.
_NO_VISIT = "none"
#: What the keys do, each with Enter.
_KEYS = "r 17, r run 2 take again, b back by one, s skip, c TEXT comment"
_BACKSPACE, _ESCAPE = "\x7f\b", "\x1b"
_CLEAR_BELOW, _UP = "\x1b[J", "\x1b[{}A"
_BAR = 24
#: What a line begins with before its words: the number of a step, or what happened.
_NAME = re.compile(r"\d+\. |\S+ {2,}")


def read_visit(text: str, progress: Progress, place: Place) -> ListedVisit | None:
    """Return the visit that a question is answered with, None for none; raise `InputError` for no answer."""
    if text == _NO_VISIT:
        return None
    visit = next((each for each in progress.visits if text == str(each.number)), None)
    if visit is None:
        raise InputError.at(
            place, f"{text[:60]!r} is no visit: state a number from 1 to {len(progress.visits)}, or none"
        )
    if progress.question is not None and visit.target != progress.question.target:
        raise InputError.at(place, f"visit {text} is at another target than the one at which the axis stood")
    return visit


def read_order(line: str, progress: Progress) -> Order:
    """Return what a line of the keyboard orders; raise `InputError` for nothing that can be done."""
    place = Place("keyboard")
    match line.strip().partition(" "):
        case ("r", _, rest) if rest:
            return progress.make_retake(rest, place)
        case ("b", _, "") if progress.taken:
            return progress.make_retake(str(progress.taken), place)
        case ("b", _, ""):
            raise InputError.at(place, "nothing was taken yet")
        case ("s", _, "") if not progress.has_all:
            return Skipped(progress.next)
        case ("c", _, rest) if rest:
            return Commented(rest.strip())
    raise InputError.at(place, f"{line[:60]!r} is no order: {_KEYS}")


class Keyboard:
    """Lines that are typed at a terminal, read without waiting for them; it shows them nowhere itself."""

    def __init__(self) -> None:
        self.typed = ""  #: What was typed of a line that is not finished.
        self._file = sys.stdin.fileno()

    @property
    def line(self) -> str:
        """What is shown of it: what is being typed, or what can be."""
        return f"> {self.typed}" if self.typed else f"keys   {_KEYS}"

    @contextmanager
    def take(self) -> Iterator[None]:
        """Take the keys one by one, and give the terminal back as it was."""
        import termios  # noqa: PLC0415 - not on every system
        import tty  # noqa: PLC0415

        before: list[Any] = termios.tcgetattr(self._file)
        tty.setcbreak(self._file, termios.TCSADRAIN)
        try:
            yield
        finally:
            termios.tcsetattr(self._file, termios.TCSADRAIN, before)

    def list_lines(self) -> Iterator[str]:
        """Yield the lines that were finished since it was asked last."""
        while select.select([self._file], [], [], 0)[0]:
            keys = os.read(self._file, 1024).decode(errors="replace")
            if not keys:
                return
            for key in keys:
                if key in "\r\n":
                    line, self.typed = self.typed, ""
                    yield line
                elif key in _BACKSPACE:
                    self.typed = self.typed[:-1]
                else:
                    self.typed = "" if key == _ESCAPE else self.typed + key


def is_watched() -> bool:
    """Tell whether somebody sits at a terminal whose cursor can be moved."""
    return sys.stdin.isatty() and sys.stdout.isatty() and os.environ.get("TERM", "dumb") != "dumb"


class PlainLines:
    """Shows a capture to somebody: a line for what happens; nothing moves, and nobody is asked."""

    def __init__(self, job: Job, assignment: Assignment) -> None:
        self._job = job
        self._assignment = assignment
        self._writer = AxisWriter(Language.ENGLISH, job.axis)

    def wait(self) -> None:
        """Say whose test it is, while the instrument is awaited."""
        number, axis = (
            make_visible(text) for text in (self._job.keys.certificate.number, self._job.axis.name)
        )
        visits = count_in_words(len(self._assignment.visits), "visit")
        method = self._assignment.plan.method
        rest = f"about {write_duration(self._assignment.estimate_remaining_time(0))}"
        for line in lay_out_heading(number, f"axis {axis}, {method}, {visits}, {rest}"):
            self._write_line(line)

    def begin(self, follower: Follower) -> None:
        """Say what is to be done."""
        for number, step in enumerate(list_what_to_do(follower.progress, self._writer), start=1):
            self._write_line(f"{number}. {step}")

    def tell(self, event: Event) -> None:
        """Print a line on an event."""
        line = write_terminal_line(event, self._assignment, self._writer)
        if line:
            self._write_line(line)

    def take_keys(self) -> AbstractContextManager[None]:
        """Take no orders."""
        return nullcontext()

    def show(self, follower: Follower, reading: LiveReading) -> Iterable[Order]:  # noqa: ARG002
        """Show nothing: a file has no present moment, and nobody is there to order."""
        return ()

    def see_to(self, event: Event | None, progress: Progress) -> None:
        """Raise `AccessError` with what is to be seen to."""
        steps = ", then ".join(list_what_to_do(progress, self._writer, event))
        raise AccessError.at(Place("zlmreport capture"), f"{say_halted(event, self._writer)}; {steps}")

    def ask(self, question: Unclear, progress: Progress) -> ListedVisit | None:  # noqa: ARG002
        """Raise `AccessError` with what may be answered."""
        raise AccessError.at(
            Place("zlmreport capture"),
            f"{say_halted(question, self._writer)}; nothing is filed: stop the program, look where it is, "
            "and state --answer with the number of the visit, or none",
        )

    def leave(self, message: str) -> None:
        """Print how the capture goes on."""
        self._write_line(message)

    def _write_line(self, line: str) -> None:
        print(line, flush=True)


class JsonLines(PlainLines):
    """Prints what happens as the journal has it, for another program."""

    def wait(self) -> None:
        """Print nothing."""

    def begin(self, follower: Follower) -> None:
        """Print nothing."""

    def tell(self, event: Event) -> None:
        """Print an event."""
        if not isinstance(event, MOMENTARY):
            self._write_line(json.dumps(to_record(event), ensure_ascii=False))

    def leave(self, message: str) -> None:
        """Print nothing: the journal is left as it is after any other end."""


class LiveDisplay(PlainLines):
    """Prints the same lines, and below them shows the present moment; a bell says that a reading is taken."""

    def __init__(self, job: Job, assignment: Assignment) -> None:
        super().__init__(job, assignment)
        self._shown = 0
        self._due = 0.0
        self._keyboard = Keyboard()

    def take_keys(self) -> AbstractContextManager[None]:
        """Take orders from the keyboard."""
        return self._keyboard.take()

    def tell(self, event: Event) -> None:
        """Print a line on an event, and ring: once for a reading, twice and in colour for what is wrong."""
        line = write_terminal_line(event, self._assignment, self._writer)
        is_wrong = isinstance(event, _WRONG) or (isinstance(event, Elsewhere) and event.factor is not None)
        if line:
            self._write_line(line, Colour.RED if is_wrong else None)
        if is_wrong or isinstance(event, Recorded):
            print(_BELL * (2 if is_wrong else 1), end="", flush=True)

    def show(self, follower: Follower, reading: LiveReading) -> Iterator[Order]:
        """Show the present moment, ten times a second at most; yield what was typed and can be done."""
        if reading.time < self._due:
            return
        for line in filter(str.strip, self._keyboard.list_lines()):
            try:
                yield read_order(line, follower.progress)
            except InputError as error:
                self._say(error.problems[0].message)
        self._due = reading.time + _BEAT
        width = shutil.get_terminal_size().columns - 1
        lines = [*_show_panel(reading, follower, self._assignment, self._writer), self._keyboard.line]
        shown = [make_visible(line)[:width] for line in lines]
        print(self._make_way_back(), *(f"{line}\n" for line in shown), sep="", end="", flush=True)
        self._shown = len(shown)

    def see_to(self, event: Event | None, progress: Progress) -> None:
        """Print what is wrong, and what to do, and wait until the operator has done it."""
        if isinstance(event, TooSlow):  # nothing that is done at the machine helps
            super().see_to(event, progress)
        self._say(say_halted(event, self._writer))
        self._write_line(f"First {list_what_to_do(progress, self._writer, event)[0]}.")
        try:
            input("Press Enter when that is done, Ctrl-C to stop: ")
        except EOFError as error:
            raise KeyboardInterrupt from error

    def ask(self, question: Unclear, progress: Progress) -> ListedVisit | None:
        """Ring, and ask which visit a stop is until there is an answer."""
        print(_BELL, end="", flush=True)
        self._say(say_halted(question, self._writer))
        self._write_line("Stop the program and look where it is.")
        while True:
            try:
                return read_visit(
                    input("Number of the visit at which it stood, or none: ").strip(),
                    progress,
                    Place("answer"),
                )
            except InputError as error:
                self._say(error.problems[0].message)
            except EOFError as error:
                raise KeyboardInterrupt from error

    def _write_line(self, line: str, colour: Colour | None = None) -> None:
        """Print a line; of one that is wider than the terminal, the rest below where its words began."""
        name = _NAME.match(line)
        indent = " " * (name.end() if name else 0)
        width = shutil.get_terminal_size().columns - 1
        for part in textwrap.wrap(hold_values(line), width, subsequent_indent=indent):
            shown = part.replace(HELD, " ")
            print(self._make_way_back() + (colour.set(shown) if colour else shown), flush=True)
            self._shown = 0
        self._due = 0.0

    def _say(self, message: str) -> None:
        """Print a message that is to be heeded."""
        self._write_line(make_visible(message), Colour.RED)

    def _make_way_back(self) -> str:
        """Return what takes the cursor to where the present moment is shown, and wipes that away."""
        return (_UP.format(self._shown) if self._shown else "") + "\r" + _CLEAR_BELOW


def write_terminal_line(event: Event, assignment: Assignment, writer: AxisWriter) -> str:
    """Return what a terminal shows of an event; nothing for one of the moment."""
    line = tell_event(event, len(assignment.visits), writer)
    if line is None:
        return ""
    return make_visible(f"{line.name:8} {line.text}" if line.name else line.text)


def _show_panel(
    reading: LiveReading, follower: Follower, assignment: Assignment, writer: AxisWriter
) -> Iterator[str]:
    """Yield what is next, what the instrument reads, and how far the test has come."""
    progress = follower.progress
    visit = progress.check or progress.next
    yield ""
    if progress.has_all and progress.datum is not None:
        yield f"next   {writer.write_position(progress.datum)}, the datum once more"
    else:
        why = ", to check the datum" if progress.check else ""
        yield f"next   {writer.name_visit(visit)} {writer.say(SIDES[visit.approach])}{why}"
    yield f"now    {_write_moment(reading, follower, assignment, writer)}"
    done, planned = progress.taken, len(progress.visits)
    full = round(_BAR * done / planned)
    bar = "█" * full + "░" * (_BAR - full)
    rest = f"about {write_duration(assignment.estimate_remaining_time(done))}"
    yield f"done   {bar}  {done} of {planned}, {planned - done} to go, {rest}"


def _write_moment(
    reading: LiveReading, follower: Follower, assignment: Assignment, writer: AxisWriter
) -> str:
    if not reading.is_usable and reading.message:
        return reading.message
    progress, status, settings = follower.progress, follower.status, assignment.settings
    still = (
        f"range {writer.write_small_length(status.range)}, still {status.still:.1f} of {settings.dwell:g} s"
    )
    if status.position is None:
        return f"waiting for the datum: {still}"
    away = status.position - progress.destination
    position = writer.write_position(status.position, 4)
    if abs(away) > settings.tolerance:
        return f"{position:>14}  {writer.write_position(-away, 3)} to go"
    return f"{position:>14}  {writer.write_deviation(away)}  {still}"


#: How often the present moment is told, s of the readings' clock.
_TOLD_EVERY = 0.2
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
                yield read_order(line, follower.progress)
            except InputError as error:
                self._say("refused", message=error.problems[0].message)
        self._due = reading.time + _TOLD_EVERY
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
                return read_visit(self._answer(), progress, Place("answer"))
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
