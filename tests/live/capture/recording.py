"""Journals that tests write."""

from __future__ import annotations

import datetime as dt
from collections.abc import Iterable
from pathlib import Path

from live.capture.moves import SETTINGS, planned
from zlmreport.live.capture.events import Event
from zlmreport.live.capture.follower import Follower
from zlmreport.live.capture.journal import Journal, capture
from zlmreport.live.capture.visits import number_visits
from zlmreport.model.planning.plan import AxisPlan
from zlmreport.plugin import AxisKind
from zlmreport.plugin.instrument import JournalHeader, LiveReading

#: Of the clock of `moves.Axis`, when a capture begins.
BEGIN = 100.0


def header(plan: AxisPlan | None = None, datum: float | None = None, **changes) -> JournalHeader:
    plan = plan or planned()
    values = {
        "number": "CAL-7",
        "job": "0" * 64,
        "axis": "X",
        "kind": AxisKind.LINEAR,
        "instrument": {"plugin": "umd1", "port": "/dev/ttyACM0"},
        "tool": "zlmreport 0.1.0",
        "started": dt.datetime(2026, 11, 20, 8, 0, tzinfo=dt.UTC),
        "method": str(plan.method),
        "settings": SETTINGS,
        "datum": datum,
        "visits": number_visits(plan),
    }
    return JournalHeader(**{**values, **changes})


def recorded(readings: Iterable[LiveReading], journal: Journal) -> list[Event]:
    """Follow readings into a journal."""
    follower = Follower(journal.progress, SETTINGS)
    return list(capture(readings, follower, journal, lambda time: time - BEGIN))


def written(path: Path, readings: Iterable[LiveReading], plan: AxisPlan | None = None, **changes) -> Path:
    """Write the journal of a sitting."""
    with Journal.begin(path, header(plan, **changes)) as journal:
        recorded(readings, journal)
    return path
