"""From what a job states to the contributions of its budget."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from document.certificate.documents import COMPLETE, ROOT, job
from evaluation.uncertainty.budgets import make_budget_of
from installed import registry
from refusals import refused
from zlmreport import pipeline
from zlmreport.plugin import InputError, Language, MeasurementSet
from zlmreport.plugin.extension import Acts, Contribution, Distribution
from zlmreport.plugin.renderer import Budget, NoBudget

MICROMETRE = 1e-6
REPORT = {**COMPLETE["certificate"], "kind": "report"}
#: Of the readings: from −20 mm to 20 mm.
LENGTH = 0.04
READINGS = 90


def keys(**groups: Any) -> dict[str, Any]:
    """Return a job that states all that matters here, groups of its keys changed."""
    bare = {**COMPLETE, "uncertainty": {}}
    changed = {name: {**bare.get(name, {}), **group} for name, group in groups.items()}
    return {**bare, **changed}


def made(
    folder: Path, stated: Mapping[str, Any], conditions: Mapping[str, Any] | None = None
) -> Budget | NoBudget:
    checked = job(folder, stated)
    measurements: MeasurementSet = pipeline.read(checked, registry())
    return pipeline.make_budget_of_job(
        checked, replace(measurements, conditions=conditions or {}), registry()
    )


def contributions(
    folder: Path, stated: Mapping[str, Any], conditions: Mapping[str, Any] | None = None
) -> dict[str, Contribution]:
    """Return the contributions of a job by their names."""
    budget = made(folder, stated, conditions)
    assert isinstance(budget, Budget)
    return {each.name.in_language(Language.ENGLISH): each for each in budget.contributions}


def size(contribution: Contribution) -> float:
    return contribution.standard_uncertainty / MICROMETRE


def test_a_number_of_the_instrument_is_a_budget_with_the_last_digit_of_the_readings(tmp_path: Path) -> None:
    found = contributions(tmp_path, COMPLETE)

    assert list(found) == ["Measuring instrument", "Resolution of the readings"]
    instrument, resolution = found.values()
    assert (size(instrument), instrument.acts) == (1.0, Acts.AT_EACH_POSITION)
    assert instrument.source.in_language(Language.ENGLISH) == "calibration certificate C-1"
    assert (size(resolution), resolution.acts) == (pytest.approx(0.01 / math.sqrt(12)), Acts.AT_EACH_READING)


def test_an_uncertainty_per_metre_counts_at_the_measured_length(tmp_path: Path) -> None:
    stated = keys(instrument={"expanded_uncertainty": 0.3, "expanded_uncertainty_per_metre": 0.5})

    found = contributions(tmp_path, stated)

    growing, constant = (each for name, each in found.items() if name.startswith("Measuring instrument"))
    assert (size(constant), constant.acts) == (pytest.approx(0.3 / 2), Acts.AT_EACH_POSITION)
    assert (size(growing), growing.acts) == (pytest.approx(0.5 * LENGTH / 2), Acts.ALONG_THE_LENGTH)
    assert growing.stated.in_language(Language.GERMAN) == "U = 0,5 µm/m · L (k = 2)"


def test_an_uncertainty_may_be_written_as_the_formula_of_the_data_sheet(tmp_path: Path) -> None:
    found = contributions(tmp_path, keys(instrument={"expanded_uncertainty": "0.6 + 0.3*L"}))

    sizes = [size(each) for name, each in found.items() if name.startswith("Measuring instrument")]
    assert sizes == pytest.approx([0.3 * LENGTH / 2, 0.6 / 2])


@pytest.mark.parametrize("formula", ["0.6 + 0.3*M", "0.6 * L + 1", "0.6 ± 0.1", "sqrt(0.6^2 + (0.3*L)^2)"])
def test_a_formula_that_is_not_understood_is_refused_and_never_taken_for_words(
    tmp_path: Path, formula: str
) -> None:
    with pytest.raises(InputError, match="is not understood"):
        job(tmp_path, keys(instrument={"expanded_uncertainty": formula}))


def test_an_instrument_may_be_said_to_act_otherwise(tmp_path: Path) -> None:
    stated = keys(uncertainty={"instrument_acts": "at-each-reading"})

    assert contributions(tmp_path, stated)["Measuring instrument"].acts is Acts.AT_EACH_READING


def test_a_misalignment_is_a_one_sided_error(tmp_path: Path) -> None:
    found = contributions(tmp_path, keys(uncertainty={"misalignment": 0.02}))

    misalignment = found["Misalignment of the measuring line"]
    assert misalignment.distribution is Distribution.ONE_SIDED
    assert size(misalignment) == pytest.approx((0.02e-3**2 / (2 * LENGTH)) / math.sqrt(3) / MICROMETRE)


def test_temperatures_and_coefficients_take_what_the_job_states_beside_them(tmp_path: Path) -> None:
    found = contributions(
        tmp_path,
        keys(
            environment={"expansion_coefficient": 11.5, "axis_temperature": 18.8},
            instrument={"expansion_coefficient": 8},
            uncertainty={
                "machine_temperature": 0.4,
                "device_temperature": 0.2,
                "expansion_coefficient": 2,
                "device_expansion_coefficient": 1,
            },
        ),
    )

    per_metre = {
        "Temperature measurement, machine": 11.5 * 0.4,
        "Temperature measurement, measuring device": 8 * 0.2,
        "Expansion coefficient, machine": 1.2 * 2,
        "Expansion coefficient, measuring device": 1.2 * 1,
    }
    expected = {name: value * LENGTH / math.sqrt(12) for name, value in per_metre.items()}
    assert {name: size(found[name]) for name in expected} == pytest.approx(expected)
    assert {found[name].acts for name in expected} == {Acts.ALONG_THE_LENGTH}


def test_a_logged_temperature_counts_by_its_largest_distance_from_20_degrees(tmp_path: Path) -> None:
    logged = {"axis_temperature": np.full(READINGS, 294.15)}
    logged["axis_temperature"][[1, 2]] = np.nan, 290.15

    stated = {**keys(uncertainty={"expansion_coefficient": 2}), "environment": {"air_temperature": 20}}
    found = contributions(tmp_path, stated, logged)

    coefficient = found["Expansion coefficient, machine"]
    assert size(coefficient) == pytest.approx(LENGTH * 3.0 * 2 / math.sqrt(12))


@pytest.mark.parametrize(
    ("key", "needed"),
    [
        ("machine_temperature", "environment.expansion_coefficient"),
        ("device_temperature", "instrument.expansion_coefficient"),
        ("expansion_coefficient", "environment.axis_temperature or environment.material_temperature"),
        ("device_expansion_coefficient", "environment.axis_temperature or environment.material_temperature"),
    ],
)
def test_a_range_without_what_its_formula_needs_is_refused_at_its_place(
    tmp_path: Path, key: str, needed: str
) -> None:
    in_words = {"expansion_coefficient": "of steel", "axis_temperature": "about 20"}

    (problem,) = refused(made, tmp_path, keys(environment=in_words, uncertainty={key: 1.0})).problems
    assert problem.message.startswith(f"uncertainty.{key}: ")
    assert problem.message.endswith(f"without a number in {needed}")
    text = (tmp_path / "job.yaml").read_text("utf-8")
    assert key in text.splitlines()[problem.place.line - 1]


def test_the_drift_at_rest_is_a_process_in_time(tmp_path: Path) -> None:
    found = contributions(tmp_path, keys(uncertainty={"environmental_variation": 0.6}))

    drift = found["Variation of the environment during the test"]
    assert (size(drift), drift.acts) == (pytest.approx(0.6 / math.sqrt(12)), Acts.IN_TIME)


def test_a_stated_resolution_takes_the_place_of_the_last_digit(tmp_path: Path) -> None:
    resolution = contributions(tmp_path, keys(uncertainty={"resolution": 0.5}))["Resolution of the readings"]

    assert size(resolution) == pytest.approx(0.5 / math.sqrt(12))
    assert resolution.source.in_language(Language.ENGLISH) == "stated by the laboratory"


def test_the_last_digit_of_corrected_readings_says_nothing_of_the_instrument(tmp_path: Path) -> None:
    corrected = keys(
        environment={"material_temperature": 21.0},
        corrections={"material": {"expansion_coefficient": 11.5}},
    )

    budget = made(tmp_path, corrected)

    assert "resolution" in budget.missing


@pytest.mark.parametrize(
    ("stated", "said"),
    [
        ({"expanded_uncertainty": 0.5}, "U = 0.5 µm (k = 2)"),
        ({"standard_uncertainty": 0.5}, "u = 0.5 µm"),
        ({"range": 0.5}, "R = 0.5 µm"),
    ],
)
def test_any_other_contribution_says_how_it_is_stated(
    tmp_path: Path, stated: dict[str, Any], said: str
) -> None:
    other = {"name": "Dead path", "acts": "at-each-position", **stated}
    found = contributions(tmp_path, keys(uncertainty={"contributions": [other]}))["Dead path"]

    assert found.stated.in_language(Language.ENGLISH) == said


@pytest.mark.parametrize(
    ("stated", "standard_uncertainty", "distribution"),
    [
        ({"expanded_uncertainty": 0.5}, 0.25, Distribution.NORMAL),
        ({"standard_uncertainty": 0.5}, 0.5, Distribution.NORMAL),
        ({"range": 0.5}, 0.5 / math.sqrt(12), Distribution.RECTANGULAR),
        ({"range": 0.5, "distribution": "triangular"}, 0.5 / math.sqrt(24), Distribution.TRIANGULAR),
        ({"range": 0.5, "distribution": "one-sided"}, 0.5 / math.sqrt(3), Distribution.ONE_SIDED),
        ({"standard_uncertainty": 0.5, "distribution": "rectangular"}, 0.5, Distribution.RECTANGULAR),
    ],
)
def test_any_other_contribution_is_stated_in_one_of_three_ways(
    tmp_path: Path, stated: dict[str, Any], standard_uncertainty: float, distribution: Distribution
) -> None:
    other = {"name": "Dead path", "acts": "at-each-position", **stated}

    found = contributions(tmp_path, keys(uncertainty={"contributions": [other]}))["Dead path"]

    assert size(found) == pytest.approx(standard_uncertainty)
    assert (found.acts, found.distribution) == (Acts.AT_EACH_POSITION, distribution)


def test_the_instrument_of_a_rotary_axis_errs_at_each_position(tmp_path: Path) -> None:
    rotary = {key: value for key, value in COMPLETE.items() if key != "axis"}
    rotary["axis"] = {"name": "C", "kind": "rotary"}
    rotary["evaluate"] = ["iso230-2:2014"]
    rotary["uncertainty"] = {}

    budget = made(tmp_path, rotary)

    assert isinstance(budget, Budget)
    instrument = next(each for each in budget.contributions if each.distribution is Distribution.NORMAL)
    assert instrument.acts is Acts.AT_EACH_POSITION
    # 2″ with k = 2.
    assert instrument.standard_uncertainty == pytest.approx(math.radians(1 / 3600))
    assert budget.missing == ("environmental_variation",)


def test_contributions_that_act_alike_stand_together(tmp_path: Path) -> None:
    along = {"name": "Dead path", "acts": "along-the-length", "range": 0.1}

    found = contributions(tmp_path, keys(uncertainty={"contributions": [along]}))

    assert list(found) == ["Dead path", "Measuring instrument", "Resolution of the readings"]


def test_what_is_neither_stated_nor_negligible_is_missing(tmp_path: Path) -> None:
    stated = {
        "misalignment": 0.1,
        "environmental_variation": 0.1,
        "negligible": {"device_temperature": "laser"},
    }

    budget = made(tmp_path, {**COMPLETE, "uncertainty": stated, "certificate": REPORT})

    assert budget.missing == ("machine_temperature", "expansion_coefficient", "device_expansion_coefficient")
    assert budget.negligible == (("device_temperature", "laser"),)
    assert not budget.is_complete


def test_the_air_is_demanded_of_readings_that_are_corrected_for_it(tmp_path: Path) -> None:
    air = {"air_temperature": 20, "air_pressure": 1013, "relative_humidity": 50}
    corrected = keys(environment=air, corrections={"air": {"assumed": "vacuum"}})

    budget = made(tmp_path, corrected)

    assert {"air_temperature", "air_pressure", "relative_humidity"} <= set(budget.missing)


def test_what_a_warm_machine_shows_too_long_is_a_known_error_and_in_the_budget_whole(tmp_path: Path) -> None:
    warm = keys(environment={"axis_temperature": 31, "expansion_coefficient": 11.5})

    budget = made(tmp_path, warm)

    assert isinstance(budget, Budget)
    assert budget.uncorrected_expansion == pytest.approx(11 * 11.5e-6 * LENGTH)
    (known,) = budget.known_errors
    assert known.largest / MICROMETRE == pytest.approx(-11 * 11.5 * LENGTH)
    assert known.stated.in_language(Language.ENGLISH) == "α·ΔT·L = 5.06 µm"
    assert known.source.in_language(Language.ENGLISH) == (
        "of known size: α = 11.5 µm/(m·K), ΔT = 11 K, L = 0.04 m"
    )


def test_what_a_cold_machine_shows_too_short_goes_the_other_way(tmp_path: Path) -> None:
    cold = made(tmp_path, keys(environment={"axis_temperature": 9, "expansion_coefficient": 11.5}))

    assert isinstance(cold, Budget)
    (known,) = cold.known_errors
    assert known.largest / MICROMETRE == pytest.approx(11 * 11.5 * LENGTH)


@pytest.mark.parametrize(("temperature", "difference"), [(20.04, 0.0), (19.96, 0.0), (20.06, 0.06)])
def test_to_half_a_tenth_of_a_kelvin_the_machine_is_at_20_degrees(
    temperature: float, difference: float, tmp_path: Path
) -> None:
    near = keys(environment={"axis_temperature": temperature, "expansion_coefficient": 11.5})
    assert made(tmp_path, near).uncorrected_expansion == pytest.approx(difference * 11.5e-6 * LENGTH)


def test_the_expansion_of_a_length_of_unknown_temperature_is_unknown(tmp_path: Path) -> None:
    unknown = {**COMPLETE, "environment": {"axis_temperature": "about 20"}}

    assert made(tmp_path, unknown).uncorrected_expansion is None


def test_the_accreditation_bounds_u_from_below(tmp_path: Path) -> None:
    budget = made(tmp_path, keys(laboratory={"cmc": {"constant": 3, "per_metre": 5}}))

    assert isinstance(budget, Budget)
    assert budget.least == pytest.approx((3 + 5 * LENGTH) * MICROMETRE)


def test_a_capability_that_grows_with_each_metre_bounds_nothing_of_a_rotary_axis(tmp_path: Path) -> None:
    """A whole turn is no 6.28 m."""
    turning = {
        **keys(laboratory={"cmc": {"constant": 0.3, "per_metre": 0.5}}),
        "axis": {"name": "C", "kind": "rotary"},
    }
    budget = made(tmp_path, turning)

    assert isinstance(budget, Budget)
    assert budget.least == 0.0


@pytest.mark.parametrize("other", [{"quantity": "angle"}, {"kind": "rotary"}])
def test_a_capability_of_another_quantity_or_unit_bounds_nothing(
    other: dict[str, str], tmp_path: Path
) -> None:
    budget = made(tmp_path, keys(laboratory={"cmc": {"constant": 3, **other}}))

    assert isinstance(budget, Budget)
    assert budget.least == 0.0


def test_without_an_accreditation_nothing_bounds_u_from_below(tmp_path: Path) -> None:
    budget = made(tmp_path, COMPLETE)

    assert isinstance(budget, Budget)
    assert budget.least == 0.0


@pytest.mark.parametrize(
    ("instrument", "reason"),
    [
        (
            {"expanded_uncertainty": "see its certificate"},
            "the uncertainty of the measuring instrument is stated in words and not as a number",
        ),
        ({}, "the uncertainty of the measuring instrument is not stated"),
    ],
)
def test_without_a_number_of_the_instrument_there_is_no_budget(
    tmp_path: Path, instrument: dict[str, Any], reason: str
) -> None:
    stated = {**COMPLETE, "instrument": {"name": "Sensor", "certificate": "C-1", **instrument}}

    budget = made(tmp_path, stated)

    assert isinstance(budget, NoBudget)
    assert budget.reason.in_language(Language.ENGLISH) == reason


#: What a job states where everything expands: of a machine at 25 °C.
IN_WARMTH: Mapping[str, Any] = {
    "environment": {"axis_temperature": 25, "expansion_coefficient": 11.5},
    "uncertainty": {
        "misalignment": 1,
        "machine_temperature": 0.5,
        "expansion_coefficient": 2,
    },
}
OF_A_LENGTH = set(IN_WARMTH["uncertainty"])


def warm(folder: Path, example: str) -> list[Budget]:
    """Return the budgets of an example that was measured in warmth: of each of its lines."""
    extending = {
        "extends": str(ROOT / "configs" / example),
        "schema": "zlmreport/job/1",
        "certificate": {"kind": "report"},
        **IN_WARMTH,
    }
    found = make_budget_of(job(folder, extending))
    return list(found.tests.values()) or [found]


@pytest.mark.parametrize(
    "example",
    [
        "machine/x-straightness.yaml",
        "whole-machine/x-pitch.yaml",
        "machine/xy-squareness.yaml",
        "flatness/certificate.yaml",
    ],
)
def test_what_is_no_length_neither_expands_nor_shortens(tmp_path: Path, example: str) -> None:
    for found in warm(tmp_path, example):
        assert not OF_A_LENGTH & {each.contributor for each in found.contributions}
        assert not found.uncorrected_expansion


@pytest.mark.parametrize("example", ["whole-machine/diagonals.yaml", "machine/x-positioning.yaml"])
def test_a_length_does_both(tmp_path: Path, example: str) -> None:
    for found in warm(tmp_path, example):
        assert {each.contributor for each in found.contributions} >= OF_A_LENGTH


def test_a_coefficient_that_a_straightness_shares_with_others_asks_for_no_temperature(tmp_path: Path) -> None:
    stated = {
        "extends": str(ROOT / "configs" / "machine" / "x-straightness.yaml"),
        "schema": "zlmreport/job/1",
        "uncertainty": {"machine_temperature": 0.5, "device_temperature": 0.5},
    }
    assert isinstance(made(tmp_path, stated), Budget)


def test_a_part_per_metre_of_an_angle_is_in_arc_seconds(tmp_path: Path) -> None:
    """Of an angle interferometer: 0.05″ per metre of travel, and no micrometre of anything."""
    stated = keys(
        measurement={"error": "EAY"},
        instrument={"expanded_uncertainty": 0.1, "expanded_uncertainty_per_metre": 5.0},
    )

    found = contributions(tmp_path, {**stated, "evaluate": ["iso230-1:2012"]})

    growing, _ = (each for name, each in found.items() if name.startswith("Measuring instrument"))
    assert growing.standard_uncertainty == pytest.approx(5.0 / 2 * LENGTH * math.pi / 648_000)
    assert growing.stated.in_language(Language.ENGLISH) == "U = 5″/m · L (k = 2)"
