"""What ``zlmreport plan --output`` writes: targets to type in, a form for the readings, the sequence."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from zlmreport.figures.sequence import sequence
from zlmreport.files import Document
from zlmreport.job.job import Job
from zlmreport.measurement.approach import Approach
from zlmreport.planning.planned_test import PlannedTest
from zlmreport.planning.programs import motion_of
from zlmreport.planning.targets import in_users_unit

SIGNS = {Approach.POSITIVE: "+", Approach.NEGATIVE: "-"}


def plan_files(folder: Path, job: Job, planned: PlannedTest) -> tuple[Document, ...]:
    """Return the files of a plan: its targets, a form for the readings, and a picture of its sequence.

    The form has a row for each reading in the order in which they are to be taken, its deviation empty, and
    empty columns for what should be logged; the data source ``laser-csv`` reads it filled in.
    """
    texts = {
        "targets.csv": "".join(f"{line}\n" for line in _targets(job, planned)),
        "readings.csv": "".join(f"{line}\n" for line in _readings(job, planned)),
        "sequence.svg": _picture(job, planned),
    }
    number = job.keys.certificate.number
    return tuple(Document(folder / f"{number}-{name}", text.encode()) for name, text in texts.items())


def _picture(job: Job, planned: PlannedTest) -> str:
    from zlmreport.figures.draw import to_svg  # noqa: PLC0415 (brings the typeface)

    keys = job.keys.certificate
    motion = motion_of(keys.number, job.axis, planned.proposal.plan, job.place_of("plan"))
    return to_svg(sequence(motion), keys.language)


def _targets(job: Job, planned: PlannedTest) -> Iterator[str]:
    yield "number,target"
    targets = in_users_unit(job.axis, planned.proposal.plan.targets)
    yield from (f"{number},{target:.12g}" for number, target in enumerate(targets, start=1))


def _readings(job: Job, planned: PlannedTest) -> Iterator[str]:
    logs = ["time", *planned.logs]
    targets = in_users_unit(job.axis, planned.proposal.plan.targets)
    unit = job.axis.deviation_unit.symbol
    yield f"# A form to fill in: deviation is actual - target, {unit}. Columns that nobody logs may go out."
    yield ",".join(["target", "direction", "run", "deviation", *logs])
    for visit in planned.visits:
        cells = [f"{targets[visit.target]:.12g}", SIGNS[visit.approach], str(visit.run)]
        yield ",".join([*cells, "", *("" for _ in logs)])
