"""Emulated µMD displays: the lines that a real one would send of an axis that moves."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from zlmreport.plugin import (
    CELSIUS,
    HECTOPASCAL,
    PERCENT,
    STATE_OF_AIR,
    ReadingScale,
    Scene,
    Trouble,
    index_change,
)
from zlmreport_plugins.instruments.umd.lines import Code, Model


@dataclass(frozen=True, slots=True)
class _Manner:
    """How one model speaks.

    Attributes
    ----------
    rate
        Samples a second, 1/s.
    reference
        Cycles of the laser's reference a second, Hz; 0 of a homodyne instrument.
    direction
        Which way DISP counts while MEAS has more cycles than REF.
    counts
        Per optical cycle.
    phase_steps
        Into how many parts PHASE divides a count; 1 for a display that sends none.
    says
        Of the low-speed channel, by slot: code and number.
    sensors
        The same of its sensors: code, what the sensor measures, its unit, and how much finer the number is.
    greeting
        What it sends first.
    """

    rate: float
    reference: float
    direction: int
    counts: int
    phase_steps: int
    says: Mapping[int, tuple[int, int]]
    sensors: Mapping[int, tuple[int, str, ReadingScale, int]] = field(default_factory=dict)
    greeting: bytes = b""


_MANNERS: Mapping[str, _Manner] = {
    "umd0": _Manner(
        rate=244.14,
        reference=0.0,
        direction=1,
        counts=4,
        phase_steps=1,
        says={1: (Code.FIRMWARE, 209), 2: (Code.SAMPLE_RATE, 24_414), 13: (Code.COUNTING, (4 << 8) + 1)},
        greeting=b"\nMinimalist Homodyne Test:\r\n",
    ),
    "umd1": _Manner(
        rate=610.35,
        reference=2.4e6,
        direction=-1,
        counts=1,
        phase_steps=256,
        says={
            1: (Code.FIRMWARE, 5704),
            2: (Code.SAMPLE_RATE, 61_035),
        },
        sensors={
            3: (Code.TEMPERATURE_1, "air_temperature", CELSIUS, 100),
            4: (Code.TEMPERATURE_2, "axis_temperature", CELSIUS, 100),
            5: (Code.PRESSURE, "air_pressure", HECTOPASCAL, 100),
            6: (Code.HUMIDITY, "relative_humidity", PERCENT, 10),
        },
    ),
    "umd2": _Manner(
        rate=1000.0,
        reference=2.4e6,
        direction=1,
        counts=2,
        phase_steps=65_536,
        says={
            1: (Code.FIRMWARE, 264 + (7 << 16)),
            2: (Code.SAMPLE_RATE, 100_000),
            3: (Code.COUNTING, 2 << 8),
            10: (Code.FLAGS, 4),
        },
    ),
}


class UmdEmulator:
    """A display that watches an axis through the air between: where the axis is at 0 there is none.

    Parameters
    ----------
    model
        Which.
    scene
        The axis, and what goes wrong.
    length
        Displacement for an optical cycle in standard air, m.
    """

    def __init__(self, model: Model, scene: Scene, length: float) -> None:
        self._model = model
        self._manner = _MANNERS[model.identifier]
        self._scene = scene
        self._length = length
        self._per_standard_air = self._air(0.0)
        self._start = scene.axis.position(0.0) * self._per_standard_air
        self._sequence = 0
        self._lost = 0
        self._count = 0
        self._counter_of_reference = 0.0
        self._greeting = self._manner.greeting

    def unasked(self, time: float) -> bytes:
        """Return the lines of the samples that are due."""
        sent = bytearray(self._greeting)
        self._greeting = b""
        while (self._sequence + 1) / self._manner.rate <= time:
            self._sequence += 1
            at = self._sequence / self._manner.rate
            line = self._line(at)
            if not self._scene.troubles.has(Trouble.SKIPPED, at):
                sent += line
        return bytes(sent)

    def answer(self, data: bytes, time: float) -> bytes:  # noqa: ARG002 - it takes no commands
        """Return nothing: it takes no commands."""
        return b""

    def _line(self, at: float) -> bytes:
        """Return the line of the next sample."""
        manner = self._manner
        slot = self._sequence % self._model.slots
        if slot == 0:
            self._per_standard_air = self._air(at)
        optical = self._scene.axis.position(at) * self._per_standard_air
        exact = (optical - self._start) / self._length * manner.counts
        troubles = self._scene.troubles
        is_broken = bool(manner.reference) and troubles.has(Trouble.LOST_BEAM, at)
        # A phase is what a count lacks upwards; a display without phases shows the nearest count.
        count = math.ceil(exact) if manner.phase_steps > 1 else round(exact)
        phase = int((count - exact) * manner.phase_steps) if manner.phase_steps > 1 else 0
        reference = self._cycles_of_reference()
        if is_broken:
            step = -manner.direction * reference * manner.counts
            self._lost += step - (count - self._count)
            measured = 0
        else:
            step = count - self._count
            measured = reference + manner.direction * round(step / manner.counts) if reference else 0
        self._count = count
        if troubles.has(Trouble.ERROR, at) and self._model.identifier == "umd1":
            phase = 0x200
        code, data = self._says(slot, at)
        velocity = step if manner.reference else 0
        fields = (reference, measured, count + self._lost, velocity, phase, self._sequence, code, data)
        return b"%d %d %d %d %d %d %d %d\r\n" % fields

    def _says(self, slot: int, at: float) -> tuple[int, int]:
        """Return what the low-speed channel says."""
        if slot not in self._manner.sensors:
            return self._manner.says.get(slot, (0, 0))
        code, condition, unit, parts = self._manner.sensors[slot]
        return code, round(unit.from_si(self._scene.condition(condition, at)) * parts)

    def _air(self, at: float) -> float:
        """Return how many cycles the air makes of a length for each that standard air makes."""
        state = (np.array(self._scene.condition(name, at)) for name in STATE_OF_AIR)
        return 1 + float(index_change(*state))

    def _cycles_of_reference(self) -> int:
        before = math.floor(self._counter_of_reference)
        self._counter_of_reference += self._manner.reference / self._manner.rate
        return math.floor(self._counter_of_reference) - before
