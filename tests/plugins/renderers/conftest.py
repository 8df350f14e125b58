"""What tests of renderers share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest


@pytest.fixture(params=["pdf", "pdf-typst"])
def press(request: pytest.FixtureRequest) -> str:
    """A format of pages: PDF by WeasyPrint, PDF by Typst."""
    return str(request.param)


@pytest.fixture(autouse=True)
def weasyprint_log(caplog: pytest.LogCaptureFixture) -> Iterator[list[str]]:
    """What WeasyPrint complained of; a test fails on what it does not take out of the list."""
    complaints: list[str] = []
    yield complaints
    reported = [record.getMessage() for record in caplog.get_records("call") if record.name == "weasyprint"]
    assert [message for message in reported if message not in complaints] == []
