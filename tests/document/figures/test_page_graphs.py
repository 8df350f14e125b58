"""Graphs drawn straight into the page of a PDF document."""

from __future__ import annotations

import io
import logging
from collections.abc import Callable
from typing import Any

import pypdf
import pytest
from weasyprint import CSS, HTML
from weasyprint.text.fonts import FontConfiguration

from document.figures.samples import ALL, ORDINARY, Recording, drawn
from zlmreport.document.figures.metrics import find_font_file
from zlmreport.plugin import Figure, Language
from zlmreport.plugin.page import FontFace
from zlmreport_plugins.renderers.pdf.press import FAMILY, PageGraph

ALTERNATIVE = "Abweichung x̄i↑ über der Position"

Typeset = Callable[..., bytes]


@pytest.fixture(scope="module")
def typeset() -> Typeset:
    """Return what makes a PDF document of figures, in the bundled faces."""
    fonts = FontConfiguration()
    looks = {
        FontFace.REGULAR: (400, "normal"),
        FontFace.ITALIC: (400, "italic"),
        FontFace.SEMIBOLD: (600, "normal"),
    }
    faces = "".join(
        f'@font-face {{ font-family: "{FAMILY}"; src: url({find_font_file(face).as_uri()});'
        f" font-weight: {weight}; font-style: {style} }}"
        for face, (weight, style) in looks.items()
    )
    sheet = CSS(string=f"@page {{ size: A4; margin: 20mm }} {faces}", font_config=fonts)

    def make(figures: list[Figure], width: str = "auto") -> bytes:
        images = "".join(
            f'<p><img src="graph:{number}" alt="{ALTERNATIVE} {number}" style="width: {width}"></p>'
            for number in range(len(figures))
        )
        pdf = HTML(string=f'<html lang="de"><title>Graphs</title><body>{images}</body></html>').write_pdf(
            stylesheets=[sheet],
            font_config=fonts,
            cache={
                f"graph:{number}": PageGraph(figure, Language.GERMAN) for number, figure in enumerate(figures)
            },
            pdf_tags=True,
            uncompressed_pdf=True,
        )
        assert pdf is not None
        return pdf

    return make


def _read(pdf: bytes) -> pypdf.PdfReader:
    return pypdf.PdfReader(io.BytesIO(pdf))


@pytest.fixture(scope="module")
def pdf(typeset: Typeset) -> bytes:
    return typeset([ORDINARY["both directions"]])


@pytest.fixture(scope="module")
def canvas() -> Recording:
    return drawn(ORDINARY["both directions"], Language.GERMAN)


def _without_spaces(text: str) -> str:
    return "".join(text.split())


def test_every_label_is_text_of_the_page_in_the_order_of_drawing(pdf: bytes, canvas: Recording) -> None:
    text = _without_spaces(_read(pdf).pages[0].extract_text())
    place = 0
    for label in canvas.texts:
        if label.angle == 0:
            place = text.index(_without_spaces(label.text), place)


def test_a_turned_title_is_text_of_the_page(pdf: bytes) -> None:
    text = _read(pdf).pages[0].extract_text(orientations=(90, 270))
    assert "Abweichung in µm" in text


def test_every_label_says_what_it_reads_as(pdf: bytes, canvas: Recording) -> None:
    for label in canvas.texts:
        meant = b"\xfe\xff" + label.text.encode("utf-16-be")
        shown = f"({label.text})" if label.text.isascii() else f"<{meant.hex()}>"
        assert f"/ActualText {shown}".encode() in pdf


def test_the_first_letter_with_a_bar_maps_to_itself(pdf: bytes) -> None:
    text = _read(pdf).pages[0].extract_text()
    assert "x̄" in text
    assert "\N{COMBINING MACRON}" * 2 not in text


def test_only_the_bundled_faces_are_embedded(pdf: bytes) -> None:
    fonts = _read(pdf).pages[0]["/Resources"]["/Font"]
    names = {font.get_object()["/BaseFont"].split("+")[1] for font in fonts.values()}
    assert names <= {"IBM-Plex-Sans", "IBM-Plex-Sans-Italic", "IBM-Plex-Sans-Semi-Bold"}


def test_a_graph_is_tagged_as_a_figure_with_its_alternative(pdf: bytes) -> None:
    root = _read(pdf).trailer["/Root"]["/StructTreeRoot"]
    assert [element["/Alt"] for element in _figures(root)] == [f"{ALTERNATIVE} 0"]


def _figures(element: Any) -> list[Any]:
    element = element.get_object()
    if isinstance(element, pypdf.generic.ArrayObject):
        return [found for child in element for found in _figures(child)]
    if not isinstance(element, pypdf.generic.DictionaryObject):
        return []
    here = [element] if element.get("/S") == "/Figure" else []
    return here + (_figures(element["/K"]) if "/K" in element else [])


def test_a_graph_is_as_large_as_its_figure() -> None:
    width, height, ratio = PageGraph(ORDINARY["both directions"], Language.ENGLISH).get_intrinsic_size(1, 16)
    assert (width, height) == (pytest.approx(170 / 25.4 * 96), pytest.approx(90 / 25.4 * 96))
    assert ratio == pytest.approx(170 / 90)


def test_a_graph_fills_the_place_that_the_document_gives_it(typeset: Typeset) -> None:
    # Points of the figure in CSS pixels of the page: 4/3 at its own size.
    assert b"1.333333 0 0 1.333333 0 0 cm" in typeset([ORDINARY["both directions"]])
    assert b"0.666667 0 0 0.666667 0 0 cm" in typeset([ORDINARY["both directions"]], width="85mm")


def test_the_same_figures_give_the_same_bytes(typeset: Typeset) -> None:
    figures = [ORDINARY["both directions"], ORDINARY["each direction"]]
    assert typeset(figures) == typeset(figures)


@pytest.mark.parametrize("sample", ALL.values(), ids=ALL.keys())
def test_every_figure_reaches_its_page_without_a_warning(
    sample: Figure, typeset: Typeset, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING, logger="weasyprint"):
        typeset([sample])
    assert not caplog.records
