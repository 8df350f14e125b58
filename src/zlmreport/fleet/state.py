"""The state of a fleet on a morning, out of its ledger."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import date, datetime

from zlmreport.fleet.drifts import Trend, trends
from zlmreport.fleet.records import Entry, State
from zlmreport.fleet.trend import series_of, standing


@dataclass(frozen=True, slots=True)
class Night:
    """A run of the fleet.

    Attributes
    ----------
    began
        With its offset from UTC.
    ended
        None for a run that was interrupted.
    """

    began: datetime
    ended: datetime | None

    @property
    def seconds(self) -> float | None:
        """How long it took."""
        return (self.ended - self.began).total_seconds() if self.ended else None


@dataclass(frozen=True, slots=True)
class Failure:
    """A job that was not made, and the night since which it is not."""

    entry: Entry
    since: str


@dataclass(frozen=True, slots=True)
class FleetState:
    """What an overview tells.

    Attributes
    ----------
    name
        Of the fleet.
    night
        The last run; None before the first.
    jobs
        How many jobs the fleet has.
    made
        How many of them the last run made.
    failures, drafts
        Jobs whose last entry is one, in the order of jobs.
    certificates
        That stand, in the order of measurement.
    trends
        Every parameter of every axis, machine by machine.
    """

    name: str
    night: Night | None
    jobs: int
    made: int
    failures: tuple[Failure, ...]
    drafts: tuple[Entry, ...]
    certificates: tuple[Entry, ...]
    trends: tuple[Trend, ...]

    @property
    def counts(self) -> Mapping[str, int]:
        """How many jobs the last run made, had no reason to make, left as drafts, and could not make."""
        drafts, failed = len(self.drafts), len(self.failures)
        unchanged = self.jobs - self.made - drafts - failed
        return {"made": self.made, "unchanged": unchanged, "draft": drafts, "failed": failed}

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
    def drifting(self) -> tuple[Trend, ...]:
        """Parameters that drift: those first that meet their limit soonest, those without a date last."""
        drifting = [each for each in self.trends if each.drifts]
        return tuple(sorted(drifting, key=lambda each: each.forecast.expected if each.forecast else date.max))

    @property
    def axes(self) -> tuple[tuple[str, str], ...]:
        """Machine and axis of every axis that has a certificate, in order."""
        return tuple(dict.fromkeys((each.series.machine, each.series.axis) for each in self.trends))


def state_of(name: str, entries: Iterable[Entry], jobs: Sequence[str], night: Night | None) -> FleetState:
    """Return the state of a fleet.

    Parameters
    ----------
    name
        Of the fleet.
    entries
        The whole ledger, oldest first.
    jobs
        That the fleet has now: of one that it no longer has, only the certificates count.
    night
        The last run.
    """
    history = tuple(entries)
    latest = {entry.job: entry for entry in history}
    current = [latest[job] for job in sorted(jobs) if job in latest]
    certificates = standing(history)
    began = night.began if night else None
    return FleetState(
        name=name,
        night=night,
        jobs=len(jobs),
        made=sum(
            entry.state is State.MADE and datetime.fromisoformat(entry.night) == began for entry in current
        ),
        failures=tuple(
            Failure(entry, _failing_since(entry, history)) for entry in current if entry.state is State.FAILED
        ),
        drafts=tuple(entry for entry in current if entry.state is State.DRAFT),
        certificates=certificates,
        trends=trends(series_of(certificates)),
    )


def _failing_since(failed: Entry, history: Sequence[Entry]) -> str:
    """Return the night from which on a job has not been made."""
    since = failed.night
    for entry in reversed([each for each in history if each.job == failed.job]):
        if entry.state is not State.FAILED:
            break
        since = entry.night
    return since
