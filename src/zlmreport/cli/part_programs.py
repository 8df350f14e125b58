"""Part programs on the command line: which are asked for, and their files."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from zlmreport.cli.terminal import show_path
from zlmreport.errors import InputError, Place, Problem
from zlmreport.files import Document
from zlmreport.job.choices import Choice, Find, choose_programs_by_name
from zlmreport.plugin.protocols import PartProgram

RUN = Place("zlmreport plan --run")
_OPTION = Place("zlmreport plan --program")


def demand_file(options: Namespace, programs: Sequence[Choice]) -> None:
    """Refuse to show a run that nobody asks to have written."""
    if options.run is not None and (not programs or not options.output):
        raise InputError.at(RUN, "the program of a run is a file; state --program NAME and --output DIR, too")


def write_program_of(subject: Callable[[Place], Any], program: PartProgram, choice: Choice) -> str:
    """Return the program of a subject, asked for where a program is named."""
    return program.write(subject(choice.place), choice.options)


def choose_programs(
    options: Namespace,
    stated: tuple[Choice, ...],
    find: Find,
    known: Sequence[PartProgram],
) -> tuple[Choice, ...]:
    """Return the programs that the command line names, or else those of the job.

    Raises `InputError` if there is none of that name, or no folder to write it into.
    """
    if options.program is None:
        return stated
    if options.output is None:
        raise InputError.at(_OPTION, "a program is a file; state its folder, too: --output DIR")
    names = [name.strip() for name in options.program.split(",") if name.strip()]
    if not names:
        such_as = ",".join(each.identifier for each in known[:2])
        raise InputError.at(_OPTION, f"there is no program in the list; for example {such_as}")
    return choose_programs_by_name(names, _OPTION, stated, find)


def tell_written(options: Namespace, programs: Sequence[Choice], written: Sequence[Path]) -> None:
    """Print the files of a plan; which programs there are, where nobody says into which folder."""
    if programs and not options.output:
        names = ", ".join(each.identifier for each in programs)
        print(f"part programs for {names}: state a folder, --output DIR")
    for path in written:
        print(show_path(path))


def make_program_files(
    folder: Path,
    number: str,
    write: Callable[[PartProgram, Choice], str],
    choices: Sequence[Choice],
    find: Callable[[str], PartProgram],
) -> tuple[Document, ...]:
    """Return the files of part programs.

    `write`: Returns the program that a writer writes with the keys of a choice, as `write_program_of` does.

    Raises `InputError` with everything that one of the controls or machines cannot be told.
    """
    problems: list[Problem] = []
    documents: list[Document] = []
    for choice in choices:
        program = find(choice.identifier)
        try:
            text = write(program, choice)
        except InputError as error:
            problems.extend(error.problems)
            continue
        documents.append(Document(folder / f"{number}{program.suffix}", text.encode("ascii")))
    if problems:
        raise InputError(problems)
    return tuple(documents)
