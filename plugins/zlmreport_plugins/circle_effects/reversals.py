"""Effects at reversals on a circle: backlash, over-compensation, lateral play, spikes, stick-slip."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations, product

import numpy as np

from zlmreport.plugin import DEGREE, MICROMETRE, FloatArray, Words
from zlmreport.plugin.circle_effect import (
    AXES,
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
from zlmreport_plugins.circle_effects.shared import is_within_u, write_pair

_LARGEST_LOST_MOTION = 5e-4  # m
#: Whether both ends of the travel lose alike, or each has its own.
_ALIKE, _EACH_END = 0.0, 1.0


class _LostMotion(CircleEffect):
    """−½B·d·cosθ of the first axis, −½B·d·sinθ of the second; both ends alike, or each its own."""

    law = Law(Parity.ODD)
    searched = (SearchedParameter("each end", ONE, title=Words("both ends alike: 0, each its own: 1")),)
    bounds: tuple[float, float]  #: Of B, m.

    def grid(self, _: CircleDesign) -> list[Searched]:
        """Return both ends alike, and each its own."""
        return [(_ALIKE,), (_EACH_END,)]

    def terms(self, design: CircleDesign, searched: Searched) -> list[CircleTerm]:
        """Return the lost motion of each axis, or of each of its ends: B goes over from one to the other."""
        terms = []
        for axis in design.axes:
            wave = design.wave(axis)
            column = -0.5 * design.travel(axis) * wave
            shares: tuple[tuple[str, FloatArray], ...] = ((AXES[axis], np.ones(design.count)),)
            if searched[0] == _EACH_END:
                shares = ((f"{AXES[axis]}+", (1.0 + wave) / 2.0), (f"{AXES[axis]}−", (1.0 - wave) / 2.0))
            low, high = self.bounds
            terms += [
                CircleTerm(name, MICROMETRE, share * column, AXES[axis], low=low, high=high, usual=5e-6)
                for name, share in shares
            ]
        return terms


class CircleBacklash(_LostMotion):
    """−½B·d·cosθ of the first axis, −½B·d·sinθ of the second; lost motion B > 0."""

    identifier = "circle-backlash"
    title = Words("Backlash")
    equation = "−½·B₁·d₁·cosθ − ½·B₂·d₂·sinθ, B > 0; both ends alike, or each its own"
    explains = Words("an axis loses motion where it turns")
    bounds = (0.0, _LARGEST_LOST_MOTION)
    is_asked_for = True

    def findings(self, estimates: Sequence[Estimate]) -> Iterator[Words]:
        """Say which axis loses how much where it turns, at which end of the circle, and what to do."""
        seen = [each for each in estimates if each.value > each.expanded_uncertainty]
        for each in seen:
            value, u = write_pair(each, each.value)
            axis, end = each.name[:1], each.name[1:]
            yield (_LOSES_AT[end] if end else _LOSES).given(axis=axis, value=value, u=u)
        if _has_unlike_ends(estimates):
            yield _ENDS_DIFFER
        if seen:
            yield _MEND

    def absence(self, estimates: Sequence[Estimate]) -> Iterator[Words]:
        """Say how much lost motion there might be."""
        for each in estimates:
            value, u = write_pair(each, each.value)
            yield Words("no backlash of {axis}: {value} ± {u} µm").given(axis=each.name, value=value, u=u)


def _has_unlike_ends(estimates: Sequence[Estimate]) -> bool:
    """Return whether the ends of an axis differ by more than both values are uncertain."""
    pairs = (
        (one, other)
        for one, other in combinations(estimates, 2)
        if one.name[:1] == other.name[:1] and one.name != other.name
    )
    return any(
        abs(one.value - other.value) > np.hypot(one.expanded_uncertainty, other.expanded_uncertainty)
        for one, other in pairs
    )


class OverCompensation(_LostMotion):
    """As lost motion, with B < 0: the control takes off more than there is."""

    identifier = "over-compensation"
    title = Words("Over-compensated backlash")
    equation = "as backlash, B < 0"
    explains = Words("the control's backlash compensation takes off more than there is")
    bounds = (-_LARGEST_LOST_MOTION, 0.0)

    def findings(self, estimates: Sequence[Estimate]) -> Iterator[Words]:
        """Say which axis is over-compensated."""
        for each in estimates:
            if each.value < -each.expanded_uncertainty:
                value, u = write_pair(each, each.value)
                yield _OVER.given(axis=each.name, value=value, u=u)


_LOSES = Words("{axis} loses {value} ± {u} µm where it turns, alike at both ends of the circle")
_LOSES_AT = {
    "+": Words("{axis} loses {value} ± {u} µm where it turns at the end of larger {axis}"),
    "−": Words("{axis} loses {value} ± {u} µm where it turns at the end of smaller {axis}"),
}
_ENDS_DIFFER = Words(
    "The ends differ, so one value of the control does not suit both: a screw that is worn in a part of its "
    "travel, or a pull of covers and hoses"
)
_MEND = Words(
    "Look for play in coupling, nut and thrust bearing first; what stays is entered as backlash compensation "
    "of the control. Then run the circle again: a value too large shows as over-compensation"
)
_OVER = Words("{axis} is over-compensated: lost motion {value} ± {u} µm")


class LateralPlay(CircleEffect):
    """½L·d across the axis that moves: ½L_x·d_x·sinθ, ½L_y·d_y·cosθ."""

    identifier = "lateral-play"
    title = Words("Lateral play")
    equation = "½·L₁·d₁·sinθ + ½·L₂·d₂·cosθ"
    explains = Words("a carriage shifts sideways where it turns")
    law = Law(Parity.ODD)
    is_asked_for = True

    def terms(self, design: CircleDesign, _: Searched) -> list[CircleTerm]:
        """Return the play of each axis."""
        return [
            CircleTerm(
                AXES[axis], MICROMETRE, 0.5 * design.travel(axis) * design.other_wave(axis),
                low=-2e-4, high=2e-4, usual=3e-6,
            )
            for axis in design.axes
        ]  # fmt: skip

    def findings(self, estimates: Sequence[Estimate]) -> Iterator[Words]:
        """Say which axis shifts sideways, and how far."""
        for each in estimates:
            if not is_within_u(each):
                value, u = write_pair(each, each.value)
                yield _SHIFTS.given(axis=each.name, value=value, u=u)

    def absence(self, estimates: Sequence[Estimate]) -> Iterator[Words]:
        """Say how much play there might be."""
        for each in estimates:
            value, u = write_pair(each, each.value)
            yield Words("no lateral play of {axis}: {value} ± {u} µm").given(axis=each.name, value=value, u=u)


_SHIFTS = Words("{axis} shifts sideways by {value} ± {u} µm where it turns")


def _compute_let_go(since: FloatArray, width: float) -> FloatArray:
    """Return what an axis leaves that decays back: exp(−φ/w)."""
    return np.asarray(np.exp(-since / width))


def _compute_stand_still(since: FloatArray, width: float) -> FloatArray:
    """Return what an axis leaves that stands still, φ²/w², until it lets go at w and falls back."""
    return np.where(since < width, (since / width) ** 2, np.exp(-(since - width) / (width / 3.0)))


def _compute_creep(since: FloatArray, width: float) -> FloatArray:
    """Return what an axis leaves that creeps under growing friction, 1 − (1 − φ/w)², until it breaks away."""
    return np.where(since < width, 1.0 - (1.0 - since / width) ** 2, np.exp(-(since - width) / (width / 3.0)))


def _compute_rise_and_fall(since: FloatArray, width: float) -> FloatArray:
    """Return what an axis leaves that is held and comes back as gently: ½(1 − cos(π·φ/w)) up to 2w."""
    return np.where(since < 2.0 * width, 0.5 * (1.0 - np.cos(np.pi * since / width)), 0.0)


def _compute_return(since: FloatArray, width: float) -> FloatArray:
    """Return what an axis leaves that creeps likewise, and is brought back gently: exp(−((φ − w)/w)²)."""
    behind = since / width - 1.0
    return np.where(behind < 0.0, 1.0 - behind**2, np.exp(-(behind**2)))


_SHAPES: tuple[Callable[[FloatArray, float], FloatArray], ...] = (
    _compute_let_go,
    _compute_stand_still,
    _compute_rise_and_fall,
    _compute_creep,
    _compute_return,
)
_WIDTHS = tuple(np.radians([2.0, 4.0, 7.0, 12.0, 20.0]).tolist())
_CONSTANT, _WITH_ACCELERATION = 0.0, 1.0


class ReversalSpikes(CircleEffect):
    """A·g(φ/w) ≥ 0 after each reversal, in five shapes; the size constant, or growing with F²/R."""

    identifier = "reversal-spikes"
    title = Words("Reversal spikes")
    equation = "A·g(φ/w) ≥ 0, five shapes; constant, or as F²/R"
    explains = Words("an axis stands still for a moment where it turns: friction")
    law = Law(Parity.BY_TRAVEL, feed=None, radius=None)
    searched = (
        SearchedParameter("shape", ONE, title=Words("shape, 0 to 4")),
        SearchedParameter("width", DEGREE, is_refined=True, title=Words("width")),
        SearchedParameter("grows", ONE, title=Words("size constant: 0, as F²/R: 1")),
    )

    def grid(self, design: CircleDesign) -> list[Searched]:
        """Return shapes, widths, and laws where several accelerations tell them apart."""
        accelerations = np.unique(np.round(design.centripetal, 12))
        laws = (_CONSTANT, _WITH_ACCELERATION) if len(accelerations) > 1 else (_CONSTANT,)
        return list(product(map(float, range(len(_SHAPES))), _WIDTHS, laws))

    def terms(self, design: CircleDesign, searched: Searched) -> list[CircleTerm]:
        """Return the spike of each axis."""
        shape, width, grows = searched
        law = design.centripetal / design.centripetal.max() if grows else np.ones(design.count)
        terms = []
        for axis in design.axes:
            since = design.since_reversal(axis)
            peak = _SHAPES[int(shape)](np.nan_to_num(since), width)
            column = np.where(np.isnan(since), 0.0, peak) * law
            terms.append(CircleTerm(AXES[axis], MICROMETRE, column, low=0.0, high=5e-4, usual=5e-6))
        return terms


_DECAYS = tuple(np.radians([7.0, 14.0, 28.0]).tolist())
_LENGTHS = tuple(np.radians([7.0, 9.0, 11.0, 13.5, 16.5, 20.0, 24.0]).tolist())


class StickSlip(CircleEffect):
    """exp(−φ/w)·(p·sin + q·cos)(2πφ/λ): an oscillation that dies after each reversal."""

    identifier = "stick-slip"
    title = Words("Stick-slip")
    equation = "exp(−φ/w)·(p·sin + q·cos)(2πφ/λ)"
    explains = Words("an axis oscillates after it has turned")
    law = Law(Parity.BY_TRAVEL, feed=None, radius=None)
    searched = (
        SearchedParameter("decay", DEGREE, is_refined=True, title=Words("decay")),
        SearchedParameter("length", DEGREE, is_refined=True, title=Words("length of the wave")),
    )

    def grid(self, _: CircleDesign) -> list[Searched]:
        """Return decays and lengths of a wave."""
        return list(product(_DECAYS, _LENGTHS))

    def terms(self, design: CircleDesign, searched: Searched) -> list[CircleTerm]:
        """Return sine and cosine of each axis."""
        decay, length = searched
        terms = []
        for axis in design.axes:
            since = design.since_reversal(axis)
            known, phase = ~np.isnan(since), 2 * np.pi * np.nan_to_num(since) / length
            envelope = np.where(known, np.exp(-np.nan_to_num(since) / decay), 0.0)
            terms += [
                CircleTerm(
                    f"{AXES[axis]} {name}", MICROMETRE, envelope * wave(phase), AXES[axis],
                    low=-2e-4, high=2e-4, usual=2e-6,
                )
                for name, wave in (("sin", np.sin), ("cos", np.cos))
            ]  # fmt: skip
        return terms
