"""What is said with an IDS3010: JSON-RPC messages, and the client that sends them."""

from __future__ import annotations

import json
import time
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from zlmreport.plugin import CELSIUS, HECTOPASCAL, PERCENT, Patience, Port, ask_instrument

_API = 2
_METHOD_NOT_FOUND = -32_601


@dataclass(frozen=True, slots=True)
class Answer:
    """What an IDS answers.

    Attributes
    ----------
    number
        Of the question.
    warning
        Of the device; 0 for none.
    values
        What was asked for.
    error
        Text of an error; empty if there is none.
    is_unknown
        Whether the error is that there is no such method.
    """

    number: int
    warning: int = 0
    values: tuple[Any, ...] = ()
    error: str = ""
    is_unknown: bool = False


def question(number: int, method: str, *parameters: int) -> bytes:
    """Return the bytes of a question."""
    message = {"jsonrpc": "2.0", "method": method, "params": parameters, "id": number, "api": _API}
    return json.dumps(message, separators=(",", ":")).encode("ascii")


def answer_to(number: int, arrived: bytes) -> Answer | None:
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


def _answer(message: Any) -> Answer | None:
    """Return a message as an answer; None if it is none."""
    if not isinstance(message, dict) or not isinstance(message.get("id"), int):
        return None
    number = message["id"]
    error = message.get("error")
    if isinstance(error, dict):
        is_unknown = error.get("code") == _METHOD_NOT_FOUND
        return Answer(number, error=str(error.get("message", "error")), is_unknown=is_unknown)
    result = message.get("result")
    if not isinstance(result, list) or not result or not isinstance(result[0], int):
        return None
    return Answer(number, result[0], tuple(result[1:]))


#: Of the methods, on older and on newer firmware.
_NAMESPACES = ("com.attocube.ids", "com.attocube.sen")
_ECU = "com.attocube.ecu"
RUNNING = "measurement running"


class Client:
    """Puts questions and takes their answers.

    Parameters
    ----------
    port
        Where the device is.
    timeout
        How long to wait for an answer, s.
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

    def call(self, method: str, *parameters: int, of_ecu: bool = False) -> Answer | None:
        """Return the answer to a question; None if it did not come or was not understood.

        Raises
        ------
        AccessError
            If the device has not answered for its time.
        """
        self._number += 1
        number = self._number
        namespace = _ECU if of_ecu else self._namespace
        asked = question(number, f"{namespace}.{method}", *parameters)
        answer = ask_instrument(self._port, asked, lambda arrived: answer_to(number, arrived), self._wait)
        now = time.monotonic()
        if isinstance(answer, bytes):
            self._patience.hear(answer, now)
            self._patience.check(now)
            return None
        self._patience.understand(now)
        return answer

    def mode(self) -> str:
        """Return what the device is doing; empty if it does not say."""
        answer = self.call("system.getCurrentMode")
        return str(answer.values[0]) if answer is not None and answer.values else ""

    def conditions(self) -> Mapping[str, float]:
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
