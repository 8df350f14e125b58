"""What every renderer must do."""

from __future__ import annotations

import contextlib
import csv
import io
import json
import math
import os
import re
import time
import zipfile
from collections.abc import Callable, Iterator, Mapping
from html.parser import HTMLParser
from typing import TypeAlias, get_args
from xml.etree import ElementTree as ET

from zlmreport.document.blocks import Block, Cell
from zlmreport.document.certificate.document import Certificate
from zlmreport.language import Language
from zlmreport.plugin.kinds import RENDERER
from zlmreport.plugin.protocols import Renderer
from zlmreport.testing.certificates import (
    LETTERS,
    MARKUP,
    NUMBER,
    make_ordered_certificate,
    make_worded_certificate,
    sample_certificate,
)
from zlmreport.testing.expectations import (
    check,
    expect,
    expect_named,
    guard_subject,
    list_checks_of,
    run_all,
)

#: From the bytes of a file to its text, as somebody reads it who opens it.
Reader: TypeAlias = Callable[[bytes], str]

#: 26 hours apart: in these two zones it is never the same date.
_ZONES = ("UTC-14", "UTC+12")


@check
def is_named(renderer: Renderer, _read: Reader | None = None) -> None:
    """Check that it has an identifier that can be typed, a title in every language, and a file suffix."""
    expect_named(renderer, RENDERER)


@check
def writes_every_block(renderer: Renderer, _read: Reader | None = None) -> None:
    """Check that a certificate with one of everything becomes a file, in every language."""
    for language in Language:
        guard_subject(renderer, RENDERER).render(sample_certificate(language))


@check
def reads_no_clock(renderer: Renderer, _read: Reader | None = None) -> None:
    """Check that the same certificate gives the same bytes, in the next second and on another date."""
    certificate = sample_certificate()
    with _set_time_zone(_ZONES[0]):
        first = renderer.render(certificate)
    time.sleep(1.001)
    with _set_time_zone(_ZONES[1]):
        second = renderer.render(certificate)
    expect(
        first == second,
        f"{renderer.identifier}: the same certificate gave other bytes on another date and in another second "
        f"({_find_difference(first, second)}); dates come from the certificate",
    )


@check
def names_the_certificate(renderer: Renderer, read: Reader | None = None) -> None:
    """Check that the file carries the certificate's number; a table of values has it in its name."""
    if renderer.suffix in _TABLES:
        return
    expect(
        NUMBER in _read_text(renderer, sample_certificate(), read),
        f"{renderer.identifier}: the file does not carry the certificate's number, {NUMBER}",
    )


@check
def prints_what_the_document_says(renderer: Renderer, read: Reader | None = None) -> None:
    """Check that nothing is dropped: no word of a document, and no value where the format is one of data."""
    certificate, words = make_worded_certificate()
    text = _read_text(renderer, certificate, read)
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
    missing = [f"{word} ({what})" for what, word in words.items() if word not in _remove_spaces(text)]
    expect(not missing, f"{renderer.identifier}: the file does not print {', '.join(missing)}")
    printed = _OBJECT.search(text)
    expect(
        not printed,
        f"{renderer.identifier}: the file prints an object as Python shows it: {printed and printed[0]}…; a "
        "cell is a text, a Symbol (notation_spans), an Explained (name, meaning) or a Verdict (word)",
    )


@check
def sets_markup_as_text(renderer: Renderer, read: Reader | None = None) -> None:
    """Check that tags, entities and template expressions in a user's words come out as they were typed."""
    if _has_users_words(renderer, read):
        expect(
            _remove_spaces(MARKUP)
            in _remove_spaces(_read_text(renderer, sample_certificate(text=MARKUP), read)),
            f"{renderer.identifier}: a user's text {MARKUP!r} does not come out as it was typed",
        )


@check
def keeps_letters_and_signs(renderer: Renderer, read: Reader | None = None) -> None:
    """Check that letters and signs of all Europe come out as they were typed: a file is UTF-8."""
    if _has_users_words(renderer, read):
        text = _remove_spaces(_read_text(renderer, sample_certificate(text=LETTERS), read))
        lost = sorted(letter for letter in set(_remove_spaces(LETTERS)) if letter not in text)
        expect(not lost, f"{renderer.identifier}: {''.join(lost)} do not come out as they were typed")


@check
def keeps_the_order(renderer: Renderer, read: Reader | None = None) -> None:
    """Check that sections, blocks and parameters come in the order of the certificate, each in its unit."""
    certificate, words, values = make_ordered_certificate()
    text = _read_text(renderer, certificate, read)
    if renderer.suffix in _DATA:
        numbers = [float(number) for number in _NUMBER.findall(text)]
        places = [
            next((at for at, number in enumerate(numbers) if _is_one_of(number, each)), -1) for each in values
        ]
        lost = [f"{value:.6g}" for (_, value), place in zip(values, places, strict=True) if place < 0]
        expect(
            not lost,
            f"{renderer.identifier}: the file does not carry {', '.join(lost)}; a parameter is in SI, or in "
            "its own unit (quantity.unit_or)",
        )
    else:
        places = [text.find(word) for word in words]
        missing = [word for word in words if word not in text]
        expect(not missing, f"{renderer.identifier}: the file does not print {', '.join(missing)}")
    expect(
        places == sorted(places),
        f"{renderer.identifier}: sections, blocks or parameters are not in the order of the certificate",
    )


def _is_one_of(number: float, values: tuple[float, float]) -> bool:
    return any(math.isclose(number, value, rel_tol=1e-3) for value in values)


def _has_users_words(renderer: Renderer, read: Reader | None) -> bool:
    """Return whether a user's own words stand in the file: of a document they do, some data have none."""
    return renderer.suffix not in _DATA or _WORD in _read_text(renderer, sample_certificate(text=_WORD), read)


def _read_text(renderer: Renderer, certificate: Certificate, read: Reader | None) -> str:
    """Return the text of a file, as its author reads it, or as the kit knows the format."""
    content = renderer.render(certificate)
    reader = read or _READERS.get(renderer.suffix)
    expect(
        reader,
        f"{renderer.identifier}: say how a file {renderer.suffix!r} is read: check_renderer(…, read=…), "
        f"from its bytes to its text; the kit knows {', '.join(sorted(_READERS))}",
    )
    assert reader is not None  # noqa: S101  # said above; for type checkers
    try:
        return reader(content)
    except UnicodeDecodeError as error:
        message = f"{renderer.identifier}: the file is not UTF-8: {error}"
        raise AssertionError(message) from error


@contextlib.contextmanager
def _set_time_zone(zone: str) -> Iterator[None]:
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


def _find_difference(first: bytes, second: bytes) -> str:
    pairs = enumerate(zip(first, second, strict=False))
    place = next((place for place, (one, other) in pairs if one != other), min(len(first), len(second)))
    return f"from byte {place}: {first[place : place + 20]!r}, then {second[place : place + 20]!r}"


def _remove_spaces(text: str) -> str:
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


def _read_json(content: bytes) -> str:
    return json.dumps(json.loads(content), ensure_ascii=False).replace('\\"', '"')


def _read_pdf(content: bytes) -> str:
    try:
        from pypdf import PdfReader  # noqa: PLC0415 - an author of a standard needs no PDF library
    except ImportError as error:
        message = "checking a renderer of PDF files needs the package pypdf"
        raise AssertionError(message) from error
    return "\n".join(page.extract_text() for page in PdfReader(io.BytesIO(content)).pages)


def _read_xml(content: bytes) -> str:
    return "".join(ET.fromstring(content).itertext())  # noqa: S314 - written by the renderer just now


def _read_workbook(content: bytes) -> str:
    """Return the text of a file that is an archive of XML, as workbooks and text documents are."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        parts = [archive.read(name) for name in archive.namelist() if name.endswith(".xml")]
    return " ".join(" ".join(ET.fromstring(part).itertext()) for part in parts)  # noqa: S314 - as above


def _read_csv(content: bytes) -> str:
    """Return the cells of a table, one a line; fails on a row that has more or fewer than the first."""
    rows = list(csv.reader(io.StringIO(content.decode(), newline=""), strict=True))
    for number, row in enumerate(rows, start=1):
        expect(
            len(row) == len(rows[0]),
            f"row {number} has {len(row)} cells, and the first has {len(rows[0])}; a comma or a quotation "
            "mark in a user's text is set as text by csv.writer",
        )
    return "\n".join(cell for row in rows for cell in row)


#: How to read the text of a file again, where the kit knows.
_READERS: Mapping[str, Reader] = {
    ".csv": _read_csv,
    ".html": _html_text,
    ".json": _read_json,
    ".pdf": _read_pdf,
    ".xml": _read_xml,
    ".txt": bytes.decode,
    ".xlsx": _read_workbook,
}
#: Stands for a user's words.
_WORD = "Kitword"
#: Formats that carry results and no document.
_DATA = frozenset({".json", ".xml", ".xlsx", ".csv"})
_TABLES = frozenset({".csv"})
_NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")

#: Of blocks and cells as Python shows them.
_KINDS = [each.__name__ for each in (*get_args(Block), *get_args(Cell)) if each is not str]
_OBJECT = re.compile(rf"(?:{'|'.join(_KINDS)})\(\w+=[^,)]*")

#: Every check of a renderer, each called with it and with how its author reads its files.
RENDERER_CHECKS = list_checks_of(__name__)


def check_renderer(renderer: Renderer, read: Reader | None = None) -> None:
    """Run every check on a renderer.

    Parameters
    ----------
    renderer
        The object that the plugin's hook returns.
    read
        From the bytes of a file to its text, as somebody sees it who opens it; of formats that the kit does
        not know it does not pass without.

    Raises
    ------
    AssertionError
        With a line for every check that fails.
    """
    run_all(RENDERER, RENDERER_CHECKS, renderer, read)
