"""Data source ``laser-csv``: tables of readings, as the contract with users lays them out."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

from zlmreport.plugin import (
    DataSource,
    InputError,
    MeasurementSet,
    Options,
    Problem,
    Provenance,
    SourceContext,
    SourceProposal,
    Words,
    collect_readings,
    hookimpl,
    read_text,
)
from zlmreport_plugins.sources.laser_csv.columns import Cells, Column, decimal_sign, heading_of
from zlmreport_plugins.sources.laser_csv.layouts import LongLayout, WideLayout, long_layout, wide_layout
from zlmreport_plugins.sources.laser_csv.options import (
    COLUMN_NAMES,
    LaserCsvOptions,
    folded,
    run_and_direction,
)
from zlmreport_plugins.sources.laser_csv.table import read_table

_NAMES = {
    "deviation": Words(en="deviations", de="Abweichungen"),
    "position": Words(en="actual positions", de="Istpositionen"),
}

_ENCODINGS = (None, "cp1252", "utf-16")
_DELIMITERS = ("\t", ";", ",")
#: Lines that are looked through for a header.
_DEEPEST = 60
#: How columns are called in files, folded, by what they are.
_CALLED = MappingProxyType(
    {
        name: column
        for column, names in {
            "target": "soll sollposition soll_position sollwert nominal nominal_position target_position "
            "zielposition pos_soll p_soll command commanded programmed",
            "position": "ist istposition ist_position istwert actual actual_position measured pos_ist p_ist",
            "deviation": "abweichung abw fehler error dev deviations positionsabweichung messabweichung",
            "direction": "richtung dir approach anfahrrichtung verfahrrichtung",
            "run": "lauf messlauf zyklus durchlauf cycle run_number repetition wiederholung",
            "time": "zeit timestamp uhrzeit",
            "air_temperature": "lufttemperatur air_temp t_luft t_air",
            "material_temperature": "materialtemperatur material_temp t_mat",
            "axis_temperature": "maßstabstemperatur scale_temperature t_achse",
            "air_pressure": "luftdruck pressure druck",
            "relative_humidity": "luftfeuchte humidity feuchte",
        }.items()
        for name in names.split()
    }
)
_UNIT_ASKED = (
    "Are the deviations in µm (arc seconds, where the axis is rotary)? The header names no unit; if they are "
    "in mm, say units: {deviation: mm}."
)
_DIRECTION_ASKED = "Were all readings taken upwards? The table names no direction; else say direction: '-'."
_SIGN_ASKED = (
    "Is the deviation actual − nominal? No file tells; if it is nominal − actual, say sign: nominal-actual."
)


def remarks(layout: LongLayout | WideLayout, options: LaserCsvOptions) -> Iterator[Words]:
    """Yield what a reader of the results must know of the table."""
    target, values = layout.columns[0], layout.value_columns
    yield Words(
        en="Target positions from the column {target}, {quantity} from {values}.",
        de="Sollpositionen aus der Spalte {target}, {quantity} aus {values}.",
    ).given(target=_with_unit(target), quantity=_NAMES[values[0].name], values=_listed(values))
    if options.sign == "nominal-actual":
        yield Words(
            en="The file gives deviations as nominal − actual; their sign was exchanged on reading.",
            de="Die Datei gibt Abweichungen als Soll − Ist an; ihr Vorzeichen wurde beim Lesen getauscht.",
        )
    if options.direction:
        yield Words(
            en="The direction of approach is not in the file; the job states it ({direction}).",
            de="Die Anfahrrichtung steht nicht in der Datei; der Auftrag gibt sie an ({direction}).",
        ).given(direction=options.direction)
    if isinstance(layout, WideLayout):
        yield Words(
            en="The table does not tell the order of the readings: they are listed run by run, upwards and "
            "then downwards.",
            de="Die Tabelle nennt die Reihenfolge der Messwerte nicht: Sie sind Durchlauf für Durchlauf "
            "aufgeführt, erst aufwärts, dann abwärts.",
        )
    else:
        if layout.run is None:
            yield Words(
                en="The file names no runs: all readings were taken as one run.",
                de="Die Datei nennt keine Durchläufe: Alle Messwerte gelten als ein Durchlauf.",
            )
        yield from _other_conditions(layout.conditions)
    if options.ignore:
        yield Words(en="Columns not read: {names}.", de="Nicht gelesene Spalten: {names}.").given(
            names=", ".join(options.ignore)
        )


def _other_conditions(conditions: Iterable[Column]) -> Iterator[Words]:
    others = [condition.text for condition in conditions if condition.name not in COLUMN_NAMES]
    if others:
        yield Words(
            en="Columns kept as conditions, as found: {names}.",
            de="Als Bedingungen unverändert übernommene Spalten: {names}.",
        ).given(names=", ".join(others))


def _listed(columns: Sequence[Column]) -> Words:
    """Return the column with its unit; of several, the first and the last."""
    if len(columns) == 1:
        return _with_unit(columns[0])
    first, last = _with_unit(columns[0]), _with_unit(columns[-1])
    return Words(en="{first} to {last}", de="{first} bis {last}").given(first=first, last=last)


def _with_unit(column: Column) -> Words:
    words = Words(en="“{name}” ({unit})", de="„{name}“ ({unit})")
    return words.given(name=column.text, unit=column.unit.symbol if column.unit else "")


class LaserCsv:
    """Tables of readings: text with a header row."""

    identifier = "laser-csv"
    title = Words(en="Table of readings (CSV)", de="Messwerttabelle (CSV)")
    options: type[Options] = LaserCsvOptions
    suffixes = (".csv", ".tsv", ".txt", ".xlsx")

    def proposals(self, file: Path) -> Iterable[SourceProposal]:
        """Return the keys by which a table that somebody else laid out may be read."""
        from zlmreport_plugins.sources.laser_csv import proposals

        return proposals(file)

    def read(self, options: LaserCsvOptions, context: SourceContext) -> MeasurementSet:
        """Read a table; raise `InputError` with every defect and its place."""
        text = read_text(options.file, options.encoding)
        table = read_table(
            text,
            delimiter=options.stated_delimiter,
            lines=options.lines,
            names_column=lambda name: _names_column(name, options),
        )
        layout = (wide_layout if options.layout == "wide" else long_layout)(table, options, context)
        sign = options.stated_decimal_sign or decimal_sign(
            table, [column.index for column in layout.number_columns()]
        )
        cells = Cells(table, sign)
        readings = list(layout.readings(cells, -1.0 if options.sign == "nominal-actual" else 1.0))
        problems: list[Problem] = [*table.problems, *cells.problems]
        provenance = Provenance(self.identifier, (text.source,), tuple(remarks(layout, options)))
        return collect_readings(readings, context.axis, provenance, place=text.place(), problems=problems)


def _names_column(text: str, options: LaserCsvOptions) -> bool:
    """Whether a header is a name that this source or the job knows."""
    named = heading_of(text)
    return (
        folded(named.name) in COLUMN_NAMES
        or any(named.is_called(name) for name in (*options.columns.values(), *options.ignore))
        or (options.layout == "wide" and run_and_direction(named.name) is not None)
    )


@dataclass(frozen=True, slots=True)
class _Header:
    """A row that names columns."""

    index: int  #: Of the line, from 0.
    delimiter: str  #: What parts the cells.
    cells: tuple[str, ...]  #: The names.
    known: int  #: How many of them are known.


def proposals(file: Path) -> Iterator[SourceProposal]:
    """Yield the keys by which a table may be read, and what only its author can say."""
    for encoding in _ENCODINGS:
        try:
            lines = read_text(file, encoding).lines
        except InputError:
            continue
        header = _header(lines)
        if header:
            keys: dict[str, Any] = {"encoding": encoding} if encoding else {}
            yield _proposal(keys, lines, header)
        return


def _header(lines: Sequence[str]) -> _Header | None:
    """Return the row with the most known names; None if no row has two."""
    found = [
        _Header(index, delimiter, cells, sum(_meaning(cell) is not None for cell in cells))
        for index, line in enumerate(lines[:_DEEPEST])
        if not line.lstrip().startswith("#")
        for delimiter in _DELIMITERS
        if len(cells := tuple(cell.strip().strip('"') for cell in line.split(delimiter))) > 1
    ]
    best = max(found, key=lambda each: each.known, default=None)
    return best if best and best.known > 1 else None


def _meaning(cell: str) -> str | None:
    """Return what a column is by its name: one of `COLUMN_NAMES`, ``run`` of a wide table, or None."""
    name = folded(heading_of(cell).name)
    if name in COLUMN_NAMES:
        return name
    if name in _CALLED:
        return _CALLED[name]
    return "reading" if run_and_direction(heading_of(cell).name) else None


def _proposal(keys: dict[str, Any], lines: Sequence[str], header: _Header) -> SourceProposal:
    meanings = [_meaning(cell) for cell in header.cells]
    rows = _rows(lines, header)
    is_wide = meanings.count("reading") > 1
    if is_wide and "target" not in meanings:  # beside readings of runs, "position" is where the axis was sent
        meanings = ["target" if meaning == "position" else meaning for meaning in meanings]
    columns = _columns(header, meanings, is_wide=is_wide)
    asked = []
    if is_wide:
        keys["layout"] = "wide"
        if _holds_positions(rows, meanings):
            keys["values"] = "position"
        else:
            asked += [_SIGN_ASKED, _UNIT_ASKED]
    elif "deviation" in meanings:
        asked.append(_SIGN_ASKED)
        if heading_of(header.cells[meanings.index("deviation")]).bracket is None:
            asked.append(_UNIT_ASKED)
    if not is_wide and "direction" not in meanings:
        keys["direction"] = "+"
        asked.append(_DIRECTION_ASKED)
    if columns:
        keys["columns"] = columns
    ignored = _words(header, meanings, rows, is_wide=is_wide)
    if ignored:
        keys["ignore"] = ignored
    content = [number for number, line in enumerate(lines, 1) if line.strip() and line.lstrip()[0] != "#"]
    last = header.index + 1 + max((number for number, _ in rows), default=0)
    if rows and (content[0] != header.index + 1 or content[-1] != last):
        keys["lines"] = [header.index + 1, last]
    return SourceProposal(keys, tuple(asked))


def _columns(header: _Header, meanings: Sequence[str | None], *, is_wide: bool) -> dict[str, str]:
    """Return the file's own names of columns, by what they are; the first of several that mean the same."""
    found: dict[str, str] = {}
    for cell, meaning in zip(header.cells, meanings, strict=True):
        name = heading_of(cell).name
        wanted = meaning in COLUMN_NAMES and (not is_wide or meaning == "target")
        if meaning and wanted and folded(name) != meaning:
            found.setdefault(meaning, name)
    return found


def _rows(lines: Sequence[str], header: _Header) -> list[tuple[int, tuple[str, ...]]]:
    """Return the rows below a header that hold numbers, each with its distance from the header."""
    below = [
        (number, tuple(cell.strip().strip('"') for cell in line.split(header.delimiter)))
        for number, line in enumerate(lines[header.index + 1 :], 1)
    ]
    return [
        (number, cells) for number, cells in below if sum(_number(cell) is not None for cell in cells) > 1
    ]


def _number(cell: str) -> float | None:
    try:
        return float(cell.replace("−", "-").replace(",", "."))
    except ValueError:
        return None


def _holds_positions(rows: Sequence[tuple[int, tuple[str, ...]]], meanings: Sequence[str | None]) -> bool:
    """Return whether the readings of a wide table go with its targets: they are positions then."""
    if "target" not in meanings:
        return False
    at, first = meanings.index("target"), meanings.index("reading")
    pairs = [
        (target, value)
        for _, cells in rows
        if len(cells) > max(at, first)
        and (target := _number(cells[at])) is not None
        and (value := _number(cells[first])) is not None
    ]
    travel = max((target for target, _ in pairs), default=0.0) - min(
        (target for target, _ in pairs), default=0.0
    )
    return travel > 0 and all(abs(value - target) < 0.01 * travel for target, value in pairs)


def _words(
    header: _Header,
    meanings: Sequence[str | None],
    rows: Sequence[tuple[int, tuple[str, ...]]],
    *,
    is_wide: bool,
) -> list[str]:
    """Return the columns of which nobody knows what they are, and that hold other things than numbers."""
    found = []
    for index, (cell, meaning) in enumerate(zip(header.cells, meanings, strict=True)):
        cells = [cells[index] for _, cells in rows if index < len(cells) and cells[index]]
        holds_words = any(_number(each) is None for each in cells)
        is_unknown = meaning not in ({"target", "reading"} if is_wide else {*COLUMN_NAMES})
        if cell and is_unknown and (is_wide or holds_words):
            found.append(cell)
    return found


@hookimpl
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the reader of tables."""
    return [LaserCsv()]
