"""A capture that is killed again and again: nothing is lost, and nothing is there twice."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from live.capture.killing import Killed, killed_capture
from zlmreport.cli import main
from zlmreport.live.capture.events import Missed, Recorded

KILLS = 4


@pytest.mark.long
@pytest.mark.early
def test_a_capture_that_is_killed_at_random_moments_goes_on_to_its_end(tmp_path: Path) -> None:
    """In one test, for the capture is the dear part of it; ``./run benchmark kills`` kills one 50 times."""
    killed = killed_capture(tmp_path, KILLS, runs=2)
    assert killed.kills == KILLS
    assert killed.history.progress.is_over
    _each_visit_is_read_once_in_the_order_of_the_plan(killed)
    _nothing_is_taken_away_that_was_in_the_journal(killed)
    _what_was_announced_is_in_the_journal(killed)
    assert main([str(killed.job), "--quiet"]) == 0
    assert (tmp_path / "out" / "K-1.json").exists()


def _each_visit_is_read_once_in_the_order_of_the_plan(killed: Killed) -> None:
    events = [entry.event for entry in killed.history.entries]
    by_visit = {event.visit.number: event for event in events if isinstance(event, Recorded)}
    recorded = list(by_visit.values())  # to which a busy computer lets it come twice, that is read twice
    assert not any(isinstance(event, Missed) for event in events)
    assert [event.visit.number for event in recorded] == list(range(1, 21))
    # a step of the display, and what the last way to the target adds to a mean of fifty readings
    assert [event.deviation for event in recorded] == pytest.approx(
        killed.axis.deviation, abs=1.3e-9 + 1e-6 / 50
    )


def _nothing_is_taken_away_that_was_in_the_journal(killed: Killed) -> None:
    last = killed.journal.read_bytes()
    for seen in killed.seen:
        assert last.startswith(seen[: seen.rfind(b"\n") + 1])


def _what_was_announced_is_in_the_journal(killed: Killed) -> None:
    written = [json.loads(line) for line in killed.journal.read_text(encoding="utf-8").splitlines()]
    said = [each for each in killed.said if each["record"] == "reading"]
    assert said
    for each in said:
        assert any(each.items() <= record.items() for record in written)
