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
    find_column_with_unit as column_with_unit,
    find_decimal_sign as decimal_sign,
    find_heading,
    fold as folded,
    read_heading as heading_of,
    read_headings,
    report_missing_column as missing_column,
    take_thousands_off as without_thousands,
)
from zlmreport.measurement.sentinels import find_sentinels
from zlmreport.measurement.table import (
    BLANKS as PARTED_BY_BLANKS,
    DELIMITERS,
    THOUSANDS as THOUSANDS_SIGNS,
    UNITS as UNITS_IN_TABLES,
    EnclosureError,
    TextRow,
    TextTable,
    find_first_cell as first_cell,
    is_units as holds_units,
    join_header as joined_header,
    join_whole_lines as whole_lines,
    part_line as parted_line,
    read_table,
    states_delimiter,
)
from zlmreport.measurement.times import (
    ReadTime,
    find_days as days_of_readings,
    make_time_reader as time_reader,
    read_moment as moment,
)

__all__ = [
    "DELIMITERS",
    "PARTED_BY_BLANKS",
    "THOUSANDS_SIGNS",
    "UNITS_IN_TABLES",
    "Cells",
    "EnclosureError",
    "Heading",
    "ReadTime",
    "TableOptions",
    "TablePlace",
    "TextColumn",
    "TextRow",
    "TextTable",
    "column_with_unit",
    "days_of_readings",
    "decimal_sign",
    "find_heading",
    "find_sentinels",
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
