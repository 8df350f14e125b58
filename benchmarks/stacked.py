"""A stack of simulated tests by every standard at once, and one after the other; one test in a notebook."""

from __future__ import annotations

import tracemalloc
from collections.abc import Sequence
from functools import partial

import numpy as np

import zlmreport as z
from measure import Cost, Measured, Sizes, alternately, cpu, median, peak_megabytes, timed
from sample import RUNS, TARGETS
from zlmreport.evaluation.statistics import PositionStatistics, position_statistics
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.arrays import FloatArray
from zlmreport.plugin.protocols import Standard
from zlmreport.plugin.registry import find_plugins

STANDARDS = (
    "iso230-2:1988",
    "iso230-2:1997",
    "iso230-2:2006",
    "iso230-2:2014",
    "vdi-dgq-3441",
    "vdi-vde-2617",
    "nmtba",
)

#: Tests that are evaluated one by one: enough for a mean, few enough to wait for.
_ONE_BY_ONE = 500
_IN_NOTEBOOK = "iso230-2:2014"
_MEGABYTE = 1e6


def measure(sizes: Sizes) -> list[Measured]:
    """Measure the evaluation of stacked tests."""
    registry = find_plugins()
    standards = [registry.standard(identifier) for identifier in STANDARDS]
    stack = np.random.default_rng(230).normal(0.0, 1e-6, (sizes.tests, len(Approach), TARGETS, RUNS))
    statistics = position_statistics(stack)
    costs = alternately(
        {
            "statistics": lambda: timed(lambda: position_statistics(stack))[0],
            **{each.identifier: partial(_cost_of_standard, each, statistics) for each in standards},
        },
        sizes.rounds,
    )
    seconds = {name: median(cpu(of_name)) for name, of_name in costs.items()}
    peak = peak_megabytes()
    chosen = stack[:_ONE_BY_ONE]
    one_by_one = timed(partial(_one_after_the_other, standards, chosen))[0].cpu / len(chosen)
    in_notebook, by_hand = _single(stack[0], sizes.rounds)
    return [
        Measured("means and standard deviations", seconds["statistics"], "s CPU"),
        *(Measured(f"formulas of {identifier}", seconds[identifier], "s CPU") for identifier in STANDARDS),
        Measured(f"all of {sizes.tests} tests by {len(STANDARDS)} standards", sum(seconds.values()), "s CPU"),
        Measured("of that, per test", sum(seconds.values()) / sizes.tests * 1e6, "µs CPU"),
        Measured("one test after the other, per test", one_by_one * 1e6, "µs CPU"),
        Measured("stack / one after the other", sum(seconds.values()) / sizes.tests / one_by_one),
        Measured("the stack itself", stack.nbytes / _MEGABYTE, "MB"),
        Measured(
            "most memory of one standard beside it", _most_memory(standards, statistics) / _MEGABYTE, "MB"
        ),
        Measured("most memory of the process", peak, "MB"),
        Measured("one test in a notebook", in_notebook * 1e6, "µs CPU"),
        Measured("one test in a notebook / by hand", in_notebook / by_hand, target=2.0),
    ]


def _single(test: FloatArray, rounds: int) -> tuple[float, float]:
    """Return what one test costs by `zlmreport.evaluate` with all its parameters, and by hand, s CPU."""
    directions, targets, runs = np.indices(test.shape)
    readings = z.read(
        {
            "target": targets.ravel() * 50.0,
            "direction": np.where(directions.ravel() == 0, "+", "-"),
            "run": runs.ravel() + 1,
            "deviation": test.ravel() * 1e6,
        }
    )

    def evaluated() -> None:
        for _ in range(_ONE_BY_ONE):
            _ = z.evaluate(readings, _IN_NOTEBOOK).parameters

    def computed() -> None:
        for _ in range(_ONE_BY_ONE):
            _by_hand(test)

    costs = alternately({"notebook": lambda: timed(evaluated)[0], "hand": lambda: timed(computed)[0]}, rounds)
    return median(cpu(costs["notebook"])) / _ONE_BY_ONE, median(cpu(costs["hand"])) / _ONE_BY_ONE


def _by_hand(test: FloatArray) -> tuple[float, ...]:
    """Return the parameters of ISO 230-2:2014 as numpy computes them, one direction at a time."""
    (mean, s), (mean_back, s_back) = ((each.mean(axis=1), each.std(axis=1, ddof=1)) for each in test)
    upper, lower, upper_back, lower_back = (
        mean + 2 * s,
        mean - 2 * s,
        mean_back + 2 * s_back,
        mean_back - 2 * s_back,
    )
    reversal = mean - mean_back
    repeatability = np.maximum(2 * s + 2 * s_back + np.abs(reversal), 4 * np.maximum(s, s_back))
    return (
        max(upper.max(), upper_back.max()) - min(lower.min(), lower_back.min()),
        upper.max() - lower.min(),
        upper_back.max() - lower_back.min(),
        max(mean.max(), mean_back.max()) - min(mean.min(), mean_back.min()),
        np.ptp(mean),
        np.ptp(mean_back),
        np.ptp((mean + mean_back) / 2),
        repeatability.max(),
        4 * s.max(),
        4 * s_back.max(),
        np.abs(reversal).max(),
        reversal.mean(),
    )


def _cost_of_standard(standard: Standard, statistics: PositionStatistics) -> Cost:
    options = standard.options()
    return timed(lambda: standard.arithmetic(statistics, options))[0]


def _one_after_the_other(standards: Sequence[Standard], tests: FloatArray) -> None:
    for test in tests:
        statistics = position_statistics(test)
        for standard in standards:
            standard.arithmetic(statistics, standard.options())


def _most_memory(standards: Sequence[Standard], statistics: PositionStatistics) -> int:
    """Return how many bytes the thriftless one of the standards takes at its height."""
    tracemalloc.start()
    peaks = []
    for standard in standards:
        tracemalloc.reset_peak()
        standard.arithmetic(statistics, standard.options())
        peaks.append(tracemalloc.get_traced_memory()[1])
    tracemalloc.stop()
    return max(peaks)
