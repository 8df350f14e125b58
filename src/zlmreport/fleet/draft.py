"""A document that is not issued says so on its cover and on every page."""

from __future__ import annotations

from dataclasses import replace

from zlmreport.certificate.document import Certificate
from zlmreport.language import Words

#: Before the suffix of a draft's file.
MARK = ".draft"

_TITLE = Words(en="Draft, not issued: {title}", de="Entwurf, nicht ausgestellt: {title}")


def drafted(certificate: Certificate) -> Certificate:
    """Return a certificate as a draft: its number stands already for a document with another content."""

    def marked(title: str) -> str:
        return _TITLE.given(title=title).in_language(certificate.language)

    words = certificate.page_words
    return replace(
        certificate,
        title=marked(certificate.title),
        page_words=replace(words, number=marked(words.number)),
    )
