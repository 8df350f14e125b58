"""Values that seem to be in another unit, on the page and in the program's own words."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from document.certificate.documents import COMPLETE, certificate, text_of
from zlmreport.plugin import InputError, Language

ROTARY = Path(__file__).parents[3] / "configs" / "rotary-axis" / "c-axis.csv"


def said(folder: Path, changes: Mapping[str, Any]) -> list[str]:
    document = certificate(folder, {**COMPLETE, **changes})
    shown = [each.in_language(Language.ENGLISH) for each in document.doubts]
    assert all(each in text_of(document) for each in shown)
    return shown


def test_usual_values_raise_no_doubt(tmp_path: Path) -> None:
    assert said(tmp_path, {}) == []


@pytest.mark.parametrize(
    ("condition", "value", "likely"),
    [
        ("air_temperature", 68.2, "68.2 °F would be 20.1 °C"),  # (68.2 − 32)·5/9
        ("relative_humidity", 0.45, "0.45 of 1 would be 45 %"),
    ],
)
def test_condition_in_another_unit_is_named_with_it(
    tmp_path: Path, condition: str, value: float, likely: str
) -> None:
    environment = {"axis_temperature": 20, "expansion_coefficient": 11.5, condition: value}
    (sentence,) = said(tmp_path, {"environment": environment})
    assert sentence.endswith(likely)


@pytest.mark.parametrize(
    ("condition", "value", "likely"),
    [
        ("axis_temperature", 293.4, "293.4 K would be 20.2 °C"),  # 293.4 − 273.15 = 20.25
        ("air_pressure", 101.3, "101.3 kPa would be 1010 hPa"),  # three digits of 1013
    ],
)
def test_condition_in_which_nobody_measures_is_refused_with_the_unit_that_fits(
    tmp_path: Path, condition: str, value: float, likely: str
) -> None:
    with pytest.raises(
        InputError, match=f"environment.{condition}: .* is not between .*; {re.escape(likely)}"
    ):
        certificate(tmp_path, {**COMPLETE, "environment": {condition: value}})


def test_a_share_of_1_is_called_one_in_german(tmp_path: Path) -> None:
    environment = {"axis_temperature": 20, "expansion_coefficient": 11.5, "relative_humidity": 0.45}
    (doubt,) = certificate(tmp_path, {**COMPLETE, "environment": environment}).doubts
    assert doubt.in_language(Language.GERMAN).endswith("0,45 von 1 wären 45 %")


def test_condition_that_fits_no_unit_is_unusual(tmp_path: Path) -> None:
    environment = {"axis_temperature": 20, "air_temperature": -20.0}
    (sentence,) = said(tmp_path, {"environment": environment})
    assert sentence == "Air temperature: -20 °C is unusual where machines are measured".replace("-", "−")


def test_logged_temperatures_are_looked_at_too(tmp_path: Path) -> None:
    rows = "".join(
        f"{target},{way},{run},{run}.5,70\n" for run in (1, 2) for way in "+-" for target in (0, 10, 20)
    )
    readings = tmp_path / "warm.csv"
    readings.write_text(f"target,direction,run,deviation,air_temperature\n{rows}", encoding="utf-8")
    measurement = {"date": "2022-04-07", "source": {"plugin": "laser-csv", "file": str(readings)}}
    (sentence,) = said(tmp_path, {"measurement": measurement, "environment": {"axis_temperature": 20}})
    assert sentence.endswith("70 °F would be 21.1 °C")


def test_limits_in_millimetres_are_told_together(tmp_path: Path) -> None:
    tolerances = {"A": 0.15, "E": 0.1, "B": 25}  # of values of 126 µm, 100 µm and 20 µm
    (sentence,) = said(tmp_path, {"evaluate": [{"standard": "iso230-2:2014", "tolerances": tolerances}]})
    assert sentence == (
        "ISO 230-2:2014: limits far below the values or their last digit: A 0.15 µm, E 0.1 µm; "
        "tolerances are stated in µm, and 1 mm is 1000 µm"
    )


def test_limit_below_the_last_digit_is_told_whatever_the_value(tmp_path: Path) -> None:
    rows = "".join(f"{target},{way},{run},0\n" for run in (1, 2) for way in "+-" for target in (0, 10, 20))
    readings = tmp_path / "still.csv"
    readings.write_text(f"target,direction,run,deviation\n{rows}", encoding="utf-8")
    measurement = {"date": "2022-04-07", "source": {"plugin": "laser-csv", "file": str(readings)}}
    evaluate = [{"standard": "iso230-2:2014", "tolerances": {"A": 0.02}}]
    (sentence,) = said(tmp_path, {"measurement": measurement, "evaluate": evaluate})
    assert "A 0.02 µm" in sentence


def test_limit_wider_than_the_measured_range_is_told(tmp_path: Path) -> None:
    (sentence,) = said(
        tmp_path, {"evaluate": [{"standard": "iso230-2:2014", "tolerances": {"A": 41_000}}]}
    )  # 40 mm were measured
    assert "wider than the measured range: A 41000 µm" in sentence


def test_degrees_taken_for_millimetres(tmp_path: Path) -> None:
    measurement = {"date": "2022-04-07", "source": {"plugin": "laser-csv", "file": str(ROTARY)}}
    source = {**measurement["source"], "units": {"target": "mm", "position": "mm"}}  # type: ignore[dict-item]
    axis = {"name": "C", "travel": [0, 360]}
    (sentence,) = said(tmp_path, {"axis": axis, "measurement": {**measurement, "source": source}})
    assert sentence.startswith("Axis C is taken for a linear one that was measured over 360 mm")


def test_millimetres_taken_for_degrees(tmp_path: Path) -> None:
    (sentence,) = said(
        tmp_path, {"axis": {"name": "Y2", "kind": "rotary", "travel": [-20, 20]}, "environment": {}}
    )
    assert sentence.endswith("measured over 40°; if these are millimetres: axis.kind: linear")


def test_a_run_in_another_unit_is_named_on_the_first_page(tmp_path: Path) -> None:
    rows = "".join(
        f"{target},{way},{run},{(run + target) * (0.001 if run == 3 else 1.0)}\n"
        for run in range(1, 6)
        for way in "+-"
        for target in (5, 10, 15)
    )
    readings = tmp_path / "mixed.csv"
    readings.write_text(f"target,direction,run,deviation\n{rows}", encoding="utf-8")
    measurement = {"date": "2022-04-07", "source": {"plugin": "laser-csv", "file": str(readings)}}
    (sentence,) = said(tmp_path, {"measurement": measurement})
    assert sentence.startswith("run 3 looks as if it were in another unit than the others; correct the run")
