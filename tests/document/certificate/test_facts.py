"""How groups of facts share two columns."""

from __future__ import annotations

from zlmreport.document.certificate.columns import gather_facts
from zlmreport.plugin.renderer import Facts, Notice, Paragraph, facts_side_by_side


def group(pairs: int, value: str = "value") -> Facts:
    return Facts((("name", value),) * pairs, f"group of {pairs}")


def test_a_single_group_keeps_the_width_of_the_page() -> None:
    assert facts_side_by_side((group(3),)) == ((group(3),),)


def test_two_groups_stand_side_by_side() -> None:
    assert facts_side_by_side((group(3), group(4))) == ((group(3),), (group(4),))


def test_columns_are_of_nearly_one_height() -> None:
    groups = (group(6), group(2), group(2), group(2))
    assert facts_side_by_side(groups) == (groups[:1], groups[1:])


def test_a_long_value_counts_with_all_its_lines() -> None:
    groups = (group(1, "word " * 60), group(2), group(2))
    assert facts_side_by_side(groups) == (groups[:1], groups[1:])


def test_groups_keep_their_order() -> None:
    groups = tuple(group(pairs) for pairs in (1, 5, 2, 4, 3))
    first, second = facts_side_by_side(groups)
    assert first + second == groups


def test_facts_that_follow_each_other_are_gathered_and_others_are_not() -> None:
    before, between, after = Paragraph("before"), Notice("between", ()), Paragraph("after")
    blocks = (before, group(1), group(2), between, group(3), after)
    assert tuple(gather_facts(blocks)) == (before, (group(1), group(2)), between, (group(3),), after)


def test_facts_at_the_end_are_not_lost() -> None:
    assert tuple(gather_facts((Paragraph("text"), group(1)))) == (Paragraph("text"), (group(1),))
