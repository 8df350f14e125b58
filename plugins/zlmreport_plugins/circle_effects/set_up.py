"""Effects of a ballbar's set-up: its centre, its length (radius), the drift of its length."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from zlmreport.plugin import MICROMETRE, Words
from zlmreport.plugin.circle_effect import (
    AXES,
    MICROMETRE_PER_MINUTE,
    CircleDesign,
    CircleEffect,
    CircleTerm,
    Law,
    Parity,
    Searched,
)


class CentreOffset(CircleEffect):
    """One centre for each turn: a shift between turns is no error of the machine."""

    identifier = "centre-offset"
    title = Words("Centre offset")
    equation = "a·cosθ + b·sinθ"
    explains = Words("the bar's ball does not stand in the programmed centre")
    law = Law(Parity.EVEN)
    is_base = True

    def terms(self, design: CircleDesign, _: Searched) -> list[CircleTerm]:
        """Return a·cosθ + b·sinθ of each turn."""
        return list(_make_centres(design))


def _make_centres(design: CircleDesign) -> Iterator[CircleTerm]:
    for turn in design.turns.tolist():
        own = design.turn == turn
        test = design.tests[int(design.test[own][0])]
        for axis, wave in zip(test.axes, (np.cos, np.sin), strict=True):
            name = f"{AXES[axis]} of {test.name}, turn {turn + 1}"
            yield CircleTerm(
                name, MICROMETRE, own * wave(design.angle), "centre", usual=20e-6,
                title=_OF_TURN.given(axis=AXES[axis], test=test.name, turn=turn + 1),
            )  # fmt: skip


_OF_TURN = Words("{axis} of {test}, turn {turn}")


class Radius(CircleEffect):
    """One radius for each length of the bar: both senses and all feeds share it."""

    identifier = "radius"
    title = Words("Radius")
    equation = "r₀"
    explains = Words("the bar is not as long as stated, or machine and bar differ in temperature")
    law = Law(Parity.EVEN, radius=None)
    is_base = True
    is_length_of_bar = True

    def terms(self, design: CircleDesign, _: Searched) -> list[CircleTerm]:
        """Return r₀ of each radius."""
        return [
            CircleTerm(
                f"R {length * 1e3:g}", MICROMETRE, (design.radius == length).astype(float), "radius",
                usual=5e-6, title=_RADIUS.given(length=length * 1e3),
            )
            for length in np.unique(design.radius).tolist()
        ]  # fmt: skip


_RADIUS = Words("R {length}")


class RadiusDrift(CircleEffect):
    """Radius and centre move in time while the turns of a test are run."""

    identifier = "radius-drift"
    title = Words("Drift of radius or centre")
    equation = "r₁·t; (a₁·cosθ + b₁·sinθ)·t"
    explains = Words("bar or machine grow or move during the test")
    law = Law(Parity.IN_TIME)

    def terms(self, design: CircleDesign, _: Searched) -> list[CircleTerm]:
        """Return r₁·t of each test, and a₁·t, b₁·t of its centre."""
        terms = []
        for index, test in enumerate(design.tests):
            own = design.test == index
            time = np.where(own, design.time - design.time[own].mean(), 0.0)
            waves = [("radius", _RADIUS_OF, "radius", np.ones(design.count))]
            waves += [
                (AXES[axis], _AXIS_OF.given(axis=AXES[axis]), "centre", design.wave(axis))
                for axis in test.axes
            ]
            terms += [
                CircleTerm(
                    f"{name} of {test.name}", MICROMETRE_PER_MINUTE, time * wave, group,
                    low=-1e-6, high=1e-6, usual=0.5e-6 / 60, title=title.given(test=test.name),
                )
                for name, title, group, wave in waves
            ]  # fmt: skip
        return terms


_RADIUS_OF, _AXIS_OF = Words("radius of {test}"), Words("{axis} of {test}")
