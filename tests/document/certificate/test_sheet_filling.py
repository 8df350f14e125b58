"""What a sheet holds of all that there is to say: nothing is lost, and nothing runs over."""

from __future__ import annotations

from collections.abc import Iterable

from hypothesis import given, settings, strategies as st

from document.certificate.documents import lines_of
from zlmreport.document.certificate import columns
from zlmreport.document.certificate.sheet_filling import Filled, SheetContent, fill, lay_out_details
from zlmreport.plugin import MICROMETRE, MILLIMETRE, Language
from zlmreport.plugin.renderer import Facts, Notice, Paragraph, Writer

#: Of a page, points.
PAGE = 650.0
WRITER = Writer(Language.ENGLISH, MILLIMETRE, MICROMETRE, 1, 1)

WHO = (("Customer", "Works Ltd, Lane 2, Town"), ("Item calibrated", "Maker M1"), ("Serial number", "S-1"))
CONDITIONS = (
    Facts((("Feed", "600 mm/min"), ("Remarks", "Words of a remark. " * 29))),
    Facts((("Serial number", "EXAMPLE-L-1"),), "Measuring instrument"),
)
SAID = SheetContent(
    (Notice("The test deviates from a standard", ("Five targets; found: three, " * 9,)),),
    WHO,
    (
        Paragraph("Decision rule: simple acceptance."),
        Paragraph("The results relate only to the item calibrated."),
    ),
    CONDITIONS,
    frozenset({("Feed", "600 mm/min")}),
)


def text(of: Filled) -> str:
    return " ".join(line for block in (*of.notices, *of.others) for line in lines_of(block))


def pairs(groups: Iterable[object]) -> set[tuple[str, str]]:
    return {pair for group in groups if isinstance(group, Facts) for pair in group.pairs}


def test_a_page_with_room_holds_everything() -> None:
    filled = fill(SAID, 700, WRITER)
    assert filled.left == SheetContent()
    assert "Details" not in text(filled)
    assert ("Feed", "600 mm/min") in pairs(filled.others)


def test_a_name_that_only_its_heading_explains_is_no_fact_of_a_column() -> None:
    filled = fill(SAID, 700, WRITER)
    assert ("Serial number", "EXAMPLE-L-1") not in pairs(filled.others)
    assert "Measuring instrument – Serial number: EXAMPLE-L-1." in text(filled)


def test_a_page_short_of_room_keeps_who_what_and_that_something_is_to_be_noted() -> None:
    filled = fill(SAID, 105, WRITER)
    for said in ("The test deviates from a standard", *(value for _, value in WHO), "simple acceptance"):
        assert said in text(filled)
    assert "On the page “Details”: what is to be noted, further conditions." in text(filled)


def test_where_not_even_headings_have_room_the_page_points_at_what_is_to_be_noted() -> None:
    long = SheetContent(tuple(Notice(f"Notice {number} " * 12, ("why",)) for number in range(9)))
    filled = fill(long, 60, WRITER)
    assert text(filled).startswith("! To be noted: see the page “Details”")
    assert filled.left.notices == long.notices


def test_a_page_that_another_one_follows_has_more_room() -> None:
    short_of = fill(SAID, 105, WRITER)
    assert fill(SAID, 105, WRITER, gained=60).height > short_of.height


def test_details_say_once_what_several_pages_lack() -> None:
    lacking = SheetContent(who=WHO, law=(Paragraph("Decision rule."),))
    title, blocks = lay_out_details((lacking, lacking, SheetContent(who=WHO[:1])), WRITER, PAGE)
    assert title == "Details"
    assert blocks == (Facts(WHO), Paragraph("Decision rule."))


def test_details_that_are_too_long_for_a_page_stand_in_small_type() -> None:
    remark = ("Remarks", "Words of a remark. " * 100)
    lacking = SheetContent((), WHO, (Paragraph("Decision rule."),), (Facts((remark,)),))
    _, blocks = lay_out_details((lacking,), WRITER, PAGE)
    assert Facts((*WHO, remark)) in blocks
    title, blocks = lay_out_details((lacking,), WRITER, 260.0)
    assert columns.estimate_heading_height(title) + columns.estimate_height(blocks) <= 260.0
    assert all(isinstance(each, Paragraph) and each.fine for each in blocks)


_TEXTS = st.text(st.sampled_from("abcdefg äöü-"), min_size=1, max_size=200).map(lambda text: f"x{text}x")
_PAIRS = st.lists(st.tuples(_TEXTS, _TEXTS), max_size=8, unique=True).map(tuple)
_SAID = st.builds(
    SheetContent,
    st.lists(st.builds(Notice, _TEXTS, st.lists(_TEXTS, max_size=2).map(tuple)), max_size=4).map(tuple),
    _PAIRS,
    st.lists(_TEXTS.map(Paragraph), max_size=5, unique=True).map(tuple),
    st.lists(st.builds(Facts, _PAIRS.filter(bool), _TEXTS), max_size=2).map(tuple),
)


@settings(max_examples=40, deadline=None)
@given(said=_SAID, room=st.floats(90, 500))
def test_nothing_is_lost_and_nothing_runs_over_whatever_the_lengths(said: SheetContent, room: float) -> None:
    filled = fill(said, room, WRITER)
    shown = text(filled)
    _, left = lay_out_details((filled.left,), WRITER, PAGE)
    printed = f"{shown} {' '.join(line for block in left for line in lines_of(block))}"
    stated = [*said.who, *(pair for group in said.conditions for pair in group.pairs)]
    for words in (
        *(each.text for each in said.law),
        *(part for pair in stated for part in pair),
        *(n.heading for n in said.notices),
    ):
        assert words in printed
    assert filled.height <= room
    assert ("“Details”: " in shown) == (filled.left != SheetContent())
    assert columns.estimate_height(filled.notices) > 0 or not said.notices
