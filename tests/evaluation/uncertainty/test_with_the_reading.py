"""A wrong scale of the instrument: an error in proportion to what was read, shared by lines of one device."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from evaluation.uncertainty.budgets import ISO as STANDARD, contribution, expanded
from zlmreport.evaluation.uncertainty.monte_carlo import propagate
from zlmreport.measurement.measurement_set import join_lines
from zlmreport.plugin import DISPLACEMENT, Axis, MeasurementSet, Options
from zlmreport.plugin.extension import Acts, of_the_reading
from zlmreport.plugin.renderer import Budget
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import simulated_test

LINE = simulated_test(11)


def scaled(line: MeasurementSet, share: float = 0.01) -> Budget:
    """Return the budget of an instrument whose scale has u as a share of the reading, and no other error."""
    of_scale = replace(contribution(0.0, Acts.WITH_THE_READING), **of_the_reading(share, line, "scale"))
    return Budget((of_scale,))


def test_every_parameter_errs_by_the_same_share_of_itself() -> None:
    """All are homogeneous in the readings: y·(1 + g) for a scale of 1 + g, so that U = 2·u(g)·y."""
    evaluation = evaluate(STANDARD, LINE, Options(), {})
    for symbol, found in expanded(scaled(LINE), LINE, trials=4000).items():
        assert found.uncertainty == pytest.approx(2 * 0.01 * abs(evaluation.value(symbol) or 0.0), rel=0.02)


def test_the_largest_reading_has_all_of_it_and_half_of_it_half() -> None:
    half = replace(LINE, deviation=LINE.deviation / 2)
    (of_whole,), (of_half,) = (scaled(each).contributions for each in (LINE, half))
    assert of_whole.standard_uncertainty == pytest.approx(0.01 * np.abs(LINE.deviation).max())
    assert of_half.standard_uncertainty == pytest.approx(of_whole.standard_uncertainty / 2)
    assert np.abs(of_whole.effect).max() == 1.0


def test_a_missing_reading_has_no_part_in_it() -> None:
    gaps = LINE.deviation.copy()
    gaps[3] = np.nan
    (found,) = scaled(replace(LINE, deviation=gaps)).contributions
    assert np.isnan(found.effect[3])
    assert np.isfinite(np.delete(found.effect, 3)).all()


def uncertainty_of_difference(line: MeasurementSet) -> float:
    """Return U of E of one line minus E of the same line, each with its own readings of one device."""
    both = join_lines(Axis("X"), {"a": line, "b": line})
    budget = Budget((), tests={name: scaled(line) for name in both.tests})
    evaluation = evaluate(STANDARD, line, Options(), {})
    difference = replace(evaluation.parameters[0], value=0.0)
    together = replace(evaluation, measurements=both, parameters=(difference,))
    symbol = difference.quantity.symbol

    def arithmetic(statistics):
        spans = [np.ptp(np.nanmean(each.mean, axis=-2), axis=-1) for each in statistics.tests.values()]
        return replace(
            STANDARD.arithmetic(statistics.tests["a"], Options()), parameters={symbol: spans[0] - spans[1]}
        )

    (found,) = propagate(budget, [(together, arithmetic)], 2000)
    return found[symbol].uncertainty


def test_lines_that_one_device_read_share_its_scale() -> None:
    assert uncertainty_of_difference(LINE) < 1e-12


def test_sensors_that_read_at_the_same_time_have_a_scale_each() -> None:
    over_time = replace(LINE, axis=Axis("Z", quantity=DISPLACEMENT))
    span = float(np.ptp(np.nanmean(LINE.deviations(), axis=(0, 2))))
    assert uncertainty_of_difference(over_time) == pytest.approx(2 * 0.01 * np.sqrt(2) * span, rel=0.1)
