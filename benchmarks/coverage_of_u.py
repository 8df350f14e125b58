"""Whether the stated intervals y ± U hold the true values: tests of a known axis, measured by a known set-up.

An axis is given with all its readings as they truly are. Errors of the set-up are drawn from its own budget
and added; the spoilt test is evaluated, and y ± U of each parameter is held against the parameter of the true
readings.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from functools import partial

import numpy as np

from zlmreport.evaluation.evaluate import evaluate
from zlmreport.job.types import Options
from zlmreport.language import same
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.plugin.protocols import Standard
from zlmreport.plugins import find_plugins
from zlmreport.testing import simulated_test
from zlmreport.uncertainty.budget import Budget, effect_along
from zlmreport.uncertainty.contribution import Acts, Contribution, Distribution
from zlmreport.uncertainty.draws import single_draws
from zlmreport.uncertainty.monte_carlo import propagate

_MICROMETRE = 1e-6


def contribution(size: float, acts: Acts, distribution: Distribution = Distribution.NORMAL) -> Contribution:
    """Return a contribution with the standard uncertainty `size`, µm."""
    nothing = same("")
    return Contribution(nothing, size * _MICROMETRE, acts, distribution, nothing, nothing)


#: Budgets by what is special in them; the readings of the axis scatter by 0.8 µm.
BUDGETS: Mapping[str, Budget] = {
    "laser, quiet room": Budget(
        (
            contribution(0.3, Acts.ALONG_THE_LENGTH),
            contribution(0.2, Acts.ALONG_THE_LENGTH, Distribution.RECTANGULAR),
            contribution(0.1, Acts.AT_EACH_READING, Distribution.RECTANGULAR),
        )
    ),
    "misalignment dominates": Budget(
        (
            contribution(0.5, Acts.ALONG_THE_LENGTH, Distribution.ONE_SIDED),
            contribution(0.05, Acts.AT_EACH_READING, Distribution.RECTANGULAR),
        )
    ),
    "polygon": Budget(
        (
            contribution(0.3, Acts.AT_EACH_POSITION),
            contribution(0.05, Acts.AT_EACH_READING, Distribution.RECTANGULAR),
        )
    ),
    "drift, a third of the scatter": Budget((contribution(0.27, Acts.AT_EACH_READING),)),
    "drift as large as the scatter": Budget((contribution(0.8, Acts.AT_EACH_READING),)),
}


def coverage(
    budget: Budget, truth: MeasurementSet, standard: Standard, trials: int, simulated: int
) -> dict[str, float]:
    """Return the share of trials in which y ± U holds the true value, by symbol."""
    generator = np.random.default_rng(20260101)
    true = {each.quantity.symbol: each.value for each in evaluate(standard, truth, Options(), {}).parameters}
    effect = effect_along(truth.target_positions)[truth.target]
    held: Counter[str] = Counter()
    for _ in range(trials):
        along, own = (
            single_draws(budget.acting(acts), shape, generator)
            for acts, shape in ((Acts.ALONG_THE_LENGTH, ()), (Acts.AT_EACH_READING, truth.deviation.shape))
        )
        at_position = single_draws(
            budget.acting(Acts.AT_EACH_POSITION), truth.target_positions.shape, generator
        )
        # What is measured lacks the error by which it would have to be corrected.
        measured = replace(
            truth, deviation=truth.deviation - along * effect - at_position[truth.target] - own
        )
        evaluation = evaluate(standard, measured, Options(), {})
        arithmetic = partial(standard.arithmetic, options=Options())
        (expanded,) = propagate(budget, [(evaluation, arithmetic)], simulated)
        for each in evaluation.parameters:
            symbol = each.quantity.symbol
            held[symbol] += abs(each.value - true[symbol]) <= expanded[symbol].uncertainty
    return {symbol: held[symbol] / trials for symbol in true}


def main(arguments: list[str] | None = None) -> None:
    """Print a table for each standard: a row for each budget, a column for each parameter, in percent."""
    parser = argparse.ArgumentParser(prog="./run benchmark coverage", description=__doc__)
    parser.add_argument("--trials", type=int, default=4000, help="spoilt tests (%(default)s)")
    parser.add_argument("--simulated", type=int, default=2000, help="simulated tests of each (%(default)s)")
    parser.add_argument("standards", nargs="*", default=["iso230-2:2014"])
    sizes = parser.parse_args(arguments)
    registry = find_plugins()
    truth = simulated_test(11)
    for identifier in sizes.standards:
        standard = registry.standard(identifier)
        symbols = [quantity.symbol for quantity in standard.quantities]
        print(f"| {identifier} |", *(f"{symbol} |" for symbol in symbols))
        print("|---|", *("--:|" for _ in symbols), sep="")
        for name, budget in BUDGETS.items():
            found = coverage(budget, truth, standard, sizes.trials, sizes.simulated)
            print(f"| {name} |", *(f"{100 * found[symbol]:.1f} |" for symbol in symbols), flush=True)
        print()
