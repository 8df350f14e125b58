"""Signing from the command line: the key is named there, and its password never is."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from cli.commands import Shop
from document.signing.keys import PASSWORD, pkcs12_file
from environments import ROOT
from pdf_conformance import complaints
from processes import ZLMREPORT, run
from zlmreport.cli import main
from zlmreport.document.signing.state import Integrity, read_signature_state

JOB = ROOT / "configs" / "german" / "messbericht.yaml"


@pytest.fixture
def key(tmp_path: Path) -> Path:
    return pkcs12_file(tmp_path / "laboratory.p12")


@pytest.mark.long
def test_a_pdf_is_signed_and_every_other_file_is_as_it_is_without(
    key: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ZLMREPORT_SIGN_PASSWORD", PASSWORD)
    plain, signed = tmp_path / "plain", tmp_path / "signed"
    assert main([str(JOB), "--quiet", "--output", str(plain)]) == 0
    assert main([str(JOB), "--quiet", "--output", str(signed), "--sign", str(key)]) == 0
    for before in plain.iterdir():
        after = (signed / before.name).read_bytes()
        if before.suffix == ".pdf":
            assert after.startswith(before.read_bytes())
            assert read_signature_state(after).integrity is Integrity.INTACT
            assert complaints(after) == []
        else:
            assert after == before.read_bytes()


def test_the_password_is_asked_for_at_a_terminal(
    key: Path, shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("ZLMREPORT_SIGN_PASSWORD", raising=False)
    monkeypatch.setattr("sys.stdin.isatty", lambda: True, raising=False)
    asked = []
    monkeypatch.setattr("getpass.getpass", lambda prompt, stream: asked.append(prompt) or "x")  # noqa: ARG005
    shop.job()
    assert shop.run("job.yaml", "--sign", str(key)).code == 2
    assert asked == [f"Password of {key}: "]


def test_without_a_terminal_and_a_password_the_user_is_told_where_it_is_taken_from(key: Path) -> None:
    done = run(*ZLMREPORT, JOB, "--sign", key)
    assert done.returncode == 2
    assert done.stderr == (
        f"zlmreport --sign: the password of {key} is asked for at a terminal "
        f"or stands in ZLMREPORT_SIGN_PASSWORD: here is neither\n"
    )


def test_a_job_without_a_pdf_has_nothing_to_sign(
    key: Path, shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ZLMREPORT_SIGN_PASSWORD", PASSWORD)
    shop.job()
    run = shop.run("job.yaml", "--sign", str(key))
    assert run.code == 2
    assert "there is nothing to sign: exemplary is no PDF; add pdf to the formats" in run.messages
    assert shop.files() == []


def test_without_the_extra_nothing_is_made_and_the_extra_is_named(
    key: Path, shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pkcs11.exceptions", None)
    shop.job()
    run = shop.run("job.yaml", "--sign", str(key))
    assert run.code == 2
    assert "pip install 'zlmreport[sign]'" in run.messages
    assert shop.files() == []


def test_a_wrong_password_is_one_message_and_nothing_is_made(
    key: Path, shop: Shop, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ZLMREPORT_SIGN_PASSWORD", "wrong")
    shop.job()
    run = shop.run("job.yaml", "--sign", str(key))
    assert (run.code, run.output, run.messages.count("\n")) == (2, "", 1)
    assert shop.files() == []
