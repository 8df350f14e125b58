"""The door of controls that take compensation tables."""

from __future__ import annotations

from zlmreport.model.compensation.curve import (
    CompensationTable,
    CrossTable,
)
from zlmreport.plugin.protocols import (
    Controller,
)

__all__ = [
    "CompensationTable",
    "Controller",
    "CrossTable",
]
