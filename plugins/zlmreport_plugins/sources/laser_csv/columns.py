"""The columns of readings at targets: their names, which may hold directions, and their units."""

from __future__ import annotations

from collections.abc import Mapping

from zlmreport.plugin import CONDITIONS, SECOND, TIME_UNITS, Axis, ReadingScale, Unit
from zlmreport.plugin.source import SourceContext
from zlmreport.plugin.table import Heading, TextColumn, TextTable, column_with_unit, heading_of
from zlmreport_plugins.sources.laser_csv.options import LaserCsvOptions, names_direction


def read_heading(text: str) -> Heading:
    """Return a name in a header, its unit taken off; a direction in brackets belongs to the name.

    >>> read_heading("Run (up)").name
    'Run up'
    """
    return heading_of(text, is_no_unit=names_direction)


def find_column_of(
    name: str, heading: Heading, options: LaserCsvOptions, context: SourceContext, table: TextTable
) -> TextColumn:
    """Return a known column with its unit; raise `InputError` if the unit is none of its quantity."""
    return column_with_unit(name, heading, options, _list_units(name, context.axis), context.place, table)


def _list_units(
    name: str, axis: Axis
) -> tuple[Mapping[str, Unit | ReadingScale], Unit | ReadingScale] | None:
    """Return the units that a column may have by their spellings, and the usual one."""
    if name in {"target", "position"}:
        return axis.position_units, axis.position_unit
    if name == "deviation":
        return axis.deviation_units, axis.deviation_unit
    if name == "time":
        return TIME_UNITS, SECOND
    return (CONDITIONS[name].units, CONDITIONS[name].unit) if name in CONDITIONS else None
