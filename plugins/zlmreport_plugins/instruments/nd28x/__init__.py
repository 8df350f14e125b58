"""Instrument ``nd28x``: HEIDENHAIN position displays."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import Instrument, hookimpl
from zlmreport_plugins.instruments.nd28x.instrument import Nd28x


@hookimpl
def zlmreport_instruments() -> Iterable[Instrument]:
    """Return the displays."""
    return [Nd28x()]
