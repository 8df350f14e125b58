"""Planes that were measured line by line; the same arguments give the same plane."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from model.axis_tests import SIGMA, linear_test, observations
from zlmreport.model.fitting.estimate import InstrumentError
from zlmreport.model.plane.surface import Surface, SurfaceLine, fit_surface, join_side_by_side
from zlmreport.plugin import Approach, Axis, FloatArray

DESIGN = linear_test(targets=9, runs=4, axis=Axis("X", travel=(0.0, 1.0)))
LINES = (0.1, 0.25, 0.3, 0.45, 0.5)
#: a, b1, c1, d1, b2, c2, d2 in SI.
COEFFICIENTS = np.array([3e-6, 12e-6, -9e-6, 4e-6, 5e-6, 8e-6, -7e-6])
LOST_MOTION = 2e-6
QUIET = InstrumentError()


def truth(along: FloatArray, across: FloatArray, approach: float | FloatArray) -> FloatArray:
    """Return the deviation of the plane, m."""
    powers = [np.ones_like(along), along, along**2, along**3, across, across**2, across**3]
    return np.stack(powers, axis=-1) @ COEFFICIENTS + LOST_MOTION / 2 * approach


def measured(
    seed: int = 1, *, sigma: float = SIGMA, lines: Sequence[float] = LINES, interaction: float = 0.0
) -> list[SurfaceLine]:
    """Return the lines of a plane whose slope may change from line to line, m/m²."""
    random = np.random.default_rng(seed)
    found = []
    for across in lines:
        deviation = truth(DESIGN.position, np.full_like(DESIGN.position, across), DESIGN.direction)
        deviation = deviation + interaction * DESIGN.position * across
        deviation = deviation + sigma * random.standard_normal(len(deviation))
        found.append(SurfaceLine(across, observations(DESIGN, deviation)))
    return found


def fitted(
    lines: Sequence[SurfaceLine], approach: Approach = Approach.POSITIVE, instrument: InstrumentError = QUIET
) -> Surface:
    """Return the surface through lines."""
    return fit_surface(join_side_by_side(lines, approach, "Y"), instrument)
