"""The NMTBA recommendation of 1972 for machine tools."""

from __future__ import annotations

from zlmreport.plugin import Standard, hookimpl
from zlmreport_plugins.standards.nmtba.standard import Nmtba


@hookimpl
def zlmreport_standards() -> tuple[Standard, ...]:
    """Return the one recommendation."""
    return (Nmtba(),)
