"""The example on which the pages are tried."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from zlmreport.plugin.registry import Registry, find_plugins

#: An axis whose model lacks the error of its screw.
EXAMPLE = Path(__file__).parents[2] / "configs" / "hidden-effect"


@cache
def registry() -> Registry:
    """Return all plugins."""
    return find_plugins()
