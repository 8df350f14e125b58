"""A file of a certificate by itself: what can be said of it without the PDF, and beside it."""

from __future__ import annotations

from pathlib import Path

import pytest

from installed import registry
from verification.issued import lay_out
from zlmreport import pipeline
from zlmreport.job.loading import load
from zlmreport.plugin import InputError
from zlmreport.verification.findings import VerificationOutcome, VerificationVerdict
from zlmreport.verification.verify import verify

FORMATS = ("json", "csv", "xlsx", "html", "pdf-typst")


@pytest.fixture(scope="module")
def documents(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The files of a certificate, by their endings."""
    job = load(lay_out(tmp_path_factory.mktemp("alone")), registry(), formats=FORMATS)
    return {each.path.suffix: each.content for each in pipeline.run(job, registry()).documents}


def laid_out(folder: Path, documents: dict[str, bytes], *endings: str) -> Path:
    """Write files of a certificate, and return the path of the first."""
    for ending in endings:
        (folder / f"VERIFY-1{ending}").write_bytes(documents[ending])
    return folder / f"VERIFY-1{endings[0]}"


@pytest.mark.parametrize("ending", [".json", ".csv", ".xlsx", ".html"])
def test_beside_its_pdf_it_holds_by_every_byte(
    ending: str, documents: dict[str, bytes], tmp_path: Path
) -> None:
    found = verify(laid_out(tmp_path, documents, ending, ".pdf"), registry())
    assert found.holds
    assert [each.subject for each in found.files] == [f"VERIFY-1{ending}", "VERIFY-1.pdf"]


def test_a_digital_certificate_of_a_job_that_can_have_none_does_not_hold(
    documents: dict[str, bytes], tmp_path: Path
) -> None:
    path = laid_out(tmp_path, documents, ".pdf").with_suffix(".xml")
    path.write_bytes(b'<?xml version="1.0"?><digital xmlns="https://ptb.de/dcc"/>')
    found = verify(path, registry())
    assert [each.subject for each in found.files if each.verdict is VerificationVerdict.DIFFERS] == [
        path.name
    ]


@pytest.mark.parametrize(("ending", "old", "new"), [(".json", b"2.7", b"0.7"), (".html", b"2.7", b"0.7")])
def test_one_that_was_altered_does_not_hold(
    ending: str, old: bytes, new: bytes, documents: dict[str, bytes], tmp_path: Path
) -> None:
    assert old in documents[ending]
    path = laid_out(tmp_path, documents, ending, ".pdf")
    path.write_bytes(documents[ending].replace(old, new))
    found = verify(path, registry())
    assert found.outcome is VerificationOutcome.DOES_NOT_HOLD
    (differing,) = (each for each in found.files if each.verdict is VerificationVerdict.DIFFERS)
    assert differing.subject == path.name
    line = documents[ending].partition(old)[0].count(b"\n") + 1
    assert f"is not what the PDF beside it gives: line {line} has " in differing.detail
    shown, right = differing.detail.split(" where it gives ")
    assert new.decode() in shown
    assert old.decode() in right


@pytest.mark.parametrize("ending", [".json", ".csv", ".xlsx", ".html"])
def test_without_its_pdf_nothing_of_it_is_decided(
    ending: str, documents: dict[str, bytes], tmp_path: Path
) -> None:
    found = verify(laid_out(tmp_path, documents, ending), registry())
    assert (found.outcome, found.undecided) == (VerificationOutcome.UNDECIDED, ("files",))
    states_digest = ending in {".json", ".html"}
    assert [bool(each.values["digest"]) for each in found.remarks] == [True] * states_digest


def test_beside_a_pdf_that_does_not_hold_it_does_not_either(
    documents: dict[str, bytes], tmp_path: Path
) -> None:
    path = laid_out(tmp_path, documents, ".json", ".pdf")
    path.with_suffix(".pdf").write_bytes(documents[".pdf"] + b"\n1 0 obj\n<< >>\nendobj\n")
    assert verify(path, registry()).outcome is VerificationOutcome.DOES_NOT_HOLD


@pytest.mark.parametrize("content", [b'{"schema": "other/1"}', b"PK\x03\x04", b"<html>", b"standard,value\n"])
def test_other_files_are_no_files_of_a_certificate(content: bytes, tmp_path: Path) -> None:
    (tmp_path / "x").write_bytes(content)
    with pytest.raises(InputError, match="is no PDF"):
        verify(tmp_path / "x", registry())
