"""Data source ``ecmc``: ``KEY=VALUE`` logs of positioning tests (``.dat``)."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import DataSource, hookimpl
from zlmreport_plugins.sources.ecmc.source import Ecmc


@hookimpl
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the reader of ecmc logs."""
    return [Ecmc()]
