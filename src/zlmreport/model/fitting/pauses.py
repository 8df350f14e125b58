"""Pauses: nights between the runs of one test; how long an interval is one."""

from __future__ import annotations

import numpy as np

from zlmreport.measurement.arrays import BoolArray, FloatArray
from zlmreport.model.effects.design import Design

#: Steps between two readings that are pauses: s, and in usual steps.
_LONG, _MANY_STEPS = 3600.0, 50.0


def find_pauses(design: Design) -> BoolArray:
    """Return after which readings of a session a long pause follows, shape (N − 1,)."""
    steps = np.diff(design.time)
    usual = _find_usual(steps)
    if design.time_is_counted or usual == 0:
        return np.zeros(len(steps), dtype=np.bool_)
    return np.asarray((steps > max(_LONG, _MANY_STEPS * usual)) & (np.diff(design.session) == 0))


def compute_working_time(design: Design) -> FloatArray:
    """Return the time of each reading as if pauses were steps as usual, shape (N,), s.

    What drifts is followed while readings are taken. To a curve over the time of day a night is a step like
    any other in it, and two evenings are two points, which every curve meets.
    """
    paused = find_pauses(design)
    if not paused.any():
        return design.time
    steps = np.diff(design.time)
    left_out = np.where(paused, steps - _find_usual(steps), 0.0)
    by_reading = np.concatenate([[0.0], left_out])
    found = design.time.copy()
    for session in np.unique(design.session):
        own = design.session == session
        found[own] -= np.cumsum(by_reading[own])
    return found


def _find_usual(steps: FloatArray) -> float:
    return float(np.median(steps[steps > 0])) if np.any(steps > 0) else 0.0
