"""A key that cannot sign is refused before any work is done, and the user is told why."""

from __future__ import annotations

import sys
from datetime import timedelta

import pytest

from document.signing.conftest import PLACE
from document.signing.keys import PASSWORD, certificate_of, elliptic, in_der, pkcs12_file
from zlmreport.document.signing.signer import open_signer
from zlmreport.plugin import AccessError, InputError

_YEAR = timedelta(days=365)


def _open(named, password: str = PASSWORD) -> None:
    with open_signer(str(named), lambda _: password, PLACE):
        pytest.fail("it was opened")


def test_the_password_is_asked_for_by_the_name_of_the_file(tmp_path) -> None:
    asked = []
    file = pkcs12_file(tmp_path / "laboratory.p12")
    with open_signer(str(file), lambda of: asked.append(of) or PASSWORD, PLACE):
        assert asked == [str(file)]


def test_a_wrong_password_is_told(tmp_path) -> None:
    with pytest.raises(InputError, match=r"--sign: .*p12 cannot be opened: either the password is wrong"):
        _open(pkcs12_file(tmp_path / "laboratory.p12"), "other")


@pytest.mark.parametrize("content", [b"", b"-----BEGIN CERTIFICATE-----", in_der(elliptic())])
def test_a_file_that_is_no_pkcs12_is_told(tmp_path, content: bytes) -> None:
    path = tmp_path / "laboratory.p12"
    path.write_bytes(content)
    with pytest.raises(InputError, match="or it is no PKCS#12 file"):
        _open(path)


def test_a_file_without_a_key_is_told(tmp_path) -> None:
    from cryptography.hazmat.primitives.serialization import BestAvailableEncryption, pkcs12

    path = tmp_path / "laboratory.p12"
    encryption = BestAvailableEncryption(PASSWORD.encode())
    path.write_bytes(
        pkcs12.serialize_key_and_certificates(None, None, None, [certificate_of(elliptic())], encryption)
    )
    with pytest.raises(InputError, match="holds no key with its certificate"):
        _open(path)


def test_a_file_that_is_not_there_cannot_be_read(tmp_path) -> None:
    with pytest.raises(AccessError, match=r"none\.p12 cannot be read"):
        _open(tmp_path / "none.p12")


@pytest.mark.parametrize(
    ("first", "last"), [(-2 * _YEAR, -_YEAR), (_YEAR, 2 * _YEAR)], ids=["expired", "not yet"]
)
def test_a_certificate_that_is_not_valid_today_is_refused(
    tmp_path, first: timedelta, last: timedelta
) -> None:
    file = pkcs12_file(tmp_path / "laboratory.p12", certificate=certificate_of(elliptic(), first, last))
    with pytest.raises(InputError, match=r"is valid from \d{4}-\d\d-\d\d to \d{4}-\d\d-\d\d, not today"):
        _open(file)


@pytest.mark.parametrize("missing", ["pyhanko.sign.signers", "pkcs11.exceptions"])
def test_without_the_extra_it_is_named(tmp_path, monkeypatch: pytest.MonkeyPatch, missing: str) -> None:
    monkeypatch.setitem(sys.modules, missing, None)
    with pytest.raises(InputError, match=r"signing needs pyHanko.*pip install 'zlmreport\[sign\]'"):
        _open(pkcs12_file(tmp_path / "laboratory.p12"))
