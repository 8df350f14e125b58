"""Data source ``laser-csv``: tables of readings, as the contract with users lays them out."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from zlmreport.plugin import (
    DataSource,
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
from zlmreport_plugins.sources.laser_csv.cells import Cells, decimal_sign
from zlmreport_plugins.sources.laser_csv.columns import Column, heading_of
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
    suffixes = (".csv", ".tsv", ".txt")

    def proposals(self, file: Path) -> Iterable[SourceProposal]:
        """Return the keys by which a table that somebody else laid out may be read."""
        from zlmreport_plugins.sources.laser_csv.guess import proposals

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


@hookimpl
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the reader of tables."""
    return [LaserCsv()]
