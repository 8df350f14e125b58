"""Pages of a PDF as pictures: a preview beside the graphs, for the policy of the page allows no frame."""

from __future__ import annotations

import io
from pathlib import Path
from threading import Lock

import pypdfium2

#: Pixels for each point of the page: 108 to the inch, for a screen.
_SCALE = 1.5
#: The library behind is not made for several threads.
_ONE_AT_A_TIME = Lock()


def page_picture(path: Path, number: int) -> bytes | None:
    """Return a page of a PDF as PNG, counted from 1; None where there is no such page."""
    with _ONE_AT_A_TIME, pypdfium2.PdfDocument(path) as document:
        if not 0 < number <= len(document):
            return None
        content = io.BytesIO()
        document[number - 1].render(scale=_SCALE).to_pil().save(content, "PNG")
        return content.getvalue()


def page_count(path: Path) -> int:
    """Return how many pages a PDF has."""
    with _ONE_AT_A_TIME, pypdfium2.PdfDocument(path) as document:
        return len(document)
