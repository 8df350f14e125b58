"""A job that has been read and checked: what the rest of the program works with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from zlmreport.errors import Place
from zlmreport.job.model import JobKeys
from zlmreport.job.options import Options
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.provenance import SourceFile


@dataclass(frozen=True, slots=True)
class StandardChoice:
    """A standard that the job names.

    Attributes
    ----------
    identifier
        Of an installed standard.
    options
        Its own keys, validated by its options class.
    tolerances
        Limits by symbol, m or rad.
    """

    identifier: str
    options: Options
    tolerances: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class SourceChoice:
    """The data source that the job names, its own keys validated, and where the job names it."""

    identifier: str
    options: Options
    place: Place


@dataclass(frozen=True, slots=True)
class Job:
    """A checked job.

    Attributes
    ----------
    keys
        What the file says, in the users' units.
    axis
        The axis in SI.
    source, standards
        The plugins chosen, with their validated keys.
    formats
        Identifiers of the renderers.
    directory
        Where the files go.
    files
        The job file and every file that it extends, with digests.
    """

    keys: JobKeys
    axis: Axis
    source: SourceChoice
    standards: tuple[StandardChoice, ...]
    formats: tuple[str, ...]
    directory: Path
    files: tuple[SourceFile, ...]
