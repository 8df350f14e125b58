"""The tests that are due, as a calendar that programs and telephones subscribe to (iCalendar, RFC 5545)."""

from __future__ import annotations

import hashlib
from datetime import UTC, datetime, timedelta
from typing import TYPE_CHECKING

from zlmreport.fleet.state import FleetState, Term
from zlmreport.language import Language, Words
from zlmreport.version import __version__

if TYPE_CHECKING:
    from icalendar import Event

_TITLE = Words(en="{fleet}: tests that are due", de="{fleet}: fällige Messungen")
_SUMMARY = Words(en="Measure {axis} of {machine}", de="{axis} von {machine} messen")
_SUMMARY_OF_AXIS = Words(en="Measure {axis}", de="{axis} messen")
_DESCRIPTION = Words(
    en="Measured last on {measured}, certificate {number}.",
    de="Zuletzt gemessen am {measured}, Kalibrierschein {number}.",
)
#: Before the day, so that a machine can be made free.
_NOTICE = timedelta(days=14)


def calendar(state: FleetState, language: Language) -> bytes:
    """Return the calendar: a whole day for each axis that is to be measured again, with a reminder.

    The same ledger gives the same bytes; an axis keeps its entry until it has been measured.
    """
    from icalendar import Calendar  # noqa: PLC0415 - only who asks for a calendar waits for it

    title = _TITLE.given(fleet=state.name).in_language(language)
    days = Calendar()
    for key, text in (
        ("prodid", f"-//zlmreport//{__version__}//EN"),
        ("version", "2.0"),
        ("name", title),
        ("x-wr-calname", title),  # RFC 7986 has the first; most programs know the second
    ):
        days.add(key, text)
    moment = state.night.began if state.night else datetime(2000, 1, 1, tzinfo=UTC)
    for term in state.terms:
        days.add_component(_day(state.name, term, moment, language))
    return bytes(days.to_ical())


def _day(fleet: str, term: Term, moment: datetime, language: Language) -> Event:
    from icalendar import Alarm, Event  # noqa: PLC0415 - as above

    entry = term.entry
    words = _SUMMARY if entry.machine else _SUMMARY_OF_AXIS
    summary = words.given(axis=entry.axis, machine=entry.machine).in_language(language)
    told = _DESCRIPTION.given(measured=entry.measured, number=entry.number).in_language(language)
    identity = hashlib.sha256(repr((fleet, entry.machine, entry.axis, term.due)).encode()).hexdigest()[:32]
    event = Event()
    event.add("uid", f"{identity}@zlmreport")
    event.add("dtstamp", moment)
    event.add("dtstart", term.due)
    event.add("summary", summary)
    event.add("description", told)
    event.add("transp", "TRANSPARENT")
    alarm = Alarm()
    alarm.add("action", "DISPLAY")
    alarm.add("description", summary)
    alarm.add("trigger", -_NOTICE)
    event.add_component(alarm)
    return event
