"""Corrections of a whole test, and what an interferometer displays that does not know its air."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from zlmreport.evaluation.correction.corrections import (
    Air,
    Corrections,
    MaterialExpansion,
    compute_dead_path_error,
    correct,
    correct_displacement_in_air,
)
from zlmreport.plugin import Language, MeasurementSet
from zlmreport.testing import simulated_test

#: A deviation is the difference of two lengths of 1 m at most.
EXACT = 1e-15


@pytest.fixture(scope="module")
def measured() -> MeasurementSet:
    return simulated_test()


def displacement(measured: MeasurementSet, datum: float) -> np.ndarray:
    return measured.target_positions[measured.target] + measured.deviation - datum


def everywhere(measured: MeasurementSet, value: float) -> np.ndarray:
    return np.full(len(measured.deviation), value)


def test_a_warm_axis_is_taken_back_to_20_degrees(measured):
    warm = MaterialExpansion(11.5e-6, everywhere(measured, 293.15 + 4))
    found = correct(measured, Corrections(datum=0.0, expansion=warm))

    expected = measured.deviation - displacement(measured, 0.0) * 11.5e-6 * 4
    np.testing.assert_allclose(found.deviation, expected, rtol=0, atol=EXACT)


def test_at_20_degrees_nothing_expands(measured):
    found = correct(
        measured, Corrections(0.0, expansion=MaterialExpansion(11.5e-6, everywhere(measured, 293.15)))
    )

    np.testing.assert_allclose(found.deviation, measured.deviation, rtol=0, atol=EXACT)


def test_the_datum_is_not_moved_by_the_index_of_the_air(measured):
    at = float(measured.target_positions[2])
    air = Air(everywhere(measured, 1.000271), 1.000270)
    found = correct(measured, Corrections(datum=at, air=air))

    change = found.deviation - measured.deviation
    np.testing.assert_allclose(
        change, displacement(measured, at) * (1.000270 / 1.000271 - 1), rtol=0, atol=EXACT
    )


def test_corrections_follow_each_other_and_are_remembered_in_their_order(measured):
    rising = np.linspace(1.000270, 1.000272, len(measured.deviation))
    corrections = Corrections(
        0.0, Air(rising, 1.000270), 0.5, MaterialExpansion(11.5e-6, everywhere(measured, 294.15))
    )
    found = correct(measured, corrections)

    names = [each.name.in_language(Language.ENGLISH) for each in found.provenance.corrections]
    assert names == ["Refractive index of air", "Dead path", "Thermal expansion, to 20 °C"]
    dead_path = found.provenance.corrections[1]
    assert dead_path.largest == pytest.approx(0.5 * 2e-6 / 1.000272, rel=1e-9)


def test_a_missing_reading_stays_missing(measured):
    deviation = measured.deviation.copy()
    deviation[3] = np.nan
    holed = replace(measured, deviation=deviation)
    air = Air(everywhere(measured, 1.000271), 1.0)
    found = correct(holed, Corrections(0.0, air))

    assert np.flatnonzero(np.isnan(found.deviation)).tolist() == [3]
    assert np.isfinite(found.provenance.corrections[0].largest)


def test_the_readings_themselves_are_left_as_they_were(measured):
    before = measured.deviation.copy()
    correct(measured, Corrections(0.0, Air(everywhere(measured, 1.000271), 1.0)))

    np.testing.assert_array_equal(measured.deviation, before)
    assert measured.provenance.corrections == ()


WAVELENGTH = 632.991e-9
#: Displacements, m, and the index of the air at each.
TRUE = np.array([0.0, 0.25, 0.5, 1.0])
INDEX = 1 + np.array([270.0e-6, 270.4e-6, 270.9e-6, 271.5e-6])


def displayed(assumed: float, dead_path: float, *, grows: bool = True) -> np.ndarray:
    """Count the half wavelengths of the measured path from the datum on, and turn them into a length."""
    path = dead_path + (TRUE if grows else -TRUE)
    fringes = 2 * (INDEX * path - INDEX[0] * dead_path) / WAVELENGTH
    return (1 if grows else -1) * fringes * WAVELENGTH / (2 * assumed)


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
