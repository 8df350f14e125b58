"""The calendar of due tests, as another reader of iCalendar sees it."""

from __future__ import annotations

import datetime as dt
from dataclasses import replace

from icalendar import Calendar

from fleet.histories import entry
from zlmreport.fleet.exports import write_calendar
from zlmreport.fleet.records import PastNight
from zlmreport.fleet.state import Rules, describe_state
from zlmreport.plugin import Language

ENTRIES = [
    entry(dt.date(2026, 1, 10), job="x.yaml", machine="MC 800; EX-1, Süd"),
    entry(dt.date(2026, 6, 30), job="y.yaml", machine="", axis="Y"),
]
NIGHT = PastNight(dt.datetime(2026, 7, 1, 2, tzinfo=dt.UTC), None)


def test_each_axis_has_its_day_with_a_reminder_two_weeks_before() -> None:
    state = describe_state("Hall North", ENTRIES, ["x.yaml", "y.yaml"], NIGHT, Rules(365))
    read = Calendar.from_ical(write_calendar(state, Language.ENGLISH))
    assert read["NAME"] == read["X-WR-CALNAME"] == "Hall North: tests that are due"
    days = [(each.decoded("DTSTART"), str(each["SUMMARY"])) for each in read.walk("VEVENT")]
    assert days == [
        (dt.date(2027, 1, 10), "Measure X of MC 800; EX-1, Süd"),
        (dt.date(2027, 6, 30), "Measure Y"),
    ]
    assert {each.decoded("TRIGGER") for each in read.walk("VALARM")} == {dt.timedelta(days=-14)}
    assert {each.decoded("DTSTAMP") for each in read.walk("VEVENT")} == {NIGHT.began}


def test_the_same_ledger_gives_the_same_bytes_and_a_new_measurement_another_entry() -> None:
    def made(*entries: object) -> bytes:
        return write_calendar(describe_state("Hall", entries, ["x.yaml"], NIGHT, Rules(365)), Language.GERMAN)  # type: ignore[arg-type]

    first, again = made(ENTRIES[0]), made(replace(ENTRIES[0], measured="2026-07-01"))
    assert first == made(ENTRIES[0])
    assert all(len(line) <= 75 for line in first.split(b"\r\n"))
    identities = [Calendar.from_ical(each).walk("VEVENT")[0]["UID"] for each in (first, again)]
    assert identities[0] != identities[1]


def test_a_fleet_without_intervals_has_an_empty_calendar() -> None:
    read = Calendar.from_ical(write_calendar(describe_state("Hall", ENTRIES, [], None), Language.ENGLISH))
    assert list(read.walk("VEVENT")) == []
