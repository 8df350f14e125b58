"""Causes that are hidden in circles: each of unit size, its shape drawn, off every grid of the search."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from machines.simulated import (
    Path as Course,
    lagging,
    nothing,
    out_of_square,
    unequal_scales,
    with_lost_motion,
    with_play,
)

Move = Callable[[Course], tuple[np.ndarray, np.ndarray]]


@dataclass(frozen=True)
class Cause:
    """A cause: what it makes of a path, and what it is, SI, by the parameter of the effect of its name."""

    move: Move
    truth: Mapping[str, float] = field(default_factory=dict)


class _Spike(NamedTuple):
    """How a bump behind a reversal rises and falls: by no shape of the catalogue, from steep to gentle."""

    width: float  #: Up to its top, rad.
    rise: float  #: Power of a sine.
    slow: float  #: Length of the fall over the width.
    fall: float  #: Its power.

    def follow(self, path: Course, axis: int) -> np.ndarray:
        """Return the bump of an axis along a path."""
        angle = np.arctan2(path.v, path.u)
        since = (path.sense * (angle - axis * np.pi / 2)) % np.pi
        up = np.sin(np.pi * np.minimum(since / self.width, 1.0) / 2) ** self.rise
        behind = np.maximum(since / self.width - 1.0, 0.0)
        return np.asarray(np.where(behind > 0, np.exp(-((behind / self.slow) ** self.fall)), up))


def _radial(path: Course, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    radius = np.hypot(path.u, path.v)
    return values * path.u / radius, values * path.v / radius


def _measure_travelled(path: Course) -> np.ndarray:
    """Return the angle travelled since the beginning of each turn, in one go over 0."""
    angle, found = np.arctan2(path.v, path.u), np.zeros(len(path.u))
    for way in np.unique(path.sense):
        own = path.sense == way
        unwrapped = np.unwrap(angle[own])
        found[own] = np.abs(unwrapped - unwrapped[0])
    return found


def drawn_cause(name: str, draw: np.random.Generator) -> Cause:
    """Return a cause of unit size, its shape drawn."""
    side = int(draw.integers(2))
    sign = float(draw.choice([-1.0, 1.0]))
    both = draw.uniform(0.3, 1.0, 2) if draw.integers(2) else np.eye(2)[side]
    width = float(np.radians(draw.uniform(2.5, 15.0)))

    def spikes(path: Course) -> tuple[np.ndarray, np.ndarray]:
        return _radial(path, sum(both[a] * spike.follow(path, a) for a in (0, 1)))

    pitch, phase = float(draw.uniform(8e-3, 60e-3)), float(draw.uniform(0, 2 * np.pi))

    def cyclic(path: Course) -> tuple[np.ndarray, np.ndarray]:
        coordinate = (path.u, path.v)[side]
        wave = np.sin(2 * np.pi * coordinate / pitch + phase)
        return (wave, 0 * wave) if side == 0 else (0 * wave, wave)

    power = int(draw.integers(2, 5))

    def bow(path: Course) -> tuple[np.ndarray, np.ndarray]:
        bent = sign * ((path.u, path.v)[side] / 0.15) ** power
        return (0 * bent, bent) if side == 0 else (bent, 0 * bent)

    order, turned = float(draw.uniform(12, 60)), draw.uniform(0, 2 * np.pi, 2)

    def vibration(path: Course) -> tuple[np.ndarray, np.ndarray]:
        travelled = _measure_travelled(path)
        return _radial(path, np.sin(order * travelled + np.where(path.sense > 0, turned[0], turned[1])))

    decay, length = np.radians(draw.uniform(10, 28)), np.radians(draw.uniform(8, 24))

    def stick_slip(path: Course) -> tuple[np.ndarray, np.ndarray]:
        angle = np.arctan2(path.v, path.u)
        since = (path.sense * (angle - side * np.pi / 2)) % np.pi
        return _radial(path, np.exp(-since / decay) * np.sin(2 * np.pi * since / length))

    lobes, where = int(draw.integers(5, 9)), float(draw.uniform(0, 2 * np.pi))

    def stranger(path: Course) -> tuple[np.ndarray, np.ndarray]:
        angle = np.arctan2(path.v, path.u)
        near = np.exp(-0.5 * ((angle - where + np.pi) % (2 * np.pi) - np.pi) ** 2 / 0.35**2)
        shapes = (np.cos(lobes * angle + where), near, path.sense * near)
        return _radial(path, shapes[int(where * 1000) % 3])

    spike = _Spike(width, *draw.uniform((0.6, 0.25, 1.0), (1.8, 0.8, 2.0)).tolist())
    lost = {"X": float(both[0]), "Y": float(both[1])}
    causes = {
        "nothing": Cause(nothing),
        "stranger": Cause(stranger),
        "squareness": Cause(out_of_square(sign), {"C0Y": sign}),
        "scale-mismatch": Cause(unequal_scales(sign, 0.0), {"X-Y": sign}),
        "servo-mismatch": Cause(lagging(max(sign, 0.0), max(-sign, 0.0)), {"T_X-T_Y": sign}),
        "circle-backlash": Cause(with_lost_motion(*both.tolist()), lost),
        "over-compensation": Cause(with_lost_motion(*(-both).tolist())),
        "lateral-play": Cause(with_play(*(sign * both).tolist())),
        "reversal-spikes": Cause(spikes),
        "cyclic-error": Cause(cyclic),
        "bow": Cause(bow),
        "vibration": Cause(vibration),
        "stick-slip": Cause(stick_slip),
    }
    return causes[name]


CAUSES = (
    "squareness", "scale-mismatch", "servo-mismatch", "circle-backlash", "over-compensation", "lateral-play",
    "reversal-spikes", "cyclic-error", "bow", "vibration", "stick-slip",
)  # fmt: skip
#: Of which a parameter of the effect of their name is known.
MEASURED = ("squareness", "scale-mismatch", "servo-mismatch", "circle-backlash")
PAIRS = (
    ("servo-mismatch", "scale-mismatch"), ("squareness", "circle-backlash"),
    ("circle-backlash", "servo-mismatch"),
    ("reversal-spikes", "squareness"), ("cyclic-error", "lateral-play"),
)  # fmt: skip
