"""Instruments ``umd0``, ``umd1``, ``umd2``: laser interferometers with a µMD display."""

from __future__ import annotations

from collections.abc import Iterable

from zlmreport.plugin import Instrument, hookimpl
from zlmreport_plugins.instruments.umd.instrument import Umd
from zlmreport_plugins.instruments.umd.models import MODELS


@hookimpl
def zlmreport_instruments() -> Iterable[Instrument]:
    """Return the three displays."""
    return [Umd(model) for model in MODELS]
