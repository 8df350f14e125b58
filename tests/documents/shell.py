"""A shell that keeps its folder and its last exit status from one command to the next."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import processes

_MARK = "\x1e"


VARIABLES = {
    "COLUMNS": "80",
    "NO_COLOR": "1",
    "LC_ALL": "C.UTF-8",
    # WeasyPrint leaves a colour profile open.
    "PYTHONWARNINGS": "error,ignore::ResourceWarning",
}


@contextmanager
def shell(folder: Path, *commands: Path) -> Iterator[Shell]:
    """Start a bash in a folder; what it has started in the background ends with it, too.

    Commands are found in the folders that are given, then in the environment.
    """
    found = [*map(str, commands), str(Path(sys.executable).parent), os.environ["PATH"]]
    variables = {**VARIABLES, "PATH": os.pathsep.join(found)}
    with processes.started(
        *("bash", "--noprofile", "--norc"),
        cwd=folder,
        env=os.environ | variables,
        stdin=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    ) as program:
        yield Shell(program)


class Shell:
    """A bash in which the project's commands are found."""

    def __init__(self, program: processes.Program) -> None:
        self._program = program

    def run(self, command: str) -> tuple[str, int]:
        """Return what a command prints, errors included, and its exit status."""
        whole = processes.run("bash", "-n", "-c", command).returncode == 0
        assert whole, f"a shell would wait for the rest of {command!r}"
        stdin = self._program.process.stdin
        assert stdin
        typed = f"{command}\n__status=$?; printf '{_MARK}%s {_MARK}' \"$__status\"; (exit $__status)\n"
        stdin.write(typed.encode())
        stdin.flush()
        printed = self._program.until(_MARK)
        return printed, int(self._program.until(_MARK))
