"""The lines of the µMD displays: fields, low-speed channel, differences of models; the emulated display."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from zlmreport.plugin import CELSIUS, HECTOPASCAL, PERCENT, STATE_OF_AIR, ReadingScale
from zlmreport.plugin.instrument import NO_CONDITIONS, Scene, Trouble, index_change


@dataclass(frozen=True, slots=True)
class UmdModel:
    """A display."""

    identifier: str  #: As jobs name it.
    name: str  #: As its makers write it.
    baud_rate: int  #: Of its port; only that of µMD0 is a real line, the others take any.
    slots: int  #: After so many samples the low-speed channel begins anew.
    #: Whether it says how many counts a cycle has (code 20); one that does not has 1.
    announces_counting: bool
    #: By how many counts DISP and VEL may disagree: the displacement is moved by interpolation, and the
    #: velocity is not.
    interpolation: int


MODELS = (
    UmdModel("umd0", "µMD0", 115_200, 256, announces_counting=True, interpolation=0),
    UmdModel("umd1", "µMD1", 115_200, 32, announces_counting=False, interpolation=0),
    UmdModel("umd2", "µMD2", 2_000_000, 32, announces_counting=True, interpolation=2),
)


_DIGITS = re.compile(rb"[-0-9 ]{15,320}")


class Code(IntEnum):
    """What the low-speed channel says, of which each line carries one number."""

    NONE = 0
    TEMPERATURE_1 = 3
    TEMPERATURE_2 = 4
    PRESSURE = 5
    HUMIDITY = 6
    SAMPLE_RATE = 8
    FIRMWARE = 10
    COUNTING = 20
    FLAGS = 112


class AxisCounts(NamedTuple):
    """What a line says of one axis."""

    measured: int  #: MEAS, cycles of the measurement signal in the sample; 0 of a homodyne instrument.
    displacement: int  #: DISP, counts from switching on.
    velocity: int  #: VEL, counts from the sample before; 0 of a homodyne instrument.
    phase: int  #: PHASE, the fraction of a count, or a flag that it was not found.


class UmdFrame(NamedTuple):
    """A line."""

    reference: int  #: REF, cycles of the laser's reference in the sample; 0 of a homodyne instrument.
    axes: tuple[AxisCounts, ...]  #: One, or three.
    sequence: int  #: SEQ, the number of the sample.
    #: code and data: The low-speed channel.
    code: int
    data: int


def find_frame_in(line: bytes) -> UmdFrame | None:
    """Return what a line without its end says; None if it is none, such as a banner or debug text (``!``)."""
    if not _DIGITS.fullmatch(line):  # or a number might be written in a way that only Python takes for one
        return None
    fields = line.split(b" ")
    if len(fields) not in {8, 16}:
        return None
    try:
        numbers = tuple(map(int, fields))
    except ValueError:
        return None
    axes: tuple[AxisCounts, ...] = (AxisCounts(*numbers[1:5]),)
    if len(numbers) > 8:
        axes += (AxisCounts(*numbers[8:12]), AxisCounts(*numbers[12:]))
    return UmdFrame(numbers[0], axes, *numbers[5:8])


_ABSENT = -1
#: From this firmware on a µMD2 sends the phase in 16 bits, unless the flag says 8.
_FIRST_WITH_16_BITS, _FLAG_8_BITS = 261, 2
#: How far two values in turn may differ, in the units of the channel: 1 K, 10 hPa, 5 %.
_MAY_DIFFER: Mapping[int, int] = {
    Code.TEMPERATURE_1: 100,
    Code.TEMPERATURE_2: 100,
    Code.PRESSURE: 1000,
    Code.HUMIDITY: 50,
}
#: What was not said in so many turns, each time alike, is not said.
_TURNS = 2


@dataclass(frozen=True, slots=True)
class Counting:
    """How a display counts."""

    rate: float  #: Samples a second, 1/s.
    per_cycle: int  #: Counts per optical cycle.
    phase_steps: int  #: Into how many parts the phase divides a count.
    is_homodyne: bool  #: Whether it counts the signals of a homodyne interferometer, which has no reference.


class LowSpeed:
    """Listens to the low-speed channel.

    `temperatures`: The names of what its two temperature sensors measure.
    """

    def __init__(self, model: UmdModel, temperatures: tuple[str, str]) -> None:
        self._model = model
        self._names: Mapping[int, str] = {
            Code.TEMPERATURE_1: temperatures[0],
            Code.TEMPERATURE_2: temperatures[1],
            Code.PRESSURE: "air_pressure",
            Code.HUMIDITY: "relative_humidity",
        }
        self._said: dict[int, int] = {}
        self._believed: dict[int, int] = {}
        self._lines = 0
        self.conditions: Mapping[str, float] = NO_CONDITIONS

    def hear(self, frame: UmdFrame) -> None:
        """Take note of what a line says."""
        self._lines += 1
        code, data = frame.code, frame.data
        if code == Code.NONE:
            return
        before = self._said.get(code)
        self._said[code] = data
        if before is None or abs(data - before) > _MAY_DIFFER.get(code, 0):
            return
        changed = self._believed.get(code) != data
        self._believed[code] = data
        if changed and code in self._names:
            self.conditions = self._collect_conditions()

    @property
    def turns(self) -> int:
        """How often the channel has come round."""
        return self._lines // self._model.slots

    @property
    def lacks(self) -> str:
        """What no reading can be formed without and has not been said; empty if nothing is."""
        if Code.SAMPLE_RATE not in self._believed:
            return "its sample rate (code 8)"
        if self._model.announces_counting and Code.COUNTING not in self._believed:
            return "how it counts (code 20)"
        return ""

    @property
    def is_complete(self) -> bool:
        """Whether all has been said that there is: of flags none is sent by an older firmware."""
        return not self.lacks and self.turns >= _TURNS

    @property
    def contradicts(self) -> bool:
        """Whether it says what the display that it should be never says."""
        return not self._model.announces_counting and Code.COUNTING in self._believed

    def find_counting(self) -> Counting | None:
        """Return how the display counts; None as long as not enough has been said."""
        if not self.is_complete:
            return None
        said = self._believed
        announced = said.get(Code.COUNTING, 1 << 8)
        release = said.get(Code.FIRMWARE, 0) & 0xFFFF
        is_new = self._model.identifier == "umd2" and release >= _FIRST_WITH_16_BITS
        has_8_bits = said.get(Code.FLAGS, 0) & _FLAG_8_BITS
        return Counting(
            rate=said[Code.SAMPLE_RATE] / 100,
            per_cycle=max(1, announced >> 8),
            phase_steps=65_536 if is_new and not has_8_bits else 256,
            is_homodyne=bool(announced & 0xFF),
        )

    def _collect_conditions(self) -> Mapping[str, float]:
        found = {}
        for code, name in self._names.items():
            said = self._believed.get(code, _ABSENT)
            if said != _ABSENT:
                found[name] = _SI[code](said)
        return MappingProxyType(found)


_SI: Mapping[int, Callable[[int], float]] = {
    Code.TEMPERATURE_1: lambda said: CELSIUS.to_si(said / 100),
    Code.TEMPERATURE_2: lambda said: CELSIUS.to_si(said / 100),
    Code.PRESSURE: float,
    Code.HUMIDITY: lambda said: PERCENT.to_si(said / 10),
}


@dataclass(frozen=True, slots=True)
class _Manner:
    """How one model speaks."""

    rate: float  #: Samples a second, 1/s.
    reference: float  #: Cycles of the laser's reference a second, Hz; 0 of a homodyne instrument.
    direction: int  #: Which way DISP counts while MEAS has more cycles than REF.
    counts: int  #: Per optical cycle.
    phase_steps: int  #: Into how many parts PHASE divides a count; 1 for a display that sends none.
    says: Mapping[int, tuple[int, int]]  #: Of the low-speed channel, by slot: code and number.
    #: The same of its sensors: code, what the sensor measures, its unit, and how much finer the number is.
    sensors: Mapping[int, tuple[int, str, ReadingScale, int]] = field(default_factory=dict)
    greeting: bytes = b""  #: What it sends first.


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

    `scene`: The axis, and what goes wrong.
    `length`: Displacement for an optical cycle in standard air, m.
    """

    def __init__(self, model: UmdModel, scene: Scene, length: float) -> None:
        self._model = model
        self._manner = _MANNERS[model.identifier]
        self._scene = scene
        self._length = length
        self._per_standard_air = self._compute_air(0.0)
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
            line = self._write_line(at)
            if not self._scene.troubles.has(Trouble.SKIPPED, at):
                sent += line
        return bytes(sent)

    def answer(self, data: bytes, time: float) -> bytes:  # noqa: ARG002 - it takes no commands
        """Return nothing: it takes no commands."""
        return b""

    def _write_line(self, at: float) -> bytes:
        manner = self._manner
        slot = self._sequence % self._model.slots
        if slot == 0:
            self._per_standard_air = self._compute_air(at)
        optical = self._scene.axis.position(at) * self._per_standard_air
        exact = (optical - self._start) / self._length * manner.counts
        troubles = self._scene.troubles
        is_broken = bool(manner.reference) and troubles.has(Trouble.LOST_BEAM, at)
        # A phase is what a count lacks upwards; a display without phases shows the nearest count.
        count = math.ceil(exact) if manner.phase_steps > 1 else round(exact)
        phase = int((count - exact) * manner.phase_steps) if manner.phase_steps > 1 else 0
        reference = self._count_cycles_of_reference()
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
        code, data = self._say_low_speed(slot, at)
        velocity = step if manner.reference else 0
        fields = (reference, measured, count + self._lost, velocity, phase, self._sequence, code, data)
        return b"%d %d %d %d %d %d %d %d\r\n" % fields

    def _say_low_speed(self, slot: int, at: float) -> tuple[int, int]:
        if slot not in self._manner.sensors:
            return self._manner.says.get(slot, (0, 0))
        code, condition, unit, parts = self._manner.sensors[slot]
        return code, round(unit.from_si(self._scene.condition(condition, at)) * parts)

    def _compute_air(self, at: float) -> float:
        """Return how many cycles the air makes of a length for each that standard air makes."""
        state = (np.array(self._scene.condition(name, at)) for name in STATE_OF_AIR)
        return 1 + float(index_change(*state))

    def _count_cycles_of_reference(self) -> int:
        before = math.floor(self._counter_of_reference)
        self._counter_of_reference += self._manner.reference / self._manner.rate
        return math.floor(self._counter_of_reference) - before
