"""The terms of the generic ways: powers and Fourier terms of everything that was recorded, and products.

What a person would try who knows which quantities matter but not the physics. The known periods of screw and
scale are among them, so that no way fails for want of the job's own facts.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from zlmreport.measurement.arrays import FloatArray
from zlmreport.model.effects.design import Design

_WAVES = 20
_DIRECTED_WAVES = 10
_POWERS = 7
_LOGS = {
    "axis_temperature": "axis temperature",
    "screw_temperature": "screw temperature",
    "air_temperature": "air",
    "air_pressure": "air",
    "relative_humidity": "air",
}


@dataclass(frozen=True, slots=True)
class Term:
    """A term.

    Attributes
    ----------
    variables
        On what it depends.
    group
        Sine and cosine of one wave have the same.
    values : (N,) array
        Of unit root mean square over the first test.
    """

    variables: frozenset[str]
    group: str
    values: FloatArray


def library(design: Design, first: Design) -> tuple[Term, ...]:
    """Return the terms on a test, scaled as on the first one."""
    found = []
    for here, there in zip(_terms(design, first), _terms(first, first), strict=True):
        size = float(np.sqrt(np.mean(there.values**2)))
        if size > 0:
            found.append(Term(here.variables, here.group, here.values / size))
    return tuple(found)


def _terms(design: Design, first: Design) -> Iterator[Term]:
    place = (design.position - first.span[0]) / first.length
    moment = design.time / first.duration
    run = {f"1 in run {run}": (design.run == run).astype(np.float64) for run in np.unique(first.run)}
    lever, along = 2 * place - 1, {**_powers("P", 2 * place - 1, _POWERS), **_waves("P", place, _WAVES)}
    over = {**_powers("t", moment, 5), **_waves("t", moment, _WAVES)}
    directed = {**_powers("P", lever, 5), **_waves("P", place, _DIRECTED_WAVES)}
    for name, period in (("pitch", design.axis.screw_pitch), ("signal", design.axis.signal_period)):
        if period:
            for order in (1, 2):
                wave = _wave(f"{name} {order}", order * design.position / period)
                along |= wave
                directed |= wave
    yield from _named({"P"}, along)
    yield from _named({"t"}, over)
    yield from _named({"c"}, run)
    yield from _times("d", design.direction, {"d", "P"}, directed)
    slow = {**_powers("t", moment, 4), **_waves("t", moment, _DIRECTED_WAVES)}
    yield from _times("P·", lever, {"P", "t"}, slow)
    yield from _times("d", design.direction, {"d", "t"}, _powers("t", moment, 3))
    yield Term(frozenset({"d"}), "d", design.direction)
    fading = design.since_reversal / first.length
    yield from _times("d", design.direction, {"d", "s"}, _powers("s", fading, 3))
    for log, variable in _LOGS.items():
        warmth = design.conditions[log] - first.conditions[log].mean()
        yield Term(frozenset({variable}), log, warmth)
        yield Term(frozenset({variable, "P"}), f"P·{log}", lever * warmth)


def _powers(name: str, values: FloatArray, most: int) -> dict[str, FloatArray]:
    return {f"{name}^{power}": values**power for power in range(1, most + 1)}


def _waves(name: str, values: FloatArray, most: int) -> dict[str, FloatArray]:
    found: dict[str, FloatArray] = {}
    for halves in range(1, most + 1):
        found |= _wave(f"{name} wave {halves}/2", halves / 2 * values)
    return found


def _wave(name: str, turns: FloatArray) -> dict[str, FloatArray]:
    return {f"{name}|sin": np.sin(2 * np.pi * turns), f"{name}|cos": np.cos(2 * np.pi * turns)}


def _named(variables: set[str], columns: dict[str, FloatArray]) -> Iterator[Term]:
    for name, values in columns.items():
        yield Term(frozenset(variables), name.split("|")[0], values)


def _times(
    prefix: str, factor: FloatArray, variables: set[str], columns: dict[str, FloatArray]
) -> Iterator[Term]:
    for name, values in columns.items():
        yield Term(frozenset(variables), prefix + name.split("|")[0], factor * values)
