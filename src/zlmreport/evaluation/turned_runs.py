"""Runs written the wrong way round: the reversal or the sign of one is not that of the others.

Of a run whose directions were interchanged the reversal has the other sign; of one whose deviations have the
wrong sign, or whose readings stand in reverse order, the curve mirrors that of the others. Where that was
done to a whole direction, the two run counter to each other along the axis.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray

#: Runs and positions that are needed to tell.
_FEWEST_RUNS, _FEWEST_POSITIONS = 3, 4
#: Standard deviations by which the mean reversal of a run differs from the others' beyond chance: where it is
#: theirs with the other sign, and elsewhere, for few runs tell little of how far runs differ.
_APART_TURNED, _APART = 6.0, 10.0
#: Share of the positions that must tell the same: outliers at a few move a mean, too.
_MOST = 0.7
#: How near a reversal is to the negative of the others', as a part of their distance.
_TURNED = 0.25
#: Correlation from which a run mirrors the others, and standard deviations that their curve then spans.
_MIRRORED, _CURVED = -0.8, 6.0
#: Part of how far the directions lie apart that is left when one of them is turned round.
_LEFT = 0.2
#: Part of how far a run in reverse order is from the others that is left in the right one, and standard
#: deviations that it is apart before; times as near to the others that decides between two ways of turning.
_LEFT_IN_ORDER, _APART_IN_ORDER, _DECIDES = 0.4, 3.0, 1.5


class Turned(NamedTuple):
    """A run whose reversal is not that of the others."""

    run: int  #: Its index.
    reversal: float  #: Its mean reversal, m or rad.
    of_others: float  #: That of the other runs.
    is_interchanged: bool  #: Whether it is theirs with the other sign.


class Mirrored(NamedTuple):
    """A run whose curve mirrors that of the others."""

    run: int  #: Its index.
    has_other_sign: bool  #: Whether its deviations, with their signs turned, are those of the others.
    is_in_reverse: bool  #: Whether its readings, in reverse order of the targets, are those of the others.


def find_run_of_another_reversal(readings: FloatArray) -> Turned | None:
    """Return the run whose mean reversal stands apart from all others, if one does.

    `readings`: (approach, position, run), m or rad; NaN where there is none.
    """
    parted = readings[Approach.POSITIVE.index] - readings[Approach.NEGATIVE.index]
    parted = parted[np.isfinite(parted).all(axis=1)]
    positions, runs = parted.shape
    if runs < _FEWEST_RUNS or positions < _FEWEST_POSITIONS:
        return None
    means = parted.mean(axis=0)
    run = int(np.abs(means - np.median(means)).argmax())
    others = np.delete(parted, run, axis=1)
    of_others = np.delete(means, run)
    left = others - others.mean(axis=1, keepdims=True) - of_others + of_others.mean()
    freedom = max(1, (positions - 1) * (runs - 2))
    own = float((left**2).sum()) / freedom / positions
    # Of whole runs that differ among each other, one that differs as much is none that stands apart.
    chance = np.sqrt(max(own, float(of_others.var(ddof=1))) * (1 + 1 / (runs - 1)))
    level = float(of_others.mean())
    apart = float(means[run]) - level
    is_interchanged = abs(float(means[run]) + level) < _TURNED * abs(apart)
    single = parted[:, run]
    at_each = others.mean(axis=1)
    agree = (
        np.abs(single + at_each) < np.abs(single - at_each)
        if is_interchanged
        else (single - at_each) * apart > 0
    )
    if agree.mean() < _MOST:
        return None
    if not chance or abs(apart) <= (_APART_TURNED if is_interchanged else _APART) * chance:
        return None
    return Turned(run, float(means[run]), level, is_interchanged)


def find_mirrored_run(readings: FloatArray) -> Mirrored | None:
    """Return the run whose curve mirrors that of the others, if one does: by its signs, or its order.

    `readings`: as of `find_run_of_another_reversal`.
    """
    there = np.asarray(np.isfinite(readings).all(axis=2))
    in_both_orders = there & there[:, ::-1]
    curves, backwards = readings[there], readings[:, ::-1][in_both_orders]
    if curves.shape[1] < _FEWEST_RUNS or len(curves) < _FEWEST_POSITIONS:
        return None
    curves = curves - curves.mean(axis=0)
    backwards = backwards - backwards.mean(axis=0) if len(backwards) else backwards
    for run in range(curves.shape[1]):
        others = np.delete(curves, run, axis=1)
        mean = others.mean(axis=1)
        scatter = float((others - mean[:, np.newaxis]).std(ddof=1))
        if not curves[:, run].any() or not mean.any() or np.ptp(mean) < _CURVED * scatter:
            continue
        has_other_sign = bool(np.corrcoef(curves[:, run], mean)[0, 1] < _MIRRORED)
        left = float((curves[:, run] + mean).std())
        left_in_order, apart = np.inf, float((curves[:, run] - mean).std())
        if len(backwards) >= _FEWEST_POSITIONS:
            mean_at_both = mean[in_both_orders[there]]
            left_in_order = float((backwards[:, run] - mean_at_both).std())
        is_in_reverse = left_in_order < _LEFT_IN_ORDER * apart and apart > _APART_IN_ORDER * scatter
        if has_other_sign and is_in_reverse:
            has_other_sign = left < _DECIDES * left_in_order
            is_in_reverse = left_in_order < _DECIDES * left
        if has_other_sign or is_in_reverse:
            return Mirrored(run, has_other_sign, is_in_reverse)
    return None


def measure_counter_directions(readings: FloatArray) -> float | None:
    """Return by how much the reversal changes along an axis whose directions run counter to each other.

    The means of one direction are then, apart from their level, those of the other with their signs turned,
    or in reverse order; None where they are not, or where scatter may do it.

    `readings`: as of `find_run_of_another_reversal`.
    """
    with np.errstate(all="ignore"):
        there = np.isfinite(readings).all(axis=2).all(axis=0)
    known = readings[:, there]
    _, positions, runs = known.shape
    if runs < 2 or positions < _FEWEST_POSITIONS:
        return None
    means = known.mean(axis=2)
    scatter = float(np.sqrt(known.var(axis=2, ddof=1).mean() / runs))
    up, down = means - means.mean(axis=1, keepdims=True)
    apart = up - down
    size = float(np.sqrt((apart**2).mean()))
    left = min(float(np.sqrt((each**2).mean())) for each in (up + down, up - down[::-1]))
    if size <= _CURVED * scatter or left >= _LEFT * size:
        return None
    return float(np.ptp(apart))
