"""The formats ``csv`` (one value a row) and ``xlsx`` (a workbook with charts): columns, sheets, cells.

The numbers are those of the results file, digit by digit; cells of the workbook hold them whole and show them
with the digits that a document prints. Readings are what the file says that they were read from, without the
rounding of a unit's conversion. In the workbook every text is a text, also one that begins as a formula does;
and the same certificate gives the same bytes: what openpyxl writes of the clock is taken out again, and its
XML, which lxml writes where it is installed and the standard library where not, is brought into one form.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime, time
from typing import Any, NamedTuple, TypeAlias
from xml.etree.ElementTree import iterparse
from xml.sax import make_parser
from xml.sax.handler import feature_namespaces
from xml.sax.saxutils import XMLGenerator
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from zlmreport.plugin import CIRCLE, Approach, MeasurementSet, Words, hookimpl
from zlmreport.plugin.renderer import CONFORMITY_STATEMENTS, Certificate, Renderer, rounded_pair
from zlmreport.plugin.standard import Conformity
from zlmreport_plugins.renderers.json_results import Json, collect_results

_HEADER = ("standard", "symbol", "target", "quantity", "value", "unit")
_NO_UNIT = "1"
#: What spreadsheets take for the beginning of a formula.
_FORMULA = ("=", "+", "-", "@", "\t", "\r")
_OF_PARAMETER = ("value", "expanded_uncertainty", "coverage_factor", "limit")
_OF_ROW = ("symbol", "name", "value", "unit", "expanded_uncertainty", "coverage_factor", "limit")
_WITHOUT_UNIT = frozenset({"coverage_factor", "risk", "chi2_per_dof"})


class _Shown(NamedTuple):
    """A number, and how a cell shows it."""

    value: float
    format: str


#: A number, a text, or nothing.
_Cell: TypeAlias = float | str | _Shown | None
#: How cells show what a document prints with three decimals, and with two: k.
_THREE_DECIMALS, _TWO_DECIMALS = "0.000", "0.00"
#: Digits of a decimal number that a double keeps.
_SURE_DIGITS = 15

_PARAMETERS = Words("Parameters")
_AS_FOUND = Words("{sheet} as found")
_POSITIONS = Words("Positions")
_READINGS = Words("Readings")
_MODEL = Words("Error model")
_STANDARD = Words("Standard")
_PARAMETER_HEADINGS = (
    Words("Certificate", context="sheet"),
    _STANDARD,
    Words("Symbol"),
    Words("Name"),
    Words("Value"),
    Words("Unit"),
    Words("U"),
    Words("k"),
    Words("Limit"),
    Words("Decision"),
)
_INCOMPLETE = Words("U incomplete, not considered")
_READING_HEADINGS = (
    Words("Run"),
    Words("Direction"),
    Words("Target"),
    Words("Deviation"),
)
_MODEL_HEADINGS = (
    Words("Effect"),
    Words("Parameter", context="model"),
    Words("Value"),
    Words("Unit"),
    Words("U"),
)
_TARGET = Words("Target")
_DEVIATION = Words("Deviation")

#: What no cell can hold.
_NOT_IN_CELLS = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff\ud800-\udfff]")
_LONGEST_TEXT = 32_767
_LONGEST_TITLE = 31
_WIDEST_COLUMN = 60
_CHART_CM = (24.0, 11.0)
#: Means of each direction, as the results file calls them.
_MEANS = {"mean_fwd": "0063A6", "mean_bwd": "CC5500"}
#: The first date that an archive can state.
_NO_DATE = (1980, 1, 1, 0, 0, 0)
_CLOCK = re.compile(rb"(<dcterms:modified[^>]*>)[^<]*")


@dataclass(frozen=True, slots=True)
class TableValue:
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
    title = Words("Results, one value a row (CSV)")
    suffix = ".csv"
    needs_layout = False
    needs_job = True

    def render(self, certificate: Certificate) -> bytes:
        """Return the table."""
        table = io.StringIO()
        writer = csv.writer(table, lineterminator="\n")
        writer.writerow(_HEADER)
        for each in list_values(certificate):
            target = "" if each.target is None else repr(each.target)
            names = map(make_harmless, (each.standard, each.symbol))
            writer.writerow((*names, target, each.quantity, repr(each.value), each.unit))
        return table.getvalue().encode()


def list_values(certificate: Certificate) -> Iterator[TableValue]:
    """Yield every number of the evaluations and of the error model."""
    found = collect_results(certificate)
    for test, prefix in _list_measured(found):
        unit = test["measurements"]["units"]["deviation"]
        for evaluation in test["evaluations"]:
            yield from _list_values_of_evaluation(evaluation, unit, prefix)
        for contributor in _list_missing(test):
            yield TableValue("", contributor, None, f"{prefix}uncertainty.missing", 1.0, _NO_UNIT)
    for part in found.get("parts", {"": found}).values():
        yield from _list_values_of_model(part["model"])


def _list_measured(found: Json) -> Iterator[tuple[Json, str]]:
    """Yield what has evaluations of its own, with what its quantities begin with.

    The measurement itself with nothing; ``as_found.`` before an adjustment; of several measured lines, and of
    the measurements of one document, their names: ``x.``, ``EYX.``.
    """
    for name, part in found.get("parts", {"": found}).items():
        prefix = f"{name}." if name else ""
        yield part, prefix
        if "as_found" in part:
            yield part["as_found"], f"{prefix}as_found."
        for line, test in part.get("tests", {}).items():
            yield test, f"{prefix}{line}."


def _list_missing(test: Json) -> Sequence[str]:
    """Return the contributors that U does not consider, by their keys."""
    missing: Sequence[str] = test.get("uncertainty", {}).get("missing", ())
    return missing


def make_harmless(text: str) -> str:
    """Return a text that no spreadsheet takes for a formula."""
    return f"'{text}" if text.startswith(_FORMULA) else text


def _list_values_of_evaluation(evaluation: Json, unit: str, prefix: str) -> Iterator[TableValue]:
    standard = evaluation["standard"]
    for parameter in evaluation["parameters"]:
        numbers = {key: parameter[key] for key in _OF_PARAMETER if key in parameter}
        numbers |= {
            key: value for key, value in parameter.get("decision", {}).items() if not isinstance(value, str)
        }
        for key, value in numbers.items():
            own = _NO_UNIT if key in _WITHOUT_UNIT else parameter["unit"]
            yield TableValue(standard, parameter["symbol"], None, prefix + key, value, own)
    for position in evaluation["positions"]:
        for key, value in position.items():
            if key != "target":
                own = _NO_UNIT if key.startswith("n_") else unit
                yield TableValue(standard, key, position["target"], prefix + key, value, own)


def _list_values_of_model(model: Json) -> Iterator[TableValue]:
    for parameter in model["parameters"]:
        symbol = f"{parameter['effect']}.{parameter['name']}"
        for key in ("value", "expanded_uncertainty"):
            if parameter.get(key) is not None:
                yield TableValue("", symbol, None, key, parameter[key], parameter["unit"])
    unit = model["error"].get("unit", "")
    for key, value in model["error"].items():
        if not isinstance(value, str):
            yield TableValue("", "error", None, key, value, _NO_UNIT if key in _WITHOUT_UNIT else unit)


class XlsxRenderer:
    """Results as a workbook of Office Open XML."""

    identifier = "xlsx"
    title = Words("Workbook of results (XLSX)")
    suffix = ".xlsx"
    needs_layout = False
    needs_job = True

    def render(self, certificate: Certificate) -> bytes:
        """Return the workbook."""
        from openpyxl import Workbook  # noqa: PLC0415 (slow to load)

        book = Workbook()
        book.remove(book.active)
        _Sheets(book, certificate).fill()
        moment = datetime.combine(certificate.issued, time()) if certificate.issued else datetime(*_NO_DATE)  # noqa: DTZ001 (a date that the job states has no zone)
        book.properties.created = moment
        book.properties.title = _clean(certificate.number)
        book.properties.creator = certificate.generator
        file = io.BytesIO()
        book.save(file)
        return _pack_alike(file.getvalue(), moment)


def _fill(cell: Any, value: float | str | _Shown) -> int:
    """Write a value into a cell; return how many characters it shows."""
    if isinstance(value, str):
        cell.value = _clean(value)
        cell.data_type = "s"  # never a formula
        return len(value[:_WIDEST_COLUMN])
    number, shown = (value.value, value.format) if isinstance(value, _Shown) else (value, "")
    cell.value = repr(number)  # all digits of the results file; openpyxl would write sixteen
    cell.data_type = "n"
    if not shown:
        return len(str(number))
    cell.number_format = shown
    return len(f"{number:.0f}") + len(shown) - 1


def _make_cells_of_parameter(parameter: Json) -> Iterator[_Cell]:
    """Yield the cells of a parameter: it and its U are shown as far as U has two digits."""
    shown, _ = rounded_pair(0.0, parameter.get("expanded_uncertainty") or 0.0)
    _, _, decimals = shown.partition(".")
    formats = {
        **dict.fromkeys(("value", "expanded_uncertainty"), f"0.{'0' * len(decimals)}" if decimals else "0"),
        "coverage_factor": _TWO_DECIMALS,
    }
    for key in _OF_ROW:
        value = parameter.get(key)
        yield _Shown(value, formats[key]) if key in formats and value is not None else value


def _make_cell_of_mean(key: str, value: float | None) -> _Cell:
    """Return the cell of a value by position; a number of readings is a whole one."""
    return value if value is None or key.startswith("n_") else _Shown(value, _THREE_DECIMALS)


def _round_as_read(value: float) -> float:
    """Return the decimal number that was read: not what the conversion to metres and back has made of it."""
    return float(f"{value:.{_SURE_DIGITS}g}")


class _Sheets:
    """Fills the sheets of one workbook."""

    def __init__(self, book: Any, certificate: Certificate) -> None:
        self._book = book
        self._certificate = certificate

    def fill(self) -> None:
        """Add every sheet that has something to say."""
        found = collect_results(self._certificate)
        for test, prefix in _list_measured(found):
            if test["evaluations"]:  # a line of several may have none of its own
                self._add_evaluations(test, self._name_sheets(prefix), _name_targets(test["measurements"]))
        parts = self._certificate.parts or {"": self._certificate}
        for name, part in parts.items():
            for line, measurements in (part.measurements.tests or {"": part.measurements}).items():
                self._add_readings(measurements, " ".join(filter(None, (name, line))))
        for name, part in found.get("parts", {"": found}).items():
            if part["model"]["parameters"]:
                self._add_model(part["model"], name)

    def _name_sheets(self, prefix: str) -> str:
        """Return how the sheets of a test are called: ``{sheet}``, ``{sheet} EYX``, ``{sheet} as found``."""
        names = prefix.rstrip(".").split(".")
        is_before = names[-1] == "as_found"
        title = " ".join(filter(None, ("{sheet}", *(names[:-1] if is_before else names))))
        return self._say(_AS_FOUND).replace("{sheet}", title) if is_before else title

    def _add_evaluations(self, found: Json, title: str, target: Words) -> None:
        missing = ", ".join(_list_missing(found))
        rows = [
            [
                self._certificate.number,
                evaluation["standard"],
                *_make_cells_of_parameter(parameter),
                self._say_decision(parameter),
                *([missing] if missing else ()),
            ]
            for evaluation in found["evaluations"]
            for parameter in evaluation["parameters"]
        ]
        headings = map(self._say, (*_PARAMETER_HEADINGS, *([_INCOMPLETE] if missing else ())))
        self._add_sheet(title.format(sheet=self._say(_PARAMETERS)), headings, rows)
        units = found["measurements"]["units"]
        positions = [
            (evaluation["standard"], position)
            for evaluation in found["evaluations"]
            for position in evaluation["positions"]
        ]
        keys = list(dict.fromkeys(key for _, position in positions for key in position if key != "target"))
        columns = [
            self._say(_STANDARD),
            f"{self._say(target)} / {units['position']}",
            *(key if key.startswith("n_") else f"{key} / {units['deviation']}" for key in keys),
        ]
        table = [
            [standard, row["target"], *(_make_cell_of_mean(key, row.get(key)) for key in keys)]
            for standard, row in positions
        ]
        if not table:
            return  # what follows from several lines has no positions
        sheet = self._add_sheet(title.format(sheet=self._say(_POSITIONS)), columns, table)
        drawn = [(2 + index, key) for index, key in enumerate(["target", *keys]) if key in _MEANS]
        of_first = sum(row[0] == table[0][0] for row in table)
        if drawn:
            self._add_chart(sheet, drawn, of_first, self._say(target), units)

    def _say_decision(self, parameter: Json) -> str | None:
        """Return what is stated of a limit, as the pages say it."""
        statement = parameter.get("decision", {}).get("statement")
        return self._say(CONFORMITY_STATEMENTS[Conformity(statement)][1]) if statement else None

    def _add_readings(self, measurements: MeasurementSet, name: str) -> None:
        if self._certificate.job and self._certificate.job.keys.agreement.simplified:
            return  # agreed with the customer: a document without them
        axis = measurements.axis
        units = ("", "", f" / {axis.position_unit.ascii}", f" / {axis.deviation_unit.ascii}")
        measurand = axis.measurand
        named = (*_READING_HEADINGS[:2], measurand.target, _DEVIATION) if measurand.is_continuous else None
        headings = [
            self._say(each) + unit for each, unit in zip(named or _READING_HEADINGS, units, strict=True)
        ]
        ways = [
            self._say(sense) if measurand.is_continuous else each.arrow
            for each, sense in zip(Approach, measurand.senses, strict=True)
        ]
        targets = axis.position_unit.from_si(measurements.target_positions)
        deviations = axis.deviation_unit.from_si(measurements.deviation)
        rows: list[list[_Cell]] = [
            [
                int(run),
                ways[Approach(approach).index],
                _round_as_read(targets[target]),
                None if deviation != deviation else _round_as_read(deviation),  # noqa: PLR0124 (what is missing is no number)
            ]
            for run, approach, target, deviation in zip(
                measurements.run, measurements.approach, measurements.target, deviations, strict=True
            )
        ]
        self._add_sheet(" ".join(filter(None, (self._say(_READINGS), name))), headings, rows)

    def _add_model(self, model: Json, name: str) -> None:
        rows = [
            [each["effect"], each["name"], each["value"], each["unit"], each.get("expanded_uncertainty")]
            for each in model["parameters"]
        ]
        title = " ".join(filter(None, (self._say(_MODEL), name)))
        self._add_sheet(title, map(self._say, _MODEL_HEADINGS), rows)

    def _add_sheet(self, title: str, headings: Iterable[str], rows: Iterable[Sequence[_Cell]]) -> Any:
        from openpyxl.styles import Font  # noqa: PLC0415 (slow to load)
        from openpyxl.utils import get_column_letter  # noqa: PLC0415 (slow to load)

        sheet = self._book.create_sheet(title[:_LONGEST_TITLE])
        widths: dict[int, int] = {}
        for number, row in enumerate([list(headings), *rows], start=1):
            for column, value in enumerate(row, start=1):
                if value is None:
                    continue
                cell = sheet.cell(number, column)
                widths[column] = max(widths.get(column, 0), _fill(cell, value))
                if number == 1:
                    cell.font = Font(bold=True)
        for column, width in widths.items():
            sheet.column_dimensions[get_column_letter(column)].width = width + 2
        sheet.freeze_panes = "A2"
        return sheet

    def _add_chart(
        self, sheet: Any, drawn: Sequence[tuple[int, str]], rows: int, target: str, units: Json
    ) -> None:
        """Add a chart of the means over the targets of the first standard, beside the table."""
        from openpyxl.chart import Reference, ScatterChart, Series  # noqa: PLC0415 (slow to load)
        from openpyxl.utils import get_column_letter  # noqa: PLC0415 (slow to load)

        chart = ScatterChart(scatterStyle="lineMarker")
        chart.x_axis.title = f"{target} / {units['position']}"
        chart.y_axis.title = f"{self._say(_DEVIATION)} / {units['deviation']}"
        chart.x_axis.delete = chart.y_axis.delete = False
        chart.x_axis.tickLblPos = "low"
        chart.width, chart.height = _CHART_CM
        targets = Reference(sheet, min_col=2, min_row=2, max_row=1 + rows)
        for column, key in drawn:
            values = Reference(sheet, min_col=column, min_row=1, max_row=1 + rows)
            series = Series(values, targets, title_from_data=True)
            series.smooth = False
            series.graphicalProperties.line.solidFill = _MEANS[key]
            series.marker.symbol = "triangle"
            chart.series.append(series)
        sheet.add_chart(chart, f"{get_column_letter(sheet.max_column + 2)}2")

    def _say(self, words: Words) -> str:
        return words.in_language(self._certificate.language)


def _name_targets(measurements: Json) -> Words:
    """Return what positions are of a measurement in a results file."""
    return CIRCLE.target if measurements.get("measurand") == CIRCLE.identifier else _TARGET


def _clean(text: str) -> str:
    return _NOT_IN_CELLS.sub("\N{REPLACEMENT CHARACTER}", text)[:_LONGEST_TEXT]


def _pack_alike(workbook: bytes, moment: datetime) -> bytes:
    """Return a workbook that tells of no other time than this, its XML as the standard library writes it."""
    stated = moment.isoformat().encode() + b"Z"
    file = io.BytesIO()
    with ZipFile(io.BytesIO(workbook)) as source, ZipFile(file, "w") as target:
        for name in source.namelist():
            content = _write_alike(_CLOCK.sub(rb"\g<1>" + stated, source.read(name)))
            target.writestr(ZipInfo(name, _NO_DATE), content, ZIP_DEFLATED)
    return file.getvalue()


def _write_alike(content: bytes) -> str:
    """Write XML in one form, whichever library has written it."""
    written = io.StringIO()
    names = {found for _, found in iterparse(io.BytesIO(content), ["start-ns"])}  # noqa: S314 - openpyxl's own
    parser = make_parser()  # noqa: S317 - the same
    parser.setFeature(feature_namespaces, True)  # noqa: FBT003 - it has no name
    parser.setContentHandler(_NamesAtRoot(written, sorted(names)))
    parser.parse(io.BytesIO(content))
    return written.getvalue()


class _NamesAtRoot(XMLGenerator):
    """Declares all namespaces at the root: lxml leaves each where it is used."""

    def __init__(self, written: io.StringIO, names: Iterable[tuple[str, str]]) -> None:
        super().__init__(written, "utf-8", short_empty_elements=True)
        for prefix, address in names:
            super().startPrefixMapping(prefix, address)

    def startPrefixMapping(self, prefix: str | None, uri: str) -> None:  # noqa: N802 - the library's name
        """Leave it: it stands at the root."""

    def endPrefixMapping(self, prefix: str | None) -> None:  # noqa: N802 - the same
        """Leave it."""


@hookimpl
def zlmreport_renderers() -> list[Renderer]:
    """Offer the numbers of the results file as tables: of one value a row, and as a workbook."""
    return [CsvRenderer(), XlsxRenderer()]
