"""attocube IDS3010 interferometers, by JSON over a network."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Annotated, Any, Literal

from pydantic import Field

from zlmreport.plugin import CELSIUS, HECTOPASCAL, PERCENT, Options, ReadingScale, Words, hookimpl
from zlmreport.plugin.instrument import (
    NO_CONDITIONS,
    NO_FAULT,
    Emulator,
    Fault,
    Framing,
    Instrument,
    LiveConnection,
    LiveReading,
    Patience,
    PolledOptions,
    Port,
    Scene,
    Trouble,
    ask_instrument,
    readings_at_rate,
    unreadable_reading,
)

_PER_METRE = 1e12
#: How long it takes to begin to measure, s; a real one takes longer.
_START = 0.3
_NAMESPACE, _ECU = "com.attocube.ids.", "com.attocube.ecu"
_LONGEST_QUESTION = 2000


class Ids3010Emulator:
    """An interferometer that watches one axis; its other two measure nothing."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._rest = ""
        self._starts_at: float | None = None
        self._zero = 0.0
        self._methods: Mapping[str, Callable[[float], list[Any]]] = {
            f"{_NAMESPACE}system.getCurrentMode": lambda time: [0, self._answer_mode(time)],
            f"{_NAMESPACE}system.startMeasurement": self._start,
            f"{_NAMESPACE}system.resetAxis": self._reset,
            f"{_NAMESPACE}system.resetError": lambda _: [0],
            f"{_NAMESPACE}displacement.getAxesDisplacement": self._answer_displacements,
            f"{_NAMESPACE}displacement.getAbsolutePosition": self._answer_absolute,
            f"{_ECU}.getTemperatureInDegrees": self._make_sensor("air_temperature", CELSIUS),
            f"{_ECU}.getPressureInHPa": self._make_sensor("air_pressure", HECTOPASCAL),
            f"{_ECU}.getHumidityInPercent": self._make_sensor("relative_humidity", PERCENT),
            f"{_ECU}.getRefractiveIndex": lambda _: [0, 1.000271],
        }

    def unasked(self, time: float) -> bytes:
        """Return nothing: it speaks when it is asked. A broken beam ends its measurement."""
        if self._scene.troubles.has(Trouble.LOST_BEAM, time):
            self._starts_at = None
        return b""

    def answer(self, data: bytes, time: float) -> bytes:
        """Return its answers to the questions that are whole."""
        text = (self._rest + data.decode("utf-8", "replace")).lstrip()
        decoder = json.JSONDecoder()
        answers = b""
        while text:
            try:
                message, end = decoder.raw_decode(text)
            except ValueError:
                break
            text = text[end:].lstrip()
            answers += (
                json.dumps(self._answer_question(message, time), separators=(",", ":")).encode() + b"\r\n"
            )
        self._rest = text if len(text) < _LONGEST_QUESTION else ""
        return b"" if self._scene.troubles.has(Trouble.SKIPPED, time) else answers

    def _answer_question(self, message: Any, time: float) -> dict[str, Any]:
        asked = message if isinstance(message, dict) else {}
        method = self._methods.get(str(asked.get("method")))
        answer: dict[str, Any] = {"jsonrpc": "2.0"}
        if method is None:
            answer["error"] = {"code": -32_601, "message": "Method not found"}
        else:
            answer["result"] = method(time)
        return {**answer, "id": asked.get("id")}

    def _answer_mode(self, time: float) -> str:
        if self._starts_at is None:
            return "system idle"
        return "measurement running" if time >= self._starts_at else "measurement starting"

    def _start(self, time: float) -> list[Any]:
        if self._starts_at is None:
            self._starts_at = time + _START
            self._zero = self._scene.axis.position(self._starts_at)
        return [0]

    def _reset(self, time: float) -> list[Any]:
        self._zero = self._scene.axis.position(time)
        return [0]

    def _answer_displacements(self, time: float) -> list[Any]:
        moved = self._scene.axis.position(time) - self._zero
        return [self._find_warning(time), round(moved * _PER_METRE), 0, 0]

    def _answer_absolute(self, time: float) -> list[Any]:
        return [self._find_warning(time), round(self._scene.axis.position(time) * _PER_METRE)]

    def _make_sensor(self, condition: str, unit: ReadingScale) -> Callable[[float], list[Any]]:
        """Return what asks a sensor of the environmental unit."""
        return lambda time: [0, round(unit.from_si(self._scene.condition(condition, time)), 3)]

    def _find_warning(self, time: float) -> int:
        return 1 if self._scene.troubles.has(Trouble.ERROR, time) else 0


_API = 2
_METHOD_NOT_FOUND = -32_601


@dataclass(frozen=True, slots=True)
class IdsAnswer:
    """What an IDS answers."""

    number: int  #: Of the question.
    warning: int = 0  #: Of the device; 0 for none.
    values: tuple[Any, ...] = ()  #: What was asked for.
    error: str = ""  #: Text of an error; empty if there is none.
    is_unknown: bool = False  #: Whether the error is that there is no such method.


def write_question(number: int, method: str, *parameters: int) -> bytes:
    """Return the bytes of a question."""
    message = {"jsonrpc": "2.0", "method": method, "params": parameters, "id": number, "api": _API}
    return json.dumps(message, separators=(",", ":")).encode("ascii")


def answer_to(number: int, arrived: bytes) -> IdsAnswer | None:
    """Return the answer to a question in what has arrived; None if it is not there, or not whole.

    Answers to earlier questions, which came too late, are passed over.
    """
    decoder = json.JSONDecoder()
    text = arrived.decode("utf-8", "replace").lstrip()
    while text:
        try:
            message, end = decoder.raw_decode(text)
        except ValueError:
            return None
        found = _answer(message)
        if found is not None and found.number == number:
            return found
        text = text[end:].lstrip()
    return None


def _answer(message: Any) -> IdsAnswer | None:
    """Return a message as an answer; None if it is none."""
    if not isinstance(message, dict) or not isinstance(message.get("id"), int):
        return None
    number = message["id"]
    error = message.get("error")
    if isinstance(error, dict):
        is_unknown = error.get("code") == _METHOD_NOT_FOUND
        return IdsAnswer(number, error=str(error.get("message", "error")), is_unknown=is_unknown)
    result = message.get("result")
    if not isinstance(result, list) or not result or not isinstance(result[0], int):
        return None
    return IdsAnswer(number, result[0], tuple(result[1:]))


#: Of the methods, on older and on newer firmware.
_NAMESPACES = ("com.attocube.ids", "com.attocube.sen")
RUNNING = "measurement running"


class Client:
    """Puts questions and takes their answers.

    `timeout`: How long to wait for an answer, s.
    """

    def __init__(self, port: Port, timeout: float) -> None:
        self._port = port
        self._wait = timeout / 4
        self._number = 0
        self._namespace = _NAMESPACES[0]
        self._has_ecu = True
        self._patience = Patience(
            port,
            timeout,
            "answers of an IDS3010",
            "look whether it is that instrument, and whether its port is 9090",
            time.monotonic(),
        )

    def find_namespace(self) -> None:
        """Find out by which names the device calls its methods."""
        for self._namespace in _NAMESPACES:
            answer = self.call("system.getCurrentMode")
            if answer is not None and not answer.is_unknown:
                return
        self._port.fail(
            "the instrument answers, but does not know how to tell its mode: is it an IDS3010, with firmware "
            "of 2019 or later?"
        )

    def call(self, method: str, *parameters: int, of_ecu: bool = False) -> IdsAnswer | None:
        """Return the answer to a question; None if it did not come or was not understood.

        Raises `AccessError` if the device has not answered for its time.
        """
        self._number += 1
        number = self._number
        namespace = _ECU if of_ecu else self._namespace
        asked = write_question(number, f"{namespace}.{method}", *parameters)
        answer = ask_instrument(self._port, asked, lambda arrived: answer_to(number, arrived), self._wait)
        now = time.monotonic()
        if isinstance(answer, bytes):
            self._patience.hear(answer, now)
            self._patience.check(now)
            return None
        self._patience.understand(now)
        return answer

    def ask_mode(self) -> str:
        """Return what the device is doing; empty if it does not say."""
        answer = self.call("system.getCurrentMode")
        return str(answer.values[0]) if answer is not None and answer.values else ""

    def ask_conditions(self) -> Mapping[str, float]:
        """Return what the environmental unit measures, SI; nothing if there is none."""
        found = {}
        for method, name, unit in (
            ("getTemperatureInDegrees", "air_temperature", CELSIUS),
            ("getPressureInHPa", "air_pressure", HECTOPASCAL),
            ("getHumidityInPercent", "relative_humidity", PERCENT),
        ):
            answer = self.call(method, of_ecu=True) if self._has_ecu else None
            if answer is None:
                continue
            self._has_ecu = not answer.error
            if answer.values and not answer.warning and isinstance(answer.values[0], int | float):
                found[name] = unit.to_si(float(answer.values[0]))
        return MappingProxyType(found)


_PICOMETRE = 1e-12
#: How long the device may take to begin to measure, and how often its mode is looked at meanwhile, s.
_LONGEST_START, _LOOK = 120.0, 0.5
#: How often its air is asked for, s.
_CONDITIONS_EVERY = 10.0


class Ids3010Options(PolledOptions):
    """Where the interferometer is."""

    axis: Literal[1, 2, 3] = Field(1, description="Which of its axes is read.")
    rate: Annotated[float, Field(gt=0, le=1000)] = Field(
        50.0, description="How often the instrument is asked, 1/s; less often where it is slower."
    )


class Ids3010:
    """An attocube IDS3010 fibre interferometer, over the network: ``socket://address:9090``.

    It is asked for the displacement of its axis, and every ten seconds for the air if it has an
    environmental unit; the wavelength is its own matter. If it is not measuring it is told to begin, which
    takes it a while. After each displacement it is asked whether it still measures: if not, the zero is
    gone. A warning with a displacement voids that reading. Not confirmed on a real device: that `resetAxis`
    takes the number of the axis, counted from 0.
    """

    identifier = "ids3010"
    title = Words("attocube interferometer IDS3010")
    options: type[Options] = Ids3010Options

    def open(self, options: Ids3010Options) -> LiveConnection:
        """Open its port."""
        port = Port(options.port, Framing(), options.timeout)
        talk = _Talk(port, options)
        return LiveConnection(port, talk.readings, talk.zero)

    def emulator(self, scene: Scene) -> Emulator:
        """Return one that measures along its first axis and has an environmental unit."""
        return Ids3010Emulator(scene)


class _Talk:
    """What is asked, and when."""

    def __init__(self, port: Port, options: Ids3010Options) -> None:
        self._port = port
        self._options = options
        self._client = Client(port, options.timeout)
        self._conditions: Mapping[str, float] = NO_CONDITIONS
        self._conditions_at = float("-inf")

    def readings(self) -> Iterator[LiveReading]:
        """Begin to measure, and yield readings."""
        self._client = Client(self._port, self._options.timeout)
        self._client.find_namespace()
        self._start()
        yield from readings_at_rate(self._options.rate, self._ask_reading)

    def zero(self) -> None:
        """Let the axis count from here."""
        answer = self._client.call("system.resetAxis", self._options.axis - 1)
        if answer is None or answer.error or answer.warning:
            self._port.fail("the instrument was not set to zero; try again, or leave its zero as it is")

    def _start(self) -> None:
        """Let it measure, and wait until it does."""
        if self._client.ask_mode() == RUNNING:
            return
        self._client.call("system.startMeasurement")
        until = time.monotonic() + _LONGEST_START
        while (mode := self._client.ask_mode()) != RUNNING:
            if time.monotonic() > until:
                self._port.fail(
                    f"the instrument does not begin to measure (it says: {mode or 'nothing'}); "
                    "align its beam, then start again"
                )
            time.sleep(_LOOK)

    def _ask_reading(self) -> LiveReading:
        """Ask for a displacement, and after it whether the device has measured up to there."""
        self._ask_for_conditions()
        axis = self._options.axis - 1
        answer = self._client.call("displacement.getAxesDisplacement")
        now = time.monotonic()
        mode = self._client.ask_mode()
        value = answer.values[axis] if answer is not None and axis < len(answer.values) else None
        if answer is None or not mode or not isinstance(value, int) or isinstance(value, bool):
            error = f" ({answer.error})" if answer is not None and answer.error else ""
            return unreadable_reading(now, f"the instrument gave no displacement{error}")
        faults, message = NO_FAULT, ""
        if mode != RUNNING:
            faults = Fault.BEAM_LOST
            message = (
                f"the instrument has stopped measuring ({mode}): align its beam, then begin the run again"
            )
        elif answer.warning:
            faults = Fault.DEVICE_ERROR
            message = f"the instrument gives warning {answer.warning}"
        return LiveReading(
            value * _PICOMETRE * self._options.factor,
            now,
            faults,
            message=message,
            conditions=self._conditions,
        )

    def _ask_for_conditions(self) -> None:
        now = time.monotonic()
        if now - self._conditions_at >= _CONDITIONS_EVERY:
            self._conditions_at = now
            self._conditions = self._client.ask_conditions()


@hookimpl
def zlmreport_instruments() -> Iterable[Instrument]:
    """Return the interferometer."""
    return [Ids3010()]
