"""A session with an I++ DME server: commands, answers, errors with advice, how long it may be silent.

``TTTTT &`` acknowledges a command, ``TTTTT # …`` brings data, ``TTTTT ! Error(…)`` an error, and ``TTTTT %``
says that the command is done. T is the tag of the command: 00001 to 99999, E0001 to E9999 for one that is
sent while another runs, E0000 for what nobody asked for.
"""

from __future__ import annotations

import re
import socket
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import NoReturn, Self

from zlmreport.plugin import AccessError, Place, Problem
from zlmreport.plugin.source import parse_number

#: The tag of what the server sends unasked.
UNASKED = "E0000"

_LINE = re.compile(r"(?P<tag>E[0-9]{4}|[0-9]{5}) (?P<kind>[&#!%])(?: (?P<text>.*))?")
_ERROR = re.compile(
    r'Error\(\s*(?P<severity>[0-9]{1,4})\s*,\s*(?P<number>[0-9]{1,4})\s*,\s*(?P<method>[^,"]*?)\s*,'
    r'\s*"(?P<text>[^"]*)"\s*\)'
)
_ITEM = re.compile(r"\s*(?P<name>[A-Za-z][A-Za-z0-9_.]*)\((?P<values>[^()]*)\)\s*(?:,|$)")


class LineKind(StrEnum):
    """What a line of the server is; the value is its sign."""

    ACKNOWLEDGED = "&"
    DATA = "#"
    ERROR = "!"
    DONE = "%"


@dataclass(frozen=True, slots=True)
class Answer:
    """A line of the server: to which command, what it is, and what it says."""

    tag: str
    kind: LineKind
    text: str = ""


@dataclass(frozen=True, slots=True)
class MachineError:
    """An error of the server."""

    severity: int  #: From 2 on the server takes no other command before ``ClearAllErrors``.
    number: int  #: By the specification: 1006 is a surface that was not found.
    method: str  #: The command, as the server calls it.
    text: str  #: In its own words.

    @property
    def is_in_the_way(self) -> bool:
        """Whether the server takes no command until the errors are cleared."""
        return self.severity >= 2

    def __str__(self) -> str:
        return f"{self.number:04d} {self.text} ({self.method})"


class UnreadableError(Exception):
    """A line is none of this protocol."""


def read_answer(line: str) -> Answer:
    """Return what a line says.

    >>> read_answer("00120 # X(1.5)")
    Answer(tag='00120', kind=<LineKind.DATA: '#'>, text='X(1.5)')

    Raises `UnreadableError` if it is no answer.
    """
    found = _LINE.fullmatch(line)
    if found is None:
        raise UnreadableError(f"{line[:60]!r} is no answer of I++ DME")
    return Answer(found["tag"], LineKind(found["kind"]), found["text"] or "")


def read_error(text: str) -> MachineError:
    """Return an error.

    >>> read_error('Error(3, 1006, PtMeas, "Surface not found")').number
    1006

    Raises `UnreadableError` if it is none.
    """
    found = _ERROR.fullmatch(text)
    if found is None:
        raise UnreadableError(f"{text[:60]!r} is no error of I++ DME")
    return MachineError(int(found["severity"]), int(found["number"]), found["method"], found["text"])


def read_data(text: str) -> Mapping[str, tuple[float, ...]]:
    """Return the numbers of a report by their names.

    >>> read_data("X(1.5), IJK(0, 0, 1)")
    {'X': (1.5,), 'IJK': (0.0, 0.0, 1.0)}

    Raises `UnreadableError` if there is anything else.
    """
    found: dict[str, tuple[float, ...]] = {}
    position = 0
    while position < len(text):
        item = _ITEM.match(text, position)
        if item is None:
            raise UnreadableError(f"{text[position : position + 60]!r} is no report of I++ DME")
        try:
            found[item["name"]] = tuple(parse_number(value.strip()) for value in item["values"].split(","))
        except ValueError:
            raise UnreadableError(f"{item['name']}({item['values'][:40]}) is no number") from None
        position = item.end()
    return found


#: Errors of a measuring move after which the face counts as missed, and the path goes on.
NO_TOUCH = 1003
NO_SURFACE = 1006
#: The server waits for ``ClearAllErrors``.
NOT_CLEARED = 514

#: What the operator can do, by the number of the error.
_ADVICE = {
    500: "the emergency stop is pressed; release it, bring the machine to a safe place, and start again",
    NOT_CLEARED: "an earlier error is not cleared; clear it at the machine, and start again",
    1001: "the probe touched where nothing should be; look at the gauge and the tip, and start again",
    1008: "the path leaves what the machine can reach; state step_gauge.path.working_volume, and plan again",
    1502: "the machine has no tool of this name; see machine.tool in the job",
    2500: "the path leaves what the machine can reach; state step_gauge.path.working_volume, and plan again",
    2504: "the machine has run into something; look at the gauge and the tip, locate the gauge again, and "
    "start again",
}


def is_missed_face(error: MachineError) -> bool:
    """Whether an error of a measuring move says that the face was not found."""
    return error.number in {NO_TOUCH, NO_SURFACE}


def _say_advice(error: MachineError) -> str:
    return _ADVICE.get(error.number, "look at the machine, and start again")


_LAST_TAG = 99999
#: How long a server may take to acknowledge a command, s.
_ACKNOWLEDGED_WITHIN = 10.0


@dataclass(slots=True)
class SessionOutcome:
    """How a command ended."""

    data: list[str] = field(default_factory=list)  #: The texts of its data lines.
    errors: list[MachineError] = field(default_factory=list)


class Session:
    """A session with a server.

    `timeout`: How long a command may take from its acknowledgement to its end, s.
    `event`: Is told what the server sends unasked, as it is written.
    """

    def __init__(self, connection: ServerConnection, timeout: float, event: Callable[[str], None]) -> None:
        self._connection = connection
        self._timeout = timeout
        self._event = event
        self._tag = 0

    def order(self, command: str) -> list[str]:
        """Give a command that must succeed; return its data.

        Raises `AccessError` for any error that is in the way, and for a machine that does not answer.
        """
        outcome = self.ask(command)
        self._see_to(outcome)
        return outcome.data

    def begin(self, commands: Iterable[str]) -> None:
        """Give the commands before the first move; an error that an earlier session has left is cleared."""
        for command in commands:
            outcome = self.ask(command)
            if any(error.number == NOT_CLEARED for error in outcome.errors):
                self.clear()
                outcome = self.ask(command)
            self._see_to(outcome)

    def clear(self) -> None:
        """Let the server take commands again after an error."""
        self._see_to(self.ask("ClearAllErrors()"))

    def abort(self) -> None:
        """Stop the machine, whatever it does; nothing is waited for."""
        self._connection.send("E0001 AbortE()")

    def fail(self, error: MachineError) -> NoReturn:
        """Raise the error of the machine, with what the operator can do."""
        raise AccessError.at(self._connection.place, f"the machine stopped: {error}; {_say_advice(error)}")

    def ask(self, command: str) -> SessionOutcome:
        """Give a command, and return how it ended."""
        self._tag = self._tag % _LAST_TAG + 1
        tag = f"{self._tag:05d}"
        self._connection.send(f"{tag} {command}")
        outcome = SessionOutcome()
        is_acknowledged = False
        until = time.monotonic() + _ACKNOWLEDGED_WITHIN
        while True:
            answer = self._receive_next(until, command)
            if answer.tag == UNASKED:
                self._take_event(answer)
            elif answer.tag == "E0001":
                continue  # of AbortE, whose own end is of no matter
            elif answer.tag != tag:
                self._raise_misunderstood(f"an answer to {answer.tag} where one to {tag} is expected")
            elif answer.kind is LineKind.ACKNOWLEDGED and not is_acknowledged:
                is_acknowledged = True
                until = time.monotonic() + self._timeout
            elif answer.kind is LineKind.ACKNOWLEDGED or not (
                is_acknowledged or answer.kind is LineKind.ERROR
            ):
                self._raise_misunderstood(f"{answer.kind.value} at the wrong place in the answers to {tag}")
            elif answer.kind is LineKind.DATA:
                outcome.data.append(answer.text)
            elif answer.kind is LineKind.ERROR:
                is_acknowledged = True  # an order that makes no sense may be refused at once
                outcome.errors.append(self._make_error(answer))
            else:
                return outcome

    def _see_to(self, outcome: SessionOutcome) -> None:
        """Tell the errors that are not in the way; the first that is ends the session."""
        for error in outcome.errors:
            if error.is_in_the_way:
                self.fail(error)
            self._event(str(error))

    def _receive_next(self, until: float, command: str) -> Answer:
        line = self._connection.receive(until - time.monotonic())
        if line is None:
            name = command.partition("(")[0]
            raise AccessError.at(
                self._connection.place,
                f"the machine does not answer to {name}; look at the machine, state a larger timeout if it "
                "is slow, and start again",
            )
        try:
            return read_answer(line)
        except UnreadableError as error:
            self._raise_misunderstood(str(error))

    def _take_event(self, answer: Answer) -> None:
        """Tell what was sent unasked; an error that is in the way ends the session."""
        if answer.kind is LineKind.ERROR:
            error = self._make_error(answer)
            if error.is_in_the_way:
                self.fail(error)
            self._event(str(error))
        else:
            self._event(answer.text)

    def _make_error(self, answer: Answer) -> MachineError:
        try:
            return read_error(answer.text)
        except UnreadableError as error:
            self._raise_misunderstood(str(error))

    def _raise_misunderstood(self, what: str) -> NoReturn:
        raise AccessError.at(
            self._connection.place,
            f"{what}; is this the port of an I++ DME server, and are both of version 1.4?",
        )


_CHUNK = 4096
#: Longer than any line of the protocol: a wrong server fills no memory.
_LONGEST_LINE = 65536
#: How long a server may take to accept a connection, s.
_PATIENCE = 10.0


class ServerConnection:
    """Lines to and from a server.

    Raises `AccessError` if it cannot be reached; here and in every method, with what the operator can do.
    """

    def __init__(self, host: str, port: int) -> None:
        self.place = Place(f"{host}:{port}")
        try:
            self._socket = socket.create_connection((host, port), timeout=_PATIENCE)
        except OSError as error:
            raise AccessError.at(
                self.place,
                f"the machine's server cannot be reached ({_say(error)}); is it started, and are host and "
                "port right?",
            ) from error
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._rest = b""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_raised: object) -> None:
        self._socket.close()

    def send(self, line: str) -> None:
        """Send a line."""
        try:
            self._socket.sendall(f"{line}\r\n".encode("ascii"))
        except OSError as error:
            raise self._make_loss(_say(error)) from error

    def receive(self, patience: float) -> str | None:
        """Return the next line without its end; None if none comes within a time, s."""
        until = time.monotonic() + patience
        while b"\n" not in self._rest:
            if len(self._rest) > _LONGEST_LINE:
                raise self._make_loss("what it sends has no lines")
            self._socket.settimeout(max(0.001, until - time.monotonic()))
            try:
                data = self._socket.recv(_CHUNK)
            except TimeoutError:
                return None
            except OSError as error:
                raise self._make_loss(_say(error)) from error
            if not data:
                raise self._make_loss("it has hung up")
            self._rest += data
        line, _, self._rest = self._rest.partition(b"\n")
        return line.rstrip(b"\r").decode("ascii", errors="replace")

    def _make_loss(self, why: str) -> AccessError:
        message = (
            f"the connection to the machine is lost ({why}); look at the machine and the network, then start "
            "again: what was probed is kept"
        )
        return AccessError([Problem(self.place, message)])


def _say(error: OSError) -> str:
    return " ".join(str(error.strerror or error).split())[:200]
