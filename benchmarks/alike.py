"""That two writers have set the same document, so that comparing their times is fair."""

from __future__ import annotations

import io
import re
from collections import Counter
from collections.abc import Iterator

from pypdf import PdfReader

from content import Content

_DECIMAL_NUMBER = re.compile(r"−?\d+[.,]\d+")


#: Two writers share out blocks among pages each in its own way.
_MOST_PAGES_APART = 1


def pages_of_same_document(content: Content, *pdfs: bytes) -> tuple[int, ...]:
    """Return the number of pages of each PDF.

    Raises
    ------
    ValueError
        If they differ by more than a page, or a decimal number of the document's text is missing in a PDF.
    """
    wanted = Counter(_decimal_numbers(_texts(content)))
    pages = []
    for pdf in pdfs:
        reader = PdfReader(io.BytesIO(pdf))
        missing = wanted - Counter(_decimal_numbers(page.extract_text() for page in reader.pages))
        if missing:
            raise ValueError(f"a PDF lacks numbers of the certificate: {dict(missing)}")
        pages.append(len(reader.pages))
    if max(pages) - min(pages) > _MOST_PAGES_APART:
        raise ValueError(f"the PDFs have different numbers of pages: {pages}")
    return tuple(pages)


def _decimal_numbers(texts: Iterator[str]) -> Iterator[str]:
    return (number for text in texts for number in _DECIMAL_NUMBER.findall(text))


def _texts(content: object) -> Iterator[str]:
    """Yield every text outside graphs, whose labels are outlines in the plain recipe's PDF."""
    match content:
        case str():
            yield content
        case {"kind": "graph"}:
            return
        case dict():
            for value in content.values():
                yield from _texts(value)
        case list() | tuple():
            for value in content:
                yield from _texts(value)
