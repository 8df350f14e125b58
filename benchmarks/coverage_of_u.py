"""Whether the stated intervals hold what they are said to hold, for axes and set-ups that are known.

Two questions. *This test*: an axis is given with all its readings as they truly are; errors of the set-up are
drawn and added, the spoilt test is evaluated, and y ± U of each parameter is held against that of the
true readings. *This axis*: two tests of one axis are drawn, and the interval that the first states for the
axis is held against what the second finds.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial

import numpy as np

from shares import Held, print_table, share_held
from zlmreport.evaluation.evaluate import evaluate
from zlmreport.evaluation.uncertainty.axis_interval import compute_axis_intervals
from zlmreport.evaluation.uncertainty.budget import (
    Acts,
    Budget,
    Contribution,
    Distribution,
    compute_effect_along,
    find_full_range,
)
from zlmreport.evaluation.uncertainty.drift import (
    Drift,
    compute_reading_times,
    sample_drifts,
)
from zlmreport.evaluation.uncertainty.monte_carlo import propagate
from zlmreport.evaluation.uncertainty.sampling import sample_singly
from zlmreport.job.types import Options
from zlmreport.language import same
from zlmreport.measurement.arrays import FloatArray
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.plugin.protocols import Standard
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import simulated_test

_MICROMETRE = 1e-6
#: Standard deviation of the readings, µm, and the full ranges of drift beside it.
_SCATTER = 0.8
_DRIFTS = (0.6, 2.8)


def contribution(size: float, acts: Acts, distribution: Distribution = Distribution.NORMAL) -> Contribution:
    """Return a contribution with the standard uncertainty `size`, µm."""
    return Contribution(same(""), size * _MICROMETRE, acts, distribution, same(""), same(""))


def drifting(full_range: float) -> Budget:
    """Return the budget of a set-up that drifts within a range, µm, and does nothing else."""
    return Budget((contribution(full_range / 12**0.5, Acts.IN_TIME, Distribution.RECTANGULAR),))


def _instrument(size: float, acts: Acts, full_range: float = 0.0) -> Budget:
    """Return the budget of an instrument, and of a drift beside it where it has a range, µm."""
    resolution = contribution(0.03, Acts.AT_EACH_READING, Distribution.RECTANGULAR)
    drifts = drifting(full_range).contributions if full_range else ()
    return Budget((contribution(size, acts), resolution, *drifts), of_the_instrument=2 * size * _MICROMETRE)


#: The worlds: what is special in them, the stated budget, and how its drift truly goes.
WORLDS: Mapping[str, tuple[Budget, Drift | None]] = {
    "instrument, each position": (_instrument(0.2, Acts.AT_EACH_POSITION), None),
    **{
        f"drift of {full_range} µm, {kind.value}": (drifting(full_range), kind)
        for full_range in _DRIFTS
        for kind in Drift
    },
    **{
        f"instrument, and drift of 0.6 µm, {kind.value}": (_instrument(0.2, Acts.AT_EACH_POSITION, 0.6), kind)
        for kind in Drift
    },
}


def of_this_test(
    world: tuple[Budget, Drift | None], axis: MeasurementSet, standard: Standard, trials: int, simulated: int
) -> dict[str, float]:
    """Return the share of trials in which y ± U holds the true value, by symbol."""
    budget, kind = world
    times = compute_reading_times(axis)

    def trial(generator: np.random.Generator) -> Held:
        truth = replace(axis, deviation=_scattered(axis, generator, np.ones_like(axis.deviation)))
        errors = sample_singly(budget.acting(Acts.AT_EACH_READING), truth.deviation.shape, generator)
        along = sample_singly(budget.acting(Acts.ALONG_THE_LENGTH), (), generator)
        errors += along * compute_effect_along(truth.target_positions)[truth.target]
        at_position = budget.acting(Acts.AT_EACH_POSITION)
        errors += sample_singly(at_position, truth.target_positions.shape, generator)[truth.target]
        if kind:
            (drift,) = sample_drifts(kind, times, 1, generator)
            (stated,) = budget.acting(Acts.IN_TIME)
            runs = np.searchsorted(truth.runs, truth.run)
            errors += find_full_range(stated) * drift[np.where(truth.approach > 0, 0, 1), truth.target, runs]
        found = _evaluated(replace(truth, deviation=truth.deviation + errors), standard)
        true = _evaluated(truth, standard)
        (expanded,) = propagate(budget, [(found, partial(standard.arithmetic, options=Options()))], simulated)
        return {
            each.quantity.symbol: abs(each.value - true.value(each.quantity.symbol))
            <= expanded[each.quantity.symbol].uncertainty
            for each in found.parameters
        }

    return share_held(trial, trials, 20260101)


def _alike(axis: MeasurementSet, _: np.random.Generator) -> FloatArray:
    return np.ones_like(axis.deviation)


def _unequal(axis: MeasurementSet, generator: np.random.Generator) -> FloatArray:
    of_cells = np.exp(generator.normal(0, 0.6, (2, len(axis.target_positions))))
    return of_cells[np.where(axis.approach > 0, 0, 1), axis.target]


def _growing(axis: MeasurementSet, _: np.random.Generator) -> FloatArray:
    return np.linspace(0.3, 2.0, len(axis.target_positions))[axis.target]


def _one_place(axis: MeasurementSet, generator: np.random.Generator) -> FloatArray:
    return np.where(axis.target == generator.integers(len(axis.target_positions)), 4.0, 1.0)


#: How an axis scatters: the relative scatter of its readings, and that of whole runs.
SCATTERS: Mapping[str, tuple[Callable[[MeasurementSet, np.random.Generator], FloatArray], float]] = {
    "alike everywhere": (_alike, 0.0),
    "unequal from position to position": (_unequal, 0.0),
    "growing along the axis": (_growing, 0.0),
    "four times as large at one position": (_one_place, 0.0),
    "whole runs as much as readings": (_alike, 1.0),
    "whole runs twice as much": (_alike, 2.0),
}


def of_this_axis(scatter: str, axis: MeasurementSet, standard: Standard, trials: int) -> dict[str, float]:
    """Return the share of trials in which the interval of one test holds what the next finds."""
    relative, of_runs = SCATTERS[scatter]

    def trial(generator: np.random.Generator) -> Held:
        sizes = relative(axis, generator)
        first, second = (
            _evaluated(replace(axis, deviation=_scattered(axis, generator, sizes, of_runs)), standard)
            for _ in range(2)
        )
        (intervals,) = compute_axis_intervals([(first, partial(standard.arithmetic, options=Options()))])
        return {
            symbol: low <= (second.value(symbol) or 0.0) <= high for symbol, (low, high) in intervals.items()
        }

    return share_held(trial, trials, 20260102)


def _scattered(
    axis: MeasurementSet, generator: np.random.Generator, sizes: FloatArray, of_runs: float = 0.0
) -> FloatArray:
    """Return readings of the axis's means that scatter anew."""
    mean = np.nanmean(axis.deviations(), axis=-1)[np.where(axis.approach > 0, 0, 1), axis.target]
    runs = generator.standard_normal(len(axis.runs))[np.searchsorted(axis.runs, axis.run)]
    own = sizes * generator.standard_normal(axis.deviation.shape)
    return np.asarray(mean + _SCATTER * _MICROMETRE * (own + of_runs * runs))


def _evaluated(measurements: MeasurementSet, standard: Standard):  # noqa: ANN202 - an Evaluation
    return evaluate(standard, measurements, Options(), {})


def main(arguments: list[str] | None = None) -> None:
    """Print two tables for each standard: a row for each world, a column for each parameter, in percent."""
    parser = argparse.ArgumentParser(prog="./run benchmark coverage", description=__doc__)
    parser.add_argument("--trials", type=int, default=1000, help="tests of each world (%(default)s)")
    parser.add_argument("--simulated", type=int, default=5000, help="simulated tests of each (%(default)s)")
    parser.add_argument("standards", nargs="*", default=["iso230-2:2014"])
    sizes = parser.parse_args(arguments)
    registry = find_plugins()
    axis = simulated_test(11)
    for identifier in sizes.standards:
        standard = registry.standard(identifier)
        symbols = [quantity.symbol for quantity in standard.quantities]
        for title, worlds, measured in (
            (
                "this test",
                WORLDS,
                lambda name: of_this_test(WORLDS[name], axis, standard, sizes.trials, sizes.simulated),  # noqa: B023
            ),
            ("this axis", SCATTERS, lambda name: of_this_axis(name, axis, standard, sizes.trials)),  # noqa: B023
        ):
            rows = ((name, measured(name)) for name in worlds)
            print_table(f"{identifier}, {title}", symbols, rows)
