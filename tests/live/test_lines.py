"""Bytes become lines wherever they are cut."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from zlmreport.live.lines import Lines


@given(st.lists(st.integers(1, 40)))
def test_lines_are_the_same_however_they_arrive(sizes: list[int]) -> None:
    data = b"one\r\ntwo\rthree\n\n\r\nfour\r\nrest"
    lines, found, start = Lines(), [], 0
    for size in [*sizes, len(data)]:
        found += lines.feed(data[start : start + size])
        start += size
    assert found == [b"one", b"two", b"three", b"four"]


@pytest.mark.parametrize("size", [5, 100_000])
def test_bytes_without_an_end_are_not_kept_for_ever(size: int) -> None:
    lines = Lines(longest=4)
    assert lines.feed(b"x" * size) == [b"x" * size]
    assert lines.feed(b"y\n") == [b"y"]
