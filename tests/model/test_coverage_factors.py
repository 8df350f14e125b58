"""Coverage factors of many values at once are those of single ones."""

from __future__ import annotations

import numpy as np
import pytest

from zlmreport.model.fitting.estimate import compute_coverage_factor, compute_coverage_factors


@pytest.mark.parametrize("degrees", [[4.0], [4.0, 9.5, 1e6], np.geomspace(3.0, 1e6, 200).tolist()])
def test_they_agree_to_a_thousandth(degrees: list[float]) -> None:
    single = [compute_coverage_factor(each) for each in degrees]
    np.testing.assert_allclose(compute_coverage_factors(np.array(degrees)), single, rtol=1e-3)


def test_few_are_not_interpolated() -> None:
    degrees = np.array([5.0, 12.0, 5.0])
    assert compute_coverage_factors(degrees).tolist() == [
        compute_coverage_factor(each) for each in degrees.tolist()
    ]
