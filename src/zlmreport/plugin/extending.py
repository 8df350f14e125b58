"""What a large plugin brings: a group of job keys, and all that a job with these keys gets by it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from zlmreport.document.certificate.conditions import Described
from zlmreport.document.writer import Writer
from zlmreport.errors import Place
from zlmreport.evaluation.uncertainty.budget import Contribution
from zlmreport.job.extends import FileFormat
from zlmreport.job.job import Job
from zlmreport.job.keys import JobKeys
from zlmreport.job.tree import Step
from zlmreport.job.types import Options
from zlmreport.language import Words
from zlmreport.measurement.measurement_set import MeasurementSet

if TYPE_CHECKING:
    from zlmreport.live.emulation.emulator import Emulator


@dataclass(frozen=True, slots=True)
class ExtensionPlan:
    """What ``zlmreport plan`` says of a job whose test an extension plans.

    Attributes
    ----------
    heading
        One line on the whole.
    parts
        Its parts: a word, what stands beside it, and sentences below.
    values
        As ``--json`` prints it, its key ``schema`` included.
    subject
        Returns what part programs are written of; it is asked for at a place, for messages.
    files
        Returns the texts of the files beside the programs, by the ends of their names.
    files_in_words, next_step
        What ``--output`` would write, and what is to be done before the job is run.
    """

    heading: tuple[str, str]
    parts: tuple[tuple[str, str, tuple[str, ...]], ...]
    values: Mapping[str, Any]
    subject: Callable[[Place], Any]
    files: Callable[[], Mapping[str, str]]
    files_in_words: str
    next_step: str


@dataclass(frozen=True, slots=True)
class Happening:
    """Something that happens while an extension takes readings.

    Attributes
    ----------
    values
        As ``--json`` prints it.
    line
        As a terminal shows it.
    warning
        A word before the line of what went wrong; empty otherwise.
    """

    values: Mapping[str, Any]
    line: str
    warning: str = ""


@dataclass(frozen=True, slots=True)
class LiveRun:
    """Readings that an extension takes itself, for ``zlmreport capture``.

    Attributes
    ----------
    heading
        What is printed first.
    run
        Takes what is missing and tells what happens; returns the file that the job's data source reads. The
        same call again goes on where it ended.
    without_journal
        Why there is no journal to close or to name, as the end of "is of no use …".
    """

    heading: str
    run: Callable[[Callable[[Happening], None]], Path]
    without_journal: str


@dataclass(frozen=True, slots=True)
class CommandOption:
    """An option of a command: ``--scale-error E``.

    Attributes
    ----------
    name, metavar, help
        As ``--help`` shows them.
    read
        Turns the text into a value; raises `ValueError` with what is wrong.
    without
        The value without the option.
    several
        Whether it may be given several times: its value is then a list.
    """

    name: str
    metavar: str
    help: str
    read: Callable[[str], Any]
    without: Any = None
    several: bool = False


class CommandHost(Protocol):
    """What a command may ask of the command line."""

    def load(self, path: Path) -> Job:
        """Return a job that has been read and checked."""

    def say(self, line: str) -> None:
        """Print a line."""

    def serve(
        self, emulator: Emulator, standard_port: int, announced: Iterable[str], is_gone: Callable[[], bool]
    ) -> int:
        """Put an emulated device on the TCP port of ``--port`` until it is gone; return the exit code.

        Printed first are the lines announced; `{address}` in them is that of the device.
        """


@dataclass(frozen=True, slots=True)
class Command:
    """A command of an extension.

    Attributes
    ----------
    words
        As it is typed: one word, or ``emulate`` and the name of a device.
    description, examples
        For its ``--help``.
    options
        Of its own. A device also has ``--port`` and ``--fault``, as every emulated instrument.
    run
        Does it, and returns the exit code; the options come by their names.
    """

    words: str
    description: str
    examples: str
    options: tuple[CommandOption, ...]
    run: Callable[[Mapping[str, Any], CommandHost], int]


class Extension:
    """A group of job keys, with all that a job gets by them. Each capability adds nothing unless overridden.

    Attributes
    ----------
    identifier
        The key of the group at the top of a job, as ``zlmreport plugins`` lists it: ``tracer``.
    title
        In words; it heads what the certificate says of the group.
    description, example
        Of the group, for messages and the schema.
    options
        The keys of the group.
    programs
        Where in the group part programs are listed, as the names of keys from outside to inside; empty for
        nowhere.
    takes
        What these programs are written of.
    formats
        Files that its keys name and that have a key ``schema`` of their own.
    commands
        Of the command line.
    stands_for_axis
        Whether a job with the group needs no ``axis``: `completed` then fills it in.
    """

    identifier: str
    title: Words
    description: str
    example: Mapping[str, Any]
    options: type[Options]
    programs: tuple[str, ...] = ()
    takes: type | None = None
    formats: tuple[FileFormat, ...] = ()
    commands: tuple[Command, ...] = ()
    stands_for_axis: bool = False

    def contradictions(self, keys: JobKeys, options: Any) -> Iterable[tuple[tuple[Step, ...], str]]:  # noqa: ARG002
        """Yield what no single key of a job shows to be wrong: the path of a key, and a sentence."""
        return ()

    def completed(self, keys: JobKeys, options: Any) -> JobKeys:  # noqa: ARG002
        """Return the keys of a job with what its own group says of them, such as the instrument."""
        return keys

    def set_up(self, job: Job, options: Any) -> Any:  # noqa: ARG002
        """Return what a data source finds in `SourceContext.set_ups`: the group read, checked and in SI."""
        return None

    def contributions(
        self,
        job: Job,  # noqa: ARG002
        options: Any,  # noqa: ARG002
        measurements: MeasurementSet,  # noqa: ARG002
    ) -> tuple[Contribution, ...]:
        """Return contributions to the uncertainty that stand for that of the instrument."""
        return ()

    def doubts(self, job: Job, options: Any, measurements: MeasurementSet) -> Iterable[Words]:  # noqa: ARG002
        """Return a sentence for each thing of the group that a reader may doubt: the first page marks it."""
        return ()

    def described(self, job: Job, options: Any, writer: Writer) -> Described | None:  # noqa: ARG002
        """Return what the certificate says of the group, in the section on conditions."""
        return None

    def plan(self, job: Job, options: Any) -> ExtensionPlan | None:  # noqa: ARG002
        """Return the plan of the test; None where the core plans it by target positions."""
        return None

    def live(self, job: Job, options: Any) -> LiveRun | None:  # noqa: ARG002
        """Return how the readings are taken; None where the job's data source has an instrument for that."""
        return None
