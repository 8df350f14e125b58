"""Times as tables write them: seconds, ISO 8601, days as in 18.11.2026 or 11/18/2026 AM, a time of day."""

from __future__ import annotations

import datetime as dt
import math
import re
from collections.abc import Callable

from zlmreport.errors import quoted
from zlmreport.measurement.columns import Cells, TextColumn
from zlmreport.measurement.provenance import ReadingDays
from zlmreport.measurement.table import TextRow
from zlmreport.measurement.text_file import parse_number

#: Reads the time of a row; None if it noted why it cannot.
ReadTime = Callable[[TextRow], float | None]

#: Year of the moments that a time of day without a date stands for.
_NO_DATE = 1900
#: Times without a date that fall by so much have passed midnight, s.
_HALF_A_DAY = 43_200.0
_DAY = 86_400.0
_LAST_HOUR, _LAST_MINUTE = 23, 59
_CLOCK = re.compile(r"([0-9]{1,2}):([0-9]{2})(?::([0-9]{2})(?:[.,]([0-9]{1,6}))?)?")
#: Year, month and day, parted by strokes; and as in America, which only AM and PM tell from others.
_STROKES = re.compile(r"([0-9]{4})/([0-9]{1,2})/([0-9]{1,2})(.*)")
_AMERICAN = re.compile(
    r"(?:([0-9]{1,2})/([0-9]{1,2})/([0-9]{4})[ ,]\s*)?([0-9]{1,2})(:.*?)\s*([AP])\.?M\.?", re.IGNORECASE
)
#: An hour of one digit behind a day of ISO 8601, and how it is written with two.
_ONE_DIGIT, _PADDED = re.compile(r"^((?:[0-9]{4}-[0-9]{2}-[0-9]{2})?[ T])([0-9])(?=:)"), r"\g<1>0\2"
_NOON = 12
#: What is said of a time that is no number where the first time is none that is read otherwise.
_ADVICE = "; a time is a number of seconds, or written as 2026-11-18 08:15:00 (ISO 8601)"
_GERMAN_DAY = re.compile(r"([0-9]{1,2})\.([0-9]{1,2})\.([0-9]{4}|[0-9]{2})(?:,?\s+(.+?)(?:\s*Uhr)?)?")


def make_time_reader(cells: Cells, column: TextColumn | None) -> ReadTime:
    """Return what reads the time of a row, NaN for an empty cell; the first time tells the kind of all."""
    if column is None:
        return lambda _row: math.nan
    index = column.index
    first = next((text for row in cells.table.rows if not cells.is_missing(text := row.cells[index])), "")
    beginning = read_moment(first)
    if beginning is None or _is_number(first, cells):
        return lambda row: cells.number(row, column, _ADVICE)
    days, before = 0.0, 0.0

    def read_seconds(row: TextRow) -> float | None:
        nonlocal days, before
        text = row.cells[index]
        if cells.is_missing(text):
            return math.nan
        found = read_moment(text)
        if found is None or _find_kind(found) != _find_kind(beginning):
            like = quoted(first)
            cells.note(row, column, f"{quoted(text)} is no time written like the first one, {like}")
            return None
        time = (found - beginning).total_seconds() + days
        if beginning.year == _NO_DATE and before - time > _HALF_A_DAY:
            days, time = days + _DAY, time + _DAY
        before = time
        return time

    return read_seconds


def find_days(cells: Cells, column: TextColumn | None) -> ReadingDays | None:
    """Return the days of the first and the last time of a column; None for times without a date."""
    if column is None:
        return None
    texts = [text for row in cells.table.rows if not cells.is_missing(text := row.cells[column.index])]
    found = [read_moment(text) for text in texts[:1] + texts[-1:] if not _is_number(text, cells)]
    moments = [each for each in found if each is not None and each.year != _NO_DATE]
    if not moments:
        return None
    is_utc = moments[0].utcoffset() == dt.timedelta(0)
    return ReadingDays(moments[0].date(), moments[-1].date(), is_utc=is_utc)


def read_moment(text: str) -> dt.datetime | None:
    """Return a time as ISO 8601 writes it, of the day alone, or as in ``18.11.2026 8:15``; None for others.

    >>> read_moment("18.11.2026 8:15") == read_moment("2026-11-18T08:15") == read_moment("11/18/2026 8:15 AM")
    True
    >>> read_moment("2026/11/18 20:15") == read_moment("11/18/2026 8:15 PM")
    True
    >>> read_moment("8:15 pm") == read_moment("20:15")
    True
    """
    text = _write_usual(text)
    try:
        return dt.datetime.fromisoformat(text)
    except ValueError:
        day = _GERMAN_DAY.fullmatch(text)
    clock = _CLOCK.fullmatch((day[4] or "0:00") if day else text)
    if clock is None:
        return None
    year, month, date = (_NO_DATE, 1, 1) if day is None else (int(day[3]), int(day[2]), int(day[1]))
    hour, minute, second, fraction = clock.groups()
    try:
        found = dt.datetime.fromisoformat(f"{year + 2000 if year < 100 else year:04}-{month:02}-{date:02}")
    except ValueError:
        return None
    seconds = float(f"{second or 0}.{fraction or 0}")
    if int(hour) > _LAST_HOUR or int(minute) > _LAST_MINUTE or seconds > _LAST_MINUTE + 1:
        return None
    return found + dt.timedelta(hours=int(hour), minutes=int(minute), seconds=seconds)


def _write_usual(text: str) -> str:
    """Return a moment as ISO 8601 writes it that has strokes, halves of the day, or hours of one digit.

    Day and month of 11/10/2026 nobody can tell apart, unless by AM and PM, which are written in one order.
    """
    strokes, american = _STROKES.fullmatch(text), _AMERICAN.fullmatch(text)
    if strokes:
        year, month, day, rest = strokes.groups()
        return f"{year}-{int(month):02}-{int(day):02}{_ONE_DIGIT.sub(_PADDED, rest)}"
    if american:
        month, day, year, hour, rest, half = american.groups()
        hours = int(hour) % _NOON + (_NOON if half in "Pp" else 0)
        date = f"{year}-{int(month):02}-{int(day):02} " if year else ""
        return f"{date}{hours:02}{rest}" if 1 <= int(hour) <= _NOON else text
    return _ONE_DIGIT.sub(_PADDED, text)


def _find_kind(found: dt.datetime) -> tuple[bool, bool]:
    return found.tzinfo is None, found.year == _NO_DATE


def _is_number(text: str, cells: Cells) -> bool:
    try:
        parse_number(text, cells.sign)
    except ValueError:
        return False
    return True
