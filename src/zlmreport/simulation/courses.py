"""Conditions during a simulated test: what they are, and what a sensor logs of them."""

from __future__ import annotations

import numpy as np

from zlmreport.quantities.arrays import FloatArray
from zlmreport.simulation.description import Course
from zlmreport.simulation.randomness import Stream, rounded


def true_course(course: Course, time: FloatArray) -> FloatArray:
    """Return a condition at each reading, SI, shape (N,)."""
    end = course.start if course.end is None else course.end
    if course.time_constant is None:
        duration = time[-1] or 1.0
        progress = time / duration
    else:
        progress = -np.expm1(-time / course.time_constant)
    swing = course.swing * np.sin(2 * np.pi * time / course.swing_period)
    return np.asarray(course.start + (end - course.start) * progress + swing)


def logged_course(course: Course, true: FloatArray, seed: int, sensor: int) -> FloatArray:
    """Return what a sensor logs of a condition.

    Parameters
    ----------
    course
        With the sensor's noise and resolution.
    true : (N,) array
        The condition, SI.
    seed
        Of the simulation.
    sensor
        Number of the sensor: each has noise of its own.
    """
    noise = course.sensor_noise * Stream.LOG.generator(seed, sensor).standard_normal(len(true))
    return rounded(true + noise, course.resolution)
