"""A report that was issued once for all tests."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from verification.issued import issue, lay_out, registry
from zlmreport.verification.findings import Verification
from zlmreport.verification.verify import verify


@pytest.fixture(scope="session")
def issued(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return issue(lay_out(tmp_path_factory.mktemp("issued")))


@pytest.fixture
def verified(tmp_path: Path) -> Callable[[bytes], Verification]:
    """Verify the bytes of a PDF."""

    def run(pdf: bytes) -> Verification:
        path = tmp_path / "certificate.pdf"
        path.write_bytes(pdf)
        return verify(path, registry())

    return run
