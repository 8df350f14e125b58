"""attocube IDS3010 interferometers, by JSON over a network."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Mapping
from typing import Annotated, Literal

from pydantic import Field

from zlmreport.plugin import (
    NO_CONDITIONS,
    NO_FAULT,
    Emulator,
    Fault,
    Framing,
    Instrument,
    LiveConnection,
    LiveReading,
    Options,
    PolledOptions,
    Port,
    Scene,
    Words,
    hookimpl,
    readings_at_rate,
    unreadable_reading,
)
from zlmreport_plugins.instruments.ids3010.dialogue import RUNNING, Client
from zlmreport_plugins.instruments.ids3010.emulator import Ids3010Emulator

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
    title = Words(en="attocube interferometer IDS3010", de="attocube-Interferometer IDS3010")
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
        yield from readings_at_rate(self._options.rate, self._reading)

    def zero(self) -> None:
        """Let the axis count from here."""
        answer = self._client.call("system.resetAxis", self._options.axis - 1)
        if answer is None or answer.error or answer.warning:
            self._port.fail("the instrument was not set to zero; try again, or leave its zero as it is")

    def _start(self) -> None:
        """Let it measure, and wait until it does."""
        if self._client.mode() == RUNNING:
            return
        self._client.call("system.startMeasurement")
        until = time.monotonic() + _LONGEST_START
        while (mode := self._client.mode()) != RUNNING:
            if time.monotonic() > until:
                self._port.fail(
                    f"the instrument does not begin to measure (it says: {mode or 'nothing'}); "
                    "align its beam, then start again"
                )
            time.sleep(_LOOK)

    def _reading(self) -> LiveReading:
        """Ask for a displacement, and after it whether the device has measured up to there."""
        self._ask_for_conditions()
        axis = self._options.axis - 1
        answer = self._client.call("displacement.getAxesDisplacement")
        now = time.monotonic()
        mode = self._client.mode()
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
            self._conditions = self._client.conditions()


@hookimpl
def zlmreport_instruments() -> Iterable[Instrument]:
    """Return the interferometer."""
    return [Ids3010()]
