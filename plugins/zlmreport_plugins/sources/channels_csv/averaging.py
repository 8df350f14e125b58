"""Averages a channel that was read often over equal intervals of time, the same for all channels."""

from __future__ import annotations

import numpy as np

from zlmreport.plugin.source import Averaging
from zlmreport_plugins.sources.channels_csv.tracks import ChannelTrack

#: Readings of a channel that are kept as they are.
MOST_KEPT = 1440
#: Intervals, s, of which the shortest is taken that leaves no more averages than that.
_INTERVALS = (1, 2, 5, 10, 15, 20, 30, 60, 120, 300, 600, 900, 1800, 3600)


def choose_interval_for(readings: int, duration: float) -> float | None:
    """Return over which intervals readings of a channel are averaged, s; None if they are kept.

    `readings`: Of the channel that was read most often.
    `duration`: From the first reading of all channels to the last, s.
    """
    if readings <= MOST_KEPT:
        return None
    enough = (float(each) for each in _INTERVALS if duration / each <= MOST_KEPT)
    return next(enough, duration / MOST_KEPT)


def average_channel(track: ChannelTrack, interval: float) -> tuple[ChannelTrack, Averaging]:
    """Return the averages of a channel at the middles of intervals, and what they leave out.

    An interval in which there is no reading has none; one in which all are missing has one that is missing.
    """
    slot = np.floor(track.time / interval + 1e-9).astype(np.int64)
    slots, first, which = np.unique(slot, return_index=True, return_inverse=True)
    there = np.isfinite(track.value)
    total = np.bincount(which, weights=np.where(there, track.value, 0.0), minlength=len(slots))
    count = np.bincount(which[there], minlength=len(slots))
    mean = np.full(len(slots), np.nan)
    np.divide(total, count, out=mean, where=count > 0)
    left = (track.value - mean[which])[there]
    left_out = float(np.sqrt(np.mean(left**2))) if left.size else 0.0
    places = tuple(track.places[index] for index in first.tolist())
    return ChannelTrack(np.asarray((slots + 0.5) * interval, dtype=np.float64), mean, places), Averaging(
        len(track.time), left_out
    )
