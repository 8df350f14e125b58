"""The weather of a test: what temperatures, pressure and humidity do beside what was planned for them.

No shop warms up along an exponential: doors open, spindles stop, the sun comes round. A random walk is added
to every condition, smoothed as a mass smooths it. Without it a log of the scale's temperature and an
exponential could not be told apart at any size of an effect.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from zlmreport.measurement.arrays import FloatArray, read_only_floats
from zlmreport.model.effects.design import Design

#: Standard deviation of the walk at the end of the test: K, Pa, 1.
_WALKS: Mapping[str, float] = {
    "axis_temperature": 0.15,
    "screw_temperature": 0.25,
    "air_temperature": 0.2,
    "air_pressure": 20.0,
    "relative_humidity": 0.01,
}
_SMOOTHED_OVER = 15


def wandering(design: Design, random: np.random.Generator) -> Design:
    """Return the design with weather."""
    conditions = {
        name: read_only_floats(course + _WALKS[name] * _walk(len(course), random))
        for name, course in design.conditions.items()
    }
    return replace(design, conditions=conditions)


def _walk(readings: int, random: np.random.Generator) -> FloatArray:
    walk = np.cumsum(random.standard_normal(readings)) / np.sqrt(readings)
    padded = np.pad(walk, _SMOOTHED_OVER // 2, mode="edge")
    return np.convolve(padded, np.full(_SMOOTHED_OVER, 1 / _SMOOTHED_OVER), "valid")
