"""What the ledger keeps of each certificate: all that the overview, the trends and the next night ask for."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


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
