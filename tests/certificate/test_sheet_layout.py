"""The layout `sheet`: one page for each standard, or a refusal that names what does not fit."""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pypdf
import pypdfium2
import pytest

from certificate.documents import COMPLETE, certificate, having, registry
from zlmreport.certificate import columns
from zlmreport.certificate.document import Block, Certificate, Facts, Graph, Notice, Paragraph, Table
from zlmreport.errors import InputError

SEVEN = (
    {"standard": "iso230-2:2014", "tolerances": {"A": 150, "E": 100}},
    "iso230-2:2006",
    "iso230-2:1997",
    "iso230-2:1988",
    "vdi-dgq-3441",
    "vdi-vde-2617",
    "nmtba",
)
SHEET = having("certificate.layout", "sheet")
REPORT = having("certificate.kind", "report", SHEET)
OPINION = [{"statement": "The axis is worn.", "basis": "The reversal error grew."}]


def pages(of: Certificate, renderer: str = "pdf-typst") -> list[str]:
    reader = pypdf.PdfReader(io.BytesIO(registry().renderer(renderer).render(of)))
    return [page.extract_text() for page in reader.pages]


def problems(folder: Path, keys: Mapping[str, Any]) -> list[str]:
    with pytest.raises(InputError) as caught:
        certificate(folder, keys)
    return [str(each) for each in caught.value.problems]


@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
def test_each_standard_has_one_page(tmp_path: Path, renderer: str) -> None:
    found = certificate(tmp_path, {**SHEET, "evaluate": list(SEVEN)})
    assert len(pages(found, renderer)) == len(found.sections) == 5


@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
def test_a_page_of_letter_paper_holds_a_standard_too(tmp_path: Path, renderer: str) -> None:
    assert len(pages(certificate(tmp_path, having("certificate.paper", "Letter", SHEET)), renderer)) == 1


def test_a_page_says_who_what_and_how_well(tmp_path: Path) -> None:
    found = certificate(tmp_path, SHEET)
    (section,) = found.sections
    kinds = [type(block) for block in section.blocks]
    assert kinds.count(Table) == kinds.count(Graph) == 1
    (text,) = pages(found)
    for stated in (
        "Calibration Certificate",
        "CAL-1",
        "Some Laboratory",
        "Street 1",
        "A Customer",
        "Lane 2",
        "Maker M1",
        "S-1",
        "2022-04-07",
        "2026-11-20",
        "A. Person, Head",
        "20.5 °C",
        "C-1",
        "simple acceptance",
        "relate only to the item calibrated",
        "reproduced only in full",
    ):
        assert stated in " ".join(text.split()), stated


def test_its_graph_has_the_brackets_and_fills_what_is_left(tmp_path: Path) -> None:
    heights = []
    for remarks in ("None.", "Words of a remark. " * 20):
        (figure,) = certificate(tmp_path, having("measurement.remarks", remarks, SHEET)).figures
        assert figure.panels[0].brackets
        heights.append(figure.height or 0.0)
    assert heights[0] > heights[1] > 38


def test_a_table_by_position_that_fits_stands_below_the_graph(tmp_path: Path) -> None:
    (section,) = certificate(tmp_path, having("evaluate", ["nmtba"], SHEET)).sections
    graph = next(at for at, block in enumerate(section.blocks) if isinstance(block, Graph))
    assert isinstance(section.blocks[graph + 1], Table)


def test_a_table_by_position_that_does_not_fit_is_left_out(tmp_path: Path) -> None:
    rows = [
        f"{target},{sign},{run},{target % 7}" for run in (1, 2) for sign in "+-" for target in range(-20, 21)
    ]
    (tmp_path / "x.csv").write_text("\n".join(["target,direction,run,deviation", *rows]), encoding="utf-8")
    source = {"plugin": "laser-csv", "file": "x.csv"}
    found = certificate(tmp_path, having("measurement.source", source, REPORT))
    (section,) = found.sections
    assert sum(isinstance(block, Table) for block in section.blocks) == 1
    assert len(pages(found)) == 1


def test_a_certificate_whose_statements_do_not_fit_is_refused(tmp_path: Path) -> None:
    keys = having("measurement.deviations_from_method", "The run was interrupted. " * 150, SHEET)
    found = problems(tmp_path, keys)
    assert any("ISO/IEC 17025:2017, 7.8.2.1 n" in each for each in found)
    assert all(each.startswith(f"{tmp_path}/job.yaml:") for each in found)


def test_opinions_have_no_place_on_a_sheet(tmp_path: Path) -> None:
    (found,) = problems(tmp_path, {**SHEET, "opinions": OPINION})
    assert "opinions and interpretations (ISO/IEC 17025:2017, 7.8.7) does not fit" in found


def test_neither_have_the_results_before_an_adjustment(tmp_path: Path) -> None:
    as_found = {
        "adjustment": "New compensation table",
        "measurement": {**COMPLETE["measurement"], "date": "2022-04-06"},
    }
    (found,) = problems(tmp_path, {**SHEET, "as_found": as_found})
    assert "7.8.4.1 d" in found


@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
def test_of_an_adjusted_axis_the_comparison_has_a_page_and_each_state_another(
    tmp_path: Path, renderer: str
) -> None:
    as_found = {"adjustment": "New compensation table", "measurement": COMPLETE["measurement"]}
    found = pages(certificate(tmp_path, {**REPORT, "as_found": as_found}), renderer)
    headings = [section.title for section in certificate(tmp_path, {**REPORT, "as_found": as_found}).sections]
    assert len(found) == len(headings) == 3
    for text, heading in zip(found, headings, strict=True):
        assert heading in text


def test_a_report_with_more_to_say_goes_on(tmp_path: Path) -> None:
    assert len(pages(certificate(tmp_path, {**REPORT, "opinions": OPINION}))) == 2


def test_what_departs_from_the_standard_stands_on_the_page(tmp_path: Path) -> None:
    (section,) = certificate(tmp_path, SHEET).sections
    assert any(isinstance(block, Notice) and "deviates" in block.heading for block in section.blocks)


def _lowest(of: Certificate, renderer: str) -> float:
    """Return how high the text of the first page stands, in points, from its top margin."""
    reader = pypdf.PdfReader(io.BytesIO(registry().renderer(renderer).render(of)))
    page = reader.pages[0]
    found: list[float] = []

    def visit(text: str, page: list[float], line: list[float], *_: object) -> None:
        height = line[4] * page[1] + line[5] * page[3] + page[5]
        if text.strip() and height > 54:
            found.append(height)

    page.extract_text(visitor_text=visit)
    return 842 - 21 * 72 / 25.4 - min(found)


@pytest.mark.parametrize("paper", ["A4", "Letter"])
@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
def test_its_graph_leaves_no_empty_foot(tmp_path: Path, renderer: str, paper: str) -> None:
    keys = {**having("certificate.paper", paper, SHEET), "evaluate": list(SEVEN)}
    pdf = pypdfium2.PdfDocument(registry().renderer(renderer).render(certificate(tmp_path, keys)))
    for page in pdf:
        inked = page.render(grayscale=True).to_numpy().squeeze()[: -round(19 * 72 / 25.4)].min(axis=1) < 200
        assert inked[::-1].argmax() < 60  # points above the margin at the foot


@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
def test_the_estimate_of_the_room_is_no_less_than_what_is_taken(tmp_path: Path, renderer: str) -> None:
    found = certificate(tmp_path, SHEET)
    (section,) = found.sections
    estimate = columns.head_height(found.letterhead, found.title) + columns.heading_height(section.title)
    estimate += columns.height(section.blocks)
    taken = _lowest(found, renderer)
    assert taken < estimate + 12
    assert estimate < 1.15 * taken


def test_words_that_do_not_share_a_line_take_one_each() -> None:
    one, four = (columns.height([Paragraph(" ".join(["n" * 60] * words))]) for words in (1, 4))
    both = columns.height([Paragraph("n" * 60), Paragraph("n" * 60)])
    assert four - one == pytest.approx(3 * (both - one - 3.0))


@pytest.mark.parametrize(
    "block", [Paragraph("word " * 100), Notice("Heading", ("item " * 60,)), Facts((("name", "value " * 40),))]
)
def test_more_text_takes_more_room(block: Block) -> None:
    assert columns.height([block]) > 20
    assert list(columns.gather_facts([block]))
