"""A signature is added to a PDF and takes nothing from it."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import pikepdf
import pytest

from document.signing.conftest import PLACE
from document.signing.keys import PASSWORD, pkcs12_file, rsa_key
from document.typesetting import samples
from installed import registry
from pdf_conformance import complaints
from zlmreport.document.signing.signer import open_signer
from zlmreport.document.signing.state import Integrity, read_signature_state


def test_what_is_signed_stays_as_it_was_byte_by_byte(unsigned: bytes, signed: bytes) -> None:
    assert signed.startswith(unsigned)


def test_a_signed_certificate_still_is_for_archives_and_for_everybody(signed: bytes) -> None:
    assert complaints(signed) == []


def test_a_signature_is_pades_and_allows_no_change_after_it(signed: bytes) -> None:
    with pikepdf.open(BytesIO(signed)) as pdf:
        (field,) = pdf.Root.AcroForm.Fields
        assert field.V.SubFilter == "/ETSI.CAdES.detached"
        (rule,) = field.V.Reference
        assert (rule.TransformMethod, rule.TransformParams.P) == ("/DocMDP", 1)


def test_a_signature_is_read_to_those_who_cannot_see_it(signed: bytes) -> None:
    with pikepdf.open(BytesIO(signed)) as pdf:
        (field,) = pdf.Root.AcroForm.Fields
        assert str(field.TU) == "Electronic signature"
        last = pdf.Root.StructTreeRoot.K[0].K[-1]
        assert last.S == "/Form"
        assert last.K[0].Obj.objgen == field.objgen


def test_a_file_that_ends_without_a_line_break_is_signed(unsigned: bytes, tmp_path) -> None:
    file = pkcs12_file(tmp_path / "laboratory.p12")
    with open_signer(str(file), lambda _: PASSWORD, PLACE) as signer:
        signed = signer(unsigned.rstrip(), "Electronic signature")
    assert read_signature_state(signed).integrity is Integrity.INTACT
    assert complaints(signed) == []


def test_a_pdf_without_structure_is_signed_as_well(tmp_path) -> None:
    plain = BytesIO()
    with pikepdf.new() as pdf:
        pdf.add_blank_page()
        pdf.save(plain)
    file = pkcs12_file(tmp_path / "laboratory.p12")
    with open_signer(str(file), lambda _: PASSWORD, PLACE) as signer:
        signed = signer(plain.getvalue(), "Electronic signature")
    assert read_signature_state(signed).integrity is Integrity.INTACT


@pytest.mark.parametrize("password", [PASSWORD, ""])
def test_a_key_of_rsa_signs_with_and_without_a_password(unsigned: bytes, tmp_path, password: str) -> None:
    file = pkcs12_file(tmp_path / "laboratory.p12", rsa_key(), password=password)
    with open_signer(str(file), lambda _: password, PLACE) as signer:
        signed = signer(unsigned, "Electronic signature")
    assert read_signature_state(signed).integrity is Integrity.INTACT


def test_what_typst_printed_stays_what_it_claims(tmp_path: Path) -> None:
    printed = registry().renderer("pdf-typst").render(samples.certificate(standards=0))
    file = pkcs12_file(tmp_path / "laboratory.p12")
    with open_signer(str(file), lambda _: PASSWORD, PLACE) as signer:
        signed = signer(printed, "Electronic signature")
    assert signed.startswith(printed)
    assert complaints(signed) == []
