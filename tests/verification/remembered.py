"""Certificates that are made again once: what the same files give is remembered."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from zlmreport.verification import verify as verifying

_made_again: dict[Any, Any] = {}


@contextmanager
def remembering() -> Iterator[None]:
    """Make each certificate again once: what it carries and states of its makers tells it from others."""
    make_again = verifying.make_certificate_again

    def known(job: Path, carrier: Any, stated: Any, plugins: Any) -> Any:
        unpacked = sorted(path for path in job.parents[1].rglob("*") if path.is_file())
        files = tuple((path.relative_to(job.parents[1]), path.read_bytes()) for path in unpacked)
        named = stated.provenance.generator, *stated.provenance.plugins.items()
        key = files, tuple(carrier.carried), carrier.creator, named
        if key not in _made_again:
            _made_again[key] = make_again(job, carrier, stated, plugins)
        return _made_again[key]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(verifying, "make_certificate_again", known)
        yield
