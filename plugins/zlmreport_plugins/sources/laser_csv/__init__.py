"""Data source ``laser-csv``: tables of readings, as the contract with users lays them out."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import DataSource, hookimpl
from zlmreport_plugins.sources.laser_csv.source import LaserCsv


@hookimpl
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the reader of tables."""
    return [LaserCsv()]
