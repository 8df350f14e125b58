"""Whether y ± U holds the true value as often as it says, for an axis whose true readings are known."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from evaluation.uncertainty.budgets import ISO, contribution, expanded
from zlmreport.plugin import MeasurementSet, Options
from zlmreport.plugin.extension import Acts, Distribution
from zlmreport.plugin.renderer import Budget
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import simulated_test

TRIALS = 400
SIMULATED = 800
STATED = 0.9545
#: Four standard deviations of the share of successes in so many trials.
BY_CHANCE = 4 * math.sqrt(STATED * (1 - STATED) / TRIALS)

LASER = Budget(
    (
        contribution(0.3, Acts.ALONG_THE_LENGTH),
        contribution(0.1, Acts.AT_EACH_READING, Distribution.RECTANGULAR),
    )
)
MISALIGNED = Budget(
    (
        contribution(0.5, Acts.ALONG_THE_LENGTH, Distribution.ONE_SIDED),
        contribution(0.1, Acts.AT_EACH_READING, Distribution.RECTANGULAR),
    )
)


def errors(of: Budget, truth: MeasurementSet, generator: np.random.Generator) -> np.ndarray:
    """Return errors of the set-up, m, drawn without the program's own draws."""
    along, reading = of.contributions
    share = (truth.target_positions / np.ptp(truth.target_positions))[truth.target]
    one_sided = along.distribution is Distribution.ONE_SIDED
    scale = generator.uniform(0, math.sqrt(3)) if one_sided else generator.normal()
    own = generator.uniform(-math.sqrt(3), math.sqrt(3), truth.deviation.shape)
    return along.standard_uncertainty * scale * share + reading.standard_uncertainty * own


@pytest.mark.long
@pytest.mark.parametrize("of", [LASER, MISALIGNED], ids=["laser", "misaligned"])
def test_the_interval_holds_the_true_value_as_often_as_stated(of: Budget) -> None:
    truth = simulated_test(7)
    true = {each.quantity.symbol: each.value for each in evaluate(ISO, truth, Options(), {}).parameters}
    generator = np.random.default_rng(11)
    held: Counter[str] = Counter()
    for _ in range(TRIALS):
        measured = replace(truth, deviation=truth.deviation - errors(of, truth, generator))
        found = expanded(of, measured, trials=SIMULATED)
        for each in evaluate(ISO, measured, Options(), {}).parameters:
            symbol = each.quantity.symbol
            held[symbol] += abs(each.value - true[symbol]) <= found[symbol].uncertainty

    shares = {symbol: held[symbol] / TRIALS for symbol in true}
    assert shares == pytest.approx(dict.fromkeys(true, STATED), abs=BY_CHANCE)
