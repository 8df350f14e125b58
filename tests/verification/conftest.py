"""A report that was issued once for all tests."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from installed import registry
from verification.issued import issue, lay_out
from verification.remembered import remembering
from zlmreport.verification import verify as verifying
from zlmreport.verification.findings import CheckedCertificate


@pytest.fixture(scope="session")
def issued(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return issue(lay_out(tmp_path_factory.mktemp("issued")))


@pytest.fixture(scope="session")
def by_typst(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    return issue(lay_out(tmp_path_factory.mktemp("by-typst")), "pdf-typst")


@pytest.fixture
def verified(tmp_path: Path) -> Iterator[Callable[[bytes], CheckedCertificate]]:
    """Verify the bytes of a PDF; what the same files give is printed once for all tests."""

    def run(pdf: bytes) -> CheckedCertificate:
        path = tmp_path / "certificate.pdf"
        path.write_bytes(pdf)
        return verifying.verify(path, registry())

    with remembering():
        yield run
