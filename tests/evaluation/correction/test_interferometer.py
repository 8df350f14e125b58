"""What an interferometer displays that does not know its air, by counting its fringes."""

from __future__ import annotations

import numpy as np
import pytest

from zlmreport.evaluation.correction.corrections import compute_dead_path_error, correct_displacement_in_air

WAVELENGTH = 632.991e-9
#: Displacements, m, and the index of the air at each.
TRUE = np.array([0.0, 0.25, 0.5, 1.0])
INDEX = 1 + np.array([270.0e-6, 270.4e-6, 270.9e-6, 271.5e-6])


def displayed(assumed: float, dead_path: float, *, grows: bool = True) -> np.ndarray:
    """Count the half wavelengths of the measured path from the datum on, and turn them into a length."""
    path = dead_path + (TRUE if grows else -TRUE)
    fringes = 2 * (INDEX * path - INDEX[0] * dead_path) / WAVELENGTH
    return (1 if grows else -1) * fringes * WAVELENGTH / (2 * assumed)


# A displacement of 1 m is a double with a spacing of 2.2e-16 m; three operations on it round by as much.
EXACT = 1e-15


@pytest.mark.parametrize("assumed", [1.0, 1.00027])
def test_the_displacement_is_found_again(assumed):
    np.testing.assert_allclose(
        correct_displacement_in_air(displayed(assumed, 0.0), INDEX, assumed), TRUE, rtol=0, atol=EXACT
    )


def test_vacuum_assumed_in_air_displays_a_length_too_long_by_n_minus_one():
    long = displayed(1.0, 0.0) - TRUE

    np.testing.assert_allclose(long, TRUE * (INDEX - 1), rtol=0, atol=EXACT)


@pytest.mark.parametrize("grows", [True, False])
def test_the_dead_path_is_taken_out_on_either_side_of_the_interferometer(grows):
    dead_path = 1.4
    found = correct_displacement_in_air(displayed(1.0, dead_path, grows=grows), INDEX, 1.0)
    signed = dead_path if grows else -dead_path

    np.testing.assert_allclose(
        found - compute_dead_path_error(INDEX, float(INDEX[0]), signed), TRUE, rtol=0, atol=2 * EXACT
    )


def test_half_a_metre_of_dead_path_and_one_millionth_of_index_are_half_a_micrometre():
    index = np.array([1.000270, 1.000271])

    assert compute_dead_path_error(index, 1.000270, 0.5)[1] == pytest.approx(0.5e-6, rel=3e-4)
