"""What every renderer must do."""

from __future__ import annotations

import contextlib
import io
import json
import math
import os
import re
import time
import zipfile
from collections.abc import Callable, Iterator, Mapping
from html.parser import HTMLParser
from xml.etree import ElementTree as ET

from zlmreport.language import Language
from zlmreport.plugin.protocols import Renderer
from zlmreport.testing.certificates import MARKUP, NUMBER, sample_certificate, worded_certificate
from zlmreport.testing.expectations import check, expect, expect_members, expect_named, run_all

_SUFFIX = re.compile(r"\.[a-z0-9]+(\.[a-z0-9]+)*")
#: 26 hours apart: in these two zones it is never the same date.
_ZONES = ("UTC-14", "UTC+12")


@check
def is_named(renderer: Renderer) -> None:
    """Check that it has an identifier that can be typed, a title in every language, and a file suffix."""
    expect_named(renderer, Renderer)
    expect(
        _SUFFIX.fullmatch(renderer.suffix),
        f"{renderer.identifier}: suffix {renderer.suffix!r} must be like '.pdf'",
    )


@check
def writes_every_block(renderer: Renderer) -> None:
    """Check that a certificate with one of everything becomes a file, in every language."""
    for language in Language:
        content = renderer.render(sample_certificate(language))
        expect(
            isinstance(content, bytes) and content,
            f"{renderer.identifier}: render must return the bytes of a file, not {type(content).__name__}",
        )


@check
def reads_no_clock(renderer: Renderer) -> None:
    """Check that the same certificate gives the same bytes, in the next second and on another date."""
    certificate = sample_certificate()
    with _time_zone(_ZONES[0]):
        first = renderer.render(certificate)
    time.sleep(1.001)
    with _time_zone(_ZONES[1]):
        second = renderer.render(certificate)
    expect(
        first == second,
        f"{renderer.identifier}: the same certificate gave other bytes on another date and in another second "
        f"({_difference(first, second)}); dates come from the certificate",
    )


@check
def names_the_certificate(renderer: Renderer) -> None:
    """Check that the file carries the certificate's number."""
    content = renderer.render(sample_certificate())
    read = _READERS.get(renderer.suffix)
    if read is not None:
        expect(
            NUMBER in read(content),
            f"{renderer.identifier}: the file does not carry the certificate's number, {NUMBER}",
        )


@check
def prints_what_the_document_says(renderer: Renderer) -> None:
    """Check that nothing is dropped: no word of a document, and no value where the format is one of data."""
    certificate, words = worded_certificate()
    content = renderer.render(certificate)
    text = _READERS.get(renderer.suffix, _plain_text)(content)
    if renderer.suffix in _DATA:
        (parameter,) = certificate.evaluations[0].parameters
        wanted = [certificate.measurements.axis.deviation_unit.from_si(parameter.value), parameter.value]
        found = [float(number) for number in _NUMBER.findall(text)]
        expect(
            any(math.isclose(one, other, rel_tol=1e-3) for one in found for other in wanted),
            f"{renderer.identifier}: the file does not carry the value of the parameter "
            f"{parameter.quantity.symbol}, {wanted[0]:.6g}",
        )
        return
    missing = [f"{word} ({what})" for what, word in words.items() if word not in _unspaced(text)]
    expect(not missing, f"{renderer.identifier}: the file does not print {', '.join(missing)}")


@check
def sets_markup_as_text(renderer: Renderer) -> None:
    """Check that tags, entities and template expressions in a user's words come out as they were typed."""
    content = renderer.render(sample_certificate(text=MARKUP))
    read = _READERS.get(renderer.suffix)
    if read is not None:
        expect(
            _unspaced(MARKUP) in _unspaced(read(content)),
            f"{renderer.identifier}: a user's text {MARKUP!r} does not come out as it was typed",
        )


@contextlib.contextmanager
def _time_zone(zone: str) -> Iterator[None]:
    if not hasattr(time, "tzset"):  # there, no process can be told that it is elsewhere
        yield
        return
    before = os.environ.get("TZ")
    os.environ["TZ"] = zone
    time.tzset()
    try:
        yield
    finally:
        if before is None:
            del os.environ["TZ"]
        else:
            os.environ["TZ"] = before
        time.tzset()


def _difference(first: bytes, second: bytes) -> str:
    pairs = enumerate(zip(first, second, strict=False))
    place = next((place for place, (one, other) in pairs if one != other), min(len(first), len(second)))
    return f"from byte {place}: {first[place : place + 20]!r}, then {second[place : place + 20]!r}"


def _unspaced(text: str) -> str:
    """Return the text without what setting it in lines adds: spaces, line breaks, hyphenation points."""
    return re.sub(r"[\s\u00ad\u200b]+", "", text)


class _Text(HTMLParser):
    """The running text of a page; fails on an element that came out of a user's words."""

    def __init__(self) -> None:
        super().__init__()
        self.parts: list[str] = []

    def handle_starttag(self, tag: str, _attributes: list[tuple[str, str | None]]) -> None:
        expect(tag != "zlm-markup", f"a user's text became an element: {self.get_starttag_text()}")

    def handle_data(self, data: str) -> None:
        self.parts.append(data)


def _html_text(content: bytes) -> str:
    parser = _Text()
    parser.feed(content.decode())
    parser.close()
    return "".join(parser.parts)


def _json_text(content: bytes) -> str:
    return json.dumps(json.loads(content), ensure_ascii=False).replace('\\"', '"')


def _pdf_text(content: bytes) -> str:
    try:
        from pypdf import PdfReader  # noqa: PLC0415 - an author of a standard needs no PDF library
    except ImportError as error:
        message = "checking a renderer of PDF files needs the package pypdf"
        raise AssertionError(message) from error
    return "\n".join(page.extract_text() for page in PdfReader(io.BytesIO(content)).pages)


def _xml_text(content: bytes) -> str:
    return "".join(ET.fromstring(content).itertext())  # noqa: S314 - written by the renderer just now


def _workbook_text(content: bytes) -> str:
    """Return the text of a file that is an archive of XML, as workbooks and text documents are."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        parts = [archive.read(name) for name in archive.namelist() if name.endswith(".xml")]
    return " ".join(" ".join(ET.fromstring(part).itertext()) for part in parts)  # noqa: S314 - as above


def _plain_text(content: bytes) -> str:
    """Return what somebody reads of a file of a kind that the kit does not know."""
    return content.decode("utf-8", "replace")


#: How to read the text of a file again, where the kit knows.
_READERS: Mapping[str, Callable[[bytes], str]] = {
    ".html": _html_text,
    ".json": _json_text,
    ".pdf": _pdf_text,
    ".xml": _xml_text,
    ".xlsx": _workbook_text,
}
#: Formats that carry results and no document.
_DATA = frozenset({".json", ".xml", ".xlsx", ".csv"})
_NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")

#: Every check of a renderer, each called with the renderer.
RENDERER_CHECKS = (
    is_named,
    writes_every_block,
    reads_no_clock,
    names_the_certificate,
    prints_what_the_document_says,
    sets_markup_as_text,
)


def check_renderer(renderer: Renderer) -> None:
    """Run every check on a renderer.

    Raises
    ------
    AssertionError
        With a line for every check that fails.
    """
    expect_members(renderer, Renderer)
    run_all(RENDERER_CHECKS, renderer)
