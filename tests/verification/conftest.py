"""A report that was issued once for all tests."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from verification.issued import issue, lay_out, registry
from zlmreport.verification import verify as verifying
from zlmreport.verification.findings import Verification

_made_again: dict[Any, Any] = {}


@pytest.fixture(scope="session")
def issued(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return issue(lay_out(tmp_path_factory.mktemp("issued")))


@pytest.fixture(scope="session")
def by_typst(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return issue(lay_out(tmp_path_factory.mktemp("by-typst")), "pdf-typst")


@pytest.fixture
def verified(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[bytes], Verification]:
    """Verify the bytes of a PDF; what the same files give is printed once for all tests."""
    made_again = verifying._again

    def known(job: Path, carrier: Any, stated: Any, plugins: Any) -> Any:
        unpacked = sorted(path for path in job.parents[1].rglob("*") if path.is_file())
        files = tuple((path.relative_to(job.parents[1]), path.read_bytes()) for path in unpacked)
        named = stated.provenance.generator, *stated.provenance.plugins.items()
        key = files, tuple(carrier.carried), carrier.creator, named
        if key not in _made_again:
            _made_again[key] = made_again(job, carrier, stated, plugins)
        return _made_again[key]

    monkeypatch.setattr(verifying, "_again", known)

    def run(pdf: bytes) -> Verification:
        path = tmp_path / "certificate.pdf"
        path.write_bytes(pdf)
        return verifying.verify(path, registry())

    return run
