"""What `zlmreport verify` says: one page in the singular, and names in a row."""

from __future__ import annotations

import pytest

from zlmreport.cli import main
from zlmreport.plugin import Language, Words
from zlmreport.verification.findings import (
    CheckedCertificate,
    CheckedStatement,
    Identity,
    VerificationVerdict,
)

HOLDS, OPEN = (
    CheckedStatement("x", verdict, Words("as stated"))
    for verdict in (VerificationVerdict.HOLDS, VerificationVerdict.OPEN)
)


def verified(
    found: CheckedCertificate, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> str:
    monkeypatch.setattr("zlmreport.cli.verify.verify", lambda *_, **__: found)
    main(["verify", "report.pdf"])
    return capsys.readouterr().out


@pytest.mark.parametrize(
    ("language", "said"),
    [(Language.ENGLISH, "1 of 1 page as printed"), (Language.GERMAN, "1 von 1 Seite wie erneut")],
)
def test_a_single_page_is_one_page(
    language: Language,
    said: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    found = CheckedCertificate(Identity(language=language), HOLDS, pages=(HOLDS,))
    assert said in verified(found, monkeypatch, capsys)


def test_what_could_not_be_compared_is_listed(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    found = CheckedCertificate(Identity(), HOLDS, files=(OPEN,), pages=(OPEN,), document=(OPEN,))
    said = verified(found, monkeypatch, capsys)
    assert "files, pages and document could not be compared whole" in " ".join(said.split())
