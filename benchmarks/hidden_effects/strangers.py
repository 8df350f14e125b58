"""Shapes that no installed effect has: of each, what a diagnosis should say is that it cannot name it.

They are functions of a design, of arbitrary size. Some are shapes that a person would call physical (a worn
stretch, a coolant that is switched on), some are only irregular.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

import numpy as np

from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.design import Design

Stranger: TypeAlias = Callable[[Design, np.random.Generator], FloatArray]


def _place(design: Design) -> FloatArray:
    """Return the position as a share of the travel, 0 to 1."""
    return (design.position - design.span[0]) / design.length


def _moment(design: Design) -> FloatArray:
    """Return the time as a share of the test, 0 to 1."""
    return (design.time - design.time.min()) / design.duration


def _smooth(where: FloatArray, length: float, random: np.random.Generator) -> FloatArray:
    """Return a smooth random curve with a correlation length, over values from 0 to 1."""
    waves = 30
    amplitude, wavenumber = random.standard_normal(waves), random.standard_normal(waves) / length
    phase = random.uniform(0, 2 * np.pi, waves)
    return np.cos(where[:, np.newaxis] * wavenumber + phase) @ amplitude


def _bump(design: Design, random: np.random.Generator) -> FloatArray:
    return np.exp(-0.5 * ((_place(design) - random.uniform(0.2, 0.8)) / random.uniform(0.04, 0.15)) ** 2)


def _plateau(design: Design, random: np.random.Generator) -> FloatArray:
    first = random.uniform(0.15, 0.55)
    last = first + random.uniform(0.15, 0.3)
    return ((_place(design) > first) & (_place(design) < last)).astype(np.float64)


def _sawtooth(design: Design, random: np.random.Generator) -> FloatArray:
    return (_place(design) * random.uniform(2, 6) + random.uniform()) % 1.0


def _chirp(design: Design, random: np.random.Generator) -> FloatArray:
    place = _place(design)
    turns = place * random.uniform(0.5, 1.5) + place**2 * random.uniform(2, 5) + random.uniform()
    return np.sin(2 * np.pi * turns)


def _smooth_place(design: Design, random: np.random.Generator) -> FloatArray:
    return _smooth(_place(design), random.uniform(0.08, 0.25), random)


def _growing_wave(design: Design, random: np.random.Generator) -> FloatArray:
    turns = _place(design) * random.uniform(3, 8) + random.uniform()
    return _place(design) ** 2 * np.sin(2 * np.pi * turns)


def _reversal_smooth(design: Design, random: np.random.Generator) -> FloatArray:
    return design.direction * _smooth(_place(design), random.uniform(0.1, 0.3), random)


def _reversal_kink(design: Design, random: np.random.Generator) -> FloatArray:
    return design.direction * np.maximum(0.0, _place(design) - random.uniform(0.3, 0.7))


def _stretch_one_way(design: Design, random: np.random.Generator) -> FloatArray:
    return (design.direction > 0) * _plateau(design, random)


def _reversal_over_time(design: Design, random: np.random.Generator) -> FloatArray:
    return design.direction * _smooth(_moment(design), random.uniform(0.15, 0.5), random)


def _smooth_time(design: Design, random: np.random.Generator) -> FloatArray:
    return _smooth(_moment(design), random.uniform(0.1, 0.3), random)


def _passing(design: Design, random: np.random.Generator) -> FloatArray:
    return np.exp(-(((_moment(design) - random.uniform(0.2, 0.8)) / random.uniform(0.03, 0.1)) ** 2))


def _switched_on(design: Design, random: np.random.Generator) -> FloatArray:
    since = np.maximum(0.0, _moment(design) - random.uniform(0.3, 0.7))
    return -np.expm1(-since / random.uniform(0.05, 0.2))


def _slope_over_time(design: Design, random: np.random.Generator) -> FloatArray:
    return _place(design) * _smooth(_moment(design), random.uniform(0.12, 0.35), random)


def _slope_step(design: Design, random: np.random.Generator) -> FloatArray:
    return _place(design) * (_moment(design) > random.uniform(0.25, 0.75))


def _bow_with_warmth(design: Design, random: np.random.Generator) -> FloatArray:
    temperature = design.conditions["screw_temperature"]
    middle = random.uniform(0.3, 0.7)
    return np.exp(-0.5 * ((_place(design) - middle) / 0.25) ** 2) * (temperature - temperature[0])


def _runs_apart(design: Design, random: np.random.Generator) -> FloatArray:
    return random.standard_normal(int(design.run.max()) + 1)[design.run]


def _slopes_of_runs(design: Design, random: np.random.Generator) -> FloatArray:
    return _place(design) * random.standard_normal(int(design.run.max()) + 1)[design.run]


STRANGERS: Mapping[str, Stranger] = {
    "bump in position": _bump,
    "plateau in position": _plateau,
    "saw teeth in position": _sawtooth,
    "chirp in position": _chirp,
    "smooth in position": _smooth_place,
    "wave that grows": _growing_wave,
    "reversal smooth in position": _reversal_smooth,
    "reversal with a kink": _reversal_kink,
    "stretch in one direction only": _stretch_one_way,
    "reversal smooth in time": _reversal_over_time,
    "smooth in time": _smooth_time,
    "passing disturbance": _passing,
    "drift that begins late": _switched_on,
    "slope smooth in time": _slope_over_time,
    "slope that jumps": _slope_step,
    "bow with warmth": _bow_with_warmth,
    "runs apart": _runs_apart,
    "slopes of runs apart": _slopes_of_runs,
}
#: Those that act in proportion to the position: they have a slope on the average.
OF_A_SLOPE = frozenset({"slope smooth in time", "slope that jumps", "slopes of runs apart"})
#: Those that are nothing but at their place; of the others, as of all that is seen beside a constant, only
#: what stands off from their mean is at a place.
OF_A_PLACE = frozenset(
    {
        "bump in position",
        "plateau in position",
        "reversal with a kink",
        "stretch in one direction only",
        "passing disturbance",
        "drift that begins late",
    }
)
#: How many numbers decide a shape, its size among them; the other kinds are random curves or numbers.
NUMBERS_OF: Mapping[str, int] = {
    "bump in position": 3,
    "plateau in position": 3,
    "saw teeth in position": 3,
    "chirp in position": 4,
    "wave that grows": 3,
    "reversal with a kink": 2,
    "stretch in one direction only": 3,
    "passing disturbance": 3,
    "drift that begins late": 3,
    "slope that jumps": 2,
    "bow with warmth": 2,
}
