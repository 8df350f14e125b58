"""The parsers of commands that extensions bring."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from zlmreport.cli.arguments.measuring import add_line
from zlmreport.cli.arguments.parser import CommandParser
from zlmreport.plugin.extension import Command
from zlmreport.plugins import find_plugins

#: The first word of commands that put a device on a line.
_EMULATE = "emulate"


def command_of_extension(arguments: Sequence[str]) -> tuple[Command, int] | None:
    """Return the command of an extension that stands first, and its number of words; None if none does."""
    known, _ = _PLUGIN_FILES.parse_known_args(arguments)
    registry = find_plugins(files=known.plugin)
    commands = {each.words: each for extension in registry.extensions for each in extension.commands}
    for words in (2, 1):
        found = commands.get(" ".join(arguments[:words]))
        if found:
            return found, words
    return None


def parser_of(command: Command) -> CommandParser:
    """Return the parser of a command."""
    parser = CommandParser(f"zlmreport {command.words}", command.description, command.examples)
    for option in command.options:
        settings: dict[str, Any] = {
            "metavar": option.metavar,
            "help": option.help,
            "type": _typed(option.read),
        }
        if option.several:
            parser.add_argument(f"--{option.name}", action="append", default=[], **settings)
        else:
            parser.add_argument(f"--{option.name}", default=option.without, **settings)
    if command.words.startswith(f"{_EMULATE} "):
        add_line(parser, with_link=False)
    parser.set_defaults(command=command, link=None)
    return parser


def _typed(read: Callable[[str], Any]) -> Callable[[str], Any]:
    def typed(text: str) -> Any:
        try:
            return read(text)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from error

    return typed


_PLUGIN_FILES = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
_PLUGIN_FILES.add_argument("--plugin", type=Path, action="append", default=[])
