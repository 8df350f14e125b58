"""Whether y ± U of a circle holds what a faultless ballbar would have found, in worlds that are known.

A machine's paths are given as they truly are. Errors of the instrument are drawn and added: a curve smooth
over the angle, one of two lobes only, one that grows with the displacement, an error of the calibrated
length, a drift, a resolution. The spoilt circle is evaluated, and y ± U of each parameter is held against the
true one.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from zlmreport.evaluation.evaluate import evaluate
from zlmreport.evaluation.uncertainty.budget import Acts, Budget, Contribution, Distribution
from zlmreport.evaluation.uncertainty.drift import (
    Drift,
    compute_reading_times,
    find_drift_range,
    sample_drifts,
)
from zlmreport.evaluation.uncertainty.monte_carlo import propagate
from zlmreport.evaluation.uncertainty.round_the_circle import smooth_curves
from zlmreport.language import same
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray, read_only_floats, read_only_integers
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.circle import NominalCircle
from zlmreport.measurement.measurand import CIRCLE
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.plugin.registry import find_plugins

_MICROMETRE = 1e-6
#: Angles of a turn, and turns in each sense.
_ANGLES, _TURNS = 180, 2
#: u of the instrument and of its length, full ranges of drift and of resolution, µm.
_DEVICE, _LENGTH, _DRIFT, _STEP = 0.25, 0.4, 0.6, 0.1

#: Returns the instrument's error at each angle in each of some tests, (count, m), of r.m.s. 1.
OfDevice = Callable[[FloatArray, FloatArray, np.random.Generator], FloatArray]


def _smooth(angles: FloatArray, _path: FloatArray, generator: np.random.Generator) -> FloatArray:
    return smooth_curves(Acts.ROUND_THE_CIRCLE, angles, 1, generator)[0]


def _two_lobes(angles: FloatArray, _path: FloatArray, generator: np.random.Generator) -> FloatArray:
    first, second = generator.standard_normal(2)
    return np.asarray(first * np.cos(2 * angles) + second * np.sin(2 * angles))


def _gain(_angles: FloatArray, path: FloatArray, generator: np.random.Generator) -> FloatArray:
    """Return an error in proportion to the displacement, of the stated size where that is largest."""
    return np.asarray(generator.standard_normal() * path / np.abs(path).max())


def _constant(angles: FloatArray, _path: FloatArray, generator: np.random.Generator) -> FloatArray:
    return np.full_like(angles, generator.standard_normal())


@dataclass(frozen=True)
class World:
    """What truly disturbs."""

    device: OfDevice | None
    length: bool = False
    drift: Drift | None = None


WORLDS: Mapping[str, World] = {
    "instrument, smooth over the angle": World(_smooth),
    "instrument, two lobes": World(_two_lobes),
    "instrument, in proportion to the displacement": World(_gain),
    "instrument, the same everywhere": World(_constant),
    "instrument and length": World(_smooth, length=True),
    **{
        f"instrument, length, drift, {kind.value}": World(_smooth, length=True, drift=kind)
        for kind in Drift
        if kind is not Drift.NOISE
    },
}


def _contribution(size: float, acts: Acts, distribution: Distribution = Distribution.NORMAL) -> Contribution:
    return Contribution(same(""), size * _MICROMETRE, acts, distribution, same(""), same(""))


def budget_of(world: World) -> Budget:
    """Return the budget that is stated in a world."""
    found = [
        _contribution(_DEVICE, Acts.ROUND_THE_CIRCLE),
        _contribution(_STEP / 12**0.5, Acts.AT_EACH_READING, Distribution.RECTANGULAR),
    ]
    if world.length:
        found.append(_contribution(_LENGTH, Acts.AT_THE_DATUM))
    if world.drift:
        found.append(_contribution(_DRIFT / 12**0.5, Acts.IN_TIME, Distribution.RECTANGULAR))
    return Budget(tuple(found), of_the_instrument=2 * _DEVICE * _MICROMETRE)


def true_circle() -> MeasurementSet:
    """Return the readings of a machine that is out of square, has lost motion, and stands off centre."""
    angles = 2 * np.pi * (np.arange(_ANGLES) + 0.5) / _ANGLES
    order = [(way, turn) for turn in range(1, _TURNS + 1) for way in (1, -1)]
    target = np.concatenate([np.arange(_ANGLES)[::way] for way, _ in order])
    approach = np.repeat([way for way, _ in order], _ANGLES)
    at = angles[target]
    path = 1.5 * np.sin(2 * at) + 0.6 * np.cos(3 * at) + 2.0
    path += approach * (-1.2 * np.sign(np.sin(at)) * np.cos(at) + 0.8 * np.sign(np.cos(at)) * np.sin(at))
    path += 12.0 * np.cos(at) - 5.0 * np.sin(at)
    return MeasurementSet(
        axis=Axis("XY", quantity=CIRCLE, circle=NominalCircle("XY", 0.15, 1 / 60, is_calibrated=True)),
        target_positions=read_only_floats(angles),
        target=read_only_integers(target),
        approach=read_only_integers(approach),
        run=read_only_integers(np.repeat([turn for _, turn in order], _ANGLES)),
        deviation=read_only_floats(path * _MICROMETRE),
    )


def held_in(world: World, standard: Any, options: Any, trials: int, simulated: int) -> dict[str, float]:
    """Return the share of trials in which y ± U holds the true value, by symbol."""
    budget, axis = budget_of(world), true_circle()
    generator = np.random.default_rng(20260304)
    times = compute_reading_times(axis)
    angles = axis.target_positions
    path = np.nanmean(axis.deviations(), axis=(0, 2)) / _MICROMETRE
    held: Counter[str] = Counter()
    for _ in range(trials):
        scatter = generator.normal(0, 0.1, axis.deviation.shape)  # which is the machine's, and no error
        truth = replace(axis, deviation=axis.deviation + scatter * _MICROMETRE)
        errors = np.zeros_like(truth.deviation)
        if world.device:
            errors += _DEVICE * _MICROMETRE * world.device(angles, path, generator)[truth.target]
        if world.length:
            errors += _LENGTH * _MICROMETRE * generator.standard_normal()
        if world.drift:
            (stated,) = budget.acting(Acts.IN_TIME)
            (drift,) = sample_drifts(world.drift, times, 1, generator)
            side = np.where(truth.approach == Approach.POSITIVE, 0, 1)
            errors += find_drift_range(stated) * drift[side, truth.target, truth.run - 1]
        step = _STEP * _MICROMETRE
        spoilt = np.round((truth.deviation + errors) / step) * step
        found = evaluate(standard, replace(truth, deviation=spoilt), options, {})
        true = evaluate(standard, truth, options, {})
        (expanded,) = propagate(budget, [(found, partial(standard.arithmetic, options=options))], simulated)
        for each in found.parameters:
            symbol = each.quantity.symbol
            held[symbol] += abs(each.value - (true.value(symbol) or 0.0)) <= expanded[symbol].uncertainty
    return {symbol: count / trials for symbol, count in held.items()}


def main(arguments: list[str] | None = None) -> None:
    """Print a row for each world, a column for each parameter, in percent."""
    parser = argparse.ArgumentParser(prog="./run benchmark circles", description=__doc__)
    parser.add_argument("--trials", type=int, default=1000, help="circles of each world (%(default)s)")
    parser.add_argument("--simulated", type=int, default=2000, help="simulated circles of each (%(default)s)")
    sizes = parser.parse_args(arguments)
    standard = find_plugins().standard("iso230-4:2005")
    options = standard.options.model_validate(
        {"circle": {"radius": 150, "feed": 1000, "calibrated_length": True}}
    )
    symbols = [quantity.symbol for quantity in standard.quantities]
    print("| this circle |", *(f"{symbol} |" for symbol in symbols))
    print("|---|", *("--:|" for _ in symbols), sep="")
    for name, world in WORLDS.items():
        found = held_in(world, standard, options, sizes.trials, sizes.simulated)
        print(f"| {name} |", *(f"{100 * found[symbol]:.1f} |" for symbol in symbols), flush=True)


if __name__ == "__main__":
    main()
