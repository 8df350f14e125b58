"""Positioning methods: the path on which each leads the axis over its targets."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise
from types import MappingProxyType
from typing import TypeAlias


class Method(StrEnum):
    """A positioning method, as jobs name it."""

    LINEAR = "linear"
    UNIDIRECTIONAL = "unidirectional"
    PENDULUM = "pendulum"
    QUASI_PILGRIM = "quasi-pilgrim"


@dataclass(frozen=True, slots=True)
class Stop:
    """A point at which the axis stops: at a target for a reading, or beyond one to turn round.

    Attributes
    ----------
    position
        m or rad.
    target
        Index of the target position that is read there; None where nothing is read.
    run
        Number of the run of that reading, from 1.
    """

    position: float
    target: int | None = None
    run: int = 0


Path: TypeAlias = Iterator[Stop]


def path(method: Method, targets: Sequence[float], runs: int, overrun: float) -> tuple[Stop, ...]:
    """Return the stops of a test, in their order.

    Parameters
    ----------
    method
        The positioning method.
    targets
        Target positions, rising, m or rad.
    runs
        How often each is read in each direction.
    overrun
        How far beyond a target the axis turns round, so that the next approach has its direction: the
        approach length at the start, the loop at the end, m or rad.

    Raises
    ------
    ValueError
        If the targets do not rise, or the overrun is lost in the rounding of one: then a reading would not be
        approached from its stated side.
    """
    if any(later <= earlier for earlier, later in pairwise(targets)):
        raise ValueError("target positions must rise")
    if any(not target - overrun < target < target + overrun for target in targets):
        raise ValueError(f"an overrun of {overrun:g} leaves no approach to the targets")
    return tuple(_PATHS[method](targets, runs, overrun))


def _linear(targets: Sequence[float], runs: int, overrun: float) -> Path:
    """Lead over all targets upwards, then over all of them downwards; and so on for each run."""
    yield Stop(targets[0] - overrun)
    for run in range(1, runs + 1):
        yield from (Stop(position, index, run) for index, position in enumerate(targets))
        yield Stop(targets[-1] + overrun)
        yield from (Stop(targets[index], index, run) for index in reversed(range(len(targets))))
        yield Stop(targets[0] - overrun)


def _unidirectional(targets: Sequence[float], runs: int, overrun: float) -> Path:
    """Lead over all targets upwards, and back without a reading; and so on for each run."""
    for run in range(1, runs + 1):
        yield Stop(targets[0] - overrun)
        yield from (Stop(position, index, run) for index, position in enumerate(targets))


def _pendulum(targets: Sequence[float], runs: int, overrun: float) -> Path:
    """Approach each target from below and from above in turn, all runs of it before the next target."""
    for index, position in enumerate(targets):
        for run in range(1, runs + 1):
            yield Stop(position - overrun)
            yield Stop(position, index, run)
            yield Stop(position + overrun)
            yield Stop(position, index, run)


def _quasi_pilgrim(targets: Sequence[float], runs: int, overrun: float) -> Path:
    """Go to and fro between each pair of neighbours: the next target upwards, this one downwards.

    The first target has all its upward readings before that, the last one its downward readings after it.
    """
    for run in range(1, runs + 1):
        yield Stop(targets[0] - overrun)
        yield Stop(targets[0], 0, run)
    for index in range(len(targets) - 1):
        for run in range(1, runs + 1):
            yield Stop(targets[index + 1], index + 1, run)
            yield Stop(targets[index], index, run)
    for run in range(1, runs + 1):
        yield Stop(targets[-1] + overrun)
        yield Stop(targets[-1], len(targets) - 1, run)


_PATHS: Mapping[Method, Callable[[Sequence[float], int, float], Path]] = MappingProxyType(
    {
        Method.LINEAR: _linear,
        Method.UNIDIRECTIONAL: _unidirectional,
        Method.PENDULUM: _pendulum,
        Method.QUASI_PILGRIM: _quasi_pilgrim,
    }
)
