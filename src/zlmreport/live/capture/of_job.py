"""The keys of a capture and their defaults: instrument, journal, tolerance, standstill; the plan to visit."""

from __future__ import annotations

import datetime as dt
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, Literal

from pydantic import Field

from zlmreport.errors import AccessError, InputError, Place, Problem, count_in_words
from zlmreport.job.choices import Choice
from zlmreport.job.job import Job
from zlmreport.job.types import Finite, JobPath, LiveInstrumentKeys, Options, Positive
from zlmreport.live.capture.journal import History
from zlmreport.live.capture.records import Header
from zlmreport.live.capture.visits import (
    FASTEST,
    SHARE_OF_INTERVAL,
    SHARE_OF_OVERRUN,
    ListedVisit,
    Settings,
    number_visits,
)
from zlmreport.measurement.axis import Axis, refuse_other_than_positions
from zlmreport.model.planning.plan import AxisPlan
from zlmreport.version import __version__


class CaptureOptions(Options):
    """The instrument, the journal, and when a reading is taken."""

    journal: JobPath = Field(
        description="Journal of the readings, relative to the file that names it; the command capture "
        "writes it.",
        examples=["x-axis.journal"],
    )
    instrument: LiveInstrumentKeys | None = Field(
        None,
        description="The live instrument, with its own keys. A journal that is finished needs none.",
        examples=[{"plugin": "umd1", "port": "/dev/ttyACM0"}],
    )
    datum: Literal["start", "instrument"] | Finite = Field(
        "start",
        description="Where the axis stands when capture begins, mm or degrees: the reading there is taken "
        "for this position. 'start' is the start of the path, before the first target; 'instrument' takes "
        "readings as they are, for a display whose zero is that of the axis.",
        examples=[0],
    )
    tolerance: Positive | None = Field(
        None,
        description="How far from a target a reading may be, mm or degrees, at most 0.4 of the smallest "
        "interval and a third of plan.overrun. Without it these, or 1 if that is less.",
        examples=[0.5],
    )
    stability: Positive = Field(
        1.0,
        description="Range of readings, largest - smallest, within which the axis stands still, micrometres "
        "(arc seconds).",
        examples=[2],
    )
    dwell: Annotated[float, Field(gt=0, le=600)] = Field(
        1.0,
        description="How long the axis must stand still, s, where `capture.settle` states nothing else; the "
        "reading is the mean over the later half. The axis rests longer (measurement.dwell): twice as long "
        "and a second is good.",
    )


_SOURCE = "measurement.source"
#: mm or °.
_USUAL_TOLERANCE = 1.0


@dataclass(frozen=True, slots=True)
class Assignment:
    """What a job asks to be captured."""

    options: CaptureOptions  #: The keys of its data source.
    settings: Settings  #: When a reading is taken.
    #: Where the axis stands when the datum is taken, m or rad; None for the instrument's own zero.
    datum: float | None
    plan: AxisPlan  #: Of the test.
    visits: tuple[ListedVisit, ...]

    def estimate_remaining_time(self, taken: int) -> float:
        """Return how long the visits still take that are not taken, s."""
        rest = self.visits[taken:]
        return sum(visit.travelled for visit in rest) / self.plan.feed + self.plan.dwell * len(rest)


def find_options_of(job: Job) -> CaptureOptions | None:
    """Return the keys of a job's data source if it is captured live; None if it is not."""
    options = job.source.options
    return options if isinstance(options, CaptureOptions) else None


def make_assignment_of(job: Job, plan: AxisPlan) -> Assignment:
    """Return what a job asks to be captured.

    Raises `InputError` if its data source is not captured live, or its limits do not fit the plan.
    """
    refuse_other_than_positions(
        job.axis,
        job.place_of("measurement.error"),
        "capture follows the axis by its position, which such an instrument does not read",
    )
    options = find_options_of(job)
    if options is None:
        raise InputError.at(
            job.source.place,
            f"the data source {job.source.identifier} is not captured; name 'plugin: serial-interferometer' "
            "with an instrument and a journal",
        )
    settings = _make_settings(options, plan, job.axis, job.keys.capture.settle)
    problems = list(_find_problems(job, settings, plan))
    if problems:
        raise InputError(problems)
    return Assignment(options, settings, _find_datum(options, plan, job.axis), plan, number_visits(plan))


def find_instrument_of(job: Job) -> Choice:
    """Return the live instrument that a job names; raise `InputError` if it names none."""
    choice = job.source.instrument
    if choice is None:
        raise InputError.at(
            job.source.place,
            f"{_SOURCE}.instrument is missing: what is captured; for example "
            "{plugin: umd1, port: /dev/ttyACM0} ('zlmreport plugins' lists the instruments)",
        )
    return choice


def make_header_of(job: Job, assignment: Assignment, started: dt.datetime) -> Header:
    """Return what the journal of a job says first."""
    choice = find_instrument_of(job)
    return Header(
        number=job.keys.certificate.number,
        job=job.files[0].sha256,
        axis=job.axis.name,
        kind=job.axis.kind,
        instrument={"plugin": choice.identifier, **choice.options.model_dump(mode="json")},
        tool=f"zlmreport {__version__}",
        started=started,
        method=str(assignment.plan.method),
        settings=assignment.settings,
        datum=assignment.datum,
        visits=assignment.visits,
    )


def demand_same_test(history: History, job: Job, assignment: Assignment, place: Place) -> None:
    """Refuse a journal of another job, or of another plan.

    Raises `AccessError` at the journal's place, with what differs.
    """
    header = history.header
    other = _say_difference(header, job, assignment)
    if other:
        raise AccessError.at(
            place,
            f"{other}; name another journal, or give the job back what it said when the capture began "
            f"({header.started:%Y-%m-%d %H:%M})",
        )


def _say_difference(header: Header, job: Job, assignment: Assignment) -> str:
    number = job.keys.certificate.number
    if header.number != number:
        return f"is the journal of {header.number}, and the job is {number}"
    if (header.axis, header.kind) != (job.axis.name, job.axis.kind):
        return f"is the journal of axis {header.axis}, and the job is on axis {job.axis.name}"
    if header.visits != assignment.visits:
        return (
            f"holds another plan: {count_in_words(len(header.visits), 'visit')}, {header.method}, "
            f"and the job's is {len(assignment.visits)}, {assignment.plan.method}, or its targets are others"
        )
    if header.settings != assignment.settings or header.datum != assignment.datum:
        return (
            f"was begun with other limits: tolerance, stability, dwell or datum in {_SOURCE}, "
            "or capture.settle"
        )
    begun, choice = header.instrument.get("plugin"), job.source.instrument
    if choice is not None and begun != choice.identifier:
        return f"was begun with the instrument {begun}, and the job names {choice.identifier}"
    return ""


def _make_settings(options: CaptureOptions, plan: AxisPlan, axis: Axis, settle: float | None) -> Settings:
    unit = axis.position_unit
    largest = _find_largest_tolerance(plan)
    return Settings(
        tolerance=unit.to_si(options.tolerance)
        if options.tolerance
        else min(largest, unit.to_si(_USUAL_TOLERANCE)),
        stability=axis.deviation_unit.to_si(options.stability),
        dwell=options.dwell,
        turn=2 * plan.overrun / (FASTEST * plan.feed),
        stay=plan.dwell,
        feed=plan.feed,
        settle=settle or 0.0,
    )


def _find_largest_tolerance(plan: AxisPlan) -> float:
    interval = min(later - earlier for earlier, later in pairwise(plan.targets.tolist()))
    return float(min(SHARE_OF_INTERVAL * interval, SHARE_OF_OVERRUN * plan.overrun))


def _find_problems(job: Job, settings: Settings, plan: AxisPlan) -> Iterator[Problem]:
    unit, fine = job.axis.position_unit, job.axis.deviation_unit
    largest = _find_largest_tolerance(plan)
    if settings.tolerance > largest * (1 + 1e-9):
        yield Problem(
            job.place_of(f"{_SOURCE}.tolerance"),
            f"{_SOURCE}.tolerance: {unit.from_si(settings.tolerance):g} {unit.symbol} is too much: a stop "
            f"would not belong to one target; state {unit.from_si(largest):.6g} or less, or a larger "
            "plan.overrun",
        )
    elif settings.motion > settings.tolerance:
        yield Problem(
            job.place_of(f"{_SOURCE}.stability"),
            f"{_SOURCE}.stability: {fine.from_si(settings.stability):g} {fine.symbol} is too much: motion "
            "counts from ten times that, which is beyond the tolerance; state "
            f"{fine.from_si(settings.tolerance) / 10:.6g} or less",
        )
    if settings.stay <= settings.still:
        key = "capture.settle" if settings.settle else f"{_SOURCE}.dwell"
        yield Problem(
            job.place_of("measurement.dwell"),
            f"measurement.dwell: the axis rests {settings.stay:g} s, and a reading takes "
            f"{settings.still:g} s ({key}); let it rest {2 * settings.still + 1:g} s or more",
        )


def _find_datum(options: CaptureOptions, plan: AxisPlan, axis: Axis) -> float | None:
    if options.datum == "instrument":
        return None
    if options.datum == "start":
        return plan.stops[0].position
    return axis.position_unit.to_si(float(options.datum))
