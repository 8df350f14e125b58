"""A laboratory's own look: its typeface, its templates, and what neither can do."""

from __future__ import annotations

import io
import re
from pathlib import Path
from typing import Any

import matplotlib as mpl
import pypdf
import pytest
from fontTools.ttLib import TTFont

from document.certificate.documents import certificate, having
from installed import registry
from refusals import mistakes, refusal
from zlmreport.document.typesetting import own_templates
from zlmreport.plugin import AccessError, InputError
from zlmreport.plugin.renderer import Certificate

FONTS = Path(mpl.get_data_path(), "fonts", "ttf")
TYPEFACE = {"regular": str(FONTS / "DejaVuSerif.ttf"), "semibold": str(FONTS / "DejaVuSerif-Bold.ttf")}
FOR = "{% for each in range(999) %}"
NOTICE = '<div class="house">{% include "usual/notice.html" %}</div>'


def styled(folder: Path, **style: Any) -> Certificate:
    return certificate(folder, having("certificate.style", style))


def templates(folder: Path, **files: str) -> Path:
    house = folder / "house"
    house.mkdir()
    for name, text in files.items():
        (house / name.replace("_", ".")).write_text(text, encoding="utf-8")
    return house


def pdf(of: Certificate) -> pypdf.PdfReader:
    return pypdf.PdfReader(io.BytesIO(registry().renderer("pdf").render(of)))


def told_of(of: Certificate, renderer: str = "html") -> str:
    return refusal(registry().renderer(renderer).render, of)


@pytest.mark.long
def test_text_is_set_in_the_typeface_and_graphs_in_the_bundled_one(tmp_path: Path) -> None:
    found = styled(tmp_path, typeface=TYPEFACE)
    reader = pdf(found)
    names = {str(font.get_object()["/BaseFont"]) for font in reader.pages[0]["/Resources"]["/Font"].values()}
    assert any("own-" in each for each in names)
    assert any("IBM-Plex-Sans-Italic" in each for each in names)
    assert "data:font/sfnt" in registry().renderer("html").render(found).decode()


@pytest.mark.long
def test_it_takes_no_more_room_than_the_bundled_one(tmp_path: Path) -> None:
    (tmp_path / "usual").mkdir()
    pages = len(pdf(certificate(tmp_path / "usual")).pages)
    assert len(pdf(styled(tmp_path, typeface=TYPEFACE)).pages) == pages


def test_its_figures_stand_in_columns_by_their_own_width(tmp_path: Path) -> None:
    typeface = styled(tmp_path, typeface=TYPEFACE).look.typeface
    assert typeface is not None
    font = TTFont(io.BytesIO(typeface.regular))
    figure = font["hmtx"].metrics[font.getBestCmap()[ord("0")]][0] / font["head"].unitsPerEm
    assert typeface.figure == figure <= 0.6


def test_a_font_that_lacks_letters_is_refused_at_its_key(tmp_path: Path) -> None:
    signs = {**TYPEFACE, "regular": str(FONTS / "STIXSizOneSymReg.ttf")}
    with pytest.raises(InputError, match=r"job\.yaml:\d+.*STIXSizOneSymReg\.ttf has no .a"):
        styled(tmp_path, typeface=signs)


def test_what_is_no_font_is_refused(tmp_path: Path) -> None:
    (tmp_path / "logo.ttf").write_bytes(b"\x89PNG")
    with pytest.raises(InputError, match=r"logo\.ttf is no font"):
        styled(tmp_path, typeface={**TYPEFACE, "regular": "logo.ttf"})


def test_a_font_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(AccessError, match=r"none\.ttf cannot be read"):
        styled(tmp_path, typeface={**TYPEFACE, "semibold": "none.ttf"})


def test_a_font_that_must_not_be_embedded_is_refused(tmp_path: Path) -> None:
    font = TTFont(TYPEFACE["regular"])
    font["OS/2"].fsType = 2
    font.save(tmp_path / "closed.ttf")
    with pytest.raises(InputError, match="must not be embedded"):
        styled(tmp_path, typeface={**TYPEFACE, "regular": "closed.ttf"})


@pytest.mark.parametrize("renderer", ["pdf", "html"])
def test_a_template_takes_the_place_of_one_kind_of_block(tmp_path: Path, renderer: str) -> None:
    house = templates(tmp_path, notice_html=NOTICE, style_css=".house { background: #fbeef2 }")
    content = registry().renderer(renderer).render(styled(tmp_path, templates=str(house)))
    if renderer == "html":
        assert content.decode().count('<div class="house">') == content.decode().count('class="notice"') > 0
        assert ".house { background: #fbeef2 }" in content.decode()


@pytest.mark.parametrize(
    ("template", "told"),
    [
        ("{{ heading }}", ": this template leaves out"),
        ("\n<p>{{ headng }}</p>", ":2:1: … 'headng' is not given here; did you mean 'heading'?"),
        ("{{ items }}\n{{ items.x }}", ":2:1: … 'x' is nothing that this value has; known: count, index"),
        ("\n{% if %}", ":2:1: … Expected an expression"),
        ("\n{{ heading | uper }}", ":2:1: … No filter named 'uper'"),
        (
            "\n<p>" + NOTICE + "<br></p>",
            ": … what it writes is no XHTML: mismatched tag in </div></div><br></p>",
        ),
        ("<p>" + NOTICE, ": … what it writes is no XHTML: an element is not closed"),
        ("{{ ''.__class__.__mro__ }}" + NOTICE, ":1:1: … access to attribute"),
        ('\n{% include "../../secret" %}', ":2:1: … there is no template '../../secret'; known: facts.html"),
        (
            '{% include "usual/notise.html" %}',
            ":1:1: … there is no template 'usual/notise.html'; did you mean",
        ),
        ("\n{{ 1 / 0 }}", ":2:1: … division by zero"),
        ('\n{% include "notice.html" %}', ":2:1: … it "),
        (
            f"\n{FOR}{FOR}{FOR}x{'{% endfor %}' * 3}",
            ":2:1: … it has not come to its end after 100000 steps",
        ),
        ("\n{{ 'x' * 10 ** 9 }}", ":2:1: … the result of * is too large"),
        ("\n{{ 10 ** 1000000 }}", ":2:1: … the result of ** is too large"),
    ],
)
def test_a_template_that_is_wrong_or_leaves_out_is_refused_at_its_line(
    tmp_path: Path, template: str, told: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(own_templates, "MOST_STEPS", 100_000)
    house = templates(tmp_path, notice_html=template)
    expected = f"{house / 'notice.html'}{told.replace('…', 'this template does not work:')}"
    assert told_of(styled(tmp_path, templates=str(house))).startswith(expected)


def test_a_template_that_is_no_utf_8_is_named_with_its_line(tmp_path: Path) -> None:
    house = templates(tmp_path, notice_html=NOTICE, table_html="")
    (house / "table.html").write_bytes(b"<div>\n\xff</div>")
    with pytest.raises(InputError, match=r"table\.html:2:1: byte 7 is no UTF-8"):
        styled(tmp_path, templates=str(house))


def test_a_picture_cannot_be_left_out_either(tmp_path: Path) -> None:
    house = templates(tmp_path, graph_html="<p>{{ label }} {{ caption }}</p>")
    assert "leaves out <" in told_of(styled(tmp_path, templates=str(house)), "pdf")


def test_a_file_that_stands_for_no_block_is_refused(tmp_path: Path) -> None:
    house = templates(tmp_path, notices_html="")
    with pytest.raises(InputError, match=r"house/notices\.html stands for no block.*notice\.html"):
        styled(tmp_path, templates=str(house))


@pytest.mark.parametrize("style", [{"typeface": TYPEFACE}, {"templates": "house"}])
def test_typst_takes_neither_and_names_the_key(tmp_path: Path, style: dict[str, Any]) -> None:
    templates(tmp_path, notice_html=NOTICE)
    told = told_of(styled(tmp_path, **style), "pdf-typst")
    assert re.match(rf"{tmp_path}/job\.yaml:\d+:\d+: the format pdf-typst .* ask for the format pdf", told)


def test_what_the_pdf_ignores_of_a_style_sheet_is_refused_at_its_line(tmp_path: Path) -> None:
    style = ".house {colr: red}\n@media screen {p {colr: red}}\n.a, p:foo{color: red}\n.b {color: rod}"
    house = templates(tmp_path, style_css=style)
    found = styled(tmp_path, typeface=TYPEFACE, templates=str(house))
    told = mistakes(house, registry().renderer("pdf").render, found)
    assert [each.partition("; ")[0] for each in told] == [
        "style.css:1:9: this style sheet does not work: Ignored `colr: red`, unknown property",
        "style.css:3:1: this style sheet does not work: Invalid or unsupported selector, '.a, p:foo'",
        "style.css:4:5: this style sheet does not work: Ignored `color: rod`, invalid value",
    ]


@pytest.mark.parametrize(
    ("files", "told"),
    [
        ({"paragraph_html": '<p style="colr: red">{{ text }}</p>'}, "Ignored `colr: red`"),
        pytest.param(
            {"style_css": "@page { margin: 100mm }"},
            "is there room for text on a page",
            marks=pytest.mark.long,
        ),
    ],
)
def test_templates_of_which_no_pages_can_be_made_are_refused_at_their_key(
    tmp_path: Path, files: dict[str, str], told: str
) -> None:
    found = told_of(styled(tmp_path, templates=str(templates(tmp_path, **files))), "pdf")
    assert found.startswith(f"{tmp_path}/job.yaml:")
    assert told in found
