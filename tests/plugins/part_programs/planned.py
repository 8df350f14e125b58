"""Motions of planned tests, and their programs."""

from __future__ import annotations

from typing import Any

from installed import registry
from zlmreport.plugin.program import Motion
from zlmreport.testing import sample_motion

REGISTRY = registry()


def written(identifier: str, motion: Motion | None = None, **keys: Any) -> str:
    """Return the program of a motion, by default of the linear method with two runs."""
    program = REGISTRY.part_program(identifier)
    return program.write(motion or sample_motion(), program.options(**keys))
