"""Corrections of a whole test."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from zlmreport.evaluation.correction.corrections import Air, Corrections, MaterialExpansion, correct
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
