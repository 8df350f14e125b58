"""The points of a run, on the disk as they arrive.

The journal lies beside the result as ``raw.csv.part`` and is a table of the same layout. Each point is on
the disk before the machine moves on; when every face has been probed, the journal gets the name of the
result. Its head holds a fingerprint of the path, so that no run goes on with another one's points.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path
from types import TracebackType
from typing import Self

from zlmreport.plugin import (
    MILLIMETRE,
    AccessError,
    Appended,
    InputError,
    Place,
    take_names,
    unwritable,
)
from zlmreport_step_gauge.paths.path import Point, Probing, ProbingPath
from zlmreport_step_gauge.paths.programs import coordinates, direction, plain

_COLUMNS = "face,cycle,x,y,z,i,j,k"
_FINGERPRINT = "# path "
#: A face of a cycle.
Key = tuple[int, int]


class Journal:
    """A journal that is open; leave it as a context manager.

    Parameters
    ----------
    result
        Where the table will stand in the end.
    path
        The whole path, whose points it takes.

    Attributes
    ----------
    done
        The faces and cycles that it holds.

    Raises
    ------
    AccessError
        If it cannot be written, or the result is there already.
    InputError
        If there is a journal of another path.
    """

    def __init__(self, result: Path, path: ProbingPath) -> None:
        self._result = result
        self._part = result.with_name(f"{result.name}.part")
        self._path = path
        if result.exists():
            raise AccessError.at(
                Place(str(result)), "is there already; the gauge has been probed. Remove it to probe it again"
            )
        try:
            self._file = Appended(self._part)
        except OSError as error:
            raise unwritable(self._part, error) from error
        try:
            self.done = self._sound()
        except BaseException:
            self._file.close()
            raise
        if not self._part.stat().st_size:
            self._append(*self._head())

    def __enter__(self) -> Self:
        """Return the journal."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close the file."""
        self._file.close()

    @property
    def part(self) -> Path:
        """Where the points stand until every face has been probed."""
        return self._part

    def take(self, probing: Probing, centre: Point, others: Mapping[str, float]) -> None:
        """Write a point: the tip's centre, m, and as a remark what else the machine reported with it."""
        row = [str(probing.face), str(probing.cycle), *coordinates(centre, 5), *direction(probing.normal)]
        told = ", ".join(f"{plain(name)} {value:.9g}" for name, value in others.items())
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
        try:
            self._file.append("".join(f"{line}\n" for line in lines).encode("ascii"))
        except OSError as error:
            raise unwritable(self._part, error) from error

    def _head(self) -> tuple[str, ...]:
        radius = MILLIMETRE.from_si(self._path.tip_radius)
        what = f"{plain(self._path.gauge)}, job {plain(self._path.number)}"
        return (
            f"# {what}; I++ DME, centres of the tip, mm, nominal radius {radius:.6g} mm",
            f"{_FINGERPRINT}{fingerprint(self._path)}",
            _COLUMNS,
        )

    def _sound(self) -> set[Key]:
        """Return the faces and cycles that are there; a last line that was torn off is cut away."""
        whole, end, _ = self._part.read_bytes().rpartition(b"\n")
        lines = whole.decode("ascii", errors="replace").splitlines()
        head = list(self._head())
        if lines[1:3] == head[1:]:
            self._file.cut(len(whole) + len(end))
            return {_key(line) for line in lines[3:] if not line.startswith("#")}
        if lines == head[: len(lines)]:  # nothing but a part of the head
            self._file.cut(0)
            return set()
        raise InputError.at(
            Place(str(self._part)),
            "holds points of another path: of another gauge, place, tip or way; rename or remove it, and "
            "start again",
        )


def _key(line: str) -> Key:
    face, cycle, _ = line.split(",", 2)
    return int(face), int(cycle)


def fingerprint(path: ProbingPath) -> str:
    """Return what tells one path from another."""
    text = repr((path.gauge, path.tip_radius, path.moves))
    return hashlib.sha256(text.encode()).hexdigest()[:16]
