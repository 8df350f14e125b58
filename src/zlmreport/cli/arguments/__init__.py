"""The list of all commands, the overview without one, and what is said of a command that there is not."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from zlmreport.cli.arguments import documents, measuring
from zlmreport.cli.arguments.documents import main_job
from zlmreport.cli.arguments.parser import CommandParser
from zlmreport.errors import InputError, Place, did_you_mean

#: The job's own name, for it has no word of its own on the command line.
MAIN_JOB = "report"
#: The module that runs the commands of extensions.
EXTENSION = "extension"

#: Each command: what it does, in a line, and what makes its parser.
COMMANDS: Mapping[str, tuple[str, Callable[[str], CommandParser]]] = {
    "capture": ("take the readings live, from the instrument that a job names", measuring.capture),
    "check": ("validate jobs, their data and the tests; write nothing", documents.check),
    "compensate": (
        "write a compensation table for a control, and say what it will leave",
        measuring.compensate,
    ),
    "emulate": ("put an instrument that is not there on a line, to try capture", measuring.emulate),
    "fleet": ("make the certificates of many machines that are due, every night", documents.fleet),
    "fleet backup": ("copy the ledger of a fleet into one file", documents.fleet_backup),
    "fleet rebuild": ("make the ledger of a fleet again from its certificates", documents.fleet_rebuild),
    "fleet report": ("write the overview of a fleet: who fails, who drifts", documents.fleet_report),
    "init": ("write a commented job with sample data that runs as it is", documents.init),
    "look": ("say what a file of measurements holds, and the keys that read it", documents.look),
    "machine": ("hold a machine against its tests: what its axes predict, what they lack", documents.machine),
    "model": ("fit a job's error model, find what it lacks, add it, watch the error fall", documents.model),
    "new": ("write a plugin to begin with, and its conformance test", documents.new),
    "plan": ("choose targets and their sequence, and say what such a test will not see", measuring.plan),
    "plugins": ("list the plugins found, and why one failed to load", documents.plugins),
    "schema": ("print the JSON Schema of the job file, for editors", documents.schema),
    "simulate": ("write simulated readings of a described axis, and a job for them", measuring.simulate),
    "surface": ("fit the deviation over a plane, from lines that were measured in it", documents.surface),
    "verify": (
        "evaluate a certificate again from what it carries, and say whether it holds",
        documents.verify,
    ),
    "workbench": ("work on a job's error model with a mouse, on a page in the browser", documents.workbench),
}


#: What somebody wants, and the command for it: for those who typed none.
_WANTED = (
    ("init first", "a job with sample data, to begin with"),
    ("init --from FILE first", "a job that reads your own table"),
    ("JOB.yaml", "its certificate"),
    ("model build JOB.yaml", "what causes the deviations"),
    ("workbench JOB.yaml", "the same with a mouse, in the browser"),
    ("machine diagnose MACHINE.yaml", "what a circle says of the axes"),
    ("compensate JOB.yaml", "a table that takes them away"),
    ("verify FILE.pdf", "whether a certificate holds"),
    ("fleet FLEET.yaml", "certificates of many machines"),
    ("--help", "all commands"),
)


def make_parsers() -> tuple[CommandParser, ...]:
    """Return the parser of the main job, and then of every command."""
    return tuple(make_parser_for(command) for command in ("", *COMMANDS))


def make_parser_for(command: str) -> CommandParser:
    """Return the parser of a command; of the main job, which has no word of its own, for an empty one."""
    if command:
        return COMMANDS[command][1](command)
    return main_job({command: summary for command, (summary, _) in COMMANDS.items()})


def parse(arguments: Sequence[str]) -> tuple[str, argparse.Namespace]:
    """Return the command with its options.

    Raises `InputError` if there is no such command or option, with the nearest that there is; `SystemExit`
    after ``--help`` and ``--version`` have been printed.
    """
    if not arguments:
        raise InputError.at(Place("zlmreport"), _show_overview())
    words = 2 if " ".join(arguments[:2]) in COMMANDS else 1
    if _is_perhaps_of_an_extension(arguments):
        from zlmreport.cli.extension import find_command_of_extension, make_parser_of

        own = find_command_of_extension(arguments)
        if own:
            return EXTENSION, make_parser_of(own[0]).parse_strictly(arguments[own[1] :])
    command, rest = " ".join(arguments[:words]), arguments[words:]
    if command in COMMANDS:
        _refuse_mistaken_second_word(command, rest)
        parser = make_parser_for(command)
        options = parser.parse_strictly(rest)
        if command in {"model", "machine"}:
            documents.demand_action(command, options, parser)
        return command, options
    options = make_parser_for("").parse_strictly(arguments)
    for job in options.jobs:
        _refuse_mistaken_command(job)
    return MAIN_JOB, options


def _show_overview() -> str:
    wide = max(len(command) for command, _ in _WANTED)
    lines = (f"  zlmreport {command:{wide}}  {result}" for command, result in _WANTED)
    return "\n".join(("name a job, or say what you want:", *lines))


def _is_perhaps_of_an_extension(arguments: Sequence[str]) -> bool:
    """Return whether only the plugins can tell if arguments begin with a command of an extension.

    It is a word that is no command, option or file, or a device behind `emulate`.
    """
    first, *rest = (*arguments[:2], "")
    if first == "emulate":
        return bool(rest[0]) and not rest[0].startswith("-")
    word = Path(first)
    return bool(first) and first not in COMMANDS and first.isidentifier() and not word.exists()


def _refuse_mistaken_second_word(command: str, rest: Sequence[str]) -> None:
    """Take a word behind a command that is no file for a second word that there is not."""
    seconds = [each.removeprefix(f"{command} ") for each in COMMANDS if each.startswith(f"{command} ")]
    word = rest[0] if rest else ""
    if seconds and word.isidentifier() and not Path(word).exists():
        raise InputError.at(
            Place(f"zlmreport {command}"),
            f"{word!r} is neither a file nor a command; {did_you_mean(word, seconds)}",
        )


def _refuse_mistaken_command(job: Path) -> None:
    """Take a word that is no file for a command that there is not."""
    word = str(job)
    if job.suffix or job.name != word or job.exists():
        return
    if word in COMMANDS:
        raise InputError.at(Place("zlmreport"), f"the command comes first: zlmreport {word} …")
    raise InputError.at(
        Place("zlmreport"), f"{word!r} is neither a file nor a command; {did_you_mean(word, list(COMMANDS))}"
    )
