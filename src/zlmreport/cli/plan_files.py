"""What ``zlmreport plan --output`` writes: targets, a form for the readings, the sequence, programs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from zlmreport.errors import InputError, Place, Problem
from zlmreport.figures.sequence import sequence
from zlmreport.files import Document
from zlmreport.job.choices import Find, ProgramChoice, programs_by_name
from zlmreport.job.job import Job
from zlmreport.measurement.approach import Approach
from zlmreport.planning.planned_test import PlannedTest
from zlmreport.planning.programs import motion_of
from zlmreport.planning.targets import in_users_unit
from zlmreport.plugin.protocols import PartProgram

SIGNS = {Approach.POSITIVE: "+", Approach.NEGATIVE: "-"}
_OPTION = Place("zlmreport plan --program")


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


def chosen_programs(
    named: str | None,
    folder: Path | None,
    stated: tuple[ProgramChoice, ...],
    find: Find,
    known: Sequence[PartProgram],
) -> tuple[ProgramChoice, ...]:
    """Return the programs that the command line names, or else those of the job.

    Parameters
    ----------
    named
        Identifiers on the command line, parted by commas; None if there are none.
    folder
        Where files go; None for nowhere.
    stated
        The programs of the job.
    find
        Finds the installed writers of their kind.
    known
        All of these, for a message.

    Raises
    ------
    InputError
        If there is none of that name, or no folder to write it into.
    """
    if named is None:
        return stated
    if folder is None:
        raise InputError.at(_OPTION, "a program is a file; state its folder, too: --output DIR")
    names = [name.strip() for name in named.split(",") if name.strip()]
    if not names:
        such_as = ",".join(each.identifier for each in known[:2])
        raise InputError.at(_OPTION, f"there is no program in the list; for example {such_as}")
    return programs_by_name(names, _OPTION, stated, find)


def program_files(
    folder: Path,
    number: str,
    subject: Callable[[Place], Any],
    choices: Sequence[ProgramChoice],
    find: Callable[[str], PartProgram],
) -> tuple[Document, ...]:
    """Return the files of part programs.

    Parameters
    ----------
    folder, number
        Of the plan; they name the files.
    subject
        Returns what the programs are written of, asked for at a place.
    choices
        The programs.
    find
        Returns an installed writer.

    Raises
    ------
    InputError
        With everything that one of the controls or machines cannot be told.
    """
    problems: list[Problem] = []
    documents: list[Document] = []
    for choice in choices:
        program = find(choice.identifier)
        try:
            text = program.write(subject(choice.place), choice.options)
        except InputError as error:
            problems.extend(error.problems)
            continue
        documents.append(Document(folder / f"{number}{program.suffix}", text.encode("ascii")))
    if problems:
        raise InputError(problems)
    return tuple(documents)
