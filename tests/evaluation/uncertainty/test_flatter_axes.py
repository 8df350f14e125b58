"""The flatter axes that may be behind readings, where the instrument errs as much as the axis."""

from __future__ import annotations

from dataclasses import replace
from statistics import NormalDist

import numpy as np
import pytest

from evaluation.uncertainty.budgets import ISO, MICROMETRE, budget, expanded
from zlmreport.evaluation.uncertainty.flatter_axes import make_flatter_axes
from zlmreport.plugin import (
    STRAIGHTNESS,
    Axis,
    MeasurementSet,
    Options,
    read_only_floats,
)
from zlmreport.plugin.extension import Acts
from zlmreport.plugin.renderer import Budget
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import bidirectional_test, simulated_test


def of_instrument(standard_uncertainty: float, acts: Acts = Acts.AT_EACH_POSITION) -> Budget:
    """Return the budget of an instrument with an error of its own at each position, m."""
    return budget(standard_uncertainty / MICROMETRE, acts)


def means(measurements: MeasurementSet) -> np.ndarray:
    return np.asarray(np.nanmean(measurements.deviations(), axis=(0, 2)))


def spread(measurements: MeasurementSet) -> float:
    return float(means(measurements).std(ddof=1))


def test_an_instrument_finer_than_the_axis_leaves_it_as_it_was_read() -> None:
    test = simulated_test()

    assert not make_flatter_axes(test, of_instrument(0.2 * spread(test)))
    assert not make_flatter_axes(test, of_instrument(spread(test), Acts.ALONG_THE_LENGTH))


def test_they_go_from_the_range_that_was_read_to_a_flat_axis() -> None:
    test = simulated_test()

    ranges = [np.ptp(means(each)) for each in make_flatter_axes(test, of_instrument(spread(test)))]

    assert ranges[0] == pytest.approx(np.ptp(means(test)))
    assert ranges[-1] == pytest.approx(0, abs=1e-12)
    assert np.diff(ranges) == pytest.approx(-ranges[0] / (len(ranges) - 1))


def test_targets_that_may_lie_at_an_end_but_for_their_error_are_put_there() -> None:
    test = simulated_test()
    error = 0.3 * spread(test)
    was, now = (means(each) for each in (test, make_flatter_axes(test, of_instrument(error))[0]))

    below, above = was - was.min() < 2 * error, was.max() - was < 2 * error
    assert now[below] - now.min() == pytest.approx(0, abs=1e-12)
    assert now.max() - now[above] == pytest.approx(0, abs=1e-12)
    between = ~(below | above)
    assert between.any()
    assert now[between] - now.min() == pytest.approx(was[between] - was.min())


def test_they_keep_the_scatter_and_the_reversal() -> None:
    test = simulated_test()

    for flat in make_flatter_axes(test, of_instrument(3 * spread(test))):
        within = [each.deviations() - means(each)[np.newaxis, :, np.newaxis] for each in (test, flat)]
        assert within[0] == pytest.approx(within[1], abs=1e-12)


def test_a_flat_axis_stays_one() -> None:
    test = simulated_test()
    nothing = replace(test, deviation=read_only_floats(np.zeros_like(test.deviation)))

    for flat in make_flatter_axes(nothing, of_instrument(1e-6)):
        assert spread(flat) == 0


def test_u_reaches_to_the_flat_axis_of_which_the_readings_may_be_a_test() -> None:
    """Each position of a flat axis errs by 1 µm: the range of 11 is then some 3.4 µm, and none of it true."""
    test = simulated_test(11)
    errors = 1e-6 * np.array([NormalDist().inv_cdf((each + 0.5) / 11) for each in range(11)])
    shown = replace(test, deviation=read_only_floats(errors[test.target]))
    evaluation = evaluate(ISO, shown, Options(), {})

    found = expanded(of_instrument(1e-6), shown, trials=4000)

    for symbol in ("E", "M"):
        assert found[symbol].uncertainty == pytest.approx(evaluation.value(symbol), rel=1e-5)
        assert found[symbol].coverage_factor > 1.9


def test_the_slope_of_a_set_up_is_no_form_of_the_axis() -> None:
    """A straightness that is no larger than the instrument is flattened, however steep its line."""
    at = np.linspace(0, 900, 10)
    form = 0.5 * np.sin(at / 60)
    for slope in (0.0, 0.1):  # µm/mm
        readings = (form + slope * at)[:, np.newaxis]
        line = bidirectional_test(at, readings, readings, axis=Axis("X", quantity=STRAIGHTNESS, error="EYX"))
        flat = make_flatter_axes(line, of_instrument(0.3e-6))[-1]
        left = np.polynomial.Polynomial.fit(at, means(flat) * 1e6, 1)
        assert np.ptp(means(flat) * 1e6 - left(at)) < 0.01 * np.ptp(form)
