"""Axes and tests drawn at random, for benchmarks: no two have the same targets, timing, weather or tables.

Ranges are those of a workshop: a metre of travel or a full turn, twenty minutes to an hour of measuring, an
axis that warms up by a few kelvin, air that changes while one measures.
"""

from __future__ import annotations

import math

import numpy as np

from zlmreport.measurement.axis import Axis, AxisKind, PositionTable
from zlmreport.measurement.units import ZERO_CELSIUS
from zlmreport.model.planning.methods import Method
from zlmreport.model.planning.plan import AxisPlan
from zlmreport.model.planning.targets import compute_target_positions
from zlmreport.model.simulation.description import ConditionCourse, Description

_TABLE_ROWS = 21
_ROUGHNESS = 0.15
_OVERRUN = (2e-3, 20e-3)
_DEGREE = math.pi / 180


def drawn_linear_test(
    random: np.random.Generator, method: Method, targets: int = 21, runs: int = 5
) -> Description:
    """Return a test of a linear axis without any effect or noise, with everything logged.

    Parameters
    ----------
    random
        Where everything comes from.
    method
        The positioning method.
    targets, runs
        m and n. Targets lie at random fractions of the screw's pitch.
    """
    travel = (0.0, 1.0)
    pitch = float(random.choice([5e-3, 10e-3, 16e-3, 20e-3]))
    axis = Axis(
        "X",
        AxisKind.LINEAR,
        travel,
        screw_pitch=pitch,
        signal_period=float(random.choice([20e-6, 40e-6])),
        compensation_table=_smooth_table(random, travel, 5e-6),
        angular_errors=_smooth_table(random, travel, 20e-6),
    )
    plan = AxisPlan(
        compute_target_positions(travel, targets, pitch, random),
        method,
        runs,
        overrun=float(random.uniform(*_OVERRUN)),
        feed=float(random.uniform(2.0, 10.0)) / 60,
        dwell=float(random.uniform(4.0, 8.0)),
    )
    return Description(axis, plan, _seed(random), conditions=_weather(random))


def drawn_rotary_test(
    random: np.random.Generator, method: Method, targets: int = 25, runs: int = 5
) -> Description:
    """Return a test of a full turn without any effect or noise; the gear has a whole number of teeth.

    Parameters
    ----------
    random
        Where everything comes from.
    method
        The positioning method.
    targets, runs
        m and n. Targets lie at random fractions of the gear's pitch.
    """
    travel = (0.0, 2 * math.pi)
    pitch = travel[1] / int(random.integers(36, 181))
    axis = Axis("C", AxisKind.ROTARY, travel, screw_pitch=pitch, signal_period=travel[1] / 18_000)
    plan = AxisPlan(
        compute_target_positions(travel, targets, pitch, random),
        method,
        runs,
        overrun=float(random.uniform(0.5, 3.0)) * _DEGREE,
        feed=float(random.uniform(5.0, 30.0)) * _DEGREE,
        dwell=float(random.uniform(4.0, 8.0)),
    )
    return Description(axis, plan, _seed(random), conditions=_weather(random))


def _seed(random: np.random.Generator) -> int:
    return int(random.integers(2**31))


def _smooth_table(random: np.random.Generator, travel: tuple[float, float], size: float) -> PositionTable:
    """Return a table that begins with zero: a random bow, a random wave, and a little roughness."""
    share = np.linspace(0.0, 1.0, _TABLE_ROWS)
    bow, wave, phase, periods = random.normal(), random.normal(), random.uniform(0, 6.3), random.uniform(1, 3)
    values = bow * share**2 + wave * np.sin(2 * np.pi * periods * share + phase)
    values += _ROUGHNESS * random.standard_normal(_TABLE_ROWS)
    positions = travel[0] + (travel[1] - travel[0]) * share
    return PositionTable(tuple(positions.tolist()), tuple((size * (values - values[0])).tolist()))


def _weather(random: np.random.Generator) -> dict[str, ConditionCourse]:
    """Return the conditions of an hour: scale and screw warm up, the air wanders."""

    def warming(rise: tuple[float, float], noise: float) -> ConditionCourse:
        start = ZERO_CELSIUS + random.uniform(19.0, 22.0)
        end = start + random.uniform(*rise)
        return ConditionCourse(start, end, random.uniform(600.0, 2400.0), sensor_noise=noise)

    air = ZERO_CELSIUS + random.uniform(18.5, 22.5)
    pressure = random.uniform(960e2, 1030e2)
    humidity = random.uniform(0.3, 0.6)
    return {
        "axis_temperature": warming((0.5, 3.0), 0.01),
        "screw_temperature": warming((1.5, 8.0), 0.02),
        "air_temperature": ConditionCourse(
            air,
            air + random.normal(0.0, 0.7),
            swing=random.uniform(0.1, 0.5),
            swing_period=random.uniform(300.0, 1500.0),
            sensor_noise=0.02,
        ),
        "air_pressure": ConditionCourse(pressure, pressure + random.normal(0.0, 120.0), sensor_noise=2.0),
        "relative_humidity": ConditionCourse(
            humidity, humidity + random.normal(0.0, 0.04), sensor_noise=0.002
        ),
    }
