"""Runs a planned path on a live machine, keeps its points in a journal, and goes on after a break.

A face that is not found is noted, and the path goes on: the tip draws back the way it came. Anything else
that the machine calls an error ends the run. Every point is on the disk before the next move, and the same
call again goes on with the faces that are missing.

The journal lies beside the result as ``raw.csv.part`` and is a table of the same layout. Each point is on
the disk before the machine moves on; when every face has been probed, the journal gets the name of the
result. Its head holds a fingerprint of the path, so that no run goes on with another one's points.
"""

from __future__ import annotations

import contextlib
import hashlib
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, Self

from zlmreport.plugin import MILLIMETRE, AccessError, InputError, Place, Problem, quoted
from zlmreport.plugin.extension import Job, JournalFile, take_names, unwritable
from zlmreport.plugin.program import plain_name
from zlmreport_step_gauge.keys import MachineKeys, StepGaugeKeys
from zlmreport_step_gauge.machines.session import (
    MachineError,
    ServerConnection,
    Session,
    UnreadableError,
    is_missed_face,
    read_data,
)
from zlmreport_step_gauge.paths.path import Point, Probing, ProbingPath
from zlmreport_step_gauge.paths.plan import PlannedPath, find_remaining, plan_path_of_job
from zlmreport_step_gauge.paths.programs import coordinates, direction, write_beginning, write_command

_COLUMNS = "face,cycle,x,y,z,i,j,k"
_ROW = re.compile(r"(?P<face>[0-9]{1,9}),(?P<cycle>[0-9]{1,9}),")
_FINGERPRINT = "# path "
#: A face of a cycle.
Key = tuple[int, int]


class PointJournal:
    """A journal that is open; leave it as a context manager.

    Raises `AccessError` if it cannot be written, another run writes it, or the result is there already;
    `InputError` if there is a journal of another path.
    """

    def __init__(self, result: Path, path: ProbingPath) -> None:
        self._result = result
        self._part = result.with_name(f"{result.name}.part")
        self._path = path
        if result.exists():
            raise AccessError.at(
                Place(str(result)), "is there already; the gauge has been probed. Remove it to probe it again"
            )
        self._file = JournalFile(self._part, "is being written by another run on this gauge; end that first")
        try:
            self.done = self._keep_sound()  #: The faces and cycles that it holds.
        except BaseException:
            self._file.close()
            raise
        if not self._part.stat().st_size:
            self._append(*self._make_head())

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_raised: object) -> None:
        self._file.close()

    @property
    def part(self) -> Path:
        """Where the points stand until every face has been probed."""
        return self._part

    def take(self, probing: Probing, centre: Point, others: Mapping[str, float]) -> None:
        """Write a point: the tip's centre, m, and as a remark what else the machine reported with it."""
        row = [str(probing.face), str(probing.cycle), *coordinates(centre, 5), *direction(probing.normal)]
        told = ", ".join(f"{plain_name(name)} {value:.9g}" for name, value in others.items())
        remark = [f"# face {probing.face}, cycle {probing.cycle}: {told}"] if told else []
        self._append(",".join(row), *remark)
        self.done.add((probing.face, probing.cycle))

    def finish(self) -> Path:
        """Give the table the name of the result."""
        self._file.close()
        try:
            take_names({self._result: self._part})
        except OSError as error:
            raise unwritable(self._part, error) from error
        return self._result

    def _append(self, *lines: str) -> None:
        self._file.append("".join(f"{line}\n" for line in lines).encode("ascii"))

    def _make_head(self) -> tuple[str, ...]:
        radius = MILLIMETRE.from_si(self._path.tip_radius)
        what = f"{plain_name(self._path.gauge)}, job {plain_name(self._path.number)}"
        return (
            f"# {what}; I++ DME, centres of the tip, mm, nominal radius {radius:.6g} mm",
            f"{_FINGERPRINT}{_digest_path(self._path)}",
            _COLUMNS,
        )

    def _keep_sound(self) -> set[Key]:
        """Return the faces and cycles that are there; a last line that was torn off is cut away."""
        whole, end, _ = self._part.read_bytes().rpartition(b"\n")
        lines = whole.decode("ascii", errors="replace").splitlines()
        head = list(self._make_head())
        if lines[1:3] == head[1:]:
            done = {
                self._read_key(line, number) for number, line in enumerate(lines[3:], 4) if line[:1] != "#"
            }
            self._file.cut(len(whole) + len(end))
            return done
        if lines == head[: len(lines)]:  # nothing but a part of the head
            self._file.cut(0)
            return set()
        raise InputError.at(
            Place(str(self._part)),
            "holds points of another path: of another gauge, place, tip or way; rename or remove it, and "
            "start again",
        )

    def _read_key(self, line: str, number: int) -> Key:
        row = _ROW.match(line)
        if row is None:
            raise InputError.at(
                Place(str(self._part), number, 1),
                f"is no row of {_COLUMNS}: {quoted(line)}; take the line out, and start again",
            )
        return int(row["face"]), int(row["cycle"])


def _digest_path(path: ProbingPath) -> str:
    """Return what tells one path from another."""
    text = repr((path.gauge, path.tip_radius, path.moves))
    return hashlib.sha256(text.encode()).hexdigest()[:16]


class Watcher(Protocol):
    """Who is told how a run goes on."""

    def note_begin(self, done: int, points: int) -> None:
        """Hear how many of all points are on the disk already."""

    def note_probed(self, probing: Probing, centre: Point, done: int) -> None:
        """Hear of a point: the tip's centre, m, and how many there are now."""

    def note_missed(self, probing: Probing, error: MachineError) -> None:
        """Hear of a face that was not found."""

    def note_told(self, text: str) -> None:
        """Hear what the machine says unasked."""


@dataclass(frozen=True, slots=True)
class LiveProbing:
    """What a job asks for that is to be probed live."""

    planned: PlannedPath  #: The path.
    machine: MachineKeys
    result: Path  #: Where the table of points goes, which the job's data source reads.


def find_live_probing(job: Job, keys: StepGaugeKeys) -> LiveProbing | None:
    """Return what a job asks to be probed live; None if its data source is none that a machine probes for.

    Raises `AccessError` if a file of the gauge cannot be read; `InputError` if no machine is stated, or the
    path cannot be planned.
    """
    options = job.source.options
    if not hasattr(options, "machine"):
        return None
    machine, result = options.machine, getattr(options, "file", None)
    if not isinstance(machine, MachineKeys) or not isinstance(result, Path):
        raise InputError.at(
            job.source.place,
            "a step gauge is probed by a machine; state measurement.source.machine, such as "
            "{host: 192.168.1.20, tool: RefTool}",
        )
    return LiveProbing(plan_path_of_job(job, keys), machine, result)


def run_probing(probing: LiveProbing, watcher: Watcher) -> Path:
    """Probe what is missing, and return the table of all points.

    Raises `AccessError` if the machine cannot be reached or stops, if faces were missed, or the table cannot
    be written: with what the operator can do. What was probed is kept. Raises `InputError` if what is there
    was probed on another path.
    """
    whole = probing.planned.path
    with PointJournal(probing.result, whole) as journal:
        watcher.note_begin(len(journal.done), len(whole.probings))
        path = find_remaining(probing.planned, journal.done)
        missed: dict[Probing, MachineError] = {}
        if path.probings:
            missed = _probe(path, probing.machine, journal, watcher)
        if missed:
            raise AccessError(_find_problems(missed, journal.part))
        return journal.finish()


def _probe(
    path: ProbingPath, machine: MachineKeys, journal: PointJournal, watcher: Watcher
) -> dict[Probing, MachineError]:
    """Make the moves of a path; return the faces that were missed."""
    missed: dict[Probing, MachineError] = {}
    with ServerConnection(machine.host, machine.port) as connection:
        session = Session(connection, machine.timeout, watcher.note_told)
        with _stop_on_interrupt(session):
            session.begin(write_beginning(path, machine.tool))
            for move in path.moves:
                if not isinstance(move, Probing):
                    session.order(write_command(move))
                    continue
                point = _touch_face(session, move, connection.place)
                if isinstance(point, MachineError):
                    missed[move] = point
                    watcher.note_missed(move, point)
                else:
                    centre, others = point
                    journal.take(move, centre, others)
                    watcher.note_probed(move, centre, len(journal.done))
            session.order("EndSession()")
    return missed


def _touch_face(
    session: Session, probing: Probing, place: Place
) -> tuple[Point, Mapping[str, float]] | MachineError:
    """Measure towards a face; return the tip's centre and what else is reported, or why there is none."""
    outcome = session.ask(write_command(probing))
    for error in outcome.errors:
        if is_missed_face(error):
            if error.is_in_the_way:
                session.clear()
            return error
        if error.is_in_the_way:
            session.fail(error)
    reports = []
    for text in outcome.data:
        try:
            reports.append(read_data(text))
        except UnreadableError as error:
            raise AccessError.at(place, f"{error}; version 1.4 is expected") from error
    report = reports[0] if len(reports) == 1 else {}
    if not {"X", "Y", "Z"} <= report.keys():
        raise AccessError.at(
            place, f"face {probing.face}: the machine reports no point with X, Y and Z; see OnPtMeasReport"
        )
    x, y, z = (MILLIMETRE.to_si(report[name][0]) for name in "XYZ")
    others = {
        name: values[0]
        for name, values in report.items()
        if name not in {"X", "Y", "Z", "IJK"} and len(values) == 1
    }
    return (x, y, z), others


@contextlib.contextmanager
def _stop_on_interrupt(session: Session) -> Iterator[None]:
    """Stop the machine when the operator interrupts the run."""
    try:
        yield
    except KeyboardInterrupt:
        with contextlib.suppress(AccessError):
            session.abort()
        raise


def _find_problems(missed: Mapping[Probing, MachineError], part: Path) -> Iterator[Problem]:
    for probing, error in missed.items():
        yield Problem(
            Place(str(part)),
            f"face {probing.face}, cycle {probing.cycle}, was missed: {error}; look at the gauge and the "
            "tip, and start again: only what is missing is probed",
        )
