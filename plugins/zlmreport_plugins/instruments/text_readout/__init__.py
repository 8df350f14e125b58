"""Instrument ``text-readout``: any readout that prints a number a line."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import Instrument, hookimpl
from zlmreport_plugins.instruments.text_readout.instrument import TextReadout


@hookimpl
def zlmreport_instruments() -> Iterable[Instrument]:
    """Return the readout."""
    return [TextReadout()]
