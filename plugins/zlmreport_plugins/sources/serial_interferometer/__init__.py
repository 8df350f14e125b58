"""Data source ``serial-interferometer``: readings that were captured live, from their journal."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import DataSource, hookimpl
from zlmreport_plugins.sources.serial_interferometer.source import SerialInterferometer


@hookimpl
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the reader of journals."""
    return [SerialInterferometer()]
