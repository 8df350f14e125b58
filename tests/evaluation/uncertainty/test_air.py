"""What the measured air adds to the budget."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from document.certificate.documents import COMPLETE, job
from evaluation.uncertainty.budgets import make_budget_of
from zlmreport.plugin import Language
from zlmreport.plugin.extension import Acts, Contribution

#: Over 1 m; measured at 20 °C, 1013.25 hPa and 50 %.
AIR = {"air_temperature": 20, "air_pressure": 1013.25, "relative_humidity": 50}


def found_in(folder: Path, ranges: dict[str, float], *, air: bool = True) -> list[Contribution]:
    """What the air adds to the budget of a test over 1 m."""
    (folder / "readings.csv").write_text("target,direction,run,deviation\n0,+,1,0\n1000,+,1,5\n")
    keys = {
        **COMPLETE,
        "axis": {"name": "X"},
        "measurement": {"date": "2022-01-01", "source": {"plugin": "laser-csv", "file": "readings.csv"}},
        "environment": AIR,
        "uncertainty": ranges,
        "evaluate": ["iso230-2:2014"],
        **({"corrections": {"air": {"assumed": "vacuum"}}} if air else {}),
    }
    found = make_budget_of(job(folder, keys)).contributions
    return [each for each in found if each.contributor not in {"instrument", "resolution"}]


def contributions(folder: Path, ranges: dict[str, float], *, air: bool = True) -> dict[str, float]:
    """u over 1 m by name, µm."""
    found = found_in(folder, ranges, air=air)
    assert all(each.acts is Acts.ALONG_THE_LENGTH for each in found)
    return {each.name.in_language(Language.ENGLISH): each.standard_uncertainty * 1e6 for each in found}


# Sensitivities at 20 °C, 1013.25 hPa and 50 %: −0.93 to −0.96 × 10⁻⁶/K, +0.268 × 10⁻⁶/hPa and
# −0.0085 × 10⁻⁶ per percent; given to two or three digits.
@pytest.mark.parametrize(
    ("key", "name", "micrometres", "digits"),
    [
        ("air_temperature", "Air temperature", 0.945, 0.016),
        ("air_pressure", "Air pressure", 0.268, 0.002),
        ("relative_humidity", "Relative humidity", 0.0085, 0.01),
    ],
)
def test_the_sensitivities_are_the_known_ones(tmp_path, key, name, micrometres, digits):
    found = contributions(tmp_path, {key: 1.0})[name]

    assert found * math.sqrt(12) == pytest.approx(micrometres, rel=digits)


def test_the_equation_itself_adds_its_part(tmp_path):
    assert contributions(tmp_path, {}) == pytest.approx(
        {"Equation of the refractive index": 0.04 / math.sqrt(12)}, rel=1e-9
    )


def test_readings_that_are_not_corrected_for_the_air_get_none_of_it(tmp_path):
    assert contributions(tmp_path, {"air_temperature": 1.0}, air=False) == {}


def test_a_range_of_a_temperature_is_stated_in_kelvin_and_of_a_pressure_in_its_own_unit(tmp_path):
    warm, pressed, _ = found_in(tmp_path, {"air_temperature": 0.5, "air_pressure": 2.0})
    assert "0.5 K" in warm.stated.in_language(Language.ENGLISH)
    assert "2 hPa" in pressed.stated.in_language(Language.ENGLISH)
