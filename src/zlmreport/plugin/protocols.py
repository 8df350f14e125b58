"""What a plugin must be: one protocol for each kind.

An `Effect` is declared in `zlmreport.model.effects.effect`: it is all that the error model knows of a plugin.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING, Any, Protocol, Self, runtime_checkable

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
    from pathlib import Path
    from types import TracebackType

    from zlmreport.document.certificate.attachments import Relationship
    from zlmreport.document.certificate.document import Certificate
    from zlmreport.document.certificate.information import Information
    from zlmreport.document.figures.figure import Figure
    from zlmreport.errors import Place
    from zlmreport.evaluation.evaluation import Arithmetic, Evaluation, Finding, PositionQuantity, Quantity
    from zlmreport.evaluation.statistics import PositionStatistics
    from zlmreport.evaluation.uncertainty.budget import Contribution
    from zlmreport.job.types import Options
    from zlmreport.language import Words
    from zlmreport.live.emulation.emulator import Emulator, Scene
    from zlmreport.live.ports.reading import LiveReading
    from zlmreport.measurement.axis import Axis
    from zlmreport.measurement.circle import NominalCircle
    from zlmreport.measurement.measurand import Measurand
    from zlmreport.measurement.measurement_set import MeasurementSet
    from zlmreport.model.compensation.curve import CompensationTable
    from zlmreport.model.planning.circle_path import CirclePath


@runtime_checkable
class Standard(Protocol):
    """One edition of a standard, complete on its own page.

    More attributes may stand beside these: ``measurands``, what it evaluates, positioning without it;
    ``information``, the `Information` that it wants reported of a test, which is held against the job;
    ``is_method``, true of a published method and nobody's standard; ``notes_on``, pairs of symbols and one of
    the ``notes``, which is left out where none of these parameters is reported; ``notes_of_one_direction``,
    what takes the place of ``notes`` of a test in one direction only; ``of_error(error)``, the
    standard as it evaluates that `ErrorSymbol`, whose quantities may bear the error's symbol; ``adoptions``,
    the names under which other bodies publish the identical text, by which jobs may call it, too; and
    ``contributions(measurements, options)``, what it knows of errors of single lines of several that it
    evaluates together, by their names.

    What several measured lines give together is evaluated of ``statistics.tests`` and ``measurements.tests``,
    which have them by the names that the job gives them.

    Attributes
    ----------
    identifier
        As jobs name it, edition included: ``iso230-2:2014``.
    designation
        As printed: ``ISO 230-2:2014``.
    title
        Its subject in words.
    position_index
        The letter that counts target positions in its symbols: ``i`` or ``j``.
    options
        The job keys of this standard beside ``standard`` and ``tolerances``; plain `Options` for none.
    quantities
        The parameters of the axis that it defines, in the order of its results table.
    position_quantities
        Its own columns of the table by position, beside means, standard deviations and reversal values.
    notes
        What a reader of the results must know.
    """

    identifier: str
    designation: str
    title: Words
    position_index: str
    options: type[Options]
    quantities: tuple[Quantity, ...]
    position_quantities: tuple[PositionQuantity, ...]
    notes: tuple[Words, ...]

    def requirements(self, measurements: MeasurementSet, options: Any) -> Iterable[Finding]:
        """Hold the standard's requirements against the test; a test that falls short is never refused."""

    def arithmetic(self, statistics: PositionStatistics, options: Any) -> Arithmetic:
        """Return every quantity and every own column, with the batch dimensions of the statistics.

        NaN stands for what the test does not define: it is not reported, and never zero.
        """

    def figures(self, evaluation: Evaluation, options: Any) -> Iterable[Figure]:
        """Return the standard's prescribed graphs."""


def find_information_asked_by(standard: Standard) -> tuple[Information, ...]:
    """Return what a standard wants reported of a test beside its results."""
    return getattr(standard, "information", ())


def find_contributions_of(
    standard: Standard, measurements: MeasurementSet, options: Any
) -> Mapping[str, Sequence[Contribution]]:
    """Return what a standard knows of errors of single lines of several; nothing for most."""
    found: Callable[..., Mapping[str, Sequence[Contribution]]] | None = getattr(
        standard, "contributions", None
    )
    return found(measurements, options) if found else {}


@dataclass(frozen=True, slots=True)
class SourceContext:
    """What a data source needs to know beside its own keys.

    Attributes
    ----------
    axis
        The axis under test, as the job describes it.
    place
        Where the job names the source: for messages about what a file leaves open.
    set_ups
        What extensions made of their groups of job keys, by the names of these (`Extension.set_up`).
    """

    axis: Axis
    place: Place
    set_ups: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class SourceProposal:
    """Job keys by which a data source may read a file, for ``zlmreport look``.

    Attributes
    ----------
    keys
        Beside ``plugin`` and ``file``.
    asks
        What only the file's author can say, in sentences: a sign, a unit.
    axis
        The letter of the axis, where the file names it; empty where it does not.
    circle
        The nominal circle, where the file holds a circular test; what of it the file does not tell is asked.
    quantity
        What the file holds readings of, where that is neither positioning nor a circle.
    tests
        The names of the lines that the file holds, where one that was read is one of several that are
        evaluated together: each becomes a test of the job.
    is_certain
        Whether the file can be nothing else: what is wrong with it is told, and no other source is tried. So
        it is of a circle, and of a `quantity`.
    beside
        Groups of keys at the top of the job that the source needs, with what its author is to fill in.
    set_ups
        What stands for these groups while the file is looked at, by their names (`SourceContext.set_ups`).
    """

    keys: Mapping[str, Any] = field(default_factory=dict)
    asks: tuple[str, ...] = ()
    axis: str = ""
    circle: NominalCircle | None = None
    quantity: Measurand | None = None
    tests: tuple[str, ...] = ()
    is_certain: bool = False
    beside: Mapping[str, Any] = field(default_factory=dict)
    set_ups: Mapping[str, Any] = field(default_factory=dict)


@runtime_checkable
class DataSource(Protocol):
    """A reader of measurements.

    Two more attributes may stand beside these: ``suffixes`` of its files, ``(".csv",)``, by which a file that
    nobody names a data source for finds its reader; its key ``file`` names the file then. And, where files of
    one kind are laid out in many ways, ``proposals(file)`` which returns the `SourceProposal` of each way in
    which a file may be read, the likeliest first.

    Attributes
    ----------
    identifier
        As jobs name it: ``laser-csv``.
    title
        In words.
    options
        Its job keys.
    """

    identifier: str
    title: Words
    options: type[Options]

    def read(self, options: Any, context: SourceContext) -> MeasurementSet:
        """Read the measurements; raise `InputError` with every defect of the data and its place."""


@runtime_checkable
class Renderer(Protocol):
    """A writer of certificates. It reads no clock and writes no file.

    Two more attributes say what it has to do with attachments, and one that lacks them has nothing to do
    with any. ``relationship`` is the `Relationship` of its file to a document that carries it.
    ``carries_attachments`` is true of a document that carries the files of others: it is rendered last, with
    ``certificate.attachments``. A renderer of PDF whose files do not name this program as their creator says
    in ``creator`` what that entry begins with: a certificate is verified by the renderer that made it.
    ``needs_job`` is true of one that writes what a job states, and no document on a whole machine.
    ``needs_layout`` is false of one that writes data alone: where all formats of a job do, no page is laid
    out and no graph drawn, and the certificate has neither ``cover`` nor ``sections``.

    Attributes
    ----------
    identifier
        As ``output.formats`` names it: ``pdf``.
    title
        In words.
    suffix
        Of the file: ``.pdf``.
    """

    identifier: str
    title: Words
    suffix: str

    def render(self, certificate: Certificate) -> bytes:
        """Return the file's bytes; the same certificate gives the same bytes."""


def find_relationship_of(renderer: Renderer) -> Relationship | None:
    """Return how a renderer's file relates to a document that carries it; None if none carries it."""
    return getattr(renderer, "relationship", None)


def carries_attachments(renderer: Renderer) -> bool:
    """Return whether a renderer's documents carry other files."""
    return getattr(renderer, "carries_attachments", False)


def needs_job(renderer: Renderer) -> bool:
    """Return whether a renderer writes what a job states, and so no document on a whole machine."""
    return getattr(renderer, "needs_job", False)


def needs_layout(renderer: Renderer) -> bool:
    """Return whether a renderer writes what is laid out: blocks and graphs, not the data alone."""
    return getattr(renderer, "needs_layout", True)


def is_made_by(renderer: Renderer, creator: str) -> bool:
    """Return whether a file that names this creator is told by it to be the renderer's."""
    own: str | None = getattr(renderer, "creator", None)
    return own is not None and creator.startswith(own)


@runtime_checkable
class PartProgram(Protocol):
    """A writer of part programs: a planned test in the language of a control or a measuring machine.

    One more attribute, ``takes``, is the type of what it writes, and one that lacks it writes the `Motion`
    of an axis. An extension names the type of its own plans (`Extension.takes`).

    One more method, ``write_circle(path, options)``, returns the program of a `CirclePath`, a circular test;
    for a control without it none is written.

    Attributes
    ----------
    identifier
        As ``plan.programs`` names it: ``linuxcnc``.
    title
        In words.
    suffix
        Of the file: ``.ngc``.
    options
        Its job keys beside ``program``; all have a default, for a command line has no keys.
    """

    identifier: str
    title: Words
    suffix: str
    options: type[Options]

    def write(self, motion: Any, options: Any) -> str:
        """Return the program in ASCII; raise `InputError` at ``motion.place`` for what cannot be programmed.

        The axis stops at every stop of the motion and stays at those that are read for ``motion.dwell``.
        """


def find_taken_by(program: PartProgram) -> type:
    """Return the type of what a writer of part programs writes."""
    from zlmreport.model.planning.programs import Motion  # noqa: PLC0415 (a type alone loads no room)

    takes: type = getattr(program, "takes", Motion)
    return takes


def find_circle_writer(program: PartProgram) -> Callable[[CirclePath, Any], str] | None:
    """Return how a writer of part programs writes circles; None where it writes none."""
    found: Callable[[CirclePath, Any], str] | None = getattr(program, "write_circle", None)
    return found


@runtime_checkable
class Controller(Protocol):
    """A writer and reader of compensation tables in the words of a control.

    One more attribute, ``most_rows``, is the number of rows that the control takes; one that lacks it takes
    any number. One that counts its rows from the reference point of the axis, in whole steps, has
    ``find_reference(axis, options)``, which returns where that is, m or rad.
    ``list_assumed(table, options)`` yields, in `Words`, what is taken for granted because no key states it.
    One that takes tables across axes has ``cross_sign``, ``known`` or ``stated``: whether it is
    known which way a positive value moves an axis, or the user has to say; ``cross_notes``, as ``notes``;
    ``cross_files(tables, moves)`` and ``read_cross(files, tables, moves)``, with `CrossTable` values and
    +1 or −1, the way in which a positive value moves the axis.

    Attributes
    ----------
    identifier
        As ``compensation.controller`` names it: ``linuxcnc``.
    title
        In words.
    options
        Its job keys beside ``controller``; all have a default.
    confidence
        ``verified`` on the control, ``documented`` by its maker, or ``unconfirmed``.
    is_directional, is_equidistant
        Whether a table has both directions of approach, and whether its rows must be equally far apart.
    notes
        What who loads the files must know: how, when they take effect, what the control does outside.
    """

    identifier: str
    title: Words
    options: type[Options]
    confidence: str
    is_directional: bool
    is_equidistant: bool
    notes: tuple[Words, ...]

    def files(self, table: CompensationTable, options: Any) -> Mapping[str, str]:
        """Return the texts of its files by the ends of their names, such as ``.comp``.

        Raises `InputError` at ``table.place`` for rows, digits or steps that the control would refuse or cut
        off. The table has e = actual − nominal: a control that wants another sign gets it here, and nowhere
        else.
        """

    def read(self, files: Mapping[str, str], table: CompensationTable, options: Any) -> CompensationTable:
        """Return what the control takes away when it reads these files; the table says of which axis."""


class Connection(Protocol):
    """An open instrument; it is left as a context manager, which closes its port.

    Attributes
    ----------
    can_zero
        Whether the instrument can be told to count from here.
    """

    can_zero: bool

    def __enter__(self) -> Self:
        """Return the connection."""

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close the port."""

    def readings(self) -> Iterator[LiveReading]:
        """Yield readings from now on, without end; raise `AccessError` once the instrument is gone.

        An instrument that sends unasked yields each of its readings, up to 1000 a second; one that answers
        questions is asked at the rate of its options. So a loop over this iterator can watch a window of
        readings for stability by their `LiveReading.time`, and needs no clock, no pause and no thread of its
        own. The next reading comes, or the error, within the time-out of the options. What did not arrive
        whole is yielded too, with a fault: a loop decides by `LiveReading.is_usable`, and ends a run by
        `LiveReading.loses_zero`. A capture runs the loop in a thread that only stores, so that a slow disk
        makes it miss nothing; it is ended by `__exit__` in another thread, after which it raises an error.

        Each call begins anew: what came in the meantime is dropped.
        """

    def zero(self) -> None:
        """Let the instrument count from here; raise `AccessError` if it cannot or does not."""


@runtime_checkable
class Instrument(Protocol):
    """A live instrument.

    Attributes
    ----------
    identifier
        As jobs name it: ``umd1``.
    title
        In words.
    options
        Its job keys; all but ``port`` have a default. `zlmreport.live.ports.port` has what most need.
    """

    identifier: str
    title: Words
    options: type[Options]

    def open(self, options: Any) -> Connection:
        """Open its port; raise `AccessError` with what the operator can do, `InputError` for no port."""

    def emulator(self, scene: Scene) -> Emulator:
        """Return an instrument that is not there, as one with the default options reads it.

        It speaks as the real one does, knows no port and no clock, and shows the troubles of the scene that
        its protocol has a way to show. ``zlmreport emulate`` puts it on a line; nobody should have to own an
        instrument to try its plugin.
        """


class Occasion(StrEnum):
    """What people are told of."""

    #: What is new after a night, all of it together.
    DIGEST = "digest"
    #: A certificate was issued.
    CERTIFICATE = "certificate"
    #: A job failed, or is gone, that did not in the night before.
    FAILURE = "failure"


@dataclass(frozen=True, slots=True)
class Message:
    """What people are told of a fleet.

    Attributes
    ----------
    occasion
        What it is about.
    title
        In one line: ``Hall North: 1 failed, 2 changed``.
    text
        In lines, in the language of the fleet, without markup.
    files
        Of a certificate, as they were issued.
    """

    occasion: Occasion
    title: str
    text: str
    files: tuple[Path, ...] = ()


@runtime_checkable
class Notifier(Protocol):
    """A way to tell people what a fleet came to.

    Attributes
    ----------
    identifier
        As fleet files name it: ``mail``.
    title
        In words.
    options
        Its keys beside ``plugin`` and ``tells``. A password is none of them: a key names the environment
        variable that holds it.
    """

    identifier: str
    title: Words
    options: type[Options]

    def receiver(self, options: Any) -> str:
        """Return who is told, in one line and without a secret; what was told to one is not told again."""

    def tell(self, message: Message, options: Any) -> None:
        """Tell it, once; raise `AccessError` if nobody took it. It has a minute for that."""
