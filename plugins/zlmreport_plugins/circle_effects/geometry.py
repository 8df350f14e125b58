"""Effects of a ballbar's set-up and of geometry on a circle: centre, radius and its drift; scales, guides."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from zlmreport.plugin import ARCSECOND, MICROMETRE, MICROMETRE_PER_METRE, MILLIMETRE, FloatArray, Words
from zlmreport.plugin.circle_effect import (
    AXES,
    MICROMETRE_PER_MINUTE,
    ONE,
    CircleDesign,
    CircleEffect,
    CircleTerm,
    Estimate,
    Law,
    Parity,
    Searched,
    SearchedParameter,
)
from zlmreport_plugins.circle_effects.shared import (
    find_differences,
    is_within_u,
    title_difference,
    write_pair,
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


class ScaleMismatch(CircleEffect):
    """R·(α_u·cos²θ + α_v·sin²θ): ½R(α_u − α_v)·cos2θ in one plane."""

    identifier = "scale-mismatch"
    title = Words("Scale mismatch")
    equation = "½·R·(α₁ − α₂)·cos 2θ"
    explains = Words("the scales of the axes differ")
    law = Law(Parity.EVEN, radius=1.0)
    is_asked_for = True

    def terms(self, design: CircleDesign, _: Searched) -> list[CircleTerm]:
        """Return the difference of scales of neighbouring axes."""
        return [
            CircleTerm(
                name, MICROMETRE_PER_METRE,
                design.radius * sum(share[axis] * design.wave(axis) ** 2 for axis in design.axes),
                low=-1e-3, high=1e-3, usual=20e-6, title=title_difference(name),
            )
            for name, share in find_differences(design)
        ]  # fmt: skip

    def findings(self, estimates: Sequence[Estimate]) -> Iterator[Words]:
        """Say whose scale is longer, and whose agree."""
        for each in estimates:
            if is_within_u(each):
                yield from self.absence([each])
                continue
            one, other = each.name.split("-")
            longer, shorter = (one, other) if each.value > 0 else (other, one)
            value, u = write_pair(each, abs(each.value))
            yield _LONGER.given(longer=longer, shorter=shorter, value=value, u=u)

    def absence(self, estimates: Sequence[Estimate]) -> Iterator[Words]:
        """Say that scales agree."""
        for each in estimates:
            one, other = each.name.split("-")
            value, u = write_pair(each, each.value)
            yield _AGREE.given(one=one, other=other, value=value, u=u)


_LONGER = Words(
    "the scale of {longer} is longer than that of {shorter} by {value} ± {u} µm/m beyond what the axes' "
    "errors hold"
)
_AGREE = Words(
    "the scales of {one} and {other} agree: they differ by {value} ± {u} µm/m beyond what the axes' "
    "errors hold"
)

#: The squareness error of a plane, its axes, and the sign with which it turns sin 2θ.
_SQUARENESS = {"XY": ("C0Y", -1.0), "YZ": ("A0Z", -1.0), "ZX": ("B0Z", 1.0)}


class Squareness(CircleEffect):
    """−½R·C0Y·sin2θ in XY, −½R·A0Z·sin2θ in YZ, +½R·B0Z·sin2θ in ZX."""

    identifier = "squareness"
    title = Words("Squareness")
    equation = "−½·R·C0Y·sin 2θ"
    explains = Words("the axes are not square, or less so than was measured")
    law = Law(Parity.EVEN, radius=1.0)
    is_asked_for = True

    def terms(self, design: CircleDesign, _: Searched) -> list[CircleTerm]:
        """Return the squareness error of each plane."""
        return [
            CircleTerm(
                name, ARCSECOND,
                0.5 * sign * design.radius * np.sin(2 * design.angle) * design.is_plane(plane),
                low=-2e-3, high=2e-3, usual=20e-6,
            )
            for plane, (name, sign) in _SQUARENESS.items()
            if plane in design.planes
        ]  # fmt: skip

    def findings(self, estimates: Sequence[Estimate]) -> Iterator[Words]:
        """Say how far the axes are out of square, and which are square."""
        for each in estimates:
            yield from _say_of_planes([each], _SQUARE if is_within_u(each) else _OUT_OF_SQUARE)

    def absence(self, estimates: Sequence[Estimate]) -> Iterator[Words]:
        """Say that the axes are square."""
        yield from _say_of_planes(estimates, _SQUARE)


def _say_of_planes(estimates: Sequence[Estimate], words: Words) -> Iterator[Words]:
    planes = {name: plane for plane, (name, _) in _SQUARENESS.items()}
    for each in estimates:
        value, u = write_pair(each, each.value)
        plane = planes[each.name]
        yield words.given(one=plane[0], other=plane[1], name=each.name, value=value, u=u)


_OUT_OF_SQUARE = Words(
    "{one} and {other} are out of square: {name} ({value} ± {u})″ beyond what the axes' errors hold"
)
_SQUARE = Words("{one} and {other} are square: {name} ({value} ± {u})″ beyond what the axes' errors hold")

#: Powers of the coordinate to which guides bend.
_POWERS = (2.0, 3.0, 4.0)


class Bow(CircleEffect):
    """k·(x/R₀)ⁿ·sinθ and k·(y/R₀)ⁿ·cosθ, n = 2, 3, 4; R₀ is the largest radius.

    A bow of a scale (EXX) makes the same of a circle as one of the other guide.
    """

    identifier = "bow"
    title = Words("Bow")
    equation = "k·(x/R₀)^n·sinθ; k·(y/R₀)^n·cosθ; n = 2, 3, 4"
    explains = Words("a guide is bent, or the other axis' scale is, which is one thing on a circle")
    law = Law(Parity.EVEN, radius=None)
    searched = (SearchedParameter("power", ONE, title=Words("power", context="exponent")),)
    is_single = True

    def grid(self, _: CircleDesign) -> list[Searched]:
        """Return the powers."""
        return [(power,) for power in _POWERS]

    def terms(self, design: CircleDesign, searched: Searched) -> list[CircleTerm]:
        """Return the bow of the guide of each axis."""
        share = design.radius / float(design.radius.max())
        return [
            CircleTerm(
                f"guide of {AXES[axis]}", MICROMETRE,
                (share * design.wave(axis)) ** searched[0] * design.other_wave(axis),
                low=-3e-4, high=3e-4, usual=5e-6, title=Words("guide of {axis}").given(axis=AXES[axis]),
            )
            for axis in design.axes
        ]  # fmt: skip


#: Periods of a cyclic error over the diameter of the circle: from few to as many as the readings resolve.
_FEWEST_PERIODS, _STEP_OF_PERIODS, _MOST_PERIODS = 3.0, 0.4, 40.0


class CyclicError(CircleEffect):
    """cosθ·(p·sin + q·cos)(2π·x/P), x = x₀ + R·cosθ: periodic in the position of an axis."""

    identifier = "cyclic-error"
    title = Words("Cyclic error")
    equation = "cosθ·(p·sin + q·cos)(2π·x/P); Y likewise"
    explains = Words("an error that repeats with the position of an axis: screw pitch, scale")
    law = Law(Parity.EVEN, radius=None)
    searched = (
        SearchedParameter("pitch", MILLIMETRE, is_refined=True, title=Words("period", context="parameter")),
    )

    def grid(self, design: CircleDesign) -> list[Searched]:
        """Return pitches that the readings resolve: 4πR/P readings a turn at least."""
        largest, smallest = float(design.radius.max()), float(design.radius.min())
        most = min(design.fewest_of_a_turn / (2.0 * np.pi), _MOST_PERIODS) * smallest / largest
        periods = np.arange(_FEWEST_PERIODS, max(most, _FEWEST_PERIODS + 0.1), _STEP_OF_PERIODS)
        return [(2.0 * largest / each,) for each in periods.tolist()]

    def terms(self, design: CircleDesign, searched: Searched) -> list[CircleTerm]:
        """Return sine and cosine of each axis."""
        centres = np.array([each.nominal.centre for each in design.tests])[design.test]
        terms: list[CircleTerm] = []
        for axis in design.axes:
            wave = design.wave(axis)
            phase = 2.0 * np.pi * (centres[:, axis] + design.radius * wave) / searched[0]
            terms += _make_sine_and_cosine(AXES[axis], wave, phase)
        return terms


def _make_sine_and_cosine(axis: str, wave: FloatArray, phase: FloatArray) -> list[CircleTerm]:
    return [
        CircleTerm(f"{axis} {name}", MICROMETRE, wave * turned, axis, low=-1e-4, high=1e-4, usual=2e-6)
        for name, turned in (("sin", np.sin(phase)), ("cos", np.cos(phase)))
    ]
