"""Runs the commands that large plugins (extensions) bring."""

from __future__ import annotations

import argparse
from argparse import Namespace
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from zlmreport.cli.arguments.measuring import add_line
from zlmreport.cli.arguments.parser import CommandParser
from zlmreport.cli.emulate import put_on_line
from zlmreport.job.job import Job
from zlmreport.live.emulation.emulator import Emulator
from zlmreport.plugin.extending import Command
from zlmreport.plugin.registry import find_plugins

#: The first word of commands that put a device on a line.
_EMULATE = "emulate"


_PLUGIN_FILES = argparse.ArgumentParser(add_help=False, allow_abbrev=False)


def run(options: Namespace) -> int:
    """Run the command that the parser has found among those of the extensions."""
    command: Command = options.command
    values = {each.name: getattr(options, each.name.replace("-", "_")) for each in command.options}
    return command.run(values, _Host(options))


@dataclass(frozen=True, slots=True)
class _Host:
    """What a command may ask of the command line."""

    options: Namespace

    def load(self, path: Path) -> Job:
        from zlmreport.job.loading import load  # noqa: PLC0415 - a parser of arguments reads no job

        return load(path, find_plugins(files=self.options.plugin))

    def say(self, line: str) -> None:
        print(line, flush=True)

    def serve(
        self, emulator: Emulator, standard_port: int, announced: Iterable[str], is_gone: Callable[[], bool]
    ) -> int:
        if self.options.port is None:
            self.options.port = standard_port
        lines = tuple(announced)

        def beat() -> None:
            if is_gone():
                raise _CutError

        def announce(address: str) -> tuple[str, ...]:
            return tuple(line.format(address=address) for line in lines)

        try:
            return put_on_line(emulator, self.options, announce, beat)
        except _CutError:
            print("the connection is cut")
            return 0


class _CutError(Exception):
    """A planned fault has cut the connection."""


def find_command_of_extension(arguments: Sequence[str]) -> tuple[Command, int] | None:
    """Return the command of an extension that stands first, and its number of words; None if none does."""
    known, _ = _PLUGIN_FILES.parse_known_args(arguments)
    registry = find_plugins(files=known.plugin)
    commands = {each.words: each for extension in registry.extensions for each in extension.commands}
    for words in (2, 1):
        found = commands.get(" ".join(arguments[:words]))
        if found:
            return found, words
    return None


def make_parser_of(command: Command) -> CommandParser:
    """Return the parser of a command."""
    parser = CommandParser(command.words, command.description, command.examples)
    for option in command.options:
        settings: dict[str, Any] = {
            "metavar": option.metavar,
            "help": option.help,
            "type": _make_type_of(option.read),
        }
        if option.several:
            parser.add_argument(f"--{option.name}", action="append", default=[], **settings)
        else:
            parser.add_argument(f"--{option.name}", default=option.without, **settings)
    if command.words.startswith(f"{_EMULATE} "):
        add_line(parser, with_link=False)
    parser.set_defaults(command=command, link=None)
    return parser


def _make_type_of(read: Callable[[str], Any]) -> Callable[[str], Any]:
    def read_typed(text: str) -> Any:
        try:
            return read(text)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from error

    return read_typed


_PLUGIN_FILES.add_argument("--plugin", type=Path, action="append", default=[])
