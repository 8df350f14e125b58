"""The part programs and probing programs that a job names, each with its own keys."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import TypeAlias

from zlmreport.errors import InputError, Place, Problem
from zlmreport.job.installed import InstalledProgram
from zlmreport.job.job import ProgramChoice
from zlmreport.job.tree import Entry, Items, Keys, Node, Scalar, keys_of
from zlmreport.job.validate import validate

#: Returns the writer of an identifier that is named at a place; raises `InputError` if there is none.
Find: TypeAlias = Callable[[str, Place | None], InstalledProgram]


def program_choices(
    listed: Node | None, find: Find, problems: list[Problem], *, within: str
) -> tuple[ProgramChoice, ...]:
    """Return the programs of a list.

    Parameters
    ----------
    listed
        The list; anything else has been refused before, and gives none.
    find
        Finds the installed writers of their kind.
    problems
        Where mistakes are added: two that would write the same file among them.
    within
        The dotted path of the list, for messages.
    """
    items = listed.items if isinstance(listed, Items) else ()
    choices = tuple(_choices(items, find, problems, within))
    problems.extend(_clashes(choices, find))
    return choices


def _choices(
    items: Sequence[Node], find: Find, problems: list[Problem], within: str
) -> Iterator[ProgramChoice]:
    for item in items:
        keys = item if isinstance(item, Keys) else keys_of(item.place, (Entry("program", item.place, item),))
        named = keys.entries.get("program")
        if named is None or not isinstance(named.value, Scalar) or named.value.is_nothing:
            continue
        place = named.value.place
        try:
            program = find(named.value.text, place)
        except InputError as error:
            problems.extend(error.problems)
            continue
        own = replace(keys.without("program"), place=place)
        options = validate(program.options, own, problems, within=within, also_known=["program"])
        if options:
            yield ProgramChoice(program.identifier, options, place)


def _clashes(choices: Sequence[ProgramChoice], find: Find) -> Iterator[Problem]:
    """Yield programs whose file would be that of one before them."""
    by_suffix: dict[str, str] = {}
    for choice in choices:
        suffix = find(choice.identifier, None).suffix
        other = by_suffix.get(suffix)
        if other is not None:
            clash = (
                f"{other} is listed twice"
                if other == choice.identifier
                else f"{other} and {choice.identifier} both write {suffix} files"
            )
            yield Problem(choice.place, f"{clash}; remove one of them")
        by_suffix[suffix] = choice.identifier


def programs_by_name(
    names: Sequence[str], named_at: Place, stated: Sequence[ProgramChoice], find: Find
) -> tuple[ProgramChoice, ...]:
    """Return programs that somebody names instead of those of a job, with the keys that it states.

    Parameters
    ----------
    names
        Identifiers of installed writers.
    named_at
        Where they are named.
    stated
        Those of the job.
    find
        Finds the installed writers of their kind.

    Raises
    ------
    InputError
        For each that no plugin provides, and each that would write the same file as one before it.
    """
    problems: list[Problem] = []
    of_job = {choice.identifier: choice for choice in stated}
    items = [Scalar(named_at, name) for name in names]
    choices = [
        of_job[item.text] if item.text in of_job else next(_choices([item], find, problems, ""), None)
        for item in items
    ]
    found = tuple(choice for choice in choices if choice)
    problems.extend(_clashes([replace(choice, place=named_at) for choice in found], find))
    if problems:
        raise InputError(problems)
    return found
