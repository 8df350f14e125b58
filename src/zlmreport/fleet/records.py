"""What the ledger keeps of a certificate: machine, axis, parameters, due date, names of its files."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from datetime import date, datetime, timedelta
from enum import StrEnum
from pathlib import PurePosixPath
from typing import Any, Self

from zlmreport.document.certificate.document import Certificate
from zlmreport.evaluation.report import report_parameter
from zlmreport.job.contradictions import find_last_day
from zlmreport.job.job import Job
from zlmreport.job.keys import JobKeys
from zlmreport.job.measurement_keys import MachineUnderTest
from zlmreport.language import Language, Words


class State(StrEnum):
    """What became of a job in a night."""

    #: The files are on the disk, as the digest says.
    MADE = "made"
    #: Made as a draft: the number was issued before, with another content.
    DRAFT = "draft"
    #: Not made; the message says why. The next night tries again.
    FAILED = "failed"
    #: Exceeded a limit, or ended its worker.
    STOPPED = "stopped"
    #: Stopped again, though nothing about it had changed; not tried until something does.
    SET_ASIDE = "set aside"
    #: Its file is gone, and the fleet file does not say that this is meant.
    VANISHED = "vanished"

    @property
    def is_failure(self) -> bool:
        """Whether there is no certificate that should be there."""
        return self in {State.FAILED, State.STOPPED, State.SET_ASIDE, State.VANISHED}


#: Stands for the standard of a parameter of the error model, whose symbol is ``backlash.lost_motion``.
MODEL = "model"


class About(StrEnum):
    """What a whole night is told about, and not one job of it."""

    #: Many jobs are gone since the last night.
    JOBS = "jobs"
    #: The folder of certificates is empty, and was not.
    FOLDER = "folder"
    #: The ledger does not know the certificates that are there.
    LEDGER = "ledger"
    #: The clock stands before the last night.
    CLOCK = "clock"
    #: The night before gave no sign of life.
    STUCK = "stuck"
    #: News could not be sent.
    UNTOLD = "untold"
    #: What the tests teach could not be written.
    PRIORS = "priors"
    #: The night before never came to its end.
    BROKEN = "broken"
    #: The time of the night was over before all was made.
    LEFT = "left"
    #: Certificates that no job makes any more are gone, or not as they were issued.
    DOCUMENTS = "documents"

    @property
    def is_condition(self) -> bool:
        """Whether it lasts until something is done, and is told once; others are events of one night."""
        return self not in {About.BROKEN, About.STUCK, About.CLOCK, About.JOBS, About.DOCUMENTS}


class NewsKind(StrEnum):
    """Of news, in the order in which they are told."""

    NIGHT = "the whole night"
    FAILED = "failed"
    NOT_MET = "limit not met"
    CHANGED = "changed"
    DRIFTING = "drifting"
    OVERDUE = "overdue"
    DRAFT = "draft"

    @property
    def is_condition(self) -> bool:
        """Whether it ends, and is news again if it comes back; what a measurement says is news once."""
        return self in {NewsKind.NIGHT, NewsKind.FAILED, NewsKind.NOT_MET, NewsKind.DRAFT}


@dataclass(frozen=True, slots=True)
class News:
    """One event."""

    kind: NewsKind  #: Of the event.
    subject: str  #: What makes it this event and no other.
    text: str  #: For people, in one line.


@dataclass(frozen=True, slots=True)
class NightNotice:
    """What concerns a whole night, and is not as it should be."""

    about: About
    text: Words

    @property
    def english(self) -> str:
        """The text for the terminal."""
        return self.text.in_language(Language.ENGLISH)


#: A night that has given no sign of life for so long does nothing any more.
SILENT = timedelta(minutes=15)


@dataclass(frozen=True, slots=True)
class PastNight:
    """A run of a fleet."""

    began: datetime  #: With its offset from UTC.
    ended: datetime | None  #: None for a run that is at work, or was interrupted.
    notices: tuple[NightNotice, ...] = ()  #: What concerned all of it.
    came_to: Mapping[State, int] = field(default_factory=dict)  #: How many jobs became what in it.
    beat: datetime | None = None  #: When it gave its last sign of life.
    is_at_work: bool = False  #: Whether it still goes on; as somebody with a clock says, `see_at`.
    untried: tuple[str, ...] = ()  #: Jobs that it had no time for.

    @property
    def seconds(self) -> float | None:
        """How long it took."""
        return (self.ended - self.began).total_seconds() if self.ended else None

    def see_at(self, now: datetime) -> Self:
        """Return the same as it is now: at work if it has not ended, and gave a sign of life lately."""
        # One that is to come is of a clock that was set back since: whoever is at work has given another.
        is_at_work = self.ended is None and self.beat is not None and abs(now - self.beat) < SILENT
        return replace(self, is_at_work=is_at_work)

    @property
    def done(self) -> int:
        """How many jobs it has come to an end with."""
        return sum(self.came_to.values())


@dataclass(frozen=True, slots=True)
class RecordedParameter:
    """A parameter of a certificate, in the units of the results file."""

    #: standard and symbol: As the results file has them: ``iso230-2:2014``, ``A_fwd``.
    standard: str
    symbol: str
    value: float  #: Micrometres or arc seconds.
    unit: str  #: ``um`` or ``arcsec``.
    expanded_uncertainty: float | None = None  #: In the same unit; None where none is stated.
    limit: float | None = None  #: In the same unit; None where the job states none.
    conforms: bool | None = None  #: None without a limit, or where the decision rule leaves it open.


def compute_due_date(measured: str, interval: int | None) -> str:
    """Return the day by which an axis is to be measured again, ISO 8601; nothing without an interval."""
    if not interval:
        return ""
    return (date.fromisoformat(measured) + timedelta(days=interval)).isoformat()


#: What is not in a folder's name, so that it reads alike on every system and in every shell.
_NOT_IN_NAMES = re.compile(r"[^\w.-]+")
_LONGEST_NAME = 100


def write_designation(machine: MachineUnderTest) -> str:
    """Return a machine's manufacturer, model and serial number: what it is called in a fleet."""
    return " ".join(filter(None, (machine.type, machine.serial)))


def find_folder_of(keys: JobKeys, layout: str) -> PurePosixPath:
    """Return the folder of a job's certificate, below that of all certificates.

    `layout`: Names of folders with placeholders, as `zlmreport.job.fleet` has them.
    """
    machine = keys.machine
    values = {
        "machine": write_designation(machine),
        "manufacturer": machine.manufacturer,
        "model": machine.model,
        "serial": machine.serial,
        "axis": keys.axis.name,
        "number": keys.certificate.number,
    }
    named = {name: make_file_name(value or f"no {name}") for name, value in values.items()}
    return PurePosixPath(layout.format(**named))


def make_file_name(text: str) -> str:
    """Return a text as the name of one file or folder."""
    return _NOT_IN_NAMES.sub("-", text).strip("-.")[:_LONGEST_NAME] or "-"


def name_axis(machine: str, axis: str) -> str:
    """Return an axis for people, as far as it is known."""
    return ", ".join(part for part in (machine, axis) if part)


@dataclass(frozen=True, slots=True)
class Subject:
    """What a job is about; empty where the job cannot be read, or does not say."""

    number: str = ""  #: Of the certificate.
    #: machine and axis: The machine's designation with its serial number, and the axis's name.
    machine: str = ""
    axis: str = ""
    measured: str = ""  #: Last day of the measurement, ISO 8601.
    #: Days after which the job itself says that the axis is to be measured again.
    interval: int | None = None
    instrument: str = ""  #: With which it was measured.
    type: str = ""  #: The machine's manufacturer and model.

    @property
    def axis_key(self) -> tuple[str, str]:
        """What tells an axis from others: the machine, and its name."""
        return self.machine, self.axis

    def name_term(self, due: str) -> str:
        """Return what tells, in the news, that the axis is overdue since a day from any other event."""
        return f"{self.machine}|{self.axis}|{due}"

    @property
    def of_axis(self) -> str:
        """Machine and axis for people, as far as they are known."""
        return name_axis(*self.axis_key)

    @classmethod
    def of(cls, job: Job) -> Self:
        """Return what a job is about."""
        keys = job.keys
        day = find_last_day(keys.measurement)
        measured = day.isoformat() if day else ""
        machine, used = write_designation(keys.machine), keys.instrument
        # Not by its certificate: a new one makes no new instrument of it.
        stated = (used.manufacturer, used.name, used.serial) if used else ()
        instrument = " ".join(part for part in stated if part)
        number, interval = keys.certificate.number, keys.fleet.interval
        return cls(number, machine, _name_quantity(job), measured, interval, instrument, keys.machine.type)


def _name_quantity(job: Job) -> str:
    """Return what was measured of a machine: an axis, whose positioning it is, or the symbol of an error."""
    return job.axis.name if job.axis.measurand.is_position else job.axis.error or job.axis.name


@dataclass(frozen=True, slots=True, kw_only=True)
class LedgerEntry(Subject):
    """One line of the ledger: what became of one job in one night, and what it is about."""

    job: str  #: Path of the job file, relative to the fleet file's folder.
    night: str  #: Date and time of the run of the fleet, ISO 8601 in UTC.
    digest: str = ""  #: Of everything that the certificate depends on; empty if it could not be formed.
    state: State  #: What became of it.
    message: str = ""  #: Why it failed, or why it is a draft; empty otherwise.
    files: tuple[str, ...] = ()  #: Paths of its files, relative to the fleet's output folder.
    parameters: tuple[RecordedParameter, ...] = ()  #: What it states.
    doubts: tuple[Words, ...] = ()  #: Sentences on what it leaves doubtful.
    seconds: float | None = None  #: How long it took; None where nothing was made.


def list_parameters_of(certificate: Certificate) -> Iterator[RecordedParameter]:
    """Yield every parameter by every standard, in the units of the results file, and those of the model."""
    for evaluation in certificate.evaluations:
        usual = evaluation.measurements.axis.deviation_unit
        reported = (report_parameter(each, usual, Language.ENGLISH) for each in evaluation.parameters)
        yield from list_parameters_by(evaluation.standard, reported)
    if certificate.diagnosis:
        from zlmreport.model.diagnosis.report import report_model  # noqa: PLC0415 - only where there is a model

        yield from list_parameters_of_model(report_model(certificate.diagnosis.fit))


def list_parameters_by(standard: str, reported: Iterable[Mapping[str, Any]]) -> Iterator[RecordedParameter]:
    """Yield the parameters by a standard, out of the ``parameters`` of a results file."""
    for each in reported:
        if isinstance(each["value"], int | float) and math.isfinite(each["value"]):
            yield RecordedParameter(
                standard=standard,
                symbol=each["symbol"],
                value=float(each["value"]),
                unit=each["unit"],
                expanded_uncertainty=_take_number(each.get("expanded_uncertainty")),
                limit=_take_number(each.get("limit")),
                conforms=each.get("conforms"),
            )


def list_parameters_of_model(model: Mapping[str, Any]) -> Iterator[RecordedParameter]:
    """Yield the parameters of an error model, out of the ``model`` of a results file."""
    for each in model.get("parameters", ()):
        value, stated = each["value"], each.get("expanded_uncertainty")
        if isinstance(value, int | float) and math.isfinite(value):
            symbol = f"{each['effect']}.{each['name']}"
            yield RecordedParameter(MODEL, symbol, float(value), each["unit"], stated)


def _take_number(value: float | None) -> float | None:
    """Return a number as databases take it: plain, and none of numpy."""
    return None if value is None else float(value)
