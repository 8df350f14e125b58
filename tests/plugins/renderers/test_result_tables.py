"""Results as a table and as a workbook: the numbers of the results file, and nothing that calculates."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import replace
from functools import cache
from typing import Any

import openpyxl
import pytest

from document.typesetting import samples
from zlmreport.document.certificate.document import Certificate
from zlmreport.evaluation.uncertainty.budget import NoBudget
from zlmreport.language import Language, Words
from zlmreport_plugins.renderers.json_results.document import JsonResultsRenderer
from zlmreport_plugins.renderers.json_results.tables import CsvRenderer, XlsxRenderer, make_harmless

FORMULA = '=HYPERLINK("http://example.com";"1")'


@cache
def certificate() -> Certificate:
    return samples.certificate()


@cache
def results() -> Any:
    return json.loads(JsonResultsRenderer().render(certificate()))


@cache
def rows() -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(CsvRenderer().render(certificate()).decode())))


def book(of: Certificate) -> Any:
    return openpyxl.load_workbook(io.BytesIO(XlsxRenderer().render(of)))


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
    printed = csv.DictReader(io.StringIO(CsvRenderer().render(incomplete).decode()))
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
    assert make_harmless(text) == f"'{text}"


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
    assert [row["Deviation / um"] for row in printed] == measurements.axis.deviation_unit.from_si(
        measurements.deviation
    ).tolist()


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
