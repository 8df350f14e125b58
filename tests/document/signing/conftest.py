"""A certificate, and one that is signed."""

from __future__ import annotations

import pytest

from document.signing.keys import PASSWORD, pkcs12_file
from document.typesetting import samples
from installed import registry
from zlmreport.document.signing.signer import open_signer
from zlmreport.plugin import Place

PLACE = Place("zlmreport --sign")


@pytest.fixture(scope="session")
def unsigned() -> bytes:
    return registry().renderer("pdf").render(samples.certificate(standards=0))


@pytest.fixture(scope="session")
def signed(unsigned: bytes, tmp_path_factory: pytest.TempPathFactory) -> bytes:
    file = pkcs12_file(tmp_path_factory.mktemp("key") / "laboratory.p12")
    with open_signer(str(file), lambda _: PASSWORD, PLACE) as signer:
        return signer(unsigned, "Electronic signature")
