"""What the ledger keeps of each certificate: what it is about, what it states, and where its files are."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from pathlib import PurePosixPath
from typing import Self

from zlmreport.certificate.document import Certificate
from zlmreport.job.job import Job
from zlmreport.job.keys import JobKeys
from zlmreport.job.measurement_keys import Machine
from zlmreport.quantities.units import Unit


class State(StrEnum):
    """What became of a job in a night."""

    #: The files are on the disk, as the digest says.
    MADE = "made"
    #: Made as a draft: the number was issued before, with another content.
    DRAFT = "draft"
    #: Not made; the message says why. The next night tries again.
    FAILED = "failed"


@dataclass(frozen=True, slots=True)
class RecordedParameter:
    """A parameter of a certificate, in the units of the results file.

    Attributes
    ----------
    standard, symbol
        As the results file has them: ``iso230-2:2014``, ``A_fwd``.
    value
        Micrometres or arc seconds.
    unit
        ``um`` or ``arcsec``.
    expanded_uncertainty
        In the same unit; None where none is stated.
    limit
        In the same unit; None where the job states none.
    conforms
        None without a limit, or where the decision rule leaves it open.
    """

    standard: str
    symbol: str
    value: float
    unit: str
    expanded_uncertainty: float | None = None
    limit: float | None = None
    conforms: bool | None = None


@dataclass(frozen=True, slots=True)
class Entry:
    """One line of the ledger: what became of one job in one night.

    Attributes
    ----------
    job
        Path of the job file, relative to the fleet file's folder.
    number
        Of the certificate; empty if the job could not be read.
    machine, axis
        The machine's designation with its serial number, and the axis's name; empty if not known.
    measured
        Date of the measurement, ISO 8601; empty if not known.
    night
        Date and time of the run of the fleet, ISO 8601 in UTC.
    digest
        Of everything that the certificate depends on; empty if it could not be formed.
    state
        What became of it.
    message
        Why it failed, or why it is a draft; empty otherwise.
    files
        Paths of its files, relative to the fleet's output folder.
    parameters
        What it states.
    """

    job: str
    number: str
    machine: str
    axis: str
    measured: str
    night: str
    digest: str
    state: State
    message: str = ""
    files: tuple[str, ...] = ()
    parameters: tuple[RecordedParameter, ...] = ()


#: What is not in a folder's name, so that it reads alike on every system and in every shell.
_NOT_IN_NAMES = re.compile(r"[^\w.-]+")
_LONGEST_NAME = 100


def designation(machine: Machine) -> str:
    """Return a machine's manufacturer, model and serial number: what it is called in a fleet."""
    return " ".join(part for part in (machine.manufacturer, machine.model, machine.serial) if part)


def folder_of(keys: JobKeys, layout: str) -> PurePosixPath:
    """Return the folder of a job's certificate, below that of all certificates.

    Parameters
    ----------
    keys
        What the job says.
    layout
        Names of folders with placeholders, as `zlmreport.job.fleet` has them.
    """
    machine = keys.machine
    values = {
        "machine": designation(machine),
        "manufacturer": machine.manufacturer,
        "model": machine.model,
        "serial": machine.serial,
        "axis": keys.axis.name,
        "number": keys.certificate.number,
    }
    named = {name: _folder_name(value or f"no {name}") for name, value in values.items()}
    return PurePosixPath(layout.format(**named))


def _folder_name(text: str) -> str:
    """Return a text as the name of one folder."""
    return _NOT_IN_NAMES.sub("-", text).strip("-.")[:_LONGEST_NAME] or "-"


@dataclass(frozen=True, slots=True)
class Subject:
    """What a job is about, as `zlmreport.fleet.records.Entry` has it; empty where the job cannot be read."""

    number: str = ""
    machine: str = ""
    axis: str = ""
    measured: str = ""

    @classmethod
    def of(cls, job: Job) -> Self:
        """Return what a job is about."""
        keys = job.keys
        date = keys.measurement.date
        measured = date.isoformat() if date else ""
        return cls(keys.certificate.number, designation(keys.machine), keys.axis.name, measured)


def parameters_of(certificate: Certificate) -> Iterator[RecordedParameter]:
    """Yield every parameter by every standard, in the units of the results file."""
    for evaluation in certificate.evaluations:
        unit = evaluation.measurements.axis.deviation_unit
        for each in evaluation.parameters:
            yield RecordedParameter(
                standard=evaluation.standard,
                symbol=each.quantity.symbol,
                value=float(unit.from_si(each.value)),
                unit=unit.ascii,
                expanded_uncertainty=_in_unit(unit, each.expanded_uncertainty),
                limit=_in_unit(unit, each.limit),
                conforms=None if each.conforms is None else bool(each.conforms),
            )


def _in_unit(unit: Unit, value: float | None) -> float | None:
    return None if value is None else float(unit.from_si(value))
