"""Parts of a guess about an unknown table: its lines, decimal sign, units, words for missing readings."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from statistics import median
from typing import Any

from zlmreport.plugin import listed
from zlmreport.plugin.table import (
    DELIMITERS,
    PARTED_BY_BLANKS,
    THOUSANDS_SIGNS,
    UNITS_IN_TABLES,
    find_sentinels,
    first_cell,
)
from zlmreport_plugins.sources.laser_csv import questions
from zlmreport_plugins.sources.laser_csv.layouts import read_heading
from zlmreport_plugins.sources.laser_csv.meanings import READING, find_meaning, read_number
from zlmreport_plugins.sources.laser_csv.tables import FoundTable

#: What stands for a missing reading, in lower case.
_MISSING = frozenset(
    (
        *("-", "--", "---", "–", "—", "?", "*", "x", "n/a", "na", "n.a.", "nan", "null", "none"),
        *("missing", "fehlt", "invalid", "ungültig", "error", "err", "(null)", "void", "lost", "no signal"),
        *("over", "overflow", "overrange", "overload", "ol"),
        *("无", "無", "缺", "缺失", "无效", "無效"),
        *("#n/a", "#nv", "#wert!", "#value!", "#div/0!"),
    )
)
#: Spellings of units that mean another one elsewhere, or are none of the program's.
_UNITS = {
    "grad": "deg",
    **dict.fromkeys(("mikrometer", "micrometer", "micrometers", "my"), "um"),
    **dict.fromkeys(("millimeter", "millimetre"), "mm"),
    "zoll": "inch",
    **dict.fromkeys(("bogensekunde", "bogensekunden", "winkelsekunden", "sek", "arc", '"', "''"), "arcsec"),
}
_NAMED_UNIT = re.compile(
    r"(?:abweich|deviation|einheit|unit|error|fehler|werte|values|readings|messwert|单位|單位|偏差|误差)[^;\t]*?"
    r"[\s(\[（=:：;\t,](µm|μm|um|mm|nm|µin|uin|arcsec|″|µrad|urad|微米|毫米|角秒)(?![\w/])",
    re.IGNORECASE,
)
_LONGEST_BEGINNING = 40


@dataclass
class Draft:
    """What is proposed so far."""

    table: FoundTable
    keys: dict[str, Any] = field(default_factory=dict)
    asks: list[str] = field(default_factory=list)
    columns: dict[str, str] = field(default_factory=dict)
    units: dict[str, str] = field(default_factory=dict)
    ignored: list[str] = field(default_factory=list)

    def find_column(self, what: str) -> int | None:
        """Return the place of a column; None if there is none."""
        return list(self.table.meanings).index(what) if what in self.table.meanings else None

    def count_runs(self) -> None:
        """Let runs be counted, and ask whether they may."""
        self.keys["runs"] = "counted"
        runs = [name for name in self.ignored if find_meaning(name) == "run"]
        not_read = questions.RUNS_NOT_READ_ASKED.format(name=repr(runs[0])) if runs else ""
        self.asks.append(not_read or questions.RUNS_ASKED)

    def name_column(self, index: int) -> str:
        """Return the name of a column."""
        return self.table.header.cells[index]


def place_table(draft: Draft) -> None:
    """Say where the table stands, and how it is laid out."""
    table, keys = draft.table, draft.keys
    keys |= table.found.keys
    if table.layout.skipped:
        keys["skip_rows"] = table.layout.skipped
    if table.layout.delimiter == PARTED_BY_BLANKS:
        keys["delimiter"] = PARTED_BY_BLANKS
    elif not table.found.text.of_cells and (table.layout.is_transposed or not table.layout.header_rows):
        first = next(line for line_number, line in table.found.lines if line_number > table.layout.skipped)
        if any(each in first for each in DELIMITERS if each != table.layout.delimiter):
            keys["delimiter"] = DELIMITERS[table.layout.delimiter]
    if table.layout.is_transposed:
        keys["transposed"] = True
    if table.layout.header_rows == 2:
        keys["header_rows"] = 2
    below = [row for row in table.below if any(row.cells)]
    if below:
        beginning = _strip_number_at_end(first_cell(below[0].cells)[:_LONGEST_BEGINNING].strip())
        data = (first_cell(row.cells).casefold() for row in table.rows)
        is_clear = beginning and read_number(beginning, table.notation) is None
        if is_clear and not any(each.startswith(beginning.casefold()) for each in data):
            keys["ends_before"] = beginning
        elif not table.layout.is_transposed:
            keys.pop("skip_rows", None)
            keys["lines"] = [table.header.line or table.rows[0].line, table.rows[-1].line]


def _strip_number_at_end(text: str) -> str:
    """Return the beginning of a line that holds from one file to the next: ``Operator: Miller`` its name."""
    head, colon, _ = text.partition(":")
    return f"{head}:" if colon and head else text


def note_notation(draft: Draft) -> None:
    """Say what parts thousands, and what stands for a missing reading."""
    table = draft.table
    measured = [
        index
        for index, each in enumerate(table.meanings)
        if each in {"target", "deviation", "position", READING}
    ]
    if table.notation.thousands:
        draft.keys["thousands"] = next(
            name for name, signs in THOUSANDS_SIGNS.items() if table.notation.thousands in signs
        )
    elif table.notation.is_open:
        draft.keys["decimal"] = table.notation.decimal.name.lower()
        draft.asks.append(questions.DECIMAL_ASKED.format(sign=table.notation.decimal.name.lower()))
    words = {
        cell
        for index in measured
        for cell in table.list_cells(index)
        if cell and read_number(cell, table.notation) is None
    }
    lost = {
        cell
        for index in measured
        if table.meanings[index] != "target"
        for cell in find_sentinels(table.list_cells(index), table.notation.decimal)
    }
    if (words or lost) and all(word.casefold() in _MISSING for word in words):
        draft.keys["missing"] = sorted(words | lost)
        draft.asks.append(questions.MISSING_ASKED.format(words=listed(map(repr, sorted(words | lost)), "or")))


def name_unit(what: str, draft: Draft, target: int, *columns: int) -> None:
    """Say in which unit values are: as named, else as said above the table, else by their size."""
    table = draft.table
    if is_unit_known(what, draft, columns[0]) or what == "position":
        return
    above = [line for line_number, line in table.found.lines if line_number <= table.layout.skipped]
    named = {match[1].casefold().replace("μ", "µ") for line in above for match in _NAMED_UNIT.finditer(line)}
    if len(named) == 1:
        draft.units[what] = named.pop()
        return
    values = [abs(value) for index in columns for value in table.list_numbers(index) if value]
    travel = [value for value in table.list_numbers(target) if value is not None]
    is_small = bool(values) and max(values) < 0.5 and median(values) < 0.1 and max(travel) - min(travel) >= 5
    if is_small:
        draft.units[what] = "mm"
        reason, unit, other = "values so small are rarely in µm; ", "mm", "µm"
    else:
        reason, unit, other = "", "µm (arc seconds, where the axis is rotary)", "mm"
    draft.asks.append(questions.UNIT_ASKED.format(unit=unit, reason=reason, other=other))


def is_unit_known(what: str, draft: Draft, index: int) -> bool:
    """Return whether the table names the unit of a column, and say which one if it spells it otherwise."""
    table = draft.table
    below = table.units.cells[index] if table.units and index < len(table.units.cells) else ""
    behind = next((cell.lstrip("+-−0123456789.,'’ \u00a0") for cell in table.list_cells(index) if cell), "")
    for spelling in (
        read_heading(table.header.cells[index]).bracket or "",
        below.strip("()[]（）【】 "),
        behind.strip(),
    ):
        if spelling.casefold() in _UNITS:
            draft.units[what] = _UNITS[spelling.casefold()]
            if spelling.casefold() == "grad":
                draft.asks.append(questions.GRADE_ASKED)
            return True
        if spelling.casefold() in UNITS_IN_TABLES:
            return True
    return False
