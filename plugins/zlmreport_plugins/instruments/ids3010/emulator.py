"""An emulated IDS3010."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any

from zlmreport.plugin import CELSIUS, HECTOPASCAL, PERCENT, ReadingScale, Scene, Trouble

_PER_METRE = 1e12
#: How long it takes to begin to measure, s; a real one takes longer.
_START = 0.3
_NAMESPACE, _ECU = "com.attocube.ids.", "com.attocube.ecu."
_LONGEST_QUESTION = 2000


class Ids3010Emulator:
    """An interferometer that watches one axis; its other two measure nothing."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._rest = ""
        self._starts_at: float | None = None
        self._zero = 0.0
        self._methods: Mapping[str, Callable[[float], list[Any]]] = {
            f"{_NAMESPACE}system.getCurrentMode": lambda time: [0, self._mode(time)],
            f"{_NAMESPACE}system.startMeasurement": self._start,
            f"{_NAMESPACE}system.resetAxis": self._reset,
            f"{_NAMESPACE}system.resetError": lambda _: [0],
            f"{_NAMESPACE}displacement.getAxesDisplacement": self._displacements,
            f"{_NAMESPACE}displacement.getAbsolutePosition": self._absolute,
            f"{_ECU}getTemperatureInDegrees": self._sensor("air_temperature", CELSIUS),
            f"{_ECU}getPressureInHPa": self._sensor("air_pressure", HECTOPASCAL),
            f"{_ECU}getHumidityInPercent": self._sensor("relative_humidity", PERCENT),
            f"{_ECU}getRefractiveIndex": lambda _: [0, 1.000271],
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
            answers += json.dumps(self._to_question(message, time), separators=(",", ":")).encode() + b"\r\n"
        self._rest = text if len(text) < _LONGEST_QUESTION else ""
        return b"" if self._scene.troubles.has(Trouble.SKIPPED, time) else answers

    def _to_question(self, message: Any, time: float) -> dict[str, Any]:
        asked = message if isinstance(message, dict) else {}
        method = self._methods.get(str(asked.get("method")))
        answer: dict[str, Any] = {"jsonrpc": "2.0"}
        if method is None:
            answer["error"] = {"code": -32_601, "message": "Method not found"}
        else:
            answer["result"] = method(time)
        return {**answer, "id": asked.get("id")}

    def _mode(self, time: float) -> str:
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

    def _displacements(self, time: float) -> list[Any]:
        moved = self._scene.axis.position(time) - self._zero
        return [self._warning(time), round(moved * _PER_METRE), 0, 0]

    def _absolute(self, time: float) -> list[Any]:
        return [self._warning(time), round(self._scene.axis.position(time) * _PER_METRE)]

    def _sensor(self, condition: str, unit: ReadingScale) -> Callable[[float], list[Any]]:
        """Return what asks a sensor of the environmental unit."""
        return lambda time: [0, round(unit.from_si(self._scene.condition(condition, time)), 3)]

    def _warning(self, time: float) -> int:
        return 1 if self._scene.troubles.has(Trouble.ERROR, time) else 0
