"""What every group of job keys that a plugin adds must do."""

from __future__ import annotations

from zlmreport.job.choices import group_model
from zlmreport.job.keys import JobKeys
from zlmreport.job.tree import Step
from zlmreport.job.types import find_model_at, list_keys_in
from zlmreport.plugin.extending import Extension
from zlmreport.plugin.kinds import EXTENSION
from zlmreport.testing.expectations import (
    check,
    expect,
    expect_members,
    expect_options,
    expect_words,
    list_checks_of,
    run_all,
)


@check
def is_named(extension: Extension) -> None:
    """Check that its identifier is a key that a job can have and the core has not, and its title."""
    expect_members(extension, EXTENSION)
    name = extension.identifier
    expect(
        name.isidentifier() and name.islower(),
        f"extension {name!r}: the identifier is a job key: lower-case ASCII letters, digits and '_'",
    )
    expect(name not in list_keys_in(JobKeys), f"extension {name!r}: the job has this key itself")
    expect_words(extension.title, f"{name}: title")
    expect(extension.description.strip(), f"{name}: description says nothing")


@check
def keys_are_described(extension: Extension) -> None:
    """Check that its keys are described, and that its example uses no others."""
    expect_options(extension, EXTENSION)
    unknown = sorted(extension.example.keys() - list_keys_in(extension.options).keys())
    expect(not unknown, f"{extension.identifier}: the example has the unknown keys {', '.join(unknown)}")


@check
def lists_part_programs_where_it_says(extension: Extension) -> None:
    """Check that the keys which list part programs are there, and that it says what these are written of."""
    if not extension.programs:
        return
    path: tuple[Step, ...] = (extension.identifier, *extension.programs, 0)
    where = f"{extension.identifier}: {'.'.join(extension.programs)}"
    item = find_model_at(group_model(extension), path)
    expect(item and "program" in list_keys_in(item), f"{where} is no list of part programs")
    expect(extension.takes, f"{where} lists part programs, and takes says not what they are written of")


@check
def commands_are_described(extension: Extension) -> None:
    """Check that its commands and their options have a help, and that each option is there once."""
    for command in extension.commands:
        expect(command.description.strip(), f"command {command.words!r} has no description")
        names = [option.name for option in command.options]
        twice = sorted({name for name in names if names.count(name) > 1})
        expect(not twice, f"command {command.words!r} has the option --{twice[:1]} twice")
        silent = [option.name for option in command.options if not option.help.strip()]
        expect(not silent, f"command {command.words!r}: --{', --'.join(silent)} has no help")


#: Every check of an extension, each called with it.
EXTENSION_CHECKS = list_checks_of(__name__)


def check_extension(extension: Extension) -> None:
    """Run every check on an extension; raise `AssertionError` with a line for every check that fails."""
    run_all(EXTENSION, EXTENSION_CHECKS, extension)
