"""Data source ``renishaw-rtl``: linear (``.rtl``) and angular (``.rta``) tests of laser interferometers."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import DataSource, hookimpl
from zlmreport_plugins.sources.renishaw_rtl.source import RenishawRtl


@hookimpl
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the reader of Renishaw's test files."""
    return [RenishawRtl()]
