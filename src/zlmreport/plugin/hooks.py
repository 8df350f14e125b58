"""The mark of a plugin's functions that answer hooks; `zlmreport.plugin.kinds` says which hooks there are."""

from __future__ import annotations

import pluggy

PROJECT = "zlmreport"
#: Marks a plugin's functions that answer hooks.
hookimpl = pluggy.HookimplMarker(PROJECT)
