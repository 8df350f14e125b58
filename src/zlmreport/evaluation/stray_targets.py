"""One target that stands apart from the curve of all others: a defect there, or another place."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from zlmreport.measurement.arrays import FloatArray

#: Targets, without the one that is looked at, that show what curve they make.
_FEWEST = 6
#: Times as far as the farthest of all others from its neighbours a target lies that stands apart.
_APART = 4.0
#: Last digits by which it must lie off, where the others make a curve without any scatter.
_STEPS = 10.0
#: Targets that are tried as the stray one: those that fit to their neighbours least.
_TRIED = 5


class Stray(NamedTuple):
    """A target that stands apart in every run."""

    position: int  #: Its index.
    distance: float  #: From the line through its neighbours, with its sign, m or rad.


def find_stray_target(positions: FloatArray, readings: FloatArray, step: float) -> Stray | None:
    """Return the one target of a direction that stands apart; None without one.

    `positions`: (position,), rising, m or rad; `readings`: (position, run), m or rad, NaN where none
    is. `step`: Of the last digit, m or rad.
    """
    there = np.isfinite(readings).any(axis=1)
    indices = np.flatnonzero(there)
    if len(indices) <= _FEWEST:
        return None
    at, typical = positions[there], np.nanmedian(readings[there], axis=1)
    if not np.ptp(typical):
        return None
    misfits = np.abs(_measure_misfits(at, typical)[0])
    best: tuple[float, int] | None = None
    for tried in np.argsort(-misfits)[:_TRIED].tolist():
        rough = float(np.abs(_measure_misfits(np.delete(at, tried), np.delete(typical, tried))[0]).max())
        best = (rough, tried) if best is None or rough < best[0] else best
    if best is None:
        return None
    rough, stray = best
    of_all, factors = _measure_misfits(at, typical)
    distance = float(of_all[stray] * factors[stray])
    of_runs = readings[there][stray] - typical[stray] + distance
    in_every_run = bool(np.nanmin(np.sign(distance) * of_runs) > abs(distance) / 2)
    is_apart = abs(of_all[stray]) > _APART * rough and abs(distance) > _STEPS * step
    return Stray(int(indices[stray]), distance) if is_apart and in_every_run else None


def _measure_misfits(positions: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return how far each value lies from the line through the two nearest others, for the noise of that.

    A misfit is a distance divided by its factor: what the noise of a single value becomes in that distance.
    """
    left = np.concatenate(([1], np.arange(len(values) - 2), [len(values) - 3]))
    right = np.concatenate(([2], np.arange(2, len(values)), [len(values) - 2]))
    share = (positions - positions[left]) / (positions[right] - positions[left])
    distances = values - (1 - share) * values[left] - share * values[right]
    factors = np.sqrt(1 + share**2 + (1 - share) ** 2)
    return distances / factors, factors


def join_found_in_both(one: Stray | None, other: Stray | None) -> Sequence[Stray]:
    """Return what stands apart in one direction or the other, once where it does so in both."""
    found = [each for each in (one, other) if each]
    return found[:1] if len(found) == 2 and found[0].position == found[1].position else found
