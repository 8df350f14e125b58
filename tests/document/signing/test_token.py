"""A key that never leaves its token signs as one in a file does."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from shutil import which
from typing import TYPE_CHECKING

import pytest
from cryptography.hazmat.primitives.serialization import Encoding

from document.signing.conftest import PLACE
from document.signing.keys import PASSWORD, certificate_of, in_der, pkcs12_file, rsa_key
from pdf_conformance import complaints
from processes import run
from zlmreport.document.signing.signer import open_signer
from zlmreport.document.signing.state import Integrity, read_signature_state
from zlmreport.plugin import AccessError, InputError

if TYPE_CHECKING:
    from pyhanko.sign.signers import SimpleSigner

_MODULE = Path("/usr/lib/softhsm/libsofthsm2.so")
_PIN = "1234"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("pkcs11:", "lacks token, object, module-path; write pkcs11:token=…;object=…"),
        ("pkcs11:token=a;object=b", "lacks module-path"),
        ("pkcs11:token=;object=b?module-path=c", "lacks token"),
        ("pkcs11:tokn=a", "unknown part 'tokn'.*did you mean 'token'"),
        ("pkcs11:token=a;object=b?module-path=c&pin-value=1234", "a PIN does not belong on the command line"),
    ],
)
def test_an_address_that_leads_nowhere_is_refused(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message), open_signer(text, lambda _: _PIN, PLACE):
        pytest.fail("it was opened")


def test_a_driver_that_is_not_there_is_told(tmp_path: Path) -> None:
    named = f"pkcs11:token=a;object=b?module-path={tmp_path}/none.so"
    with (
        pytest.raises(AccessError, match=r"the key 'b' of token 'a' cannot be opened by .*none\.so"),
        open_signer(named, lambda _: _PIN, PLACE),
    ):
        pytest.fail("it was opened")


@contextmanager
def token_of(key: SimpleSigner) -> Iterator[list[object]]:
    """Let the library of tokens find a key; yields what it is asked for."""
    import pyhanko.sign.pkcs11

    asked: list[object] = []

    @contextmanager
    def session(module, *, token_criteria, user_pin):
        asked.append((module, token_criteria.label, user_pin))
        yield "session"
        asked.append("closed")

    def found(opened, *, cert_label, key_label):
        asked.append((opened, cert_label, key_label))
        return key

    with pytest.MonkeyPatch.context() as monkeypatch:
        monkeypatch.setattr(pyhanko.sign.pkcs11, "open_pkcs11_session", session)
        monkeypatch.setattr(pyhanko.sign.pkcs11, "PKCS11Signer", found)
        yield asked


@pytest.fixture
def key(tmp_path: Path) -> SimpleSigner:
    from pyhanko.sign.signers import SimpleSigner

    content = pkcs12_file(tmp_path / "key.p12").read_bytes()
    return SimpleSigner.load_pkcs12_data(content, [], PASSWORD.encode())


NAMED = "pkcs11:token=Our%20Lab;object=signature?module-path=/usr/lib/token.so"


def test_the_key_of_a_token_signs_and_the_token_is_closed_behind_it(
    unsigned: bytes, key: SimpleSigner
) -> None:
    with token_of(key) as asked, open_signer(NAMED, lambda of: {"token Our Lab": _PIN}[of], PLACE) as signer:
        signed = signer(unsigned, "Electronic signature")
    assert asked == [("/usr/lib/token.so", "Our Lab", _PIN), ("session", "signature", "signature"), "closed"]
    assert read_signature_state(signed).integrity is Integrity.INTACT


def test_a_key_that_fails_to_sign_is_told(
    unsigned: bytes, key: SimpleSigner, monkeypatch: pytest.MonkeyPatch
) -> None:
    from pkcs11.exceptions import DeviceRemoved

    async def removed(*_: object, **__: object) -> bytes:
        raise DeviceRemoved

    monkeypatch.setattr(key, "async_sign_raw", removed)
    with (
        pytest.raises(AccessError, match="--sign: the key did not sign: DeviceRemoved"),
        token_of(key),
        open_signer(NAMED, lambda _: _PIN, PLACE) as signer,
    ):
        signer(unsigned, "Electronic signature")


@pytest.fixture(scope="module")
def token(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The address of a key in a token that is made of files; a process can have but one such token."""
    if not (_MODULE.exists() and which("softhsm2-util")):
        pytest.skip("SoftHSM, a token made of files, is not installed")
    import pkcs11
    from pkcs11.util.rsa import decode_rsa_private_key
    from pkcs11.util.x509 import decode_x509_certificate

    folder = tmp_path_factory.mktemp("tokens")
    settings = folder / "softhsm2.conf"
    settings.write_text(f"directories.tokendir = {folder}\n", encoding="utf-8")
    key = rsa_key()
    with pytest.MonkeyPatch.context() as environment:
        environment.setenv("SOFTHSM2_CONF", str(settings))
        pins = ("--pin", _PIN, "--so-pin", _PIN)
        run("softhsm2-util", "--init-token", "--free", "--label", "Lab", *pins, check=True)
        with pkcs11.lib(str(_MODULE)).get_token(token_label="Lab").open(rw=True, user_pin=_PIN) as session:
            label = {pkcs11.Attribute.LABEL: "signature", pkcs11.Attribute.TOKEN: True}
            session.create_object({**decode_rsa_private_key(in_der(key)), **label})
            certificate = certificate_of(key).public_bytes(Encoding.DER)
            session.create_object({**decode_x509_certificate(certificate), **label})
        yield f"pkcs11:token=Lab;object=signature?module-path={_MODULE}"


def test_a_token_signs(token: str, unsigned: bytes) -> None:
    with open_signer(token, lambda _: _PIN, PLACE) as signer:
        signed = signer(unsigned, "Electronic signature")
    assert read_signature_state(signed).integrity is Integrity.INTACT
    assert complaints(signed) == []


def test_a_wrong_pin_is_told(token: str) -> None:
    with (
        pytest.raises(AccessError, match=r"cannot be opened by .*: PinIncorrect"),
        open_signer(token, lambda _: "9999", PLACE),
    ):
        pytest.fail("it was opened")
