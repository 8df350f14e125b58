"""What ``zlmreport plan --output`` writes: the targets to type in, and a form for the readings."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from zlmreport.errors import InputError, Place, Problem
from zlmreport.foresight.foresee import Foresight
from zlmreport.job.job import Job
from zlmreport.measurement.approach import Approach
from zlmreport.measurement.axis import Axis
from zlmreport.pipeline import Document
from zlmreport.quantities.arrays import FloatArray

SIGNS = {Approach.POSITIVE: "+", Approach.NEGATIVE: "-"}
#: More digits than any control takes, and fewer than a double rounds at.
_DIGITS = 9


def in_users_unit(axis: Axis, positions: FloatArray) -> list[float]:
    """Return positions in mm or °, as decimal numbers that were meant."""
    return [round(value, _DIGITS) for value in axis.position_unit.from_si(positions).tolist()]


def plan_files(folder: Path, job: Job, foresight: Foresight) -> tuple[Document, ...]:
    """Return the files of a plan.

    The form has a row for each reading in the order in which they are to be taken, its deviation empty, and
    empty columns for what should be logged; the data source ``laser-csv`` reads it filled in.
    """
    number = job.keys.certificate.number
    texts = {"targets": _targets(job, foresight), "readings": _readings(job, foresight)}
    return tuple(
        Document(folder / f"{number}-{name}.csv", "".join(f"{line}\n" for line in lines).encode())
        for name, lines in texts.items()
    )


def refuse_files_that_are_there(documents: Iterable[Document]) -> None:
    """Refuse to write over a form that somebody may have filled in."""
    problems = [
        Problem(Place(str(document.path)), "is there already; choose another folder, or remove it")
        for document in documents
        if document.path.exists()
    ]
    if problems:
        raise InputError(problems)


def _targets(job: Job, foresight: Foresight) -> Iterator[str]:
    yield "number,target"
    targets = in_users_unit(job.axis, foresight.proposal.plan.targets)
    yield from (f"{number},{target:.12g}" for number, target in enumerate(targets, start=1))


def _readings(job: Job, foresight: Foresight) -> Iterator[str]:
    logs = ["time", *foresight.logs]
    targets = in_users_unit(job.axis, foresight.proposal.plan.targets)
    unit = job.axis.deviation_unit.symbol
    yield f"# A form to fill in: deviation is actual - target, {unit}. Columns that nobody logs may go out."
    yield ",".join(["target", "direction", "run", "deviation", *logs])
    for visit in foresight.visits:
        cells = [f"{targets[visit.target]:.12g}", SIGNS[visit.approach], str(visit.run)]
        yield ",".join([*cells, "", *("" for _ in logs)])
