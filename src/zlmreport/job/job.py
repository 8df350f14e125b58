"""The `Job`: a job that was read and checked, as all other rooms get it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from zlmreport.errors import InputError, Place, quoted
from zlmreport.job.choices import Choice, ControllerChoice, ExtensionChoice, SourceChoice
from zlmreport.job.evaluation_keys import PriorsKeys
from zlmreport.job.keys import JobKeys
from zlmreport.job.quantity import convert_places_to_si
from zlmreport.job.tree import Keys, Step, make_keys_of, place_of
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.provenance import SourceFile

if TYPE_CHECKING:
    from zlmreport.job.effect_choices import EffectChoice

#: Keys of a measurement that no other one shares with it.
_OF_ITS_READINGS = frozenset({"source", "date", "end", "excluded", "remarks"})


@dataclass(frozen=True, slots=True)
class StandardChoice(Choice):
    """A standard that the job names."""

    tolerances: Mapping[str, float]  #: Limits by symbol, m or rad.
    specification: str = ""  #: The document that they come from; empty where the job does not say.
    adoption: str = ""  #: By whose name the job calls it, if by an identical adoption's; else empty.


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
    tests
        The measured lines that are evaluated together, each as a job of its own, by the names that the job
        gives them; none of most jobs.
    measurements
        The jobs that the document of this one is made of, by the symbols of their errors or their files'
        names; none of most. What is said above is then that of the first, and the document's own where it
        says so.
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
    tree: Keys = field(default_factory=lambda: make_keys_of(Place("job")))
    sessions: tuple[Job, ...] = ()
    priors: PriorsKeys | None = None
    tests: Mapping[str, Job] = field(default_factory=dict)
    measurements: Mapping[str, Job] = field(default_factory=dict)

    @property
    def as_found(self) -> Job | None:
        """The same job on the axis before it was adjusted; None where it was not.

        What the job does not say of that measurement is as in the measurement after, but for what belongs to
        the readings of one alone.
        """
        keys, source = self.keys.as_found, self.source_as_found
        if keys is None or source is None:
            return None
        after, before = self.keys.measurement, keys.measurement
        shared = after.model_fields_set - before.model_fields_set - _OF_ITS_READINGS
        measurement = before.model_copy(update={key: getattr(after, key) for key in shared})
        environment = keys.environment or self.keys.environment
        own = self.keys.model_copy(update={"measurement": measurement, "environment": environment})
        axis = replace(self.axis, at=convert_places_to_si(measurement.at))
        return replace(self, keys=own, axis=axis, source=source, source_as_found=None)

    @property
    def lines(self) -> Mapping[str, Job]:
        """What was measured: each of several lines by its name, or the job itself by an empty one."""
        return self.tests or {"": self}

    @property
    def parts(self) -> tuple[Job, ...]:
        """What a document is made of: each of its jobs, or the job itself."""
        return tuple(self.measurements.values()) or (self,)

    @property
    def sources(self) -> tuple[SourceChoice, ...]:
        """Every data source that the job names."""
        if self.measurements:
            return tuple(each for of in self.measurements.values() for each in of.sources)
        own = [each.source for each in self.lines.values()]
        return (*own, *([self.source_as_found] if self.source_as_found else []))

    def demand_one_line(self, doing: str) -> None:
        """Raise `InputError` for a job of several measured lines, where one is meant.

        `doing`: What is of one line, as the beginning of a sentence.
        """
        if self.measurements:
            raise InputError.at(
                self.place_of("measurements"),
                f"{doing} is of one measurement, and this document has several; take one of their jobs",
            )
        if self.tests:
            raise InputError.at(
                self.place_of("measurement.tests"),
                f"{doing} is of one measured line, and this job has {', '.join(self.tests)}; write a job "
                f"for one",
            )

    def line(self, name: str | None, option: Place) -> Job:
        """Return one of several measured lines as a job of its own, by its name; a job without any, itself.

        Raises `InputError` at the `option` that names it if there is no such line, or one has to be named.
        """
        if self.measurements:
            self.demand_one_line("this command")
        if not self.tests and name is None:
            return self
        found = self.tests.get(name or "")
        if found is None:
            lines = f"this job has {', '.join(self.tests)}" if self.tests else "this job has a single line"
            asked = (
                f"{quoted(name)} is no test; {lines}" if name else f"{lines}: say which of them, --test NAME"
            )
            raise InputError.at(option, asked)
        certificate = found.keys.certificate.model_copy(
            update={"number": f"{self.keys.certificate.number}-{name}"}
        )
        return replace(found, keys=found.keys.model_copy(update={"certificate": certificate}))

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
