"""What a viewer shows of two documents is compared by its text and its pixels."""

from __future__ import annotations

import re
from collections.abc import Callable
from io import BytesIO

import pikepdf
import pytest
from pypdf import PdfReader

from verification.issued import with_page_content
from zlmreport.cli.terminal import say
from zlmreport.verification import raster
from zlmreport.verification.findings import CheckedCertificate, VerificationOutcome, VerificationVerdict


def page(drawn: str, width: int = 200, rotate: int = 0) -> bytes:
    """Return a document of one page."""
    saved = BytesIO()
    with pikepdf.new() as pdf:
        pdf.add_blank_page(page_size=(width, 100))
        pdf.pages[0].obj.Contents = pdf.make_stream(drawn.encode())
        font = pikepdf.Dictionary(
            Type=pikepdf.Name.Font, Subtype=pikepdf.Name.Type1, BaseFont=pikepdf.Name.Helvetica
        )
        pdf.pages[0].obj.Resources = pikepdf.Dictionary(Font=pikepdf.Dictionary(F=font))
        pdf.pages[0].obj.Rotate = rotate
        pdf.save(saved)
    return saved.getvalue()


def seen(content: bytes, again: bytes, *, is_alike: bool = True) -> str:
    """Return what is told of the first page; empty if both show the same."""
    found = raster.compare(content, again, [is_alike])
    assert all(each.verdict is VerificationVerdict.DIFFERS for each in found.values())
    return str(found[0].detail) if found else ""


def words(text: str, y: float = 50) -> str:
    return f"BT /F 12 Tf 20 {y} Td ({text}) Tj ET"


BOX = "0 0 0 rg {x} 20 50 30 re f"


def test_what_shows_the_same_is_the_same() -> None:
    assert seen(page(words("7.26")), page(words("7.26"))) == ""


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (page(words("7.96")), "'96' stands where '26' is printed again"),
        (page(words("7.26"), width=201), "in another size"),
        (page(words("7.26"), rotate=180), "in another size"),
        (
            page(words("7.26") + " 1 0 0 rg 100 60 4 4 re f"),
            "pixels, the first 35 mm from the left and 13 mm",
        ),
    ],
    ids=["digit", "size", "rotation", "mark"],
)
def test_what_a_viewer_shows_otherwise_is_told(content: bytes, told: str) -> None:
    assert told in seen(content, page(words("7.26")))


def test_each_pixel_is_counted_once() -> None:
    """A quarter of an inch square: 24 pixels by 24, and its smoothed edge."""
    count = re.search(r"(\d+) pixels", seen(page("20 20 18 18 re f"), page("")))
    assert count is not None
    assert 24**2 <= int(count[1]) <= 26**2


def test_a_page_that_is_not_there_is_told() -> None:
    found = raster.compare(page(""), page(""), [True, True])
    assert [(number, "it is not there" in str(each.detail)) for number, each in found.items()] == [(1, True)]


@pytest.mark.parametrize(
    ("points", "is_alike", "holds"), [(0.7, False, True), (0.7, True, False), (2, False, False)]
)
def test_a_mark_may_be_off_by_a_pixel_where_other_libraries_drew(
    points: float,
    is_alike: bool,
    holds: bool,
) -> None:
    told = seen(page(BOX.format(x=20 + points)), page(BOX.format(x=20)), is_alike=is_alike)
    assert (told == "") is holds


@pytest.mark.long
@pytest.mark.parametrize(
    ("points", "outcome"),
    [(0.3, VerificationOutcome.HOLDS), (2.0, VerificationOutcome.UNDECIDED)],
    ids=["a little", "far"],
)
def test_what_another_library_shifted_holds_within_the_tolerance(
    issued: bytes,
    verified: Callable[[bytes], CheckedCertificate],
    points: float,
    outcome: VerificationOutcome,
) -> None:
    shift = b"1 0 0 1 %f 0 cm\n" % points
    shifted = issued
    for number in range(1, len(PdfReader(BytesIO(issued)).pages) + 1):
        shifted = with_page_content(shifted, number, lambda content: shift + content)
    found = verified(shifted)
    assert found.outcome is outcome
    assert "other libraries printed it" in say(found.remarks[0])


@pytest.mark.parametrize(
    "over", ["1 1 1 rg 18 45 40 20 re f", "0 0 0 rg 23 50 2 9 re f", "1 g 27 48 8 12 re f"]
)
def test_what_is_painted_over_words_is_told_on_a_page_of_other_libraries(over: str) -> None:
    assert "pixels" in seen(page(f"{words('7.26')} {over}"), page(words("7.26")), is_alike=False)
