"""Angular errors: spans from which no line is taken."""

from __future__ import annotations

import numpy as np
import pytest

from plugins.standards.iso230_1.lines import evaluated, line, values

POSITIONS = np.linspace(0.0, 600.0, 7)
UP = np.array([[0.0, 0.2], [1.0, 1.2], [2.2, 2.0], [2.9, 3.1], [4.0, 4.2], [3.1, 2.9], [2.0, 2.0]])
DOWN = UP - 0.6


def test_a_span_is_that_of_the_mean_of_all_runs() -> None:
    found = values(line("EBX", POSITIONS, UP, DOWN))
    mean = (UP.mean(axis=1) + DOWN.mean(axis=1)) / 2
    assert found["EBX"] == pytest.approx(np.ptp(mean))
    assert found["EBX_fwd"] == pytest.approx(np.ptp(UP.mean(axis=1)))
    assert found["EBX_both"] == pytest.approx(np.ptp(mean) + 0.6)


@pytest.mark.parametrize("offset", [-30.0, 12.5])
def test_where_the_instrument_was_zeroed_does_not_matter(offset: float) -> None:
    assert values(line("EAX", POSITIONS, UP + offset, DOWN + offset))["EAX"] == pytest.approx(
        values(line("EAX", POSITIONS, UP, DOWN))["EAX"]
    )


def test_a_slope_of_an_angle_is_part_of_it() -> None:
    assert values(line("ECX", POSITIONS, 0.01 * POSITIONS))["ECX"] == pytest.approx(6.0)


def test_one_direction_alone_has_no_span_of_both() -> None:
    found = {each.quantity.symbol for each in evaluated(line("EBX", POSITIONS, UP)).parameters}
    assert found == {"EBX", "EBX_fwd"}
