"""The commands that extensions bring."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from zlmreport.cli.emulate import put_on_line
from zlmreport.emulation.emulator import Emulator
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.plugin.extension import Command
from zlmreport.plugins import find_plugins


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
