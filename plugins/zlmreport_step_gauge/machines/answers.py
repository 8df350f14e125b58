"""What an I++ DME server answers, line by line.

``TTTTT &`` acknowledges a command, ``TTTTT # …`` brings data, ``TTTTT ! Error(…)`` an error, and ``TTTTT %``
says that the command is done. T is the tag of the command: 00001 to 99999, E0001 to E9999 for one that is
sent while another runs, E0000 for what nobody asked for.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

#: The tag of what the server sends unasked.
UNASKED = "E0000"

_LINE = re.compile(r"(?P<tag>E[0-9]{4}|[0-9]{5}) (?P<kind>[&#!%])(?: (?P<text>.*))?")
_ERROR = re.compile(
    r'Error\(\s*(?P<severity>[0-9]+)\s*,\s*(?P<number>[0-9]{1,4})\s*,\s*(?P<method>[^,"]*?)\s*,'
    r'\s*"(?P<text>[^"]*)"\s*\)'
)
_ITEM = re.compile(r"\s*(?P<name>[A-Za-z][A-Za-z0-9_.]*)\((?P<values>[^()]*)\)\s*(?:,|$)")


class Kind(StrEnum):
    """What a line of the server is; the value is its sign."""

    ACKNOWLEDGED = "&"
    DATA = "#"
    ERROR = "!"
    DONE = "%"


@dataclass(frozen=True, slots=True)
class Answer:
    """A line of the server: to which command, what it is, and what it says."""

    tag: str
    kind: Kind
    text: str = ""


@dataclass(frozen=True, slots=True)
class MachineError:
    """An error of the server.

    Attributes
    ----------
    severity
        From 2 on the server takes no other command before ``ClearAllErrors``.
    number
        By the specification: 1006 is a surface that was not found.
    method
        The command, as the server calls it.
    text
        In its own words.
    """

    severity: int
    number: int
    method: str
    text: str

    @property
    def is_in_the_way(self) -> bool:
        """Whether the server takes no command until the errors are cleared."""
        return self.severity >= 2

    def __str__(self) -> str:
        """Return it as messages show it."""
        return f"{self.number:04d} {self.text} ({self.method})"


class UnreadableError(Exception):
    """A line is none of this protocol."""


def read_answer(line: str) -> Answer:
    """Return what a line says.

    >>> read_answer("00120 # X(1.5)")
    Answer(tag='00120', kind=<Kind.DATA: '#'>, text='X(1.5)')

    Raises
    ------
    UnreadableError
        If it is no answer.
    """
    found = _LINE.fullmatch(line)
    if found is None:
        raise UnreadableError(f"{line[:60]!r} is no answer of I++ DME")
    return Answer(found["tag"], Kind(found["kind"]), found["text"] or "")


def read_error(text: str) -> MachineError:
    """Return an error.

    >>> read_error('Error(3, 1006, PtMeas, "Surface not found")').number
    1006

    Raises
    ------
    UnreadableError
        If it is none.
    """
    found = _ERROR.fullmatch(text)
    if found is None:
        raise UnreadableError(f"{text[:60]!r} is no error of I++ DME")
    return MachineError(int(found["severity"]), int(found["number"]), found["method"], found["text"])


def read_data(text: str) -> Mapping[str, tuple[float, ...]]:
    """Return the numbers of a report by their names.

    >>> read_data("X(1.5), IJK(0, 0, 1)")
    {'X': (1.5,), 'IJK': (0.0, 0.0, 1.0)}

    Raises
    ------
    UnreadableError
        If there is anything else.
    """
    found: dict[str, tuple[float, ...]] = {}
    position = 0
    while position < len(text):
        item = _ITEM.match(text, position)
        if item is None:
            raise UnreadableError(f"{text[position : position + 60]!r} is no report of I++ DME")
        try:
            found[item["name"]] = tuple(float(value) for value in item["values"].split(","))
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


def advice(error: MachineError) -> str:
    """Return what the operator can do."""
    return _ADVICE.get(error.number, "look at the machine, and start again")
