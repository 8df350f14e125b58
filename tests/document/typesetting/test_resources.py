"""Style sheets, fonts and files of pages, as they are bundled; templates of one's own run in a sandbox."""

from __future__ import annotations

import re
from io import BytesIO

import pytest
from fontTools.ttLib import TTFont, woff2
from jinja2 import TemplateNotFound
from jinja2.exceptions import SecurityError, UndefinedError

from zlmreport.document.certificate.document import OwnTemplate
from zlmreport.document.figures.canvas import FAMILY
from zlmreport.document.typesetting.resources import FontFace, find_page_file, read_page_files
from zlmreport.document.typesetting.templates import make_environment
from zlmreport.plugin.page import FONT_FACES, font_face_rules, font_file, style_sheet

OWN = (OwnTemplate("notice.html", "house/notice.html", ""),)
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


_IMPORT = re.compile(r'from "\./([\w.]+)"')
_URL = re.compile(r"url\(([^)]+)\)")


def test_everything_that_a_page_loads_is_there() -> None:
    named = {"workbench.js", "tokens.css", "workbench.css", "graphs.css", "faces.css", "icon.svg"}
    for name, file in read_page_files().items():
        if name.endswith((".js", ".css")):
            named.update((_IMPORT if name.endswith(".js") else _URL).findall(file.content.decode()))
    assert named == set(read_page_files())


@pytest.mark.parametrize("name", ["", ".", "..", "../templates/document.html", "/etc/passwd", "__init__.py"])
def test_nothing_else_is_handed_out(name: str) -> None:
    assert find_page_file(name) is None


def test_scripts_turn_no_text_into_markup_or_program() -> None:
    scripts = "".join(
        file.content.decode() for name, file in read_page_files().items() if name.endswith(".js")
    )
    for word in (
        "innerHTML",
        "outerHTML",
        "insertAdjacentHTML",
        "document.write",
        "eval(",
        "new Function",
        ".style",
    ):
        assert word not in scripts


def test_every_media_type_is_one_that_browsers_take() -> None:
    assert {file.media_type for file in read_page_files().values()} == {
        "text/css",
        "text/javascript",
        "image/svg+xml",
        "font/woff2",
    }


@pytest.mark.parametrize(
    "attack",
    [
        "{{ ''.__class__.__mro__[1].__subclasses__() }}",
        "{{ words.append('x') }}",
        "{{ words.clear() }}",
        "{{ call.__globals__ }}",
        "{{ '{0.__class__.__init__.__globals__}'.format(call) }}",
        "{{ range(10**9) | list }}",
    ],
)
def test_a_template_of_ones_own_reaches_nothing_but_what_it_is_given(attack: str) -> None:
    words = ["a"]
    with pytest.raises((SecurityError, OverflowError)):
        make_environment(OWN).from_string(attack).render(words=words, call=lambda: None)
    assert words == ["a"]


@pytest.mark.parametrize("name", ["/etc/passwd", "../styles/A4.css", "../../../../etc/passwd", "none.html"])
def test_a_template_of_elsewhere_is_not_found(name: str) -> None:
    with pytest.raises(TemplateNotFound):
        make_environment(OWN).from_string("{% include name %}").render(name=name)


def test_a_value_that_is_missing_is_a_mistake_and_no_blank() -> None:
    with pytest.raises(UndefinedError):
        make_environment().from_string("{{ nothing }}").render()


def test_a_value_is_escaped() -> None:
    text = make_environment().from_string("<p title='{{ text }}'>{{ text }}</p>").render(text="<b>'&\"")
    assert text == "<p title='&lt;b&gt;&#39;&amp;&#34;'>&lt;b&gt;&#39;&amp;&#34;</p>"
