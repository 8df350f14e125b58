"""What is installed, found once for all tests."""

from __future__ import annotations

from functools import cache

from zlmreport.plugin.registry import Registry, find_plugins


@cache
def registry() -> Registry:
    """Return the installed plugins."""
    return find_plugins()
