"""A PDF by Typst, read again."""

from __future__ import annotations

from functools import cache
from io import BytesIO

from pypdf import PdfReader

from document.typesetting import samples
from installed import registry
from zlmreport.plugin import Language
from zlmreport.plugin.renderer import Certificate


def read(certificate: Certificate) -> PdfReader:
    """Print a certificate and open it."""
    return PdfReader(BytesIO(registry().renderer("pdf-typst").render(certificate)))


@cache
def sample(language: Language = Language.ENGLISH, paper: str = "A4") -> PdfReader:
    """The sample certificate, printed once for all tests that only look."""
    return read(samples.certificate(language, paper))
