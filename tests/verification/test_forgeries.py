"""No forged certificate holds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest
from pikepdf import Pdf

from verification import carried_forgeries, raw_forgeries  # noqa: F401 - what they forge joins the others
from verification.altering import Forgery, draw, page_of, rewritten
from verification.forgeries import FORGERIES, plain
from verification.test_trust import signed
from zlmreport.plugin import InputError
from zlmreport.verification.findings import CheckedCertificate, VerificationOutcome, VerificationVerdict

Verify = Callable[[bytes], CheckedCertificate]


def one_in(count: int, forgeries: Sequence[Forgery]) -> list[Any]:
    """Return forgeries: all take two minutes, so one of so many is tried at once, and the others are long."""
    return [
        pytest.param(each, id=each.name, marks=pytest.mark.long if number % count else ())
        for number, each in enumerate(forgeries)
    ]


def test_forgeries_are_many_and_each_has_its_own_name() -> None:
    names = [each.name for each in FORGERIES]
    assert len(names) == len(set(names)) > 100
    assert all(each.seen for each in FORGERIES)


@pytest.mark.parametrize("forgery", one_in(3, FORGERIES))
def test_a_forged_certificate_does_not_hold(forgery: Forgery, issued: bytes, verified: Verify) -> None:
    is_found(forgery, issued, verified)


@pytest.mark.parametrize("forgery", one_in(3, FORGERIES[::10]))  # each way costs time
def test_a_forged_certificate_of_typst_does_not_hold(
    forgery: Forgery, by_typst: bytes, verified: Verify
) -> None:
    is_found(forgery, by_typst, verified)


@pytest.mark.parametrize("forgery", one_in(3, FORGERIES[::8]))
def test_a_forged_certificate_does_not_hold_if_its_forger_signs_it(
    forgery: Forgery, issued: bytes, verified: Verify, tmp_path: Path
) -> None:
    """What a signature may add hides nothing else; a file that cannot even be signed is none."""
    try:
        forged = signed(forgery.make(issued), tmp_path)
    except Exception:  # noqa: BLE001 - pyHanko meets spoiled files with many kinds of errors
        return
    is_found(Forgery(forgery.name, forgery.seen, lambda _: forged), issued, verified)


@pytest.mark.parametrize("forgery", one_in(3, FORGERIES[::8]))
def test_a_signed_certificate_that_is_forged_is_not_what_was_signed(
    forgery: Forgery, issued: bytes, verified: Verify, tmp_path: Path
) -> None:
    try:
        found = verified(forgery.make(signed(issued, tmp_path)))
    except InputError:
        return
    assert found.outcome is VerificationOutcome.DOES_NOT_HOLD, f"seen: {forgery.seen}"
    assert found.signature.verdict is not VerificationVerdict.HOLDS


@pytest.mark.long
@pytest.mark.parametrize(
    "saved", [lambda pdf: rewritten(pdf, lambda _: None), plain], ids=["packed", "plain"]
)
@pytest.mark.parametrize("printed", ["issued", "by_typst"])
def test_what_another_program_saved_again_and_did_not_change_holds(
    printed: str, saved: Callable[[bytes], bytes], request: pytest.FixtureRequest, verified: Verify
) -> None:
    """So what a forgery is found by is its own trick, and not that the file was saved again for it."""
    pdf: bytes = request.getfixturevalue(printed)
    assert verified(pdf).holds
    assert verified(saved(pdf)).holds


def saved_by_pikepdf(pdf: bytes, change: Callable[[Pdf], None] = lambda _: None, **how: Any) -> bytes:
    """Return a PDF as pikepdf saves it by itself: it writes the XML of the metadata anew, too."""
    saved = BytesIO()
    with Pdf.open(BytesIO(pdf)) as opened:
        change(opened)
        opened.save(saved, **how)
    return saved.getvalue()


def test_metadata_whose_xml_was_written_anew_hold(issued: bytes, verified: Verify) -> None:
    found = verified(saved_by_pikepdf(issued))
    assert found.holds


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (b"Measuring Report", b"Calibration Certificate"),
        (b"</rdf:RDF>", b"<rdf:Description/></rdf:RDF>"),
        (b"</rdf:RDF>", b"<!-- accredited --></rdf:RDF>"),
        (b"</rdf:RDF>", b"<?accredited?></rdf:RDF>"),
        (b"<x:xmpmeta", b"<!DOCTYPE x><x:xmpmeta"),
        (b'rdf:about=""', b'rdf:about="a"'),
    ],
)
def test_metadata_that_say_something_else_do_not_hold(
    old: bytes, new: bytes, issued: bytes, verified: Verify
) -> None:
    def change(opened: Pdf) -> None:
        content = opened.Root.Metadata.read_bytes()
        assert old in content
        opened.Root.Metadata.write(content.replace(old, new, 1))

    found = verified(saved_by_pikepdf(issued, change, fix_metadata_version=False))
    assert found.outcome is VerificationOutcome.DOES_NOT_HOLD
    differing = [each.subject for each in found.document if each.verdict is VerificationVerdict.DIFFERS]
    assert differing == ["metadata (XMP)"]


@pytest.mark.parametrize("way", ["linearize", "qdf"])
def test_a_file_arranged_for_fast_web_view_or_for_people_is_not_decided_and_says_what_to_do(
    way: str, issued: bytes, verified: Verify
) -> None:
    found = verified(saved_by_pikepdf(issued, **{way: True}))
    assert found.outcome is VerificationOutcome.UNDECIDED
    (open_,) = (each for each in found.document if each.verdict is VerificationVerdict.OPEN)
    assert "qpdf FILE NEW" in str(open_.detail)


@pytest.mark.parametrize("way", ["linearize", "qdf"])
def test_what_is_forged_in_a_file_arranged_for_fast_web_view_or_for_people_does_not_hold(
    way: str, issued: bytes, verified: Verify
) -> None:
    def change(opened: Pdf) -> None:
        draw(opened, page_of(opened), b"0 0 m 100 100 l S")

    found = verified(saved_by_pikepdf(issued, change, **{way: True}))
    assert found.outcome is VerificationOutcome.DOES_NOT_HOLD


def is_found(forgery: Forgery, pdf: bytes, verified: Verify) -> None:
    forged = forgery.make(pdf)
    try:
        found = verified(forged)
    except InputError:
        return
    expected = (
        VerificationOutcome.UNDECIDED
        if forgery.name == "another release"
        else VerificationOutcome.DOES_NOT_HOLD
    )
    assert found.outcome is expected, f"seen: {forgery.seen}"
