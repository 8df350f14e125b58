"""Days to come: a job that states one as past is refused; what is due soon; the day by the clock.

Nobody has measured, or issued anything, on a day that has not come yet.

What a document says does not depend on the clock, so that the same job gives the same bytes on any day; the
clock only decides whether a job is made at all.
"""

from __future__ import annotations

import datetime as dt
from collections.abc import Iterator
from typing import NamedTuple

from zlmreport.errors import InputError, Problem
from zlmreport.job.job import Job
from zlmreport.job.types import list_values
from zlmreport.version import RELEASED

#: What a job says of the future.
_OF_THE_FUTURE = frozenset({"due", "next_due"})
#: What is due within this time may be planned now.
SOON = dt.timedelta(days=90)
#: Where it is another day already.
_ELSEWHERE = dt.timedelta(days=1)


class DayToCome(NamedTuple):
    """A day that a job states and that lies in the future."""

    job: Job  #: Whose key it is: the job itself, one of its measurements, or a line of one.
    key: str  #: Dotted, within that job: ``measurement.date``.
    within: str  #: Dotted, what stands before it in the whole job; empty or ending in a dot.
    day: dt.date


def find_days_to_come(job: Job, today: dt.date, within: str = "") -> Iterator[DayToCome]:
    """Yield the days of a job that have not come yet, with those of its measurements and lines."""
    yield from (
        DayToCome(job, key, within, day)
        for key, day in list_values(job.keys)
        if isinstance(day, dt.date) and day > today + _ELSEWHERE and _OF_THE_FUTURE.isdisjoint(key.split("."))
    )
    for name, part in (*job.measurements.items(), *job.tests.items()):
        yield from find_days_to_come(part, today, f"{within}{name}.")


def demand_days_past(job: Job, today: dt.date | None = None) -> None:
    """Refuse a job of which a day has not come yet; a clock behind this program itself is not believed.

    `today`: By the clock of this computer if it is left out.

    Raises `InputError` with every such day, at the key that states it.
    """
    today = today or read_clock()
    if today < RELEASED:
        return
    problems = [
        Problem(
            each.job.place_of(each.key),
            f"{each.key}: {each.day} lies in the future: by the clock of this computer it is {today}; state "
            "the day that it was, or set the clock",
        )
        for each in find_days_to_come(job, today)
    ]
    if problems:
        raise InputError(dict.fromkeys(problems))


def read_clock() -> dt.date:
    """Return the day by the clock of this computer, a day here: as a certificate states one."""
    return dt.date.today()  # noqa: DTZ011
