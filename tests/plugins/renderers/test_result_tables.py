"""Results as a table and as a workbook: the numbers of the results file, and nothing that calculates."""

from __future__ import annotations

import csv
import io
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import openpyxl
import pytest

from document.typesetting import samples
from installed import registry
from plugins.renderers.results import results_of, rows_of
from zlmreport.plugin import ANGLE, ARCSECOND, Language, Words
from zlmreport.plugin.renderer import Certificate, NoBudget

FORMULA = '=HYPERLINK("http://example.com";"1")'


@cache
def certificate() -> Certificate:
    return samples.certificate()


@cache
def results() -> Any:
    return results_of(certificate())


@cache
def rows() -> list[dict[str, str]]:
    return rows_of(certificate())


def book(of: Certificate) -> Any:
    return openpyxl.load_workbook(io.BytesIO(registry().renderer("xlsx").render(of)))


def table(sheet: Any) -> list[dict[str, Any]]:
    headings, *lines = sheet.iter_rows(values_only=True)
    return [dict(zip(headings, line, strict=True)) for line in lines]


def test_a_table_has_one_value_a_row_with_its_unit() -> None:
    assert list(rows()[0]) == ["standard", "symbol", "target", "quantity", "value", "unit"]
    assert all(row["unit"] for row in rows())


def test_parameters_of_the_table_are_those_of_the_results_file() -> None:
    printed = {
        (row["standard"], row["symbol"], row["quantity"]): (float(row["value"]), row["unit"])
        for row in rows()
        if not row["target"]
    }
    for evaluation in results()["evaluations"]:
        for each in evaluation["parameters"]:
            name = evaluation["standard"], each["symbol"]
            assert printed[*name, "value"] == (each["value"], each["unit"])
            if "limit" in each:
                assert printed[*name, "limit"] == (each["limit"], each["unit"])


def test_positions_of_the_table_are_those_of_the_results_file() -> None:
    printed = {
        (row["standard"], float(row["target"]), row["quantity"]): float(row["value"])
        for row in rows()
        if row["target"]
    }
    stated = {
        (evaluation["standard"], position["target"], key): value
        for evaluation in results()["evaluations"]
        for position in evaluation["positions"]
        for key, value in position.items()
        if key != "target"
    }
    assert printed == stated


def test_what_u_does_not_consider_stands_beside_it_in_the_table_and_in_the_workbook() -> None:
    reason = Words(en="no number", de="keine Zahl")
    incomplete = replace(certificate(), budget=NoBudget(reason, missing=("misalignment", "instrument")))
    printed = csv.DictReader(io.StringIO(registry().renderer("csv").render(incomplete).decode()))
    assert [row["symbol"] for row in printed if row["quantity"] == "uncertainty.missing"] == [
        "misalignment",
        "instrument",
    ]
    column = [row["U incomplete, not considered"] for row in table(book(incomplete)["Parameters"])]
    assert set(column) == {"misalignment, instrument"}


def test_a_complete_u_has_no_such_rows_and_no_such_column() -> None:
    assert not [row for row in rows() if "missing" in row["quantity"]]
    assert "U incomplete, not considered" not in table(book(certificate())["Parameters"])[0]


@pytest.mark.parametrize("text", [FORMULA, "+1", "-1", "@x", "\t=1"])
def test_no_text_of_a_table_begins_a_formula(text: str) -> None:
    (first, *others) = certificate().evaluations
    made = replace(certificate(), evaluations=(replace(first, standard=text), *others))
    printed = csv.DictReader(io.StringIO(registry().renderer("csv").render(made).decode(), newline=""))
    assert next(printed)["standard"] == f"'{text}"


def test_the_workbook_holds_the_numbers_of_the_results_file() -> None:
    stated = [
        (evaluation["standard"], each["symbol"], each["value"], each["unit"])
        for evaluation in results()["evaluations"]
        for each in evaluation["parameters"]
    ]
    printed = table(book(certificate())["Parameters"])
    assert [(row["Standard"], row["Symbol"], row["Value"], row["Unit"]) for row in printed] == stated


def test_the_workbook_holds_means_by_position_and_draws_them() -> None:
    sheet = book(certificate())["Positions"]
    stated = [position["mean_fwd"] for each in results()["evaluations"] for position in each["positions"]]
    assert [row["mean_fwd / um"] for row in table(sheet)] == stated
    (chart,) = sheet._charts
    assert len(chart.ser) == 2


def test_the_workbook_holds_the_readings_in_the_order_in_which_they_were_taken() -> None:
    measurements = certificate().measurements
    printed = table(book(certificate())["Readings"])
    assert [row["Run"] for row in printed] == measurements.run.tolist()
    there_and_back = measurements.axis.deviation_unit.from_si(measurements.deviation)
    assert [row["Deviation / um"] for row in printed] == pytest.approx(there_and_back.tolist(), rel=1e-15)


def test_a_reading_of_the_workbook_has_the_digits_that_were_read() -> None:
    """3.52″ are 3.5199999999999996″ after a way through radians."""
    of = certificate()
    turning = replace(of.measurements.axis, quantity=ANGLE)
    readings = np.full_like(of.measurements.deviation, ARCSECOND.to_si(3.52))
    assert ARCSECOND.from_si(readings)[0] != 3.52
    read = replace(of, measurements=replace(of.measurements, axis=turning, deviation=readings))
    assert {row["Deviation / arcsec"] for row in table(book(read)["Readings"])} == {3.52}


@pytest.mark.parametrize(
    ("expanded", "format_"), [(None, "0.000"), (0.0432, "0.000"), (0.0996, "0.00"), (43.2, "0")]
)
def test_a_parameter_of_the_workbook_is_shown_as_it_is_printed_and_held_whole(
    expanded: float | None, format_: str
) -> None:
    of = certificate()
    found = of.evaluations[0]
    first = replace(found.parameters[0], expanded_uncertainty=None if expanded is None else expanded * 1e-6)
    shown = replace(of, evaluations=(replace(found, parameters=(first,)), *of.evaluations[1:]))
    sheet = book(shown)["Parameters"]
    (column,) = (cell.column for cell in sheet[1] if cell.value == "Value")
    cell = sheet.cell(2, column)
    assert cell.value == results()["evaluations"][0]["parameters"][0]["value"]
    assert cell.number_format == format_


def test_no_text_of_a_workbook_is_a_formula() -> None:
    cells = [
        cell
        for sheet in book(replace(certificate(), number=FORMULA))
        for row in sheet.iter_rows()
        for cell in row
    ]
    assert FORMULA in {cell.value for cell in cells}
    assert "f" not in {cell.data_type for cell in cells}


def test_the_sheets_have_names_in_the_language() -> None:
    german = replace(certificate(), language=Language.GERMAN)
    assert book(german).sheetnames[:3] == ["Kenngrößen", "Positionen", "Messwerte"]


def test_the_workbook_says_what_is_decided_as_the_pages_do() -> None:
    german = replace(certificate(), language=Language.GERMAN)
    decided = {row["Entscheidung"] for row in table(book(german)["Kenngrößen"])} - {None}
    assert decided
    assert decided <= {"eingehalten", "nicht eingehalten", "nicht entschieden"}
