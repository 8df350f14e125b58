"""Units as files spell them."""

from __future__ import annotations

import math

import pytest

from zlmreport.measurement.units import PRESSURE_UNITS, RATIO_UNITS, TEMPERATURE_UNITS, with_unit
from zlmreport.plugin import ANGLE_UNITS, LENGTH_UNITS, TIME_UNITS, AxisKind, position_units, unit_named


@pytest.mark.parametrize(
    ("spelling", "metres"),
    [
        ("m", 1.0),
        ("mm", 1e-3),
        ("\u00b5m", 1e-6),
        ("\u03bcm", 1e-6),
        ("um", 1e-6),
        (" NM ", 1e-9),
        ("inch", 0.0254),
        ("\u00b5in", 2.54e-8),
        ("uin", 2.54e-8),
        ("thou", 2.54e-5),
        ("mil", 2.54e-5),
    ],
)
def test_a_length_is_known_by_its_spellings_with_either_micro_sign(spelling: str, metres: float) -> None:
    assert unit_named(spelling, LENGTH_UNITS).to_si(1.0) == pytest.approx(metres, rel=4e-16)


@pytest.mark.parametrize(
    ("spelling", "radians"),
    [
        ("°", math.pi / 180),
        ("deg", math.pi / 180),
        ("arcsec", math.pi / 648_000),
        ("″", math.pi / 648_000),
        ("mrad", 1e-3),
        ("gon", math.pi / 200),
        ("mgon", math.pi / 200_000),
    ],
)
def test_an_angle_is_known_by_its_spellings(spelling: str, radians: float) -> None:
    assert unit_named(spelling, ANGLE_UNITS).to_si(1.0) == pytest.approx(radians, rel=4e-16)


def test_one_milliradian_is_206_264806_arc_seconds() -> None:
    milliradian = unit_named("mrad", ANGLE_UNITS).to_si(1.0)
    assert unit_named("arcsec", ANGLE_UNITS).from_si(milliradian) == pytest.approx(206.264806, abs=5e-7)


@pytest.mark.parametrize(
    ("spelling", "value", "kelvin"), [("°C", 20.0, 293.15), ("K", 293.15, 293.15), ("°F", 68.0, 293.15)]
)
def test_temperatures_have_zeros_of_their_own(spelling: str, value: float, kelvin: float) -> None:
    assert unit_named(spelling, TEMPERATURE_UNITS).to_si(value) == pytest.approx(kelvin, rel=4e-16)


@pytest.mark.parametrize(
    ("spelling", "value"), [("Pa", 101325), ("hPa", 1013.25), ("mbar", 1013.25), ("kPa", 101.325)]
)
def test_one_atmosphere_is_the_same_in_every_unit(spelling: str, value: float) -> None:
    assert unit_named(spelling, PRESSURE_UNITS).to_si(value) == pytest.approx(101325, rel=4e-16)


def test_a_humidity_is_a_ratio_and_a_time_is_in_seconds() -> None:
    assert unit_named("%", RATIO_UNITS).to_si(45.0) == pytest.approx(0.45, rel=4e-16)
    assert unit_named("min", TIME_UNITS).to_si(2.0) == 120.0


def test_a_rotary_axis_has_no_lengths() -> None:
    with pytest.raises(
        ValueError,
        match=r"^'mm' is no unit of this quantity; .*known: gon, mgon, mrad, rad, °, µm/m, µrad, ″",
    ):
        unit_named("mm", position_units(AxisKind.ROTARY))


@pytest.mark.parametrize(
    ("number", "unit", "expected"),
    [("4.2", "µm", "4.2 µm"), ("20", "″", "20″"), ("4.2 ± 0.3", "″", "(4.2 ± 0.3)″")],
)
def test_a_unit_stands_as_it_is_printed(number: str, unit: str, expected: str) -> None:
    assert with_unit(number, unit) == expected
