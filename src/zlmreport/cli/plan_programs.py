"""Part programs of ``zlmreport plan``: which are asked for, and their files."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from zlmreport.errors import InputError, Place, Problem
from zlmreport.files import Document
from zlmreport.job.choices import Find, ProgramChoice, programs_by_name
from zlmreport.job.job import Job
from zlmreport.planning.plan import Plan
from zlmreport.planning.programs import motion_of
from zlmreport.plugins import Registry

_OPTION = Place("zlmreport plan --program")


def chosen_programs(
    named: str | None, folder: Path | None, stated: tuple[ProgramChoice, ...], find: Find, such_as: str
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
    such_as
        Two identifiers, for a message.

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
        raise InputError.at(_OPTION, f"there is no program in the list; for example {such_as}")
    return programs_by_name(names, _OPTION, stated, find)


def program_files(
    folder: Path, job: Job, plan: Plan, choices: Sequence[ProgramChoice], registry: Registry
) -> tuple[Document, ...]:
    """Return the files of part programs.

    Raises
    ------
    InputError
        With everything that one of the controls cannot be told.
    """
    problems: list[Problem] = []
    documents = tuple(_documents(folder, job, plan, choices, registry, problems))
    if problems:
        raise InputError(problems)
    return documents


def _documents(  # noqa: PLR0913, PLR0917 - what is written, for whom, and where mistakes go
    folder: Path,
    job: Job,
    plan: Plan,
    choices: Sequence[ProgramChoice],
    registry: Registry,
    problems: list[Problem],
) -> Iterator[Document]:
    number = job.keys.certificate.number
    for choice in choices:
        program = registry.part_program(choice.identifier)
        try:
            text = program.write(motion_of(number, job.axis, plan, choice.place), choice.options)
        except InputError as error:
            problems.extend(error.problems)
            continue
        yield Document(folder / f"{number}{program.suffix}", text.encode("ascii"))
