"""The laser interferometer displays µMD0, µMD1 and µMD2: keys, decoding, wavelength, faults."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from zlmreport.plugin import REFERENCE_TEMPERATURE, Options, Words, hookimpl
from zlmreport.plugin.instrument import (
    NO_FAULT,
    STANDARD_HUMIDITY,
    STANDARD_PRESSURE,
    Emulator,
    Fault,
    Framing,
    Instrument,
    LiveConnection,
    LiveReading,
    Patience,
    Port,
    PortOptions,
    SampleClock,
    Scene,
    WholeLines,
    WrongDeviceError,
    refractive_index,
    streamed_readings,
)
from zlmreport_plugins.instruments.umd.lines import (
    MODELS,
    AxisCounts,
    Counting,
    LowSpeed,
    UmdEmulator,
    UmdFrame,
    UmdModel,
    find_frame_in,
)

#: Hz: nearer to 0, or to twice the reference, the measurement signal cannot be counted.
_MARGIN = 100e3
#: So many lines in turn must each follow the one before: one damaged line may by chance be like the next.
_LINKS = 2
#: After so many turns of the low-speed channel what has not been said will not be.
_LONGEST_WAIT = 16
#: In an 8-bit phase of a µMD1: no edge of a signal was found.
_NO_EDGE = 0x7E00


@dataclass(frozen=True, slots=True)
class Setup:
    """What the display does not know."""

    axis: int  #: Which of its axes, from 0.
    #: Displacement for an optical cycle, m, with its sign: half the wavelength in air with a retroreflector,
    #: divided by the fold of the optics.
    length: float
    temperatures: tuple[str, str]  #: The names of what its two temperature sensors measure.


class UmdDecoder:
    """Understands one display.

    A line has no checksum, but each repeats what the one before said: the number of the sample is the next,
    and DISP has gone on by VEL, which is the difference of the cycles REF and MEAS. A line that does not
    follow its predecessor so is no reading, and neither is the first after one. Homodyne displays send no
    VEL, REF and MEAS: there the number alone is checked, and a lost beam is not seen. The number says when a
    sample was taken, too, by the rate that the display announces.
    """

    def __init__(self, model: UmdModel, setup: Setup) -> None:
        self.understood = 0  #: How many lines were lines of a µMD.
        self._model = model
        self._setup = setup
        self._lines = WholeLines()
        self._low_speed = LowSpeed(model, setup.temperatures)
        self._counting: Counting | None = None
        self._before: UmdFrame | None = None
        self._accepted: int | None = None
        self._void = 0
        self._links = _LINKS - 1
        self._clock = SampleClock()

    def feed(self, data: bytes, now: float) -> list[LiveReading]:
        """Return the readings that these bytes complete.

        Raises `WrongDeviceError` if it is another µMD than the model, or has no such axis.
        """
        readings = []
        for line in self._lines.feed(data):
            frame = find_frame_in(line)
            if frame is None or frame == self._before:  # a banner, debug text, a line that came twice
                continue
            self.understood += 1
            self._low_speed.hear(frame)
            if frame.code or self._counting is None:
                self._counting = self._find_counting()
            if self._counting:
                readings.append(self._make_reading(frame, self._counting, now))
            self._before = frame
        return readings

    def _find_counting(self) -> Counting | None:
        """Return what readings are formed with; None as long as it is not known."""
        low_speed, name = self._low_speed, self._model.name
        if low_speed.contradicts:
            raise WrongDeviceError(
                f"this is no {name}: it says how many counts a cycle has, which a {name} does not; "
                "name umd2 or umd0"
            )
        if low_speed.lacks and low_speed.turns >= _LONGEST_WAIT:
            raise WrongDeviceError(
                f"this is no {name}, or the line is bad: it has not said {low_speed.lacks}; "
                "a µMD1 is named umd1"
            )
        return low_speed.find_counting()

    def _make_reading(self, frame: UmdFrame, counting: Counting, now: float) -> LiveReading:
        """Return what a line says: (DISP − phase)/mult · λ/2 / fold; NaN for one that is not believed."""
        before = self._before
        index = self._setup.axis
        if index >= len(frame.axes):
            if before is not None and len(before.axes) == len(frame.axes):
                raise WrongDeviceError(
                    f"the display sends {len(frame.axes)} axis, and axis {index + 1} is wanted"
                )
            return self._make_unreadable(now)
        follows = before is not None and self._is_next(before, frame, counting)
        self._links = self._links + 1 if follows else 0
        if self._links < _LINKS:
            return self._make_unreadable(now)
        counts = frame.axes[index]
        faults, message = self._find_faults(frame.reference, counts, counting)
        skipped = 0
        if self._accepted is not None:
            step = frame.sequence - self._accepted
            if step <= 0:
                self._clock.restart()
                faults |= Fault.RESTARTED
                message = "the display began anew: its zero is another one; begin the run again"
            skipped = max(0, step - 1 - self._void)
        self._accepted, self._void = frame.sequence, 0
        displacement = counts.displacement - counts.phase / counting.phase_steps
        value = displacement / counting.per_cycle * self._setup.length
        taken = self._clock.time(frame.sequence, counting.rate, now)
        return LiveReading(value, taken, faults, skipped, message, self._low_speed.conditions)

    def _make_unreadable(self, now: float) -> LiveReading:
        self._void += 1
        return LiveReading(
            float("nan"),
            now if self._accepted is None else self._clock.now,
            Fault.UNREADABLE,
            message="a line was garbled or lost",
            conditions=self._low_speed.conditions,
        )

    def _is_next(self, before: UmdFrame, frame: UmdFrame, counting: Counting) -> bool:
        index = self._setup.axis
        if frame.sequence != before.sequence + 1 or index >= len(before.axes):
            return False
        if counting.is_homodyne:
            return True
        counts = frame.axes[index]
        step = counts.displacement - before.axes[index].displacement
        allowed = self._model.interpolation
        if abs(step - counts.velocity) > allowed:
            return False
        if index > 1:  # the cycles of axis 3 are those of axis 2 in firmware 2.61 of µMD2
            return True
        cycles = abs(counts.measured - frame.reference) * counting.per_cycle
        return abs(cycles - abs(counts.velocity)) <= allowed

    def _find_faults(self, reference: int, counts: AxisCounts, counting: Counting) -> tuple[Fault, str]:
        """Return what the cycles and the phase show to be wrong."""
        if counting.is_homodyne:
            return NO_FAULT, ""
        if reference == 0:
            return (
                Fault.BEAM_LOST,
                "no reference from the laser head: look at its cable and whether it is locked",
            )
        if counts.measured == 0:
            return Fault.BEAM_LOST, "the beam is broken: clear its path, then begin the run again"
        frequency = counts.measured * counting.rate
        if not _MARGIN <= frequency <= 2 * reference * counting.rate - _MARGIN:
            return (
                Fault.TOO_FAST,
                "the axis is too fast for the display: lower the feed, then begin the run again",
            )
        if self._model.identifier == "umd1" and counts.phase >= 0 and counts.phase & _NO_EDGE:
            return Fault.DEVICE_ERROR, f"the display found no phase (flag {counts.phase:#x})"
        return NO_FAULT, ""


_NANOMETRE = 1e-9
#: How long to wait for bytes, s; a display sends every 4 ms at least.
_WAIT = 0.1


class UmdOptions(PortOptions):
    """Where the display is, and the optics that it does not know."""

    optics: Literal["retroreflector", "plane mirror", "double plane mirror"] = Field(
        "retroreflector",
        description="Of the interferometer: an optical cycle is λ/2 with a linear retroreflector, λ/4 with a "
        "plane mirror, λ/8 with a high-resolution (double) plane mirror.",
    )
    wavelength: Annotated[float, Field(gt=200, lt=2000)] = Field(
        632.991372, description="Of the laser in vacuum, nm."
    )
    axis: Literal[1, 2, 3] = Field(1, description="Which of the display's axes is read.")
    temperatures: tuple[str, str] = Field(
        ("air_temperature", "temperature_2"),
        description="What the display's two temperature sensors measure: names of conditions, such as "
        "material_temperature.",
    )


class Umd:
    """A µMD display of J. Beck and S. Goldwasser: an open reader of laser interferometers.

    It streams; each sample is a line. Its counts become lengths with the wavelength in the standard air
    (20 °C, 1013.25 hPa, 50 %) that an interferometer without an air sensor assumes; what the air really was
    travels with the readings, and the job's correction for the air works on it. A display has no zero to
    set: it counts from when it was switched on.

    µMD1 counts REF − MEAS and µMD2 MEAS − REF: the key `sign` sets right which way is up.
    """

    def __init__(self, model: UmdModel) -> None:
        self.identifier = model.identifier
        self.title = Words("Laser interferometer display {name}").given(name=model.name)
        self.options: type[Options] = UmdOptions
        self._model = model

    def open(self, options: UmdOptions) -> LiveConnection:
        """Open its port."""
        port = Port(options.port, Framing(self._model.baud_rate), options.timeout)

        def readings() -> Iterator[LiveReading]:
            port.drop_input()
            patience = Patience(
                port,
                options.timeout,
                f"lines of a {self._model.name}",
                "look whether it is that instrument",
                time.monotonic(),
            )
            return streamed_readings(port, UmdDecoder(self._model, _make_setup(options)), patience, _WAIT)

        return LiveConnection(port, readings)

    def emulator(self, scene: Scene) -> Emulator:
        """Return one with a retroreflector, in standard air, whose sensors say so."""
        return UmdEmulator(self._model, scene, compute_cycle_length(UmdOptions(port="emulated")))


def compute_cycle_length(options: UmdOptions) -> float:
    """Return the displacement for an optical cycle in standard air, m: λ/2 divided by the fold."""
    vacuum = options.wavelength * _NANOMETRE
    index = refractive_index(
        np.array(REFERENCE_TEMPERATURE), np.array(STANDARD_PRESSURE), np.array(STANDARD_HUMIDITY), vacuum
    )
    return vacuum / float(index) / 2 / _FOLDS[options.optics]


_FOLDS = {"retroreflector": 1, "plane mirror": 2, "double plane mirror": 4}


def _make_setup(options: UmdOptions) -> Setup:
    return Setup(options.axis - 1, compute_cycle_length(options) * options.factor, options.temperatures)


@hookimpl
def zlmreport_instruments() -> Iterable[Instrument]:
    """Return the three displays."""
    return [Umd(model) for model in MODELS]
