"""Axes whose hidden effects are known, as owners have them: seeded, and told by what is wrong with them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from model.axis_tests import EFFECTS, INSTALLED, noise, observations
from zlmreport.model.diagnosis.building import Built, build
from zlmreport.model.diagnosis.contest import Told
from zlmreport.model.diagnosis.diagnosis import AxisDiagnosis, diagnose
from zlmreport.model.effects.axis_model import AxisModel
from zlmreport.plugin import FloatArray
from zlmreport.plugin.effect import Design

_HOUR = 3600.0


def lasting_noise(design: Design, share: float, seed: int = 1) -> FloatArray:
    """Return noise of which each reading keeps a share of the one before, m."""
    fresh = noise(design, seed)
    found = fresh.copy()
    for place in range(1, len(found)):
        found[place] = share * found[place - 1] + np.sqrt(1.0 - share**2) * fresh[place]
    return found


def straight(design: Design) -> FloatArray:
    """Return 10 µm/m and 3 µm of lost motion, m."""
    return 1e-5 * design.position - 1.5e-6 * design.direction


def joints(design: Design) -> FloatArray:
    """Return a scale in three pieces: steps of 4 µm and of −6 µm, m."""
    targets = design.target_positions
    gaps = (targets[:-1] + targets[1:]) / 2
    first, second = gaps[len(gaps) // 4], gaps[3 * len(gaps) // 4]
    return 4e-6 * (design.position > first) - 6e-6 * (design.position > second)


def with_night(design: Design, run: int, hours: float = 22.0) -> Design:
    """Return a test that goes on after a night, without logs."""
    return replace(design, time=design.time + hours * _HOUR * (design.run > run), conditions={})


def in_warm_air(design: Design) -> Design:
    """Return a test in a room whose air swings by 3 K."""
    air = 293.35 + 3.0 * np.sin(design.time / 250.0 + 1.0)
    return replace(design, conditions={**design.conditions, "air_temperature": air})


def corrected_twice(design: Design) -> FloatArray:
    """Return what an air correction does that is made by the instrument and once more, m."""
    return -EFFECTS["air-index"].columns(design, np.empty(0))[:, 0]


def diagnosed(model: AxisModel, design: Design, deviation: FloatArray) -> AxisDiagnosis:
    """Return what a diagnosis with all installed effects says."""
    return diagnose(model, observations(design, deviation), INSTALLED)


def built(model: AxisModel, design: Design, deviation: FloatArray) -> Built:
    """Return the model that comes of following every diagnosis."""
    observed = observations(design, deviation)

    def diagnosing(now: AxisModel, may_go: frozenset[str], told: Told) -> AxisDiagnosis:
        return diagnose(now, observed, INSTALLED, may_go=may_go, told=told)

    return build(model, diagnosing)
