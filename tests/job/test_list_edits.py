"""The list of effects is changed, and nothing else of the file."""

from __future__ import annotations

import pytest
from hypothesis import given, strategies as st

from job.layouts import Layout, layouts
from zlmreport.job.extents import Written
from zlmreport.job.list_edits import ListKey, UneditableError, add_item, add_list, drop_item, find_own_list
from zlmreport.job.parse import parse
from zlmreport.job.tree import Items, Keys, Node, Scalar, walk


def node(text: str) -> Node:
    """Return a value as YAML reads it."""
    return parse(f"value: {text}".encode(), "value.yaml").entries["value"].value


def effects(text: str) -> list[str]:
    """Return the names in the list of effects of a file."""
    found = list(walk(parse(text.encode(), "job.yaml"), ("model", "effects")))
    listed = found[-1][2] if len(found) == 2 else None
    assert isinstance(listed, Items)
    return [item.text if isinstance(item, Scalar) else next(iter(item.entries)) for item in listed.items]


NEW = node("thermal-drift")
EFFECTS = ListKey("model", "effects")

ADDED = {
    "a line more": ("effects:\n  - a\n  - b\n", "effects:\n  - a\n  - b\n  - thermal-drift\n"),
    "before the comment that ends the list": (
        "effects:\n  - a  # beside\n  # below\n",
        "effects:\n  - a  # beside\n  - thermal-drift\n  # below\n",
    ),
    "at the column of the dashes": ("effects:\n- a\n", "effects:\n- a\n- thermal-drift\n"),
    "without a line break at the end": ("effects:\n  - a", "effects:\n  - a\n  - thermal-drift"),
    "after the parameters of the last": (
        "effects:\n  - a:\n      gain: 1 # c\n",
        "effects:\n  - a:\n      gain: 1 # c\n  - thermal-drift\n",
    ),
    "with the line breaks of the file": (
        "effects:\r\n  - a\r\n",
        "effects:\r\n  - a\r\n  - thermal-drift\r\n",
    ),
    "in the quotes of its neighbour": ('effects:\n  - "a"\n', 'effects:\n  - "a"\n  - "thermal-drift"\n'),
    "in brackets": ("effects: [a, b]  # c\n", "effects: [a, b, thermal-drift]  # c\n"),
    "in empty brackets": ("effects: []\n", "effects: [thermal-drift]\n"),
    "in empty brackets with a space": ("effects: [ ]\n", "effects: [ thermal-drift ]\n"),
    "before the last comma": ("effects: [a,]\n", "effects: [a, thermal-drift,]\n"),
    "in a line of its own in brackets": (
        "effects: [\n  a, # a, b\n  b  # beside\n]\n",
        "effects: [\n  a, # a, b\n  b,  # beside\n  thermal-drift\n]\n",
    ),
    "in a line of its own with a comma": (
        "effects: [\n  a,  # beside\n]\n",
        "effects: [\n  a,  # beside\n  thermal-drift,\n]\n",
    ),
    "where the bracket closes beside the last": (
        "effects: [\n  a,\n  b]\n",
        "effects: [\n  a,\n  b,\n  thermal-drift]\n",
    ),
}
REMOVED = {
    "a line": ("effects:\n  - a\n  - b  # c\n  - d\n", 1, "effects:\n  - a\n  - d\n"),
    "with its parameters": ("effects:\n  - a:\n      gain: 1\n  - b\n", 0, "effects:\n  - b\n"),
    "the last line of a file": ("effects:\r\n  - a\r\n  - b", 1, "effects:\r\n  - a"),
    "the only one": ("effects:  # c\n  - a\nnext: 1\n", 0, "effects: []  # c\nnext: 1\n"),
    "the first in brackets": ("effects: [a, b]\n", 0, "effects: [b]\n"),
    "the last in brackets": ("effects: [a, b]\n", 1, "effects: [a]\n"),
    "the only one in brackets": ("effects: [ a ]\n", 0, "effects: [ ]\n"),
    "a line in brackets": ("effects: [\n  a,  # a\n  b,\n]\n", 0, "effects: [\n  b,\n]\n"),
    "the last line in brackets": ("effects: [\n  a,  # a\n  b  # b\n]\n", 1, "effects: [\n  a  # a\n]\n"),
    "what stands after a comment": ("effects: [a, # a\n b]\n", 1, "effects: [a, # a\n ]\n"),
}
NEW_LIST = {
    "after all other keys": ("a: 1\n", "a: 1\nmodel:\n  effects:\n    - thermal-drift\n"),
    "without a line break at the end": ("a: 1", "a: 1\nmodel:\n  effects:\n    - thermal-drift"),
    "before the end of the document": ("a: 1\n...\n", "a: 1\nmodel:\n  effects:\n    - thermal-drift\n...\n"),
    "at the column of the other keys": (
        "  a: 1\n",
        "  a: 1\n  model:\n    effects:\n      - thermal-drift\n",
    ),
    "in braces": ("{a: 1}\n", "{a: 1, model: {effects: [thermal-drift]}}\n"),
    "in JSON": ('{"a": 1}\n', '{"a": 1, "model": {"effects": ["thermal-drift"]}}\n'),
    "below an empty key": ("model:  # c\nb: 1\n", "model:  # c\n  effects:\n    - thermal-drift\nb: 1\n"),
    "for nothing": ("model: ~\n", "model: {effects: [thermal-drift]}\n"),
    "in empty braces": ("model: {}\n", "model: {effects: [thermal-drift]}\n"),
    "below empty effects": (
        "model:\n  effects: # c\nb: 1\n",
        "model:\n  effects: # c\n    - thermal-drift\nb: 1\n",
    ),
    "for empty effects in braces": ("model: {effects: }\n", "model: {effects: [thermal-drift] }\n"),
    "for effects that are nothing": ("model: {effects: null}\n", "model: {effects: [thermal-drift]}\n"),
    "behind an anchor": ("model: &m\nb: 1\n", "model: &m {effects: [thermal-drift]}\nb: 1\n"),
}


def _in_model(effects_: str) -> str:
    """Return a file with this list below `model`, indented as it must be."""
    return "model:\n  " + effects_.replace("\n", "\n  ").removesuffix("  ")


@pytest.mark.parametrize(("before", "after"), ADDED.values(), ids=ADDED.keys())
def test_an_effect_is_added(before: str, after: str) -> None:
    assert add_item(_in_model(before), EFFECTS, NEW) == _in_model(after)


@pytest.mark.parametrize(("before", "index", "after"), REMOVED.values(), ids=REMOVED.keys())
def test_an_effect_is_taken_out(before: str, index: int, after: str) -> None:
    assert drop_item(_in_model(before), EFFECTS, index) == _in_model(after)


@pytest.mark.parametrize(("before", "after"), NEW_LIST.values(), ids=NEW_LIST.keys())
def test_a_list_is_begun(before: str, after: str) -> None:
    assert add_list(before, EFFECTS, [NEW]) == after


def test_an_effect_keeps_its_keys() -> None:
    item = node("{polynomial: {order: 5, weights: [1, 2.5], note: 'a: b'}}")
    after = add_item("model:\n  effects:\n    - a\n", EFFECTS, item)
    assert after.splitlines()[-1] == '    - polynomial: {order: 5, weights: [1, 2.5], note: "a: b"}'


def test_an_effect_in_brackets_keeps_its_keys_in_braces() -> None:
    after = add_item("model: {effects: [a]}\n", EFFECTS, node("{polynomial: {order: 5}}"))
    assert after == "model: {effects: [a, {polynomial: {order: 5}}]}\n"


@pytest.mark.parametrize("text", ["null", "~", "12", "on fire", "a, b", "#", "a: b"])
def test_text_that_would_mean_something_else_is_quoted(text: str) -> None:
    after = add_item("model: {effects: [a]}\n", EFFECTS, Scalar(NEW.place, text, plain=False))
    assert effects(after) == ["a", text]


@pytest.mark.parametrize("before", ["effects: *x\n", "effects: &x\n  - a\n"])
def test_what_cannot_be_changed_alone_is_refused(before: str) -> None:
    text = f"other: &x [a]\n{_in_model(before)}"
    with pytest.raises(UneditableError):
        add_list(text, EFFECTS, [NEW]) if "*" in before else drop_item(text, EFFECTS, 0)


@given(layouts)
def test_adding_and_taking_out_again_gives_the_same_bytes(layout: Layout) -> None:
    text = layout.text
    added = add_item(text, EFFECTS, NEW)
    assert effects(added) == [*layout.names, "thermal-drift"]
    assert drop_item(added, EFFECTS, len(layout.names)) == text


@given(layouts)
def test_adding_takes_nothing_away(layout: Layout) -> None:
    rest = iter(add_item(layout.text, EFFECTS, NEW))
    assert all(character in rest for character in layout.text)


@given(layouts)
def test_what_is_around_the_list_stays_when_an_effect_is_added(layout: Layout) -> None:
    added = add_item(layout.text, EFFECTS, NEW)
    assert added.startswith(layout.head)
    assert added.endswith(layout.tail)


@given(layouts, st.data())
def test_taking_out_leaves_everything_else(layout: Layout, data: st.DataObject) -> None:
    if not layout.names:
        return
    index = data.draw(st.integers(0, len(layout.names) - 1))
    left = drop_item(layout.text, EFFECTS, index)
    assert effects(left) == [name for number, name in enumerate(layout.names) if number != index]
    assert left.startswith(layout.head)
    assert left.endswith(layout.tail)


@given(layouts, st.data())
def test_comments_in_lines_of_their_own_stay(layout: Layout, data: st.DataObject) -> None:
    if not layout.names:
        return
    index = data.draw(st.integers(0, len(layout.names) - 1))
    left = drop_item(add_item(layout.text, EFFECTS, NEW), EFFECTS, index)
    assert [comment for comment in layout.comments if comment not in left] == []


@given(layouts)
def test_values_are_found_where_they_stand(layout: Layout) -> None:
    written = Written.of(layout.text)
    listed = find_own_list(written, EFFECTS)
    assert listed is not None
    for item, name in zip(listed.parts, layout.names, strict=True):
        assert name in written.text[item.start : item.end]


def test_keys_and_values_come_in_turn() -> None:
    written = Written.of("a: 1\nb: [x, {c: 2}]\n")
    found = written.root.find_entry("b")
    assert found is not None
    assert written.text[found[1].start : found[1].end] == "[x, {c: 2}]"
    assert found[1].find_entry("c") is None
    assert isinstance(node("{c: 2}"), Keys)
