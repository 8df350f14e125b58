r"""Probing programs as commands of I++ DME 1.4.3, for an executive that sends files of commands.

Lines end with CR LF, and ``\\`` parts the commands; ``:`` twice is the end. It is the layout of the command
files of NIST's test suite for I++ DME. A machine on the network needs no file: see ``zlmreport capture``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from pydantic import Field

from zlmreport.errors import InputError
from zlmreport.job.machine_keys import TOOL
from zlmreport.job.types import Options
from zlmreport.language import Words
from zlmreport.plugin import hookimpl
from zlmreport.plugin.protocols import ProbingProgram
from zlmreport.step_gauge.dme_commands import beginning, command
from zlmreport.step_gauge.path import ProbingPath

_LAST_TAG = 99999
_STEP = 10


class IppDmeOptions(Options):
    """The keys of ``ippdme``."""

    tool: str = Field("RefTool", pattern=TOOL, description="Name of the tool, as the machine knows it.")


class IppDme:
    """I++ DME."""

    identifier = "ippdme"
    title = Words(en="I++ DME commands", de="I++-DME-Befehle")
    suffix = ".prg"
    options: Any = IppDmeOptions

    def write(self, path: ProbingPath, options: Any) -> str:
        """Return the program."""
        commands = [*beginning(path, options.tool), *map(command, path.moves)]
        if len(commands) >= _LAST_TAG:
            raise InputError.at(
                path.place, f"{len(commands)} commands are more than can be numbered; state fewer cycles"
            )
        return "".join(f"{line}\r\n" for line in _lines(commands))


def _lines(commands: list[str]) -> Iterator[str]:
    step = _STEP if _STEP * len(commands) < _LAST_TAG else 1
    for number, text in enumerate(commands, start=1):
        yield f"{number * step:05d} {text}"
        yield "\\\\"
    yield f"{_LAST_TAG:05d} EndSession()"
    yield "\\\\"
    yield ":"
    yield ":"


@hookimpl
def zlmreport_probing_programs() -> Iterable[ProbingProgram]:
    """Return the writer."""
    return [IppDme()]
