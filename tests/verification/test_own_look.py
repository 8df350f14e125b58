"""A certificate in a laboratory's own look: what can be decided of it, and what cannot."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import matplotlib as mpl
import pytest

from verification.issued import LABORATORY, issue, lay_out, page_with, with_page_content
from zlmreport.verification.findings import Outcome, Verdict, Verification

FONT = Path(mpl.get_data_path(), "fonts", "ttf", "DejaVuSerif.ttf")
STYLE = f"style: {{typeface: {{regular: {FONT}, semibold: {FONT}}}, templates: house}}"


@pytest.fixture
def issued(tmp_path: Path) -> bytes:
    """A report by a template and in a typeface of the laboratory's own."""
    job = lay_out(tmp_path, laboratory=LABORATORY.replace("issued:", f"{STYLE}, issued:"))
    (tmp_path / "house").mkdir()
    (tmp_path / "house" / "notice.html").write_text('<div>{% include "usual/notice.html" %}</div>', "utf-8")
    return issue(job)


def test_its_values_are_decided_and_how_its_pages_are_drawn_is_not(
    issued: bytes, verified: Callable[[bytes], Verification]
) -> None:
    found = verified(issued)
    assert found.outcome is Outcome.UNDECIDED
    assert {each.verdict for each in (*found.files, *found.values)} == {Verdict.HOLDS}
    assert Verdict.DIFFERS not in {each.verdict for each in (*found.pages, *found.document)}
    assert "typeface or by templates" in found.remarks[0].en


def test_a_number_that_is_taken_from_its_pages_is_found(
    issued: bytes, verified: Callable[[bytes], Verification]
) -> None:
    page = page_with(issued, "Figure 1")
    found = verified(with_page_content(issued, page, lambda _: b""))
    assert found.outcome is not Outcome.UNDECIDED
    assert any("cannot be read on its pages" in each.detail for each in found.document)
