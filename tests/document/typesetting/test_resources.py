"""Style sheets and fonts as they are bundled."""

from __future__ import annotations

import re
from io import BytesIO

import pytest
from fontTools.ttLib import TTFont, woff2

from zlmreport.document.typesetting.resources import FAMILY, FontFace
from zlmreport.plugin.page import FONT_FACES, font_face_rules, font_file, style_sheet

SHEETS = ("certificate", "paged", "screen", "A4", "Letter", "overview")


@pytest.mark.parametrize("face", FONT_FACES, ids=lambda face: face.stem)
def test_the_packed_font_is_the_font(face: FontFace) -> None:
    unpacked = BytesIO()
    woff2.decompress(BytesIO(font_file(f"{face.stem}.woff2")), unpacked)
    original = TTFont(BytesIO(font_file(f"{face.stem}.ttf")))
    packed = TTFont(unpacked)
    assert packed.getBestCmap() == original.getBestCmap()
    assert packed["hmtx"].metrics == original["hmtx"].metrics
    assert packed["head"].fontRevision == original["head"].fontRevision


@pytest.mark.parametrize("face", FONT_FACES, ids=lambda face: face.stem)
def test_all_figures_and_the_signs_between_them_are_of_the_widths_that_the_style_sheet_counts_on(
    face: FontFace,
) -> None:
    loaded = TTFont(BytesIO(font_file(f"{face.stem}.ttf")))
    glyphs = loaded.getBestCmap()
    widths = {character: loaded["hmtx"][glyphs[ord(character)]][0] for character in "0123456789−.,"}
    assert {widths[character] for character in "0123456789−"} == {600}
    assert widths["."] == widths[","]
    if face.stem.endswith("Regular"):
        assert widths["."] == 272


@pytest.mark.parametrize("face", FONT_FACES, ids=lambda face: face.stem)
@pytest.mark.parametrize("character", "↑↓µ−×·±≤≥″°∑√|Δα½²\N{COMBINING MACRON}✓×–—…")
def test_the_typeface_has_what_standards_print(face: FontFace, character: str) -> None:
    assert ord(character) in TTFont(BytesIO(font_file(f"{face.stem}.ttf"))).getBestCmap()


def test_every_face_is_brought_in_under_the_family() -> None:
    rules = font_face_rules(lambda face: f"font:{face.stem}")
    assert rules.count(f'font-family: "{FAMILY}"') == len(FONT_FACES)
    assert "src: url(font:IBMPlexSans-Italic)" in rules


@pytest.mark.parametrize("sheet", SHEETS)
def test_a_style_sheet_loads_nothing(sheet: str) -> None:
    assert not re.search(r"@import|url\(", style_sheet(sheet))


@pytest.mark.parametrize("sheet", SHEETS)
def test_a_style_sheet_asks_for_no_font_feature(sheet: str) -> None:
    # Each costs a certificate some memory that WeasyPrint never gives back.
    assert not re.search(r"font-variant|font-feature|tabular", style_sheet(sheet))


def test_style_sheets_follow_each_other_as_named() -> None:
    assert style_sheet("A4", "Letter") == f"{style_sheet('A4')}\n{style_sheet('Letter')}"


def test_a_colour_stands_for_the_usual_one_wherever_a_style_sheet_has_that() -> None:
    usual, accent = style_sheet("certificate"), "#0d4a63"
    assert usual.count(accent) > 1
    assert style_sheet("certificate", accent="#5c1a33") == usual.replace(accent, "#5c1a33")
