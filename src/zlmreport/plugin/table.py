"""The door of data sources that read tables: their keys, rows, columns and cells."""

from __future__ import annotations

from zlmreport.job.table_keys import (
    TableOptions,
    TablePlace,
)
from zlmreport.measurement.columns import (
    Cells,
    Heading,
    TextColumn,
    column_with_unit,
    decimal_sign,
    find_heading,
    folded,
    heading_of,
    missing_column,
    read_headings,
    without_thousands,
)
from zlmreport.measurement.table import (
    BLANKS as PARTED_BY_BLANKS,
    DELIMITERS,
    THOUSANDS as THOUSANDS_SIGNS,
    UNITS as UNITS_IN_TABLES,
    EnclosureError,
    Row as TextRow,
    TextTable,
    first_cell,
    is_units as holds_units,
    joined_header,
    parted as parted_line,
    read_table,
    states_delimiter,
    whole_lines,
)
from zlmreport.measurement.times import (
    moment,
    time_reader,
)

__all__ = [
    "DELIMITERS",
    "PARTED_BY_BLANKS",
    "THOUSANDS_SIGNS",
    "UNITS_IN_TABLES",
    "Cells",
    "EnclosureError",
    "Heading",
    "TableOptions",
    "TablePlace",
    "TextColumn",
    "TextRow",
    "TextTable",
    "column_with_unit",
    "decimal_sign",
    "find_heading",
    "first_cell",
    "folded",
    "heading_of",
    "holds_units",
    "joined_header",
    "missing_column",
    "moment",
    "parted_line",
    "read_headings",
    "read_table",
    "states_delimiter",
    "time_reader",
    "whole_lines",
    "without_thousands",
]
