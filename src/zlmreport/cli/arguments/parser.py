"""A parser of one command, whose errors are problems like all others."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn

from zlmreport.errors import InputError, Place, did_you_mean

JSON_HELP = "print a machine-readable summary (zlmreport/summary/1) instead of tables"


class CommandParser(argparse.ArgumentParser):
    """A parser whose errors are problems like all others, and name the nearest option."""

    def __init__(self, program: str, description: str, epilog: str = "") -> None:
        super().__init__(
            program,
            description=description,
            epilog=epilog,
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
        )
        self._known = ["--help"]
        self.add_argument(
            "--plugin",
            metavar="FILE",
            type=Path,
            action="append",
            default=[],
            help="a plugin in a file of its own, beside the installed ones; may be given several times",
        )

    def add_argument(self, *names: Any, **settings: Any) -> argparse.Action:
        """Add an argument, and remember its long names."""
        action = super().add_argument(*names, **settings)
        if hasattr(self, "_known"):
            self._known.extend(name for name in names if name.startswith("--"))
        return action

    def parse_strictly(self, arguments: Sequence[str]) -> argparse.Namespace:
        """Return the options; raise `InputError` for one that there is not, with the nearest."""
        options, unknown = self.parse_known_args(arguments)
        if unknown:
            name = unknown[0].partition("=")[0]
            if name.startswith("-"):
                self.error(f"unknown option {name!r}; {did_you_mean(name, self._known)}")
            self.error(f"{name!r} is one argument too many")
        return options

    def error(self, message: str) -> NoReturn:
        """Raise what argparse complains of as a problem of the command line."""
        raise InputError.at(Place(self.prog), f"{message} (see {self.prog} --help)")


def add_jobs(parser: CommandParser) -> None:
    """Let a command take one job file or several."""
    parser.add_argument("jobs", metavar="JOB.yaml", nargs="+", type=Path, help="job files")
