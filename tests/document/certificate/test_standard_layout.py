"""The layout `standard`: a page or so for each standard, with all that the layout `full` states."""

from __future__ import annotations

import io
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pypdf
import pytest

from document.certificate.documents import COMPLETE, SEVEN, certificate, having, lines_of
from document.certificate.everything import EVERYTHING, write_tables
from document.figures.samples import figure
from installed import registry
from zlmreport.document.certificate.standard_layout import draw_in_less_room, find_main_graph
from zlmreport.plugin import same_in_all_languages
from zlmreport.plugin.renderer import Block, Certificate, Facts, Formulas, Graph, Notice, Paragraph, Table
from zlmreport.plugin.standard import Curve, Panel, Role

#: More of the conditions than a first page has room for beside the results by seven standards.
_LONG: Mapping[str, Any] = {
    "measurement": {**COMPLETE["measurement"], "feed": 600, "dwell": 3, "remarks": "Words of a remark. " * 6},
    "environment": {
        **COMPLETE["environment"],
        "expansion_coefficient": 11.5,
        "sensors": "air 0.2 m beside the axis, axis on its base",
        "thermometers": [{"name": f"T{number}", "certificate": f"C-T{number}"} for number in range(4)],
    },
}
#: Points of a page that hold text: between the margins, and where the running head and foot stand.
_TOP, _BOTTOM = 782.0, 54.0


def laid_out(folder: Path, layout: str, **keys: Any) -> Certificate:
    job = {**COMPLETE, **keys}
    return certificate(folder, {**job, "certificate": {**job["certificate"], "layout": layout}})


@cache
def _of_seven(layout: str, folder: Path) -> Certificate:
    return laid_out(folder, layout, evaluate=list(SEVEN))


@pytest.fixture(scope="module")
def seven(tmp_path_factory: pytest.TempPathFactory) -> Certificate:
    return _of_seven("standard", tmp_path_factory.mktemp("standard"))


@pytest.fixture(scope="module")
def seven_in_full(tmp_path_factory: pytest.TempPathFactory) -> Certificate:
    return _of_seven("full", tmp_path_factory.mktemp("full"))


def pages(of: Certificate, renderer: str = "pdf-typst") -> list[pypdf.PageObject]:
    return list(pypdf.PdfReader(io.BytesIO(registry().renderer(renderer).render(of))).pages)


def blocks(of: Certificate) -> list[Block]:
    return [*of.cover, *(block for section in of.sections for block in section.blocks)]


def facts(of: Certificate) -> set[str]:
    return {value for block in blocks(of) if isinstance(block, Facts) for _, value in block.pairs}


def _fill(page: pypdf.PageObject) -> float:
    """Return how far down a page text stands, as a part of the room between its margins."""
    lowest = _TOP

    def visit(text: str, matrix: Any, *_: Any) -> None:
        nonlocal lowest
        if text.strip() and matrix[5] > _BOTTOM:
            lowest = min(lowest, matrix[5])

    page.extract_text(visitor_text=visit)
    return (_TOP - lowest) / (_TOP - _BOTTOM)


@pytest.mark.long
@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
def test_seven_standards_take_no_more_than_eleven_pages(seven: Certificate, renderer: str) -> None:
    assert len(pages(seven, renderer)) <= 11


def test_one_standard_takes_no_more_than_four_pages(tmp_path: Path) -> None:
    targets = [10.0 + 48.0 * number + number % 3 for number in range(11)]
    rows = [
        f"{target},{sign},{run},{0.01 * target + run % 3 + (1.5 if sign == '+' else 0):.1f}"
        for run in range(1, 6)
        for sign, order in (("+", targets), ("-", targets[::-1]))
        for target in order
    ]
    (tmp_path / "x.csv").write_text("\n".join(["target,direction,run,deviation", *rows]), encoding="utf-8")
    measurement = {**COMPLETE["measurement"], "source": {"plugin": "laser-csv", "file": "x.csv"}}
    axis = {"name": "X", "travel": [0, 500]}
    assert len(pages(laid_out(tmp_path, "standard", axis=axis, measurement=measurement))) <= 4


@pytest.mark.long
@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
@pytest.mark.parametrize("language", ["en", "de"])
def test_the_first_page_ends_with_the_statements_and_none_of_it_stands_on_the_second(
    tmp_path: Path, language: str, renderer: str
) -> None:
    keys = having("certificate.language", language, {**COMPLETE, "evaluate": list(SEVEN), **_LONG})
    found = laid_out(tmp_path, "standard", **keys)
    first, second, *_ = (" ".join(page.extract_text().split()) for page in pages(found, renderer))
    rule, *_, in_full = (each.text for each in found.cover if isinstance(each, Paragraph))
    for stated in ("A Customer", "S-1", "A. Person, Head", rule, in_full):
        assert stated.split()[-1] in first
    assert in_full not in second
    (section,) = (each for each in found.sections if each.key == "conditions")
    assert section.title in first


def test_no_page_but_the_last_is_emptier_than_a_third(seven: Certificate) -> None:
    *others, _ = map(_fill, pages(seven))
    assert min(others) > 0.35


def test_editions_that_give_the_same_numbers_share_a_page(seven: Certificate) -> None:
    titles = [section.title for section in seven.sections]
    assert titles[:3] == [
        "Results by ISO 230-2:2014, ISO 230-2:2006, ISO 230-2:1997",
        "Results by ISO 230-2:1988",
        "Results by VDI/DGQ 3441",
    ]
    first = seven.sections[0].blocks[0]
    assert first == Paragraph(
        "These readings give the same numbers by ISO 230-2:2006, ISO 230-2:1997; names and limits are those "
        "of ISO 230-2:2014."
    )


def test_an_edition_with_limits_of_its_own_has_a_page_of_its_own(tmp_path: Path) -> None:
    other = {"standard": "iso230-2:2006", "tolerances": {"A": 10}}
    found = laid_out(tmp_path, "standard", evaluate=[SEVEN[0], other])
    assert [section.key for section in found.sections[:2]] == ["iso230-2-2014", "iso230-2-2006"]


@pytest.mark.parametrize("keys", [COMPLETE, EVERYTHING], ids=["complete", "everything"])
def test_it_states_what_the_full_layout_states(keys: Mapping[str, Any], tmp_path: Path) -> None:
    write_tables(tmp_path)
    standard, full = (laid_out(tmp_path, layout, **keys) for layout in ("standard", "full"))
    assert facts(full) - facts(standard) <= _of_machine(keys)
    for kind, within in ((Paragraph, blocks(standard)), (Notice, standard.cover)):
        stated = {str(block) for block in full.cover if isinstance(block, kind)}
        assert stated <= {str(block) for block in within}


def _of_machine(keys: Mapping[str, Any]) -> set[str]:
    """Return what the first page says in one line of the machine."""
    return {str(value) for value in keys["machine"].values()} | {"machine tool"}


def test_every_value_of_every_standard_is_printed(seven: Certificate, seven_in_full: Certificate) -> None:
    def numbers(of: Certificate) -> set[tuple[Any, ...]]:
        tables = [block for block in blocks(of) if isinstance(block, Table)]
        rows = (row for table in tables for group in table.groups for row in group.rows)
        return {row[2:] for row in rows if len(row) == 7}

    assert numbers(seven_in_full) - numbers(seven) <= {
        # editions without limits that share the page of one with limits
        row
        for row in numbers(seven_in_full)
        if row[3:] == ("–", "–")
    }


def test_definitions_and_requirements_stand_once(seven: Certificate) -> None:
    (section,) = [each for each in seven.sections if each.key == "definitions"]
    assert sum(isinstance(block, Formulas) for block in section.blocks) == 5
    others = [block for each in seven.sections if each is not section for block in each.blocks]
    assert not any(isinstance(block, Formulas) for block in others)


def test_no_graph_draws_the_curves_of_another_again(seven: Certificate, seven_in_full: Certificate) -> None:
    def of_first(of: Certificate) -> list[str]:
        section = next(each for each in of.sections if each.key == "iso230-2-2014")
        return [block.figure.key for block in section.blocks if isinstance(block, Graph)]

    assert len(of_first(seven_in_full)) > len(of_first(seven)) == 2


def test_the_graph_that_is_kept_shows_the_single_readings(seven_in_full: Certificate) -> None:
    section = next(each for each in seven_in_full.sections if each.key == "iso230-2-2014")
    figures = [block.figure for block in section.blocks if isinstance(block, Graph)]
    main, *_ = draw_in_less_room(figures)
    assert main.panels[0].brackets
    assert main.panels[0].readings


def test_what_is_said_of_a_standard_stands_below_its_own_definitions(seven: Certificate) -> None:
    (section,) = (each for each in seven.sections if each.key == "definitions")
    under = ""
    said: dict[str, str] = {}
    for block in section.blocks:
        if isinstance(block, Formulas):
            under = block.caption
        elif isinstance(block, Paragraph):
            said[under] = said.get(under, "") + str(block)
    (of_1988,) = (words for caption, words in said.items() if "ISO 230-2:1988" in caption)
    (of_2014,) = (words for caption, words in said.items() if "ISO 230-2:2014" in caption)
    assert "The limits lie 3 standard deviations" in of_1988
    assert "The limits lie 2 standard deviations" in of_2014


def test_quantities_of_their_own_stand_one_below_the_other_on_one_axis() -> None:
    x = np.arange(3.0)
    curve = Curve("Z", Role.CHANNEL_1, x, x)
    panels = (
        Panel(curves=(curve,)),
        Panel(curves=(curve,), y_title=same_in_all_languages("Temperature"), y_unit="°C"),
    )
    alike = figure(*panels[:1], panels[0])
    of_several = figure(*panels)
    assert [each.is_wide for each in draw_in_less_room([alike])] == [True]
    assert list(draw_in_less_room([of_several])) == [of_several]
    assert find_main_graph([of_several]) is of_several
    assert find_main_graph([alike]) is alike


def test_a_test_that_gives_nothing_has_no_empty_table_of_results(tmp_path):
    """One reading at one target: no standard defines a parameter of it."""
    (tmp_path / "one.csv").write_text("target,direction,run,deviation\n10,+,1,1.5\n")
    source = {"plugin": "laser-csv", "file": "one.csv"}
    keys = having("certificate.kind", "report")
    document = certificate(tmp_path, {**keys, "measurement": {"date": "2022-04-07", "source": source}})
    said = [line.strip() for block in document.cover for line in lines_of(block)]
    assert "This test defines none of the parameters." in said
    assert not any(isinstance(block, Table) for block in document.cover)
    assert "Target positions: 1, at 10 mm" in said
