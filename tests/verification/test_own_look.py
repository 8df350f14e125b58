"""A certificate in a laboratory's own look: what can be decided of it, and what cannot."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import matplotlib as mpl
import pytest

from installed import registry
from verification.issued import LABORATORY, issue, lay_out, page_with, with_digit, with_page_content
from zlmreport import pipeline
from zlmreport.job.loading import load
from zlmreport.verification.findings import CheckedCertificate, VerificationOutcome, VerificationVerdict

FONT = Path(mpl.get_data_path(), "fonts", "ttf", "DejaVuSerif.ttf")
TYPEFACE = f"typeface: {{regular: {FONT}, semibold: {FONT}}}"
LOOKS = {"templates": "templates: house", "templates and typeface": f"{TYPEFACE}, templates: house"}


@pytest.fixture(params=LOOKS.values(), ids=LOOKS)
def issued(request: pytest.FixtureRequest, tmp_path: Path) -> bytes:
    """A report by a template, or also in a typeface, of the laboratory's own."""
    style = f"style: {{{request.param}}}, issued:"
    job = lay_out(tmp_path, laboratory=LABORATORY.replace("issued:", style))
    (tmp_path / "house").mkdir()
    notice = '<div>{% include "usual/notice.html" %} Telephone 4711</div>'
    (tmp_path / "house" / "notice.html").write_text(notice, "utf-8")
    return issue(job)


@pytest.mark.long
def test_its_values_are_decided_and_how_its_pages_are_drawn_is_not(
    issued: bytes, verified: Callable[[bytes], CheckedCertificate]
) -> None:
    found = verified(issued)
    assert found.outcome is VerificationOutcome.UNDECIDED
    assert {each.verdict for each in (*found.files, *found.values)} == {VerificationVerdict.HOLDS}
    assert VerificationVerdict.DIFFERS not in {each.verdict for each in (*found.pages, *found.document)}
    assert "typeface or by templates" in found.remarks[0].en


@pytest.mark.long
def test_a_number_that_is_taken_from_its_pages_is_found(
    issued: bytes, verified: Callable[[bytes], CheckedCertificate]
) -> None:
    page = page_with(issued, "Figure 1")
    found = verified(with_page_content(issued, page, lambda _: b""))
    assert found.outcome is not VerificationOutcome.UNDECIDED
    assert any("cannot be read on its pages" in each.detail for each in found.document)


#: A digit of a result; a limit, which has no decimals; two uncertainties that change places.
CHANGED = {
    "a result": ([("7.26", "7.96")], VerificationOutcome.DOES_NOT_HOLD),
    "a whole number": ([("20", "30")], VerificationOutcome.DOES_NOT_HOLD),
    "two numbers": ([("0.72", "0.74"), ("0.74", "0.72")], VerificationOutcome.UNDECIDED),
}


@pytest.mark.long
@pytest.mark.parametrize(("digits", "outcome"), CHANGED.values(), ids=CHANGED)
def test_a_page_whose_number_was_changed_never_holds(
    digits: list[tuple[str, str]],
    outcome: VerificationOutcome,
    issued: bytes,
    verified: Callable[[bytes], CheckedCertificate],
) -> None:
    forged, changed = issued, set()
    for number, other in digits:
        changed.add(f"page {page_with(forged, number)}")
        forged = with_digit(forged, number, other)
    found = verified(forged)
    assert found.outcome is outcome
    assert VerificationVerdict.HOLDS not in {each.verdict for each in found.pages if each.subject in changed}


@pytest.mark.long
def test_pages_with_letters_of_another_system_are_not_decided(
    tmp_path: Path, verified: Callable[[bytes], CheckedCertificate]
) -> None:
    """It was printed where a typeface has them all; here boxes would stand for them."""
    name = LABORATORY.replace("Example Laboratory", "Laboratory \U000f1234")
    job = load(lay_out(tmp_path, laboratory=name), registry(), formats=("pdf",))
    certificate = pipeline.compose(job, registry())
    printed = replace(certificate, look=replace(certificate.look, may_lack_letters=True))
    pdf = pipeline.render(printed, [registry().renderer("pdf")], registry())["pdf"]

    found = verified(with_page_content(pdf, 1, lambda content: content.replace(b" Tf", b".5 Tf")))

    assert found.outcome is VerificationOutcome.UNDECIDED
    assert {each.verdict for each in found.values} == {VerificationVerdict.HOLDS}
    assert "letters that no typeface of this system has" in found.remarks[0].en
