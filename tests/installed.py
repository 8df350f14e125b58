"""What is installed, found once for all tests."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from zlmreport.job.loading import load
from zlmreport.plugin.extension import Job
from zlmreport.plugin.registry import Registry, find_plugins


@cache
def registry() -> Registry:
    """Return the installed plugins."""
    return find_plugins()


def load_job(path: Path, formats: tuple[str, ...] = ()) -> Job:
    """Return the job of a file, checked against them."""
    return load(path, registry(), formats)
