"""Where readings come from and what was done to them: files, corrections, exclusions, averages, days."""

from __future__ import annotations

import datetime as dt
import hashlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Self

from zlmreport.language import Words
from zlmreport.measurement.approach import Approach


@dataclass(frozen=True, slots=True)
class SourceFile:
    """A file that a certificate was made from: its job, its readings, or what these name.

    Attributes
    ----------
    name
        The file's name without its folder: the folder is nobody's business but the laboratory's.
    sha256
        Digest of its bytes, hexadecimal.
    size
        Its length in bytes.
    path
        Where it was read; no document states it.
    content
        Its bytes, so that a certificate can carry what was read and not what lies there later; None from
        a reader that did not keep them.
    """

    name: str
    sha256: str
    size: int
    path: Path | None = field(default=None, repr=False, compare=False)
    content: bytes | None = field(default=None, repr=False, compare=False)

    @classmethod
    def of(cls, path: Path, content: bytes) -> Self:
        """Return the file that was read from a path."""
        return cls(path.name, hashlib.sha256(content).hexdigest(), len(content), path, content)


@dataclass(frozen=True, slots=True)
class Correction:
    """A correction that was applied to readings.

    Attributes
    ----------
    name
        Of what.
    method
        By which equation.
    inputs
        The values that went into it.
    largest
        What it changed most in a reading, with its sign, m or rad.
    """

    name: Words
    method: Words
    inputs: Words
    largest: float


@dataclass(frozen=True, slots=True)
class Exclusion:
    """A reading that was set aside."""

    reading: int  #: Its place in the measurement set.
    target_position: float  #: m or rad.
    approach: Approach  #: Direction of approach.
    run: int  #: Number of its run, from 1.
    deviation: float  #: What was read, corrected as the others are, m or rad.
    reason: str  #: Why, in the words of whoever did it.


@dataclass(frozen=True, slots=True)
class Averaging:
    """Readings of a motion, many to a target, that were averaged on reading; and what that may hide.

    Attributes
    ----------
    readings
        How many there were.
    left_out
        Root mean square of what the averages leave out, m or rad.
    amplitude
        Of the strongest vibration in it, m or rad; 0 where none stands out of the noise.
    frequency
        Of that vibration, Hz; 0 for none.
    """

    readings: int
    left_out: float
    amplitude: float = 0.0
    frequency: float = 0.0


@dataclass(frozen=True, slots=True)
class ReadingDays:
    """On which days a file says that its readings were taken."""

    first: dt.date
    last: dt.date
    is_utc: bool = False  #: Whether by the time of Greenwich: where it was measured it may have been another.


@dataclass(frozen=True, slots=True)
class Provenance:
    """The origin of a measurement set.

    Attributes
    ----------
    source
        Identifier of the data source that read it.
    files
        The files read.
    remarks
        What the reader has to say of them: units taken, columns mapped, what the file left open.
    corrections
        What this program has corrected in the readings, in its order; nothing if they are as they were read.
    exclusions
        Readings that were set aside: in the set they are missing.
    step
        Of readings that were corrected: the step in which they were displayed, m or rad; None where they
        were not.
    averaging
        What became of readings that were many to a target; None where each stands for itself.
    days
        On which days the readings were taken, as the file dates them; None where it does not.
    """

    source: str
    files: tuple[SourceFile, ...] = ()
    remarks: tuple[Words, ...] = ()
    corrections: tuple[Correction, ...] = ()
    exclusions: tuple[Exclusion, ...] = ()
    step: float | None = None
    averaging: Averaging | None = None
    days: ReadingDays | None = None
