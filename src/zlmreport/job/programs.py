"""The part programs that a job names, each with its own keys."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from zlmreport.errors import InputError, Place, Problem
from zlmreport.job.installed import Installed
from zlmreport.job.job import ProgramChoice
from zlmreport.job.tree import Entry, Items, Keys, Node, Scalar, keys_of
from zlmreport.job.validate import validate


def program_choices(
    listed: Node | None, registry: Installed, problems: list[Problem], *, within: str
) -> tuple[ProgramChoice, ...]:
    """Return the part programs of a list.

    Parameters
    ----------
    listed
        The list; anything else has been refused before, and gives none.
    registry
        The installed plugins.
    problems
        Where mistakes are added: two that would write the same file among them.
    within
        The dotted path of the list, for messages.
    """
    items = listed.items if isinstance(listed, Items) else ()
    choices = tuple(_choices(items, registry, problems, within))
    problems.extend(_clashes(choices, registry))
    return choices


def _choices(
    items: Sequence[Node], registry: Installed, problems: list[Problem], within: str
) -> Iterator[ProgramChoice]:
    for item in items:
        keys = item if isinstance(item, Keys) else keys_of(item.place, (Entry("program", item.place, item),))
        named = keys.entries.get("program")
        if named is None or not isinstance(named.value, Scalar) or named.value.is_nothing:
            continue
        place = named.value.place
        try:
            program = registry.part_program(named.value.text, place)
        except InputError as error:
            problems.extend(error.problems)
            continue
        own = replace(keys.without("program"), place=place)
        options = validate(program.options, own, problems, within=within, also_known=["program"])
        if options:
            yield ProgramChoice(program.identifier, options, place)


def _clashes(choices: Sequence[ProgramChoice], registry: Installed) -> Iterator[Problem]:
    """Yield part programs whose file would be that of one before them."""
    by_suffix: dict[str, str] = {}
    for choice in choices:
        suffix = registry.part_program(choice.identifier).suffix
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
    names: Sequence[str], named_at: Place, stated: Sequence[ProgramChoice], registry: Installed
) -> tuple[ProgramChoice, ...]:
    """Return part programs that somebody names instead of those of a job, with the keys that it states.

    Parameters
    ----------
    names
        Identifiers of installed writers of part programs.
    named_at
        Where they are named.
    stated
        Those of the job.
    registry
        The installed plugins.

    Raises
    ------
    InputError
        For each that no plugin provides, and each that would write the same file as one before it.
    """
    problems: list[Problem] = []
    of_job = {choice.identifier: choice for choice in stated}
    items = [Scalar(named_at, name) for name in names]
    choices = [
        of_job[item.text] if item.text in of_job else next(_choices([item], registry, problems, ""), None)
        for item in items
    ]
    found = tuple(choice for choice in choices if choice)
    problems.extend(_clashes([replace(choice, place=named_at) for choice in found], registry))
    if problems:
        raise InputError(problems)
    return found
