"""Tests of axes for the tests of the error model; the same arguments give the same test."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from zlmreport.job.formula_keys import FormulaKeys
from zlmreport.measurement.axis import PositionTable
from zlmreport.model.effects.axis_model import AxisModel, Term
from zlmreport.model.effects.formula import FormulaEffect
from zlmreport.model.fitting.observations import Observations
from zlmreport.plugin import Axis, AxisKind, FloatArray
from zlmreport.plugin.effect import Design, Effect
from zlmreport_plugins.effects import zlmreport_effects

EFFECTS: Mapping[str, Effect] = {effect.identifier: effect for effect in zlmreport_effects()}
INSTALLED = tuple(EFFECTS.values())

PITCH = 0.01
SIGMA = 0.8e-6
OVERRUN = 0.005
DURATION = 2000.0

_TRAVEL = np.linspace(0.0, 1.0, 41)
AXIS = Axis(
    "X",
    travel=(0.0, 1.0),
    screw_pitch=PITCH,
    signal_period=20e-6,
    compensation_table=PositionTable(
        tuple(_TRAVEL), tuple(4e-6 * np.sin(13 * _TRAVEL) * np.cos(5 * _TRAVEL))
    ),
    angular_errors=PositionTable(tuple(_TRAVEL), tuple(20e-6 * np.sin(4 * _TRAVEL + 1) * _TRAVEL)),
)


def linear_test(
    targets: int = 21, runs: int = 5, *, seed: int = 1, axis: Axis = AXIS, places: FloatArray | None = None
) -> Design:
    """Return a test by the linear method, with logs, on targets at random fractions of the pitch.

    `places`: Those of the targets, m, if they are others.
    """
    places = _places(targets, seed) if places is None else places
    visits = [
        (target, direction, run)
        for run in range(1, runs + 1)
        for direction in (1, -1)
        for target in (range(targets) if direction > 0 else reversed(range(targets)))
    ]
    return _design(axis, places, visits)


def pendulum_test(targets: int = 21, runs: int = 5, *, seed: int = 1, axis: Axis = AXIS) -> Design:
    """Return a test by the pendulum method: each target from both sides before the next."""
    visits = [
        (target, direction, run)
        for target in range(targets)
        for run in range(1, runs + 1)
        for direction in (1, -1)
    ]
    return _design(axis, _places(targets, seed), visits)


def model_of(*effects: str | Effect) -> AxisModel:
    """Return a model of effects, by identifier or as they are."""
    return AxisModel(tuple(Term(EFFECTS[each] if isinstance(each, str) else each) for each in effects))


def formula(text: str, **parameters: Any) -> FormulaEffect:
    """Return the effect of a formula of a job."""
    return FormulaEffect(FormulaKeys(name="own", formula=text, parameters=parameters), AxisKind.LINEAR)


#: What the tests take for granted of an axis: a cubic and backlash.
USUAL = model_of("polynomial", "backlash")


def noise(design: Design, seed: int = 2, sigma: float = SIGMA) -> FloatArray:
    """Return independent noise, m."""
    return sigma * np.random.default_rng(seed).standard_normal(len(design.position))


def realistic_noise(design: Design, seed: int = 1, sigma: float = SIGMA) -> FloatArray:
    """Return noise that targets, runs and neighbours in time share in part, m."""
    random = np.random.default_rng(seed)
    targets = random.standard_normal((2, design.target.max() + 1))
    apart = np.abs(design.time[:, np.newaxis] - design.time)
    drift = np.linalg.cholesky(np.exp(-apart / 600.0) + 1e-9 * np.eye(len(apart)))
    return (
        sigma * random.standard_normal(len(design.position))
        + 0.3e-6 * targets[0, design.target]
        + 0.12e-6 * design.direction * targets[1, design.target]
        + 0.1e-6 * random.standard_normal(design.run.max() + 1)[design.run]
        + 0.2e-6 * drift @ random.standard_normal(len(apart))
    )


def known(design: Design) -> FloatArray:
    """Return what the usual model describes, m."""
    place = 2 * design.position - 1
    return 1e-6 * (2.0 + 10.0 * place + 3.0 * place**3 - 1.5 * design.direction)


def hidden(
    design: Design,
    effect: str | Effect,
    theta: Sequence[float] = (),
    *,
    size: float = 1.0,
    model: AxisModel = USUAL,
) -> FloatArray:
    """Return the deviation by an effect of all coefficients one, scaled to a size, m.

    Parameters
    ----------
    design
        The test.
    effect
        The effect.
    theta
        Its searched parameters.
    size
        ρ: root mean square of what the model cannot imitate, over σ.
    model
        The model.
    """
    found = EFFECTS[effect] if isinstance(effect, str) else effect
    shape = found.columns(design, np.array(theta, dtype=np.float64)).sum(axis=1)
    base = np.concatenate([term.effect.columns(design, np.empty(0)) for term in model.terms], axis=1)
    visible = shape - base @ np.linalg.lstsq(base, shape, rcond=None)[0]
    return np.asarray(shape * size * SIGMA / np.sqrt(np.mean(visible**2)), dtype=np.float64)


def observations(design: Design, deviation: FloatArray) -> Observations:
    """Return readings as the diagnosis takes them."""
    return Observations(design, deviation, np.arange(len(deviation)), ())


def _places(targets: int, seed: int) -> FloatArray:
    fractions = np.random.default_rng([seed, 7]).uniform(0.0, PITCH, targets)
    return np.round(np.linspace(0.0, 0.99, targets) / PITCH) * PITCH + fractions


def _design(axis: Axis, places: FloatArray, visits: Sequence[tuple[int, int, int]]) -> Design:
    target, direction, run = (np.array(column) for column in zip(*visits, strict=True))
    position = places[target]
    time = np.linspace(0.0, DURATION, len(visits))
    since = np.full(len(visits), OVERRUN)
    for row in range(1, len(visits)):
        ahead = (position[row] - position[row - 1]) * direction[row]
        if ahead > 0:
            since[row] = ahead + (since[row - 1] if direction[row] == direction[row - 1] else 0.0)
    return Design(
        axis=axis,
        position=position,
        direction=direction.astype(np.float64),
        run=run,
        target=target,
        time=time,
        time_is_counted=False,
        since_reversal=since,
        conditions={
            "axis_temperature": 293.65 + 2.0 * -np.expm1(-time / 900.0) + 0.3 * np.sin(time / 190.0),
            "screw_temperature": 294.15 + 4.0 * -np.expm1(-time / 500.0),
            "air_temperature": 293.35 + 0.4 * np.sin(time / 250.0 + 1.0),
            "air_pressure": 101_300.0 + 60.0 * time / DURATION,
            "relative_humidity": 0.45 + 0.03 * np.sin(time / 400.0),
        },
    )
