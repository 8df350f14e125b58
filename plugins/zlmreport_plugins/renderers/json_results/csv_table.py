"""The results as a table of one value a row: for pandas, R, and whoever draws a graph of their own.

The numbers are those of the results file, digit by digit.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from dataclasses import dataclass

from zlmreport.plugin import Certificate, Words
from zlmreport_plugins.renderers.json_results.document import Json, results

_HEADER = ("standard", "symbol", "target", "quantity", "value", "unit")
_NO_UNIT = "1"
#: What spreadsheets take for the beginning of a formula.
_FORMULA = ("=", "+", "-", "@", "\t", "\r")
_OF_PARAMETER = ("value", "expanded_uncertainty", "coverage_factor", "limit")
_WITHOUT_UNIT = frozenset({"coverage_factor", "risk", "chi2_per_dof"})


@dataclass(frozen=True, slots=True)
class Value:
    """A number: whose it is, what it is, its unit; `target` is None beside the table by position."""

    standard: str
    symbol: str
    target: float | None
    quantity: str
    value: float
    unit: str


class CsvRenderer:
    """Results as CSV: UTF-8, comma, decimal point."""

    identifier = "csv"
    title = Words(en="Results, one value a row (CSV)", de="Ergebnisse, ein Wert je Zeile (CSV)")
    suffix = ".csv"

    def render(self, certificate: Certificate) -> bytes:
        """Return the table."""
        table = io.StringIO()
        writer = csv.writer(table, lineterminator="\n")
        writer.writerow(_HEADER)
        for each in values(certificate):
            target = "" if each.target is None else repr(each.target)
            names = map(harmless, (each.standard, each.symbol))
            writer.writerow((*names, target, each.quantity, repr(each.value), each.unit))
        return table.getvalue().encode()


def values(certificate: Certificate) -> Iterator[Value]:
    """Yield every number of the evaluations and of the error model."""
    found = results(certificate)
    for evaluation in found["evaluations"]:
        yield from _of_evaluation(evaluation, found["measurements"]["units"]["deviation"])
    before = found.get("as_found", {})
    for evaluation in before.get("evaluations", ()):
        unit = before["measurements"]["units"]["deviation"]
        yield from _of_evaluation(evaluation, unit, prefix="as_found.")
    yield from _of_model(found["model"])


def harmless(text: str) -> str:
    """Return a text that no spreadsheet takes for a formula."""
    return f"'{text}" if text.startswith(_FORMULA) else text


def _of_evaluation(evaluation: Json, unit: str, prefix: str = "") -> Iterator[Value]:
    standard = evaluation["standard"]
    for parameter in evaluation["parameters"]:
        numbers = {key: parameter[key] for key in _OF_PARAMETER if key in parameter}
        numbers |= {
            key: value for key, value in parameter.get("decision", {}).items() if not isinstance(value, str)
        }
        for key, value in numbers.items():
            own = _NO_UNIT if key in _WITHOUT_UNIT else parameter["unit"]
            yield Value(standard, parameter["symbol"], None, prefix + key, value, own)
    for position in evaluation["positions"]:
        for key, value in position.items():
            if key != "target":
                own = _NO_UNIT if key.startswith("n_") else unit
                yield Value(standard, key, position["target"], prefix + key, value, own)


def _of_model(model: Json) -> Iterator[Value]:
    for parameter in model["parameters"]:
        symbol = f"{parameter['effect']}.{parameter['name']}"
        for key in ("value", "expanded_uncertainty"):
            if parameter.get(key) is not None:
                yield Value("", symbol, None, key, parameter[key], parameter["unit"])
    unit = model["error"].get("unit", "")
    for key, value in model["error"].items():
        if not isinstance(value, str):
            yield Value("", "error", None, key, value, _NO_UNIT if key in _WITHOUT_UNIT else unit)
