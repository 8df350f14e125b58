"""A job that has been read and checked: what the rest of the program works with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, replace
from pathlib import Path
from typing import Any

from zlmreport.errors import Place
from zlmreport.job.choices import Choice, ControllerChoice, EffectChoice, ExtensionChoice
from zlmreport.job.evaluation_keys import PriorsKeys
from zlmreport.job.keys import JobKeys
from zlmreport.job.tree import Keys, Step, keys_of, place_of
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.provenance import SourceFile
from zlmreport.values import dataclass


@dataclass(frozen=True, slots=True)
class StandardChoice(Choice):
    """A standard that the job names."""

    tolerances: Mapping[str, float]  #: Limits by symbol, m or rad.


@dataclass(frozen=True, slots=True)
class SourceChoice(Choice):
    """The data source that the job names; `instrument` is the live one that its keys name, None for most."""

    instrument: Choice | None = None


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
    source_as_found
        The data source of the axis as it was found before an adjustment; None where there was none.
    effects
        The effects of the error model, with the parameters that it fixes.
    programs
        The part programs of its plan.
    extensions
        The groups of keys that belong to extensions.
    controller
        The control for which a compensation table is written; None where the job names none.
    formats
        Identifiers of the renderers.
    directory
        Where the files go.
    files
        The job file, every file that it extends, the tables of its axis, and those of its sessions, with
        digests.
    tree
        What the files say, value by value, with the places.
    sessions
        Further tests of the same axis, against which the error model is held as well.
    priors
        What earlier tests say of noise and sizes of effects; None where the job names no such file.
    """

    keys: JobKeys
    axis: Axis
    source: SourceChoice
    standards: tuple[StandardChoice, ...]
    effects: tuple[EffectChoice, ...]
    formats: tuple[str, ...]
    directory: Path
    files: tuple[SourceFile, ...]
    source_as_found: SourceChoice | None = None
    candidates: tuple[EffectChoice, ...] = ()
    programs: tuple[Choice, ...] = ()
    extensions: tuple[ExtensionChoice, ...] = ()
    controller: ControllerChoice | None = None
    tree: Keys = field(default_factory=lambda: keys_of(Place("job")))
    sessions: tuple[Job, ...] = ()
    priors: PriorsKeys | None = None

    @property
    def as_found(self) -> Job | None:
        """The same job on the axis before it was adjusted; None where it was not.

        What the job does not say of that measurement is as in the measurement after.
        """
        keys, source = self.keys.as_found, self.source_as_found
        if keys is None or source is None:
            return None
        environment = keys.environment or self.keys.environment
        own = self.keys.model_copy(update={"measurement": keys.measurement, "environment": environment})
        return replace(self, keys=own, source=source, source_as_found=None)

    def own_keys(self, extension: str) -> Any:
        """Return the keys of an extension's group; None where the job does not have it."""
        return next((each.options for each in self.extensions if each.identifier == extension), None)

    def place_of(self, key: str) -> Place:
        """Return where a key stands, for messages: of one that is missing, its nearest parent's place.

        Parameters
        ----------
        key
            Dotted, items of lists by their index: ``certificate.number``, ``evaluate.0.tolerances.A``.
        """
        steps: list[Step] = [int(step) if step.isdecimal() else step for step in key.split(".")]
        return place_of(self.tree, tuple(steps))
