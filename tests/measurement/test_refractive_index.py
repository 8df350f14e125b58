"""The refractive index of air against published values, and its sensitivities against their known size."""

from __future__ import annotations

import numpy as np
import pytest

from zlmreport.measurement.refractive_index import saturation_vapour_pressure
from zlmreport.plugin import above_reference_temperature
from zlmreport.plugin.instrument import index_change, refractive_index

# Stone and Zimmerman, Index of refraction of air, NIST Engineering Metrology Toolbox
# (emtoolbox.nist.gov/Wavelength/Documentation.asp), table 1: °C, % relative humidity, kPa, nm; the column of
# the modified Edlén equation. Rows below 0 °C are left out: there the page takes humidity over ice.
PUBLISHED = [
    (20, 0, 101.325, 633, 1.000271799),
    (20, 0, 60, 633, 1.000160920),
    (20, 0, 120, 633, 1.000321918),
    (50, 0, 100, 633, 1.000243270),
    (5, 0, 100, 633, 1.000282750),
    (50, 100, 120, 633, 1.000287864),
    (40, 75, 120, 633, 1.000299406),
    (20, 100, 100, 633, 1.000267394),
    (40, 100, 110, 1700, 1.000270237),
    (20, 0, 101.325, 1700, 1.000268483),
    (40, 100, 110, 300, 1.000288922),
    (20, 0, 101.325, 300, 1.000286579),
]
HALF_A_DIGIT = 0.5e-9
ROOM = (np.array(293.15), np.array(101_325.0), np.array(0.5))


@pytest.mark.parametrize(("celsius", "percent", "kilopascal", "nanometre", "index"), PUBLISHED)
def test_published_values(
    celsius: float, percent: float, kilopascal: float, nanometre: float, index: float
) -> None:
    computed = refractive_index(
        np.array(celsius + 273.15), np.array(1e3 * kilopascal), np.array(percent / 100), 1e-9 * nanometre
    )
    assert abs(computed - index) <= HALF_A_DIGIT * 1.0001


# IAPWS-IF97, table 35 (saturation pressure from the temperature), MPa.
@pytest.mark.parametrize(("kelvin", "megapascal"), [(300, 0.353658941e-2), (500, 0.263889776e1)])
def test_published_vapour_pressures(kelvin: float, megapascal: float) -> None:
    assert saturation_vapour_pressure(np.array(kelvin)) == pytest.approx(1e6 * megapascal, rel=2e-9)


def _per_unit(index: int, step: float) -> float:
    """Return the change of Δn, ppm, for one step of a condition of the room."""
    changed = list(ROOM)
    changed[index] = changed[index] + step
    return float(1e6 * (index_change(*changed) - index_change(*ROOM)))


def test_a_kelvin_takes_about_a_millionth() -> None:
    assert -0.97 < _per_unit(0, 1.0) < -0.92


def test_a_hectopascal_brings_a_quarter_of_a_millionth() -> None:
    assert _per_unit(1, 100.0) == pytest.approx(0.268, abs=0.001)


def test_a_percent_of_humidity_takes_less_than_a_hundredth_of_a_millionth() -> None:
    assert _per_unit(2, 0.01) == pytest.approx(-0.0085, abs=0.0001)


def test_standard_air_changes_nothing() -> None:
    assert index_change(*ROOM) == 0.0


def test_conditions_may_be_arrays() -> None:
    together = index_change(np.array([293.15, 294.15]), np.full(2, 101_325.0), np.full(2, 0.5))
    np.testing.assert_array_equal(together, [0.0, index_change(np.array(294.15), *ROOM[1:])])


def test_reference_temperature_is_twenty_degrees_celsius() -> None:
    assert above_reference_temperature(20.0 + 273.15) == 0.0
