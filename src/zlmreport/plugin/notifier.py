"""The door of notifiers, which tell people what a fleet came to."""

from __future__ import annotations

from zlmreport.plugin.protocols import (
    Message,
    Notifier,
    Occasion,
)

__all__ = [
    "Message",
    "Notifier",
    "Occasion",
]
