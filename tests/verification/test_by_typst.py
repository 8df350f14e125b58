"""A certificate that Typst printed is verified by what Typst prints again."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from installed import registry
from verification.issued import READINGS, page_with, with_page_content, with_source
from verification.test_verify import differing
from zlmreport.plugin.protocols import is_made_by
from zlmreport.plugin.registry import DISABLE, find_plugins
from zlmreport.verification import verify as verifying
from zlmreport.verification.findings import CheckedCertificate, VerificationVerdict

Verify = Callable[[bytes], CheckedCertificate]


def test_it_holds_as_it_was_issued(by_typst: bytes, verified: Verify) -> None:
    found = verified(by_typst)
    assert found.holds
    verdicts = {each.verdict for each in (*found.files, *found.values, *found.pages, *found.document)}
    assert verdicts == {VerificationVerdict.HOLDS}
    assert len(found.pages) > 2


def test_a_line_that_is_drawn_over_a_page_is_found(by_typst: bytes, verified: Verify) -> None:
    page = page_with(by_typst, "Figure 1")
    altered = with_page_content(by_typst, page, lambda content: content + b"\n0 0 m 100 100 l S\n")
    assert differing(verified(altered)) == [f"page {page}"]


def test_another_reading_is_found(by_typst: bytes, verified: Verify) -> None:
    found = verified(with_source(by_typst, "x-axis.csv", READINGS.replace("1.3", "1.9").encode()))
    assert "page 1" in differing(found)


def test_the_other_renderers_documents_are_not_taken_for_its_own() -> None:
    typst = registry().renderer("pdf-typst")
    assert is_made_by(typst, "Typst 0.15.0")
    assert not is_made_by(typst, "zlmreport 0.1.0")
    assert not is_made_by(registry().renderer("pdf"), "Typst 0.15.0")


def test_where_its_renderer_is_missing_nothing_of_its_drawing_is_said_to_hold(
    by_typst: bytes, tmp_path: Path
) -> None:
    path = tmp_path / "certificate.pdf"
    path.write_bytes(by_typst)
    found = verifying.verify(path, find_plugins({DISABLE: "pdf-typst"}))
    assert VerificationVerdict.HOLDS not in {each.verdict for each in found.pages}
    assert {each.verdict for each in found.values} == {VerificationVerdict.HOLDS}
