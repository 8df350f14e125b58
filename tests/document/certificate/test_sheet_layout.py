"""The layout `sheet`: one page for each standard, and one of details for what they do not hold."""

from __future__ import annotations

import io
import shutil
from collections.abc import Iterable, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pypdf
import pytest
import yaml
from hypothesis import example, given, settings, strategies as st

from document.certificate.documents import COMPLETE, ROOT, SEVEN, certificate, having, lines_of, without
from installed import registry
from zlmreport.document.certificate import columns
from zlmreport.document.certificate.document import Head, Party
from zlmreport.plugin import Language
from zlmreport.plugin.renderer import (
    Block,
    Certificate,
    Facts,
    Graph,
    Letterhead,
    Notice,
    Paragraph,
    Section,
    Table,
)

#: An axis that drifts by no more than is said, by an instrument whose calibration has a date.
_NEGLECTED = {
    name: reason
    for name, reason in COMPLETE["uncertainty"]["negligible"].items()
    if name != "environmental_variation"
}
SOUND = having(
    "uncertainty",
    {"environmental_variation": 15, "negligible": _NEGLECTED},
    having("instrument.calibrated", "2022-01-10"),
)
SHEET = having("certificate.layout", "sheet", SOUND)
REPORT = having("certificate.kind", "report", SHEET)
OPINION = [{"statement": "The axis is worn.", "basis": "The reversal error grew."}]


def pages(of: Certificate, renderer: str = "pdf-typst") -> list[str]:
    reader = pypdf.PdfReader(io.BytesIO(registry().renderer(renderer).render(of)))
    return [page.extract_text() for page in reader.pages]


def measure_graph(of: Certificate) -> float:
    """Return the height of the only graph, mm."""
    (figure,) = of.figures
    assert figure.height is not None
    return figure.height


def said(*sections: Section) -> str:
    """Return all that sections say, in a line."""
    return " ".join(text for section in sections for block in section.blocks for text in lines_of(block))


@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
def test_each_standard_has_one_page(tmp_path: Path, renderer: str) -> None:
    found = certificate(tmp_path, {**SHEET, "evaluate": list(SEVEN)})
    *sheets, details = found.sections
    assert details.key == "details"
    assert len(sheets) == 5
    assert len(pages(found, renderer)) == 6


def test_a_page_says_who_what_and_how_well(tmp_path: Path) -> None:
    found = certificate(tmp_path, SHEET)
    section = found.sections[0]
    kinds = [type(block) for block in section.blocks]
    assert kinds.count(Table) == kinds.count(Graph) == 1
    text = " ".join(" ".join(pages(found)).split())
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
        "2022-04-20",
        "A. Person, Head",
        "20.5 °C",
        "C-1",
        "simple acceptance",
        "relate only to the item calibrated",
        "reproduced only in full",
    ):
        assert stated in text, stated


@pytest.mark.parametrize("paper", ["A4", "Letter"])
def test_its_graph_has_the_brackets_and_is_at_least_90_mm_high_whatever_is_remarked(
    tmp_path: Path, paper: str
) -> None:
    for remarks in ("None.", "Words of a remark. " * 20):
        keys = having("certificate.paper", paper, having("measurement.remarks", remarks, SHEET))
        found = certificate(tmp_path, keys)
        assert found.figures[0].panels[0].brackets
        assert 90 <= measure_graph(found) <= 130


def test_the_verdict_stands_before_the_graph_the_gravest_first(tmp_path: Path) -> None:
    blocks = certificate(tmp_path, SHEET).sections[0].blocks
    graph = next(at for at, block in enumerate(blocks) if isinstance(block, Graph))
    verdicts = [
        (block.verdict.word, block.text)
        for block in blocks[:graph]
        if isinstance(block, Paragraph) and block.verdict
    ]
    assert verdicts == [("does not conform", "E"), ("conforms", "A")]


def test_no_verdict_is_told_where_nothing_is_limited(tmp_path: Path) -> None:
    blocks = certificate(tmp_path, having("evaluate", ["iso230-2:2014"], SHEET)).sections[0].blocks
    assert not any(isinstance(block, Paragraph) and block.verdict for block in blocks)


def measuring(folder: Path, rows: Iterable[str], keys: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return the keys of a job on a table of these rows, which is written."""
    table = "\n".join(["target,direction,run,deviation", *rows])
    (folder / "x.csv").write_text(table, encoding="utf-8")
    return having("measurement.source", {"plugin": "laser-csv", "file": "x.csv"}, keys)


def test_a_table_by_position_that_fits_stands_below_the_graph(tmp_path: Path) -> None:
    rows = [
        f"{target},{sign},{run},{target % 7 + run * (1 + target % 4) / 5 + (sign == '-') / 10}"
        for run in (1, 2)
        for sign in "+-"
        for target in (0, 9, 19)
    ]
    keys = having("evaluate", ["nmtba"], measuring(tmp_path, rows, without("customer", keys=REPORT)))
    section = certificate(tmp_path, having("location", "Hall 3", keys)).sections[0]
    tables = [block for block in section.blocks if isinstance(block, Table)]
    assert len(tables) == 2


def test_a_table_by_position_that_does_not_fit_is_left_out(tmp_path: Path) -> None:
    rows = [
        f"{target},{sign},{run},{target % 7}" for run in (1, 2) for sign in "+-" for target in range(-20, 21)
    ]
    section = certificate(tmp_path, measuring(tmp_path, rows, REPORT)).sections[0]
    assert sum(isinstance(block, Table) for block in section.blocks) == 1


@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
def test_what_a_page_does_not_hold_stands_on_the_page_of_details(tmp_path: Path, renderer: str) -> None:
    words = "The run was interrupted. " * 40
    found = certificate(tmp_path, having("measurement.deviations_from_method", words, SHEET))
    sheet, details = found.sections
    assert not any(isinstance(block, Notice) and "deviations" in block.heading for block in sheet.blocks)
    assert any(isinstance(block, Notice) and words.strip() in block.items for block in details.blocks)
    (told,) = [b.text for b in sheet.blocks if isinstance(b, Paragraph) and "“Details”" in b.text]
    assert "what is to be noted" in told
    assert len(pages(found, renderer)) == 2


def test_opinions_have_a_page_of_their_own(tmp_path: Path) -> None:
    found = certificate(tmp_path, {**SHEET, "opinions": OPINION})
    assert found.sections[-1].key == "opinions"
    assert found.sections[-1].new_page


#: Words that end a line anywhere, and words that leave much of it empty.
_WORDS = ("Werk", "a", "Instandhaltung", "Präzisionswerkzeugmaschinen-Instandhaltung", "MWMW")
_BY_LETTER = {each[0].lower(): each for each in _WORDS}
#: Facts whose long words end a line after a hyphen and leave much of it empty; each word by its first letter.
_HYPHENATED = {
    "laboratory.name": "w",
    "laboratory.address": "wwwip",
    "laboratory.accreditation": "mma",
    "certificate.authorised_by.name": "a",
    "certificate.authorised_by.function": "iw",
    "customer.name": "miiaaiwawmp",
    "customer.address": "wmppp",
    "machine.manufacturer": "pwp",
    "machine.model": "wmp",
    "machine.serial": "piwwwama",
    "machine.condition": "m",
    "instrument.name": "iw",
    "instrument.manufacturer": "waa",
    "measurement.warm_up": "pwmaapwp",
    "measurement.compensation": "aw",
    "measurement.line": "w",
    "measurement.operator": "piwii",
    "measurement.deviations_from_method": "i",
    "measurement.remarks": "aaapwaap",
    "environment.sensors": "i",
    "environment.remarks": "pmapwi",
    "procedure": "amaawmmapimp",
}
#: What a job states in words, by its keys.
STATED = ("certificate.title", *_HYPHENATED)


def stating(words: Mapping[str, str]) -> Mapping[str, Any]:
    keys: Mapping[str, Any] = SHEET
    for dotted, value in words.items():
        keys = having(dotted, value, keys)
    return keys


def taken(of: Certificate) -> list[float]:
    """Return how high each page is estimated to be, in parts of what it has."""
    head = columns.estimate_head_height(of.letterhead, of.title, of.subtitle, of.number, of.head)
    heights = [
        columns.estimate_heading_height(each.title) + columns.estimate_height(each.blocks)
        for each in of.sections
    ]
    heights[0] += head + columns.BELOW_TITLE
    return [height / (columns.PAGES[of.paper] + columns.END_MARK) for height in heights]


def longest(letters: int) -> dict[str, str]:
    return dict.fromkeys(STATED, ("Präzisionswerkzeugmaschinen-Instandhaltung der Halle " * 12)[:letters])


#: The longest text that a job may state in a line, letters; one as long as names are.
LONGEST, LONG = 500, 110
_LANGUAGES = [each.value for each in Language]


def joined(words: Iterable[str]) -> str:
    return " ".join(words)[:LONGEST].strip()


_TEXTS = st.lists(st.sampled_from(_WORDS), min_size=1, max_size=60).map(joined)


@pytest.mark.parametrize("paper", ["A4", "Letter"])
@pytest.mark.parametrize("language", _LANGUAGES)
@pytest.mark.parametrize("letters", [25, LONG, LONGEST])
def test_the_graph_of_a_sheet_is_90_mm_high_whatever_the_length_of_what_is_stated(
    tmp_path: Path, paper: str, language: str, letters: int
) -> None:
    certified = {"certificate.language": language, "certificate.paper": paper}
    found = certificate(tmp_path, stating({**certified, **longest(letters)}))
    assert max(taken(found)) <= 1
    assert measure_graph(found) >= 90


@pytest.mark.long
@settings(max_examples=8, deadline=None)
@example(
    stated={key: joined(map(_BY_LETTER.__getitem__, words)) for key, words in _HYPHENATED.items()},
    language="de",
    paper="Letter",
    renderer="pdf",
)
@given(
    stated=st.fixed_dictionaries(dict.fromkeys(STATED, _TEXTS)),
    language=st.sampled_from(_LANGUAGES),
    paper=st.sampled_from(("A4", "Letter")),
    renderer=st.sampled_from(("pdf", "pdf-typst")),
)
def test_a_sheet_is_a_page_and_one_of_details_at_most(
    stated: dict[str, str], language: str, paper: str, renderer: str
) -> None:
    keys = stating({"certificate.language": language, "certificate.paper": paper, **stated})
    with TemporaryDirectory() as folder:
        found = certificate(Path(folder), keys)
    assert measure_graph(found) >= 90
    assert len(pages(found, renderer)) == len(found.sections) <= 2


@pytest.mark.parametrize("language", ["en", "de"])
@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
def test_the_longest_names_leave_a_page_and_one_of_details_that_it_names(
    tmp_path: Path, renderer: str, language: str
) -> None:
    keys = having("certificate.language", language, stating(longest(110)))
    found = certificate(tmp_path, keys)
    sheet, details = found.sections
    first, second = pages(found, renderer)
    assert sheet.title in first
    assert f"„{details.title}“" in first or f"“{details.title}”" in first
    assert details.title in second


@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
def test_no_line_parts_the_number(tmp_path: Path, renderer: str) -> None:
    number = "CAL-" + "2026-" * 12 + "17"
    (page, *_) = pages(certificate(tmp_path, having("certificate.number", number, SHEET)), renderer)
    assert page.count(number) == 2


@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
def test_what_is_as_long_as_a_job_may_state_it_is_not_refused(tmp_path: Path, renderer: str) -> None:
    addresses = dict.fromkeys(("laboratory.address", "customer.address"), "Lane 2, " * 600)
    stated = {"certificate.paper": "Letter", **longest(LONGEST), **addresses}
    found = certificate(tmp_path, stating(stated))
    assert [each.key for each in found.sections] == ["iso230-2-2014", "details"]
    assert taken(found)[0] <= 1
    assert measure_graph(found) >= 90
    first, *_ = pages(found, renderer)
    assert found.sections[0].title in first
    assert found.digest in first


def test_a_letterhead_that_leaves_the_graph_no_room_has_the_name_and_details_the_rest(tmp_path: Path) -> None:
    of_laboratory = {"laboratory.address": "Gaugeway 1 " * 40, "laboratory.accreditation": "Body, No. 7"}
    words = {**longest(200), **of_laboratory, "certificate.paper": "Letter"}
    found = certificate(tmp_path, stating(words))
    assert found.head is not Head.WHOLE
    assert found.printed_letterhead == Letterhead(Party(words["laboratory.name"].strip()))
    sheet, details = pages(found)
    assert "Gaugeway" not in sheet
    assert "No. 7" not in sheet
    assert "Gaugeway 1" in details
    assert "Body, No. 7" in details
    assert found.letterhead
    assert found.letterhead.accreditation == "Body, No. 7"


#: Jobs of other quantities, with what their sheets show.
_OTHERS = (
    "rotary-axis/report",
    "machine/x-straightness",
    "whole-machine/circle-xy",
    "whole-machine/x-pitch",
    "flatness/certificate",
    "step-gauge/job",
)


@pytest.mark.parametrize("path", _OTHERS)
def test_the_graph_of_any_quantity_is_90_mm_high_below_the_longest_letterhead(
    tmp_path: Path, path: str
) -> None:
    file = ROOT / "configs" / f"{path}.yaml"
    shutil.copytree(file.parent, tmp_path / "jobs")
    shutil.copy(ROOT / "configs" / "laboratory.yaml", tmp_path)
    (tmp_path / "machine").symlink_to(ROOT / "configs" / "machine")
    keys: Mapping[str, Any] = yaml.safe_load(file.read_text(encoding="utf-8"))
    own = {each: value for each, value in longest(LONGEST).items() if not each.startswith("instrument")}
    for dotted, value in {**own, "certificate.layout": "sheet", "certificate.paper": "Letter"}.items():
        keys = having(dotted, value, keys)
    found = certificate(tmp_path / "jobs", keys)
    assert taken(found)[0] <= 1
    assert found.figures[0].height is not None
    assert found.figures[0].height >= 90


def test_customer_and_machine_stand_on_every_page(tmp_path: Path) -> None:
    found = certificate(tmp_path, {**stating(longest(110)), "evaluate": ["vdi-dgq-3441", "nmtba"]})
    for section in found.sections[:2]:
        assert longest(110)["customer.name"] in said(section)
        assert longest(110)["machine.model"].strip() in said(section)


def test_what_was_declared_negligible_is_listed_with_its_reason(tmp_path: Path) -> None:
    sheet = said(certificate(tmp_path, SHEET).sections[0])
    assert "Declared negligible by the laboratory" in sheet
    assert "40 mm at 20 °C" in sheet


def test_details_repeat_nothing_that_the_page_says(tmp_path: Path) -> None:
    sheet, details = certificate(tmp_path, stating(longest(110))).sections
    shown = {pair for block in sheet.blocks if isinstance(block, Facts) for pair in block.pairs}
    again = [pair for block in details.blocks if isinstance(block, Facts) for pair in block.pairs]
    assert shown.isdisjoint(again)
    assert len(again) == len(set(again))


def test_readings_that_were_set_aside_are_all_named(tmp_path: Path) -> None:
    excluded = [
        {"target": target, "direction": "+", "run": 1, "reason": "chip"} for target in range(-20, 20, 5)
    ]
    whole = said(*certificate(tmp_path, having("measurement.excluded", excluded, SHEET)).sections)
    assert whole.count("chip") >= len(excluded)
    assert "section on the readings" not in whole


@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
def test_of_an_adjusted_axis_the_comparison_has_a_page_and_each_state_another(
    tmp_path: Path, renderer: str
) -> None:
    as_found = {"adjustment": "New compensation table", "measurement": COMPLETE["measurement"]}
    document = certificate(tmp_path, {**REPORT, "as_found": as_found})
    assert [section.key for section in document.sections] == [
        "iso230-2-2014",
        "as-found-as-left",
        "as-found-iso230-2-2014",
        "details",
    ]
    for text, section in zip(pages(document, renderer), document.sections, strict=True):
        assert section.title in text


def test_a_report_with_more_to_say_goes_on(tmp_path: Path) -> None:
    assert len(pages(certificate(tmp_path, {**REPORT, "opinions": OPINION}))) == 3


def test_what_departs_from_the_standard_stands_on_the_page(tmp_path: Path) -> None:
    section = certificate(tmp_path, SHEET).sections[0]
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


@pytest.mark.parametrize("renderer", ["pdf", "pdf-typst"])
def test_the_estimate_of_the_room_is_no_less_than_what_is_taken(tmp_path: Path, renderer: str) -> None:
    found = certificate(tmp_path, SHEET)
    section = found.sections[0]
    estimate = columns.estimate_head_height(found.letterhead, found.title, found.subtitle, found.number)
    estimate += columns.BELOW_TITLE + columns.estimate_heading_height(section.title)
    estimate += columns.estimate_height(section.blocks)
    taken = _lowest(found, renderer)
    assert taken < estimate + 12
    assert estimate < 1.15 * taken


def test_a_line_ends_after_a_hyphen_and_leaves_the_rest_of_it_empty() -> None:
    words = "Präzisionswerkzeugmaschinen-Instandhaltung"
    assert columns.count_fact_lines("Name", f"{words} Instandhaltung Werk Instandhaltung Instandhaltung") == 4
    assert columns.count_fact_lines("Name", "4711-D-K-15133-01-00-2026 and ISO 230-2:2014") == 2


def test_words_that_do_not_share_a_line_take_one_each() -> None:
    one, four = (columns.estimate_height([Paragraph(" ".join(["n" * 60] * words))]) for words in (1, 4))
    both = columns.estimate_height([Paragraph("n" * 60), Paragraph("n" * 60)])
    assert four - one == pytest.approx(3 * (both - one - 3.0))


@pytest.mark.parametrize(
    "block", [Paragraph("word " * 100), Notice("Heading", ("item " * 60,)), Facts((("name", "value " * 40),))]
)
def test_more_text_takes_more_room(block: Block) -> None:
    assert columns.estimate_height([block]) > 20
    assert list(columns.gather_facts([block]))
