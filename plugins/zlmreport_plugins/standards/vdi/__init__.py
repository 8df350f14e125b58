"""VDI/DGQ 3441 and VDI/VDE 2617: the same algebra with 3 and with 2 standard deviations."""

from __future__ import annotations

from zlmreport.plugin import Standard, hookimpl
from zlmreport_plugins.standards.vdi.guidelines import GUIDELINES
from zlmreport_plugins.standards.vdi.standard import VdiGuideline


@hookimpl
def zlmreport_standards() -> tuple[Standard, ...]:
    """Return the two guidelines."""
    return tuple(VdiGuideline(guideline) for guideline in GUIDELINES)
