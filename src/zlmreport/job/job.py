"""A job that has been read and checked: what the rest of the program works with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from zlmreport.errors import Place
from zlmreport.job.effects import EffectChoice
from zlmreport.job.model import JobKeys
from zlmreport.job.options import Options
from zlmreport.job.tree import Keys, Step, keys_of, place_of
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
    effects
        The effects of the error model, with the parameters that it fixes.
    formats
        Identifiers of the renderers.
    directory
        Where the files go.
    files
        The job file, every file that it extends, and the tables of its axis, with digests.
    tree
        What the files say, value by value, with the places.
    """

    keys: JobKeys
    axis: Axis
    source: SourceChoice
    standards: tuple[StandardChoice, ...]
    effects: tuple[EffectChoice, ...]
    formats: tuple[str, ...]
    directory: Path
    files: tuple[SourceFile, ...]
    tree: Keys = field(default_factory=lambda: keys_of(Place("job")))

    def place_of(self, key: str) -> Place:
        """Return where a key stands, for messages: of one that is missing, its nearest parent's place.

        Parameters
        ----------
        key
            Dotted, items of lists by their index: ``certificate.number``, ``evaluate.0.tolerances.A``.
        """
        steps: list[Step] = [int(step) if step.isdecimal() else step for step in key.split(".")]
        return place_of(self.tree, tuple(steps))
