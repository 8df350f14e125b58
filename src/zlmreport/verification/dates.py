"""Dates of a document that lie in the future: nobody has measured, or issued anything, then."""

from __future__ import annotations

import datetime as dt
from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel

from zlmreport.job.job import Job
from zlmreport.language import Words
from zlmreport.verification.findings import CheckedStatement, VerificationVerdict

#: What a job says of the future.
_OF_THE_FUTURE = frozenset({"due", "next_due"})
#: Where it is another day already.
_ELSEWHERE = dt.timedelta(days=1)
_AHEAD = Words("{date} lies in the future: by the clock of this computer it is {today}")


def find_future_dates(job: Job, today: dt.date) -> tuple[CheckedStatement, ...]:
    """Return the dates of a job that have not come yet, as not decided."""
    return tuple(
        CheckedStatement(
            key, VerificationVerdict.OPEN, _AHEAD.given(date=date.isoformat(), today=today.isoformat())
        )
        for key, date in _list_dates_of_job(job)
        if date > today + _ELSEWHERE
    )


def _list_dates_of_job(job: Job, within: str = "") -> Iterator[tuple[str, dt.date]]:
    yield from ((f"{within}{key}", date) for key, date in _list_dates(job.keys, ""))
    for name, part in (*job.measurements.items(), *job.tests.items()):
        yield from _list_dates_of_job(part, f"{within}{name}.")


def _list_dates(value: Any, key: str) -> Iterator[tuple[str, dt.date]]:
    match value:
        case dt.date():
            yield key, value
        case BaseModel():
            for name in type(value).model_fields:
                if name not in _OF_THE_FUTURE:
                    yield from _list_dates(getattr(value, name), f"{key}.{name}" if key else name)
        case dict():
            for name, each in value.items():
                yield from _list_dates(each, f"{key}.{name}")
        case list() | tuple():
            for number, each in enumerate(value):
                yield from _list_dates(each, f"{key}.{number}")
