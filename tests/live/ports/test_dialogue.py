"""Bytes to lines, questions and answers, and patience with both."""

from __future__ import annotations

from itertools import islice
from typing import Any

import pytest
from hypothesis import given, strategies as st

from zlmreport.live.ports import dialogue
from zlmreport.plugin.instrument import (
    Fault,
    Framing,
    LiveReading,
    Port,
    WholeLines,
    ask_instrument,
    readings_at_rate,
    unreadable_reading,
)


def test_an_answer_is_returned_as_soon_as_it_is_understood() -> None:
    with Port("loop://", Framing(), 1.0) as port:
        assert ask_instrument(port, b"hello", lambda arrived: 17 if arrived == b"hello" else None, 60.0) == 17


def test_what_is_never_understood_is_returned_as_it_came() -> None:
    with Port("loop://", Framing(), 1.0) as port:
        assert ask_instrument(port, b"hello", lambda _: None, 0.05) == b"hello"


class _Clock:
    """A clock that a test moves."""

    def __init__(self) -> None:
        self.now = 100.0

    def monotonic(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += seconds


@pytest.mark.parametrize(
    ("lasts", "asked_at"),
    [
        ([0.0, 0.0, 0.0, 0.0], [0.0, 0.1, 0.2, 0.3]),
        ([0.05, 0.05, 0.05, 0.05], [0.0, 0.1, 0.2, 0.3]),
        ([0.5, 0.0, 0.0, 0.0], [0.0, 0.5, 0.6, 0.7]),  # no burst after a slow answer
    ],
)
def test_questions_keep_their_rate(
    lasts: list[float], asked_at: list[float], monkeypatch: pytest.MonkeyPatch
) -> None:
    clock: Any = _Clock()
    monkeypatch.setattr(dialogue, "time", clock)
    durations = iter(lasts)
    times = []

    def question() -> LiveReading:
        times.append(clock.now - 100.0)
        clock.now += next(durations)
        return unreadable_reading(clock.now, "")

    list(islice(readings_at_rate(10.0, question), len(lasts)))
    assert times == pytest.approx(asked_at)


def test_what_was_not_understood_is_void_and_keeps_the_zero() -> None:
    reading = unreadable_reading(1.0, "the display did not answer")
    assert not reading.is_usable
    assert not reading.loses_zero


@pytest.mark.parametrize(
    ("fault", "loses"),
    [
        (Fault.BEAM_LOST, True),
        (Fault.TOO_FAST, True),
        (Fault.RESTARTED, True),
        (Fault.DEVICE_ERROR, False),
        (Fault.UNREADABLE, False),
        (Fault.DEVICE_ERROR | Fault.BEAM_LOST, True),
    ],
)
def test_faults_that_lose_counts_lose_the_zero(fault: Fault, loses: bool) -> None:
    reading = LiveReading(0.0, 1.0, fault)
    assert (reading.is_usable, reading.loses_zero) == (False, loses)


def test_skipped_readings_do_no_harm_to_the_one_after() -> None:
    assert LiveReading(0.0, 1.0, skipped=3).is_usable


@given(st.lists(st.integers(1, 40)))
def test_lines_are_the_same_however_they_arrive(sizes: list[int]) -> None:
    data = b"one\r\ntwo\rthree\n\n\r\nfour\r\nrest"
    lines, found, start = WholeLines(), [], 0
    for size in [*sizes, len(data)]:
        found += lines.feed(data[start : start + size])
        start += size
    assert found == [b"one", b"two", b"three", b"four"]


@pytest.mark.parametrize("size", [5, 100_000])
def test_bytes_without_an_end_are_not_kept_for_ever(size: int) -> None:
    lines = WholeLines(longest=4)
    assert lines.feed(b"x" * size) == [b"x" * size]
    assert lines.feed(b"y\n") == [b"y"]
