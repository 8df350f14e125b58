"""Where a plugin comes from, and why one does not work."""

from __future__ import annotations

import traceback
from dataclasses import dataclass
from pathlib import Path

import pluggy

#: Environment variable that switches plugins off.
DISABLE = "ZLMREPORT_DISABLE_PLUGINS"

_LONGEST_REASON = 300


@dataclass(frozen=True, slots=True)
class Plugin:
    """Where a plugin comes from.

    Attributes
    ----------
    name
        Of its entry point; of a plugin in a file of its own, the file's without its suffix.
    module
        That the entry point names, or the file.
    distribution, version
        What was installed; empty for a file.
    """

    name: str
    module: str = ""
    distribution: str = ""
    version: str = ""

    @property
    def release(self) -> str:
        """Distribution and version: ``zlmreport 0.1.0``."""
        return f"{self.distribution} {self.version}".strip()

    @property
    def in_words(self) -> str:
        """As messages call it: ``plugin house (zlmreport-house 1.0)``, or the file."""
        where = self.release or self.module
        return f"plugin {self.name} ({where})" if where else f"plugin {self.name}"


@dataclass(frozen=True, slots=True)
class FailedPlugin:
    """A plugin that could not be loaded, and why."""

    plugin: Plugin
    reason: str


class UnfitError(Exception):
    """A plugin offers something that is not what its hook asks for."""


def reason_of(error: BaseException) -> str:
    """Return in one line why a plugin fails, with the line of it that does."""
    message = " ".join(str(error).split())[:_LONGEST_REASON]
    if isinstance(error, UnfitError | ImportError | SyntaxError | pluggy.PluginValidationError):
        return message
    if isinstance(error, OSError):
        return message or type(error).__name__
    frames = traceback.extract_tb(error.__traceback__)
    where = f" ({Path(frames[-1].filename).name}, line {frames[-1].lineno})" if frames else ""
    return f"{type(error).__name__}{f': {message}' if message else ''}{where}"
