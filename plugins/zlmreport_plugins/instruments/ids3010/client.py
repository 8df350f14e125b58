"""A talk with an IDS3010."""

from __future__ import annotations

import time
from collections.abc import Mapping
from types import MappingProxyType

from zlmreport.plugin import CELSIUS, HECTOPASCAL, PERCENT, Patience, Port, ask_instrument
from zlmreport_plugins.instruments.ids3010.messages import Answer, answer_to, question

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
