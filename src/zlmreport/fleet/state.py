"""The state of a fleet on a morning: what failed, is overdue or soon due, not met, changed, drifting."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import date, datetime

from zlmreport.fleet.drifts import Trend, judge_trends
from zlmreport.fleet.records import MODEL, LedgerEntry, NightNotice, PastNight, State, compute_due_date
from zlmreport.fleet.trend import Series, list_series_of, select_standing
from zlmreport.job.days import SOON


@dataclass(frozen=True, slots=True)
class FailingJob:
    """A job that was not made, and the night since which it is not."""

    entry: LedgerEntry
    since: str


@dataclass(frozen=True, slots=True)
class DueDate:
    """By when an axis is to be measured again."""

    entry: LedgerEntry  #: Its latest certificate.
    due: date  #: The day.
    is_over: bool  #: Whether that day was over, in UTC, when the last run began.


@dataclass(frozen=True, slots=True)
class FleetState:
    """What an overview tells."""

    name: str  #: Of the fleet.
    night: PastNight | None  #: The last run; None before the first.
    jobs: int  #: How many jobs the fleet has.
    made: int  #: How many of them the last run made.
    #: failures and drafts: Jobs whose last entry is one, in the order of jobs.
    failures: tuple[FailingJob, ...]
    drafts: tuple[LedgerEntry, ...]
    certificates: tuple[LedgerEntry, ...]  #: That stand, in the order of measurement.
    trends: tuple[Trend, ...]  #: Every parameter of every axis, machine by machine.
    effects: tuple[Series, ...] = ()  #: Parameters of the error models over time, where jobs name effects.
    doubtful: tuple[LedgerEntry, ...] = ()  #: Latest certificates that leave something doubtful, by axis.
    terms: tuple[DueDate, ...] = ()  #: Of every axis that has one, the earliest first.
    #: How many of them the last run had no time for; of those that failed before, or are drafts, none.
    untried: int = 0

    @property
    def notices(self) -> tuple[NightNotice, ...]:
        """What concerned the whole of the last run."""
        return self.night.notices if self.night else ()

    @property
    def overdue(self) -> tuple[DueDate, ...]:
        """Those that are over."""
        return tuple(term for term in self.terms if term.is_over)

    @property
    def soon(self) -> tuple[DueDate, ...]:
        """Those that end within `SOON` after the last run."""
        last = self.night.began.date() + SOON if self.night else date.min
        return tuple(term for term in self.terms if not term.is_over and term.due <= last)

    @property
    def counts(self) -> Mapping[str, int]:
        """How many jobs the last run made, had no reason or no time to make, left as drafts, failed at."""
        vanished = sum(each.entry.state is State.VANISHED for each in self.failures)
        drafts, failed = len(self.drafts), len(self.failures) - vanished
        unchanged = self.jobs - self.made - drafts - failed - self.untried
        return {
            "made": self.made,
            "unchanged": unchanged,
            "left": self.untried,
            "draft": drafts,
            "failed": failed,
            "vanished": vanished,
        }

    @property
    def not_met(self) -> tuple[Trend, ...]:
        """Parameters whose latest certificate says that they exceed their limit."""
        return tuple(each for each in self.trends if each.series.latest.conforms is False)

    @property
    def undecided(self) -> tuple[Trend, ...]:
        """Parameters that are so near to their limit that nothing is stated."""
        latest = ((each, each.series.latest) for each in self.trends)
        return tuple(each for each, last in latest if last.limit is not None and last.conforms is None)

    @property
    def changed(self) -> tuple[Trend, ...]:
        """Parameters of which the latest test shows a step, or whose latest tests scatter more."""
        return tuple(each for each in self.trends if each.step or each.is_wilder)

    @property
    def drifting(self) -> tuple[Trend, ...]:
        """Parameters that drift: those first that meet their limit soonest, those without a date last."""
        drifting = [each for each in self.trends if each.drifts]
        return tuple(sorted(drifting, key=lambda each: each.forecast.expected if each.forecast else date.max))

    @property
    def axes(self) -> tuple[tuple[str, str], ...]:
        """Machine and axis of every axis that has a certificate, in order."""
        return tuple(dict.fromkeys((each.series.machine, each.series.axis) for each in self.trends))


@dataclass(frozen=True, slots=True)
class Rules:
    """What a fleet file says of its jobs."""

    interval: int | None = None  #: Days after which an axis is to be measured again, if its job does not say.
    is_retired: Callable[[str], bool] = lambda _: False  #: Whether a job is gone on purpose.


def describe_state(
    name: str,
    entries: Iterable[LedgerEntry],
    jobs: Sequence[str],
    night: PastNight | None,
    rules: Rules = Rules(),
) -> FleetState:
    """Return the state of a fleet.

    `entries`: The whole ledger, oldest first.
    `jobs`: That the fleet has now: of one that it no longer has, only the certificates count.
    """
    history = tuple(entries)
    latest = {entry.job: entry for entry in history}
    current = [latest[job] for job in sorted(jobs) if job in latest]
    missing = [
        entry
        for job, entry in sorted(latest.items())
        if entry.state is State.VANISHED and job not in jobs and not rules.is_retired(job)
    ]
    certificates = select_standing(history)
    series = list_series_of(certificates)
    latest_of_axes = _select_latest(certificates, rules)
    began = night.began if night else None
    counted = {each.job for each in current if each.state.is_failure or each.state is State.DRAFT}
    return FleetState(
        name=name,
        night=night,
        jobs=len(jobs),
        made=sum(
            entry.state is State.MADE and datetime.fromisoformat(entry.night) == began for entry in current
        ),
        failures=tuple(
            FailingJob(entry, _find_failing_since(entry, history))
            for entry in (*current, *missing)
            if entry.state.is_failure
        ),
        drafts=tuple(entry for entry in current if entry.state is State.DRAFT),
        certificates=certificates,
        trends=judge_trends(each for each in series if each.standard != MODEL),
        effects=tuple(each for each in series if each.standard == MODEL),
        doubtful=tuple(each for each in latest_of_axes if each.doubts),
        terms=_list_terms(latest_of_axes, rules, began),
        untried=len(set(night.untried) & set(jobs) - counted) if night else 0,
    )


def _select_latest(certificates: Iterable[LedgerEntry], rules: Rules) -> tuple[LedgerEntry, ...]:
    """Return the latest certificate of each axis that is not gone on purpose, axis by axis."""
    standing = (entry for entry in certificates if not rules.is_retired(entry.job))
    latest = {entry.axis_key: entry for entry in standing}
    return tuple(latest[axis] for axis in sorted(latest))


def _list_terms(latest: Iterable[LedgerEntry], rules: Rules, now: datetime | None) -> tuple[DueDate, ...]:
    stated = ((entry, compute_due_date(entry.measured, entry.interval or rules.interval)) for entry in latest)
    days = [(entry, date.fromisoformat(day)) for entry, day in stated if day]
    terms = [DueDate(entry, day, is_over=now is not None and day < now.date()) for entry, day in days]
    return tuple(sorted(terms, key=lambda term: (term.due, term.entry.machine, term.entry.axis)))


def _find_failing_since(failed: LedgerEntry, history: Sequence[LedgerEntry]) -> str:
    """Return the night from which on a job has not been made."""
    since = failed.night
    for entry in reversed([each for each in history if each.job == failed.job]):
        if not entry.state.is_failure:
            break
        since = entry.night
    return since
