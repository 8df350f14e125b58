"""Instrument ``ids3010``: attocube fibre interferometers."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import Instrument, hookimpl
from zlmreport_plugins.instruments.ids3010.instrument import Ids3010


@hookimpl
def zlmreport_instruments() -> Iterable[Instrument]:
    """Return the interferometer."""
    return [Ids3010()]
