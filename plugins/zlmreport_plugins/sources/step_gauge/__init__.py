"""Data source ``step-gauge``: the faces of a step gauge as a machine has probed them."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import hookimpl
from zlmreport.plugin.protocols import DataSource
from zlmreport_plugins.sources.step_gauge.source import StepGaugeSource


@hookimpl
def zlmreport_sources() -> Iterable[DataSource]:
    """Return the reader of probed faces."""
    return [StepGaugeSource()]
