"""Finds plugins by their entry points and in files that the user names; answers by name, or says why not.

Every plugin is asked by itself, in the order of names: so one that fails neither ends the program nor
vanishes, and nothing depends on the order in which plugins were installed.
"""

from __future__ import annotations

from zlmreport.plugins.collect import collect
from zlmreport.plugins.find import FILES, find_plugins
from zlmreport.plugins.kind import Kind
from zlmreport.plugins.origin import FailedPlugin, Plugin
from zlmreport.plugins.registry import DISABLE, Registry

__all__ = ["DISABLE", "FILES", "FailedPlugin", "Kind", "Plugin", "Registry", "collect", "find_plugins"]
