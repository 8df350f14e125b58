"""In how many decimals values were given."""

from __future__ import annotations

import numpy as np
import pytest

from zlmreport.measurement.arrays import count_decimals_of


@pytest.mark.parametrize(
    ("values", "decimals"),
    [
        ([1.0, -20.0], 0),
        ([1.0, 0.25], 2),
        ([0.1 + 0.2], 1),
        ([np.nan, 0.5], 1),
        ([1 / 3], 3),
        ([], 0),
    ],
)
def test_the_fewest_decimals_that_hold_all_values_count(values: list[float], decimals: int) -> None:
    assert count_decimals_of(np.array(values), most=3) == decimals
