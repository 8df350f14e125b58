"""The live instruments ``umd0``, ``umd1`` and ``umd2``."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from zlmreport.plugin import (
    REFERENCE_TEMPERATURE,
    STANDARD_HUMIDITY,
    STANDARD_PRESSURE,
    Emulator,
    Framing,
    LiveConnection,
    LiveReading,
    Options,
    Patience,
    Port,
    PortOptions,
    Scene,
    Words,
    refractive_index,
    streamed_readings,
)
from zlmreport_plugins.instruments.umd.decoder import Setup, UmdDecoder
from zlmreport_plugins.instruments.umd.emulator import UmdEmulator
from zlmreport_plugins.instruments.umd.models import Model

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

    Parameters
    ----------
    model
        Which of them.
    """

    def __init__(self, model: Model) -> None:
        self.identifier = model.identifier
        self.title = Words(
            en="Laser interferometer display {name}", de="Laserinterferometer-Anzeige {name}"
        ).given(name=model.name)
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
            return streamed_readings(port, UmdDecoder(self._model, _setup(options)), patience, _WAIT)

        return LiveConnection(port, readings)

    def emulator(self, scene: Scene) -> Emulator:
        """Return one with a retroreflector, in standard air, whose sensors say so."""
        return UmdEmulator(self._model, scene, cycle_length(UmdOptions(port="emulated")))


def cycle_length(options: UmdOptions) -> float:
    """Return the displacement for an optical cycle in standard air, m: λ/2 divided by the fold."""
    vacuum = options.wavelength * _NANOMETRE
    index = refractive_index(
        np.array(REFERENCE_TEMPERATURE), np.array(STANDARD_PRESSURE), np.array(STANDARD_HUMIDITY), vacuum
    )
    return vacuum / float(index) / 2 / _FOLDS[options.optics]


_FOLDS = {"retroreflector": 1, "plane mirror": 2, "double plane mirror": 4}


def _setup(options: UmdOptions) -> Setup:
    return Setup(options.axis - 1, cycle_length(options) * options.factor, options.temperatures)
