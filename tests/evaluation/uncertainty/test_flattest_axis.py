"""The flattest axis that may be behind readings, where the instrument errs as much as the axis."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from zlmreport.evaluation.uncertainty.budget import Acts, Budget, Contribution, Distribution
from zlmreport.evaluation.uncertainty.flattest_axis import make_flattest
from zlmreport.language import same
from zlmreport.measurement.arrays import read_only_floats
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.measurand import STRAIGHTNESS
from zlmreport.measurement.measurement_set import MeasurementSet
from zlmreport.testing import bidirectional_test, simulated_test


def of_instrument(standard_uncertainty: float, acts: Acts = Acts.AT_EACH_POSITION) -> Budget:
    """Return the budget of an instrument with an error of its own at each position, m."""
    return Budget(
        (
            Contribution(
                same("Instrument"), standard_uncertainty, acts, Distribution.NORMAL, same(""), same("")
            ),
        )
    )


def means(measurements: MeasurementSet) -> np.ndarray:
    return np.asarray(np.nanmean(measurements.deviations(), axis=(0, 2)))


def spread(measurements: MeasurementSet) -> float:
    return float(means(measurements).std(ddof=1))


def test_an_instrument_finer_than_the_axis_leaves_it_as_it_was_read() -> None:
    test = simulated_test()

    assert make_flattest(test, of_instrument(0.2 * spread(test))) is None
    assert make_flattest(test, of_instrument(spread(test), Acts.ALONG_THE_LENGTH)) is None


def test_the_variance_that_the_errors_may_have_brought_is_taken_out() -> None:
    test = simulated_test()
    positions = len(test.target_positions)

    flat = make_flattest(test, of_instrument(0.5 * spread(test)))

    assert flat is not None
    # The upper limit of χ²/ν, 95 %, is 1.83 for 10 degrees of freedom, and nearer to 1 for more.
    brought = 1 - (spread(flat) / spread(test)) ** 2
    assert 0.25 * 1.2 < brought < 0.25 * 2.3, positions
    assert means(flat).mean() == pytest.approx(means(test).mean())


def test_an_axis_that_errs_less_than_the_instrument_may_be_flat_and_keeps_its_scatter() -> None:
    test = simulated_test()

    flat = make_flattest(test, of_instrument(3 * spread(test)))

    assert flat is not None
    assert spread(flat) == pytest.approx(0, abs=1e-12)
    within = [each.deviations().std(axis=-1) for each in (test, flat)]
    assert within[0] == pytest.approx(within[1])


def test_a_flat_axis_stays_one() -> None:
    test = simulated_test()
    nothing = replace(test, deviation=read_only_floats(np.zeros_like(test.deviation)))

    flat = make_flattest(nothing, of_instrument(1e-6))

    assert flat is not None
    assert spread(flat) == 0


def test_the_slope_of_a_set_up_is_no_form_of_the_axis() -> None:
    """A straightness that is no larger than the instrument is flattened, however steep its line."""
    at = np.linspace(0, 900, 10)
    form = 0.5 * np.sin(at / 60)
    for slope in (0.0, 0.1):  # µm/mm
        readings = (form + slope * at)[:, np.newaxis]
        line = bidirectional_test(at, readings, readings, axis=Axis("X", quantity=STRAIGHTNESS, error="EYX"))
        found = make_flattest(line, of_instrument(0.3e-6))
        assert found is not None
        left = np.polynomial.Polynomial.fit(at, means(found) * 1e6, 1)
        assert np.ptp(means(found) * 1e6 - left(at)) < 0.8 * np.ptp(form)
