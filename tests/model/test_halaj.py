"""The fit of single readings beside the paper's fit of means: equation (2), one direction at a time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from model import halaj
from model.axis_tests import EFFECTS, known, linear_test, model_of, noise
from zlmreport.model.fitting.estimate import InstrumentError
from zlmreport.model.fitting.fit import Assumptions, Fit, fit
from zlmreport.model.fitting.observations import select_readings
from zlmreport.plugin import FloatArray

DESIGN = linear_test(targets=10, runs=10)
READINGS = known(DESIGN) + noise(DESIGN)
U_INSTRUMENT = 0.4e-6
#: Positions where nobody measured, on the travel that was.
BETWEEN = replace(linear_test(targets=17, runs=1, seed=4), span=DESIGN.span)


@pytest.fixture(params=[1.0, -1.0], ids=["upwards", "downwards"])
def one_way(request: pytest.FixtureRequest) -> tuple[Fit, FloatArray]:
    """Return a cubic through the readings of one direction, and the readings."""
    chosen = np.flatnonzero(request.param == DESIGN.direction)
    assumed = Assumptions(InstrumentError(U_INSTRUMENT), parts=(), weights=np.ones(len(chosen)))
    found = fit(model_of(EFFECTS["polynomial"]), select_readings(DESIGN, chosen), READINGS[chosen], assumed)
    return found, READINGS[chosen]


def test_the_deviation_at_any_point_is_that_of_the_cubic_through_the_means(
    one_way: tuple[Fit, FloatArray],
) -> None:
    fitted, readings = one_way
    (position,), mean, u = halaj.means([fitted.design.position], readings)
    coefficients, covariance = halaj.solve(
        halaj.columns(position), mean, fitted.noise.sigma / np.sqrt(10), U_INSTRUMENT
    )
    rows = halaj.columns(BETWEEN.position)
    predicted = fitted.predict(BETWEEN)
    assert predicted.deviation == pytest.approx(rows @ coefficients, rel=1e-9)
    expected = np.sqrt(np.einsum("np,pq,nq->n", rows, covariance, rows))
    assert predicted.standard_uncertainty == pytest.approx(expected, rel=1e-6)
    # σ is that of the residuals about the cubic; equation (10) takes each point's own, of 9 degrees each.
    assert np.sqrt(np.mean(u**2)) == pytest.approx(fitted.noise.sigma / np.sqrt(10), rel=0.1)
