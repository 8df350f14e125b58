"""A small effect that does everything right; the tests of the kit make it sin."""

from __future__ import annotations

from typing import Any

import numpy as np
from pydantic import Field

from zlmreport.plugin import Axis, FloatArray, Options, Words
from zlmreport.plugin.effect import Confusion, Design, Dimension, Effect, Parameter, Shape


class ExemplaryOptions(Options):
    rectified: bool = Field(default=False, description="Whether the wave has no negative half.")


class ExemplaryEffect(Effect):
    identifier = "exemplary-wave"
    title = Words(en="A wave over the travel", de="Eine Welle über dem Verfahrweg")
    equation = "A·sin(2πP/Λ)"
    linear: Any = (
        Parameter("height", "A", Dimension.DEVIATION, Words(en="height", de="Höhe"), -20e-6, 20e-6),
    )
    searched: Any = (
        Parameter("wavelength", "Λ", Dimension.POSITION, Words(en="wavelength", de="Wellenlänge"), 0.0, 10.0),
    )
    shape: Any = Shape.POSITION
    look = Words(en="a wave", de="eine Welle")
    remedy: Any = Words(en="straighten it", de="richten")
    confusions: Any = (Confusion("periodic", Words(en="more targets", de="mehr Zielpositionen")),)
    options: Any = ExemplaryOptions

    def __init__(self, settings: ExemplaryOptions | None = None) -> None:
        self.settings = settings or ExemplaryOptions()
        self.rectified = self.settings.rectified

    def with_settings(self, settings: ExemplaryOptions) -> Effect:
        return type(self)(settings)

    def forms(self) -> tuple[Effect, ...]:
        return (self, self.with_settings(ExemplaryOptions(rectified=True)))

    def untestable(self, design: Design) -> Words | None:
        if len(design.target_positions) < 4:
            return Words(en="it needs four targets", de="sie braucht vier Zielpositionen")
        return None

    def grid(self, design: Design) -> FloatArray:
        return design.length / np.array([[1.5], [2.0], [3.0]])

    def columns(self, design: Design, theta: FloatArray) -> FloatArray:
        wave = np.sin(2 * np.pi * design.position / theta[0])
        return (np.maximum(wave, 0.0) if self.rectified else wave)[:, np.newaxis]

    def expected(self, axis: Axis) -> dict[str, float]:
        return {"wavelength": axis.screw_pitch} if axis.screw_pitch else {}
