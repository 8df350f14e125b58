"""PTB's Digital Calibration Certificate 3.3.0."""

from __future__ import annotations

from zlmreport.plugin import hookimpl
from zlmreport_plugins.renderers.dcc.renderer import DccRenderer


@hookimpl
def zlmreport_renderers() -> list[DccRenderer]:
    """Offer the renderer."""
    return [DccRenderer()]
