"""An emulated machine as an I++ DME 1.4 server: text in, text out, and no port and no clock.

It is strict where a client must be right: tags, one space, CR LF, known commands with their arguments, and
nothing but ``ClearAllErrors`` after an error. Its moves take no time.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from zlmreport.plugin import FloatArray
from zlmreport_step_gauge.machines.emulated import CoordinateMachine

_NUMBER = r"[-+]?\d+(?:\.\d+)?"
_COMMAND = re.compile(r"(?P<tag>\d{5}|E\d{4}) (?P<name>[A-Za-z]+)\((?P<arguments>.*)\)")
_POINT = rf"X\(({_NUMBER})\), Y\(({_NUMBER})\), Z\(({_NUMBER})\)"
_GO_TO = re.compile(_POINT)
_MEASURE = re.compile(rf"{_POINT}, IJK\(({_NUMBER}), ?({_NUMBER}), ?({_NUMBER})\)")
_PROPERTY = re.compile(rf"Tool\.(GoToPar|PtMeasPar)\.([A-Z][a-z]+)\(({_NUMBER})\)")
_PROPERTIES = {
    ("GoToPar", "Speed"),
    ("PtMeasPar", "Speed"),
    ("PtMeasPar", "Approach"),
    ("PtMeasPar", "Search"),
    ("PtMeasPar", "Retract"),
}
_REPORT = re.compile(r"X\(\), Y\(\), Z\(\)(, IJK\(\))?(, Temperature\(\))?")
_PER_METRE = 1000.0


class PointFault(StrEnum):
    """What goes wrong at a measuring move, as the command line names it."""

    NO_TOUCH = "no-touch"
    NO_SURFACE = "no-surface"
    COLLISION = "collision"
    EMERGENCY_STOP = "emergency-stop"
    LOST_CONNECTION = "lost-connection"


@dataclass(frozen=True, slots=True)
class _Trouble(Exception):  # noqa: N818 - it is an answer of the protocol
    """An error of the protocol: its severity, number and text."""

    severity: int
    number: int
    text: str


_ILLEGAL_TAG = _Trouble(2, 1, "Illegal tag")
_PROTOCOL_ERROR = _Trouble(3, 8, "Protocol error")
_STOPPED = _Trouble(3, 500, "Emergency stop")
_UNSUPPORTED = _Trouble(3, 501, "Unsupported command")
_ARGUMENTS = _Trouble(3, 502, "Incorrect arguments")
_CONTEXT = _Trouble(3, 508, "Bad context")
_USE_CLEAR = _Trouble(2, 514, "Use ClearAllErrors to continue")
_ILLEGAL_TOUCH = _Trouble(2, 1001, "Illegal touch")
_NO_TOUCH = _Trouble(2, 1003, "No touch")
_NO_SURFACE = _Trouble(2, 1006, "Surface not found")
_NO_TOOL = _Trouble(3, 1502, "Tool not found")
_LIMIT = _Trouble(3, 2500, "Machine limit encountered [Move Out Of Limits]")
_COLLISION = _Trouble(3, 2504, "Collision")


class DmeServer:
    """The server.

    `faults`: What goes wrong, by the number of the measuring move since the server was started, from 1.
    `temperature`: Of the part, °C, for who asks for it with each point.
    """

    def __init__(
        self,
        machine: CoordinateMachine,
        tools: tuple[str, ...] = ("RefTool",),
        faults: dict[int, PointFault] | None = None,
        temperature: float = 20.0,
    ) -> None:
        self.machine = machine
        self.is_gone = False  #: Whether the connection is to be lost.
        self._tools = tools
        self._faults = dict(faults or {})
        self._temperature = temperature
        self._rest = b""
        self._measured = 0
        self._is_in_session = False
        self._is_homed = False
        self._is_stuck = False
        self._report = "X(), Y(), Z()"
        self._parameters = {("PtMeasPar", "Approach"): 2.0, ("PtMeasPar", "Search"): 5.0}
        self._parameters["PtMeasPar", "Retract"] = 2.0

    def unasked(self, _time: float) -> bytes:
        """Return nothing: what happens, happens at commands."""
        return b""

    def answer(self, data: bytes, _time: float) -> bytes:
        """Return the answers to the commands that end in these bytes."""
        self._rest += data
        answers: list[str] = []
        while b"\r\n" in self._rest and not self.is_gone:
            line, _, self._rest = self._rest.partition(b"\r\n")
            answers.extend(self._answer_line(line.decode("ascii", errors="replace")))
        return "".join(f"{each}\r\n" for each in answers).encode("ascii")

    def _answer_line(self, line: str) -> Iterator[str]:
        found = _COMMAND.fullmatch(line)
        if found is None:
            tag = line[:5] if re.match(r"\d{5} ", line) else "E0000"
            self._is_stuck = True
            yield from _answer_refused(tag, _PROTOCOL_ERROR, "Unknown")
            return
        tag, name, arguments = found.group("tag", "name", "arguments")
        if tag in {"00000", "E0000"}:
            yield from _answer_refused(tag, _ILLEGAL_TAG, name)
            return
        yield f"{tag} &"
        try:
            data = list(self._carry_out(name, arguments))
        except _Trouble as trouble:
            if self.is_gone:
                return
            self._is_stuck = True
            if trouble is _STOPPED:
                yield f"E0000 ! {_write_error(trouble, 'Server')}"
            yield f"{tag} ! {_write_error(trouble, name)}"
        else:
            yield from (f"{tag} # {text}" for text in data)
        yield f"{tag} %"

    def _carry_out(self, name: str, arguments: str) -> Iterator[str]:
        """Do what a command says; yield the data of its answer."""
        if name in {"ClearAllErrors", "AbortE"}:
            self._is_stuck = False
            return
        if name == "StartSession":
            self._is_in_session = True  # one that a lost client has left ends with it
            return
        self._demand(self._is_in_session, _CONTEXT)
        if name == "EndSession":
            self._is_in_session = self._is_stuck = False
            return
        self._demand(not self._is_stuck, _USE_CLEAR)
        do = self._list_commands().get(name)
        if do is None:
            raise _UNSUPPORTED
        yield from do(arguments)

    def _list_commands(self) -> dict[str, Callable[[str], Iterator[str]]]:
        return {
            "Home": self._home,
            "ChangeTool": self._change_tool,
            "SetProp": self._set_property,
            "OnPtMeasReport": self._on_report,
            "GoTo": self._go_to,
            "PtMeas": self._measure,
        }

    def _home(self, arguments: str) -> Iterator[str]:
        self._demand(not arguments, _ARGUMENTS)
        self._is_homed = True
        yield from ()

    def _change_tool(self, arguments: str) -> Iterator[str]:
        named = re.fullmatch(r'"([^"]*)"', arguments)
        if named is None:
            raise _ARGUMENTS
        self._demand(named[1] in self._tools, _NO_TOOL)
        yield from ()

    def _set_property(self, arguments: str) -> Iterator[str]:
        named = _PROPERTY.fullmatch(arguments)
        if named is None or (named[1], named[2]) not in _PROPERTIES:
            raise _ARGUMENTS
        self._parameters[named[1], named[2]] = float(named[3])
        yield from ()

    def _on_report(self, arguments: str) -> Iterator[str]:
        self._demand(_REPORT.fullmatch(arguments) is not None, _ARGUMENTS)
        self._report = arguments
        yield from ()

    def _go_to(self, arguments: str) -> Iterator[str]:
        named = _GO_TO.fullmatch(arguments)
        if named is None:
            raise _ARGUMENTS
        self._travel(_read_metres(named.groups()))
        yield from ()

    def _measure(self, arguments: str) -> Iterator[str]:
        named = _MEASURE.fullmatch(arguments)
        if named is None:
            raise _ARGUMENTS
        nominal = _read_metres(named.groups()[:3])
        normal = np.array([float(each) for each in named.groups()[3:]])
        length = float(np.linalg.norm(normal))
        self._demand(abs(length - 1) < 1e-3, _ARGUMENTS)
        self._measured += 1
        self._have_trouble(self._faults.get(self._measured))
        normal /= length
        radius = self.machine.effective_radius
        self._travel(nominal + normal * (self._read_length("Approach") + radius), touching=_ILLEGAL_TOUCH)
        touched = self.machine.probe(nominal + normal * (radius - self._read_length("Search")))
        if touched is None:
            self._retract(normal, self._read_length("Approach") + self._read_length("Search"))
            raise _NO_SURFACE
        self._retract(normal, self._read_length("Retract"))
        yield self._write_report(touched, normal)

    def _travel(self, to: FloatArray, touching: _Trouble = _COLLISION) -> None:
        self._demand(self._is_homed, _CONTEXT)
        self._demand(self.machine.can_reach(to), _LIMIT)
        self._demand(self.machine.travel(to), touching)

    def _retract(self, normal: FloatArray, distance: float) -> None:
        self.machine.position = self.machine.position + normal * distance

    def _have_trouble(self, fault: PointFault | None) -> None:
        """Let the planned fault of this measuring move happen."""
        if fault is PointFault.LOST_CONNECTION:
            self.is_gone = True
        troubles = {
            PointFault.NO_TOUCH: _NO_TOUCH,
            PointFault.NO_SURFACE: _NO_SURFACE,
            PointFault.COLLISION: _COLLISION,
            PointFault.EMERGENCY_STOP: _STOPPED,
            PointFault.LOST_CONNECTION: _STOPPED,
        }
        if fault is not None:
            raise troubles[fault]

    def _write_report(self, centre: FloatArray, normal: FloatArray) -> str:
        x, y, z = (centre * _PER_METRE).tolist()
        i, j, k = (normal + 0.0).tolist()
        items = [f"X({x:.5f}), Y({y:.5f}), Z({z:.5f})"]
        if "IJK" in self._report:
            items.append(f"IJK({i:.7f},{j:.7f},{k:.7f})")
        if "Temperature" in self._report:
            items.append(f"Temperature({self._temperature:.3f})")
        return ", ".join(items)

    def _read_length(self, name: str) -> float:
        return self._parameters["PtMeasPar", name] / _PER_METRE

    @staticmethod
    def _demand(condition: bool, trouble: _Trouble) -> None:  # noqa: FBT001 - a condition
        if not condition:
            raise trouble


def _read_metres(texts: tuple[str, ...]) -> FloatArray:
    return np.array([float(each) for each in texts]) / _PER_METRE


def _answer_refused(tag: str, trouble: _Trouble, name: str) -> Iterator[str]:
    """Yield the answers to a line that is no command."""
    yield f"{tag} ! {_write_error(trouble, name)}"
    yield f"{tag} %"


def _write_error(trouble: _Trouble, name: str) -> str:
    return f'Error({trouble.severity}, {trouble.number:04d}, {name}, "{trouble.text}")'
