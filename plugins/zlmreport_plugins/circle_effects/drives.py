"""Effects of drives on a circle: servo lag, its mismatch, dynamic cross talk, compliance; vibration."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from zlmreport.plugin import MICROMETRE, Words
from zlmreport.plugin.circle_effect import (
    HERTZ,
    MILLISECOND,
    PER_ACCELERATION,
    SQUARE_MILLISECOND,
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


class ServoLag(CircleEffect):
    """−(T_s² + T_p²)·F²/(2R); T_s of smoothing, T_p of the position loop (JSPE 54 (1988) 1113)."""

    identifier = "servo-lag"
    title = Words("Servo lag")
    equation = "−T²·F²/(2R)"
    explains = Words("both drives follow with the same delay: the circle shrinks with the square of the feed")
    law = Law(Parity.EVEN, feed=2.0, radius=-1.0)

    def terms(self, design: CircleDesign, _: Searched) -> list[CircleTerm]:
        """Return T²."""
        return [
            CircleTerm(
                "T²", SQUARE_MILLISECOND, -design.centripetal / 2.0, low=0.0, high=0.15**2, usual=0.03**2
            )
        ]


class ServoMismatch(CircleEffect):
    """½s·F·(T_u − T_v)·sin2θ; T the lag of an axis."""

    identifier = "servo-mismatch"
    title = Words("Servo mismatch")
    equation = "½·s·F·(T₁ − T₂)·sin 2θ"
    explains = Words("one drive lags behind the other")
    law = Law(Parity.ODD, feed=1.0)
    is_asked_for = True

    def terms(self, design: CircleDesign, _: Searched) -> list[CircleTerm]:
        """Return the difference of lags of neighbouring axes."""
        terms = []
        for name, share in find_differences(design):
            lag = share[design.first] - share[design.second]
            column = 0.5 * design.sense * design.feed * lag * np.sin(2 * design.angle)
            one, other = name.split("-")
            terms.append(
                CircleTerm(
                    f"T_{one}-T_{other}",
                    MILLISECOND,
                    column,
                    low=-0.05,
                    high=0.05,
                    usual=1e-3,
                    title=Words("lag {one} − {other}").given(one=one, other=other),
                )
            )
        return terms

    def findings(self, estimates: Sequence[Estimate]) -> Iterator[Words]:
        """Say who lags behind whom, and who follow alike."""
        for each in estimates:
            if is_within_u(each):
                yield from self.absence([each])
                continue
            early, late = _list_axes(each)
            early, late = (early, late) if each.value < 0 else (late, early)
            time, u = write_pair(each, abs(each.value))
            yield _LAGS.given(late=late, early=early, time=time, u=u)

    def absence(self, estimates: Sequence[Estimate]) -> Iterator[Words]:
        """Say that drives follow alike."""
        for each in estimates:
            one, other = _list_axes(each)
            time, u = write_pair(each, each.value)
            yield _ALIKE.given(one=one, other=other, time=time, u=u)


def _list_axes(estimate: Estimate) -> list[str]:
    return estimate.name.replace("T_", "").split("-")


_LAGS = Words("{late} lags behind {early} by {time} ± {u} ms")
_ALIKE = Words("{one} and {other} follow alike: their lags differ by {time} ± {u} ms")


class DynamicCrossTalk(CircleEffect):
    """½c·(F²/R)·sin2θ: an axis that accelerates bends the machine across."""

    identifier = "dynamic-cross-talk"
    title = Words("Dynamic cross-talk")
    equation = "½·c·(F²/R)·sin 2θ"
    explains = Words("the acceleration of an axis bends the machine across it")
    law = Law(Parity.EVEN, feed=2.0, radius=-1.0)

    def terms(self, design: CircleDesign, _: Searched) -> list[CircleTerm]:
        """Return the compliance c of each plane."""
        return [
            CircleTerm(
                plane, PER_ACCELERATION,
                0.5 * design.centripetal * np.sin(2 * design.angle) * design.is_plane(plane),
                low=-1e-4, high=1e-4, usual=1e-5,
            )
            for plane in design.planes
        ]  # fmt: skip


class DriveCompliance(CircleEffect):
    """(F²/R)·(k_u·cos²θ + k_v·sin²θ): a drive that gives way to the acceleration of its axis."""

    identifier = "drive-compliance"
    title = Words("Drive compliance")
    equation = "½·(F²/R)·(k₁ − k₂)·cos 2θ"
    explains = Words("a drive gives way to the acceleration of its axis")
    law = Law(Parity.EVEN, feed=2.0, radius=-1.0)

    def terms(self, design: CircleDesign, _: Searched) -> list[CircleTerm]:
        """Return the difference of compliances of neighbouring axes."""
        return [
            CircleTerm(
                name, PER_ACCELERATION,
                design.centripetal * sum(share[axis] * design.wave(axis) ** 2 for axis in design.axes),
                low=-1e-4, high=1e-4, usual=1e-5, title=title_difference(name),
            )
            for name, share in find_differences(design)
        ]  # fmt: skip


#: Oscillations a turn: from more than geometry has to as many as the readings resolve.
_FEWEST, _MOST, _READINGS_OF_ONE = 8.0, 70.0, 2.5
#: Steps of the search in oscillations a turn, for few turns and for many.
_FINE, _COARSE, _FEW_TURNS = 0.5, 1.0, 4


class Vibration(CircleEffect):
    """A·sin(2πf·t + ψ), ψ of each turn its own: fixed in Hz, so that its order falls with the feed."""

    identifier = "vibration"
    title = Words("Vibration")
    equation = "A·sin(2πf·t + ψ), each turn its own"
    explains = Words("an oscillation of a fixed frequency")
    law = Law(Parity.IN_TIME, feed=None, radius=None)
    searched = (SearchedParameter("frequency", HERTZ, is_refined=True, title=Words("frequency")),)

    def grid(self, design: CircleDesign) -> list[Searched]:
        """Return frequencies that the readings of every turn resolve."""
        turns_a_second = design.feed / design.radius / (2.0 * np.pi)
        slowest, fastest = float(turns_a_second.min()), float(turns_a_second.max())
        step = _FINE if len(design.turns) <= _FEW_TURNS else _COARSE
        most = min(design.fewest_of_a_turn / _READINGS_OF_ONE, _MOST)
        return [(each,) for each in np.arange(_FEWEST * fastest, most * slowest, step * slowest).tolist()]

    def terms(self, design: CircleDesign, searched: Searched) -> list[CircleTerm]:
        """Return sine and cosine of each turn."""
        # Time by the path: what is logged may be rounded or missing.
        phase = 2.0 * np.pi * searched[0] * design.travelled * design.radius / design.feed
        return [
            CircleTerm(
                f"{name} of turn {turn + 1}", MICROMETRE, (design.turn == turn) * wave(phase), "all",
                low=-1e-4, high=1e-4, usual=2e-6, title=_OF_TURN.given(wave=name, turn=turn + 1),
            )
            for turn in design.turns.tolist()
            for name, wave in (("sin", np.sin), ("cos", np.cos))
        ]  # fmt: skip


_OF_TURN = Words("{wave} of turn {turn}")
