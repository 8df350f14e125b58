"""Whether a PDF is what it says it is, asked of two programs that had no part in making it."""

from __future__ import annotations

from collections.abc import Iterator
from io import BytesIO

import page
import pikepdf

PROFILES = (page.ValidationProfile.PDF_A_3A, page.ValidationProfile.PDF_UA_1)


def complaints(content: bytes, *profiles: page.ValidationProfile) -> list[str]:
    """Return all that is wrong with a file: as a file (qpdf), and by each profile that it claims."""
    with pikepdf.open(BytesIO(content), attempt_recovery=False) as pdf:
        damages = [f"qpdf: {damage}" for damage in (*pdf.check_pdf_syntax(), *pdf.get_warnings())]
        failures = [failure for profile in profiles or PROFILES for failure in _failures(content, profile)]
        return damages + [
            f"{failure.rule_id}: {failure.message} ({failure.object_id})"
            for failure in failures
            if not (failure.rule_id.endswith("-STREAM-LENGTH-001") and _ends_in_return(pdf, failure))
        ]


def _failures(content: bytes, profile: page.ValidationProfile) -> Iterator[page.ValidationFailure]:
    report = page.validate_pdf_bytes(content, profile=profile)
    yield from report.failures
    assert report.is_compliant or report.failures


def _ends_in_return(pdf: pikepdf.Pdf, failure: page.ValidationFailure) -> bool:
    """Return whether a stream is as long as it says, and ends in the byte of a carriage return.

    One in 256 does by chance, and page-validation takes that byte for a part of the line's end after it.
    """
    if failure.object_id is None:
        return False
    stream = pdf.get_object(failure.object_id.object_number, failure.object_id.generation)
    if not isinstance(stream, pikepdf.Stream):  # so wrong that none is found
        return False
    content = stream.read_raw_bytes()
    return len(content) == int(stream["/Length"]) and content.endswith(b"\r")
