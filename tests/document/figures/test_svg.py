"""A figure as an SVG image: text stays text, and the same figure gives the same bytes."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from xml.etree import ElementTree as ET

import pytest

from document.figures.samples import ALL, both_directions, figure
from processes import PYTHON, run
from zlmreport.plugin import Figure, Language, same_in_all_languages
from zlmreport.plugin.page import figure_size, figure_to_svg

SVG = "{http://www.w3.org/2000/svg}"


def _svg(language: Language = Language.ENGLISH) -> ET.Element:
    return ET.fromstring(figure_to_svg(figure(both_directions()), language))


def _lines(image: ET.Element) -> list[str]:
    return ["".join(text.itertext()) for text in image.iter(f"{SVG}text")]


@pytest.mark.parametrize("sample", ALL.values(), ids=ALL.keys())
def test_every_figure_is_well_formed(sample: Figure) -> None:
    assert ET.fromstring(figure_to_svg(sample, Language.GERMAN)).tag == f"{SVG}svg"


def test_the_image_is_as_wide_as_the_text_of_a_page() -> None:
    assert float(_svg().attrib["width"].removesuffix("pt")) == pytest.approx(170 / 25.4 * 72, abs=0.001)


def test_one_panel_is_90_millimetres_high() -> None:
    _, height = figure_size(figure(both_directions()))
    assert height == pytest.approx(90 / 25.4 * 72)


def test_a_symbol_is_one_line_of_text() -> None:
    assert "x̄i↑ ± 2si↑" in _lines(_svg())


def test_titles_are_text_in_the_language() -> None:
    assert {"Sollposition in mm", "Abweichung in µm"} <= set(_lines(_svg(Language.GERMAN)))


def test_letters_are_italic_and_arrows_upright() -> None:
    label = next(text for text in _svg().iter(f"{SVG}text") if "".join(text.itertext()) == "x̄i↑")
    assert [run.get("font-style") for run in label] == ["italic", "italic", None]


def test_the_image_says_what_it_shows() -> None:
    assert _svg().attrib["aria-label"] == 'Deviations up to 7.5 µm, "A" and B < A'


def test_markup_in_a_text_stays_text() -> None:
    sample = figure(both_directions())
    named = type(sample)(
        "k",
        sample.title,
        sample.alternative,
        same_in_all_languages("<b>X</b> & Y"),
        sample.y_title,
        "mm",
        "µm",
        (),
    )
    assert "<b>X</b> & Y in mm" in _lines(ET.fromstring(figure_to_svg(named, Language.ENGLISH)))


def test_a_turned_title_stands_at_the_left_edge() -> None:
    title = next(text for text in _svg().iter(f"{SVG}text") if "transform" in text.attrib)
    assert title.attrib["transform"] == "rotate(-90)"
    # Turned by -90°, the page's x is the text's y.
    assert 5.0 < float(title[0].attrib["y"]) < 12.0


def test_the_same_figure_gives_the_same_bytes() -> None:
    assert figure_to_svg(figure(both_directions()), Language.ENGLISH) == figure_to_svg(
        figure(both_directions()), Language.ENGLISH
    )


def test_another_process_gives_the_same_bytes() -> None:
    program = (
        "import sys; sys.path.insert(0, sys.argv[1]);"
        "from figures.samples import figure, both_directions;"
        "from zlmreport.document.figures.draw import to_svg; from zlmreport.language import Language;"
        "sys.stdout.buffer.write(to_svg(figure(both_directions()), Language.GERMAN).encode())"
    )
    tests = __file__.rsplit("/figures/", 1)[0]
    other = run(PYTHON, "-c", program, tests, check=True)
    assert other.stdout == figure_to_svg(figure(both_directions()), Language.GERMAN)


def test_threads_draw_alike() -> None:
    samples = [*ALL.values()] * 2
    expected = [figure_to_svg(sample, Language.ENGLISH) for sample in samples]
    with ThreadPoolExecutor(4) as threads:
        assert list(threads.map(lambda sample: figure_to_svg(sample, Language.ENGLISH), samples)) == expected
