"""Finds plugins by their entry points and in files that the user names; answers by name, or says why not.

Every plugin is asked by itself, in the order of names: so one that fails neither ends the program nor
vanishes, and nothing depends on the order in which plugins were installed. None is
loaded before it is needed.
"""

from __future__ import annotations

from zlmreport.plugin.registry.candidate import DISABLE, FILES, FailedPlugin, Plugin
from zlmreport.plugin.registry.find import find_plugins
from zlmreport.plugin.registry.registry import Offer, Registry, collect

__all__ = ["DISABLE", "FILES", "FailedPlugin", "Offer", "Plugin", "Registry", "collect", "find_plugins"]
