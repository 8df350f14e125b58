"""Fitted error models to draw: a simulated axis of which everything is known."""

from __future__ import annotations

from functools import cache

import numpy as np

from plugins.effects.installed import EFFECTS
from zlmreport.document.figures.model_diagram import ModelDiagram
from zlmreport.model.diagnosis.error_numbers import compute_error_numbers
from zlmreport.model.diagnosis.study import Fitted
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.fitting.fit import fit
from zlmreport.model.fitting.observations import select_readings
from zlmreport.plugin import FloatArray, read_only_floats
from zlmreport.plugin.effect import Design
from zlmreport.testing import full_designs

#: The axis: scale error, lost motion, a wave of the screw, scatter of single readings; m and m/m.
SLOPE, LOST_MOTION, WAVE, SIGMA = 12e-6, -4e-6, 2e-6, 0.5e-6
WHOLE = ("offset", "scale-error", "backlash", "screw-pitch")


def linear_test() -> Design:
    """Return a complete test of a linear axis."""
    return full_designs()["a complete linear test"]


def deviations(design: Design) -> FloatArray:
    """Return the deviations of the axis; the same design gives the same."""
    noise = np.random.default_rng(7).standard_normal(len(design.position))
    wave = np.sin(2 * np.pi * design.position / 10e-3)
    along = SLOPE * design.position + WAVE * wave
    return read_only_floats(along + LOST_MOTION / 2 * design.direction + SIGMA * noise)


def fitted(*effects: str, design: Design | None = None) -> Fitted:
    """Return a model of the axis by these effects."""
    test = linear_test() if design is None else design
    found = fit(AxisModel(tuple(Term(EFFECTS[name]) for name in effects)), test, deviations(test))
    return Fitted(found, compute_error_numbers(found))


@cache
def diagram(*effects: str) -> ModelDiagram:
    """Return the graphs of a model of the axis."""
    found = fitted(*(effects or WHOLE))
    return ModelDiagram(found.fit, found.error)


@cache
def history() -> tuple[Fitted, ...]:
    """Return the model of the axis, effect by effect."""
    return tuple(fitted(*WHOLE[:count]) for count in range(len(WHOLE) + 1))


def one_way(design: Design) -> Design:
    """Return the readings of the positive approach alone."""
    return select_readings(design, np.flatnonzero(design.direction > 0))
