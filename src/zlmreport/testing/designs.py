"""Tests without deviations, for effects: with everything stated and logged, and as bare as they come."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import cache

import numpy as np

from zlmreport.measurement.axis import Axis, AxisKind, PositionTable
from zlmreport.model.design import Design
from zlmreport.planning.methods import Method, path, planned_design, visits
from zlmreport.planning.targets import target_positions
from zlmreport.quantities.arrays import FloatArray, read_only_floats
from zlmreport.quantities.units import REFERENCE_TEMPERATURE

_BETWEEN = np.linspace(0.0, 1.0, 11)
_ROWS = tuple(_BETWEEN.tolist())
_LINEAR = Axis(
    "X",
    AxisKind.LINEAR,
    (0.0, 1.0),
    screw_pitch=10e-3,
    signal_period=20e-6,
    scale_element=0.5,
    compensation_table=PositionTable(_ROWS, tuple((8e-6 * np.sin(4.0 * _BETWEEN) * _BETWEEN).tolist())),
    angular_errors=PositionTable(_ROWS, tuple((30e-6 * np.cos(5.0 * _BETWEEN)).tolist())),
    abbe_offset=0.2,
)
_ROTARY = Axis(
    "C",
    AxisKind.ROTARY,
    (0.0, 2 * math.pi),
    screw_pitch=math.radians(3.0),
    signal_period=math.radians(0.02),
    compensation_table=PositionTable(
        tuple((2 * math.pi * _BETWEEN).tolist()), tuple((20e-6 * np.sin(9.0 * _BETWEEN)).tolist())
    ),
)


@cache
def full_designs() -> Mapping[str, Design]:
    """Return tests with every log and every key of the axis that are known by name, by what they are."""
    return {
        "a complete linear test": _complete(_LINEAR, Method.LINEAR),
        "a complete pendulum test": _complete(_LINEAR, Method.PENDULUM),
        "a complete quasi-pilgrim test": _complete(_LINEAR, Method.QUASI_PILGRIM),
        "a complete rotary test": _complete(_ROTARY, Method.LINEAR),
    }


@cache
def poor_designs() -> Mapping[str, Design]:
    """Return tests that lack much, by what they are; no effect fails on them, and many cannot be tested."""
    bare, turn = Axis("X"), Axis("C", AxisKind.ROTARY)
    five = np.linspace(0.0, 0.4, 5)
    return {
        "a test without logs and times": _counted(_planned(bare, Method.LINEAR, five, 5)),
        "a test in one direction": _planned(bare, Method.UNIDIRECTIONAL, five, 5),
        "a test of one run": _planned(bare, Method.LINEAR, five, 1),
        "a test of two targets": _planned(bare, Method.LINEAR, five[:2], 3),
        "a test of one target": _planned(bare, Method.LINEAR, five[1:2], 3),
        "a single reading": _planned(bare, Method.UNIDIRECTIONAL, five[1:2], 1),
        "a rotary axis without logs": _planned(turn, Method.LINEAR, np.linspace(0.0, 0.7, 8), 3),
    }


def _complete(axis: Axis, method: Method) -> Design:
    random = np.random.default_rng(20)
    targets = target_positions(axis.travel or (0.0, 1.0), 21, axis.screw_pitch or 0.0, random)
    design = _planned(axis, method, targets, 5)
    share = design.time / design.duration
    conditions = {
        "axis_temperature": REFERENCE_TEMPERATURE + 0.4 + 1.5 * share**0.7,
        "screw_temperature": REFERENCE_TEMPERATURE + 0.8 - 4.0 * np.expm1(-2.0 * share),
        "air_temperature": REFERENCE_TEMPERATURE - 0.3 + 0.6 * np.sin(5.0 * share),
        "material_temperature": REFERENCE_TEMPERATURE + 0.2 + 0.5 * share,
        "air_pressure": 1005e2 + 120.0 * share**2,
        "relative_humidity": 0.45 + 0.05 * np.cos(3.0 * share),
        "face": np.where(design.target % 2 == 0, 1.0, -1.0),
    }
    return replace(design, conditions={name: read_only_floats(log) for name, log in conditions.items()})


def _planned(axis: Axis, method: Method, targets: FloatArray, runs: int) -> Design:
    return planned_design(axis, targets, visits(path(method, targets.tolist(), runs, 5e-3)), 0.05, 4.0)


def _counted(design: Design) -> Design:
    count = read_only_floats(np.arange(len(design.time)))
    return replace(design, time=count, time_is_counted=True)
