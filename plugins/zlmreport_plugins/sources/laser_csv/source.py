"""The data source ``laser-csv``."""

from __future__ import annotations

from zlmreport.plugin import (
    MeasurementSet,
    Options,
    Problem,
    Provenance,
    SourceContext,
    Words,
    collect_readings,
    read_text,
)
from zlmreport_plugins.sources.laser_csv.cells import Cells
from zlmreport_plugins.sources.laser_csv.columns import heading_of
from zlmreport_plugins.sources.laser_csv.decimal_sign import decimal_sign
from zlmreport_plugins.sources.laser_csv.long_layout import long_layout
from zlmreport_plugins.sources.laser_csv.names import COLUMN_NAMES, folded, run_and_direction
from zlmreport_plugins.sources.laser_csv.options import LaserCsvOptions
from zlmreport_plugins.sources.laser_csv.remarks import remarks
from zlmreport_plugins.sources.laser_csv.table import read_table
from zlmreport_plugins.sources.laser_csv.wide_layout import wide_layout


class LaserCsv:
    """Tables of readings: text with a header row."""

    identifier = "laser-csv"
    title = Words(en="Table of readings (CSV)", de="Messwerttabelle (CSV)")
    options: type[Options] = LaserCsvOptions

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
