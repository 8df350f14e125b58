"""The present moment of a capture, in three lines."""

from __future__ import annotations

from collections.abc import Iterator

from zlmreport.capture.follower import Follower
from zlmreport.capture.of_job import Assignment
from zlmreport.cli.capture_lines import SIDES, Scribe, duration
from zlmreport.live.reading import LiveReading

_BAR = 24


def panel(reading: LiveReading, follower: Follower, assignment: Assignment, scribe: Scribe) -> Iterator[str]:
    """Yield what is next, what the instrument reads, and how far the test has come."""
    progress = follower.progress
    visit = progress.next
    yield ""
    yield f"next   {scribe.visit(visit)} {SIDES[visit.approach]}"
    yield f"now    {_now(reading, follower, assignment, scribe)}"
    done, planned = progress.taken, len(progress.visits)
    full = round(_BAR * done / planned)
    bar = "█" * full + "░" * (_BAR - full)
    rest = duration(assignment.remaining_time(done))
    yield f"done   {bar}  {done} of {planned}, {planned - done} to go, {rest}"


def _now(reading: LiveReading, follower: Follower, assignment: Assignment, scribe: Scribe) -> str:
    if not reading.is_usable and reading.message:
        return reading.message
    progress, status, settings = follower.progress, follower.status, assignment.settings
    still = f"range {scribe.fine(status.range)}, still {status.still:.1f} of {settings.dwell:g} s"
    if status.position is None:
        return f"waiting for the datum: {still}"
    away = status.position - progress.next.position
    position = scribe.position(status.position, 4)
    if abs(away) > settings.tolerance:
        return f"{position:>14}  {scribe.position(-away, 3)} to go"
    return f"{position:>14}  {scribe.deviation(away)}  {still}"
