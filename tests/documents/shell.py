"""A shell that keeps its folder and its last exit status from one command to the next."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Self

_MARK = "\x1e"


class Shell:
    """A bash in a folder, in which the project's commands are found."""

    def __init__(self, folder: Path) -> None:
        self._process = subprocess.Popen(
            ["bash", "--noprofile", "--norc"],
            cwd=folder,
            env={
                **os.environ,
                "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
                "COLUMNS": "80",
                "NO_COLOR": "1",
                "LC_ALL": "C.UTF-8",
                # WeasyPrint leaves a colour profile open.
                "PYTHONWARNINGS": "error,ignore::ResourceWarning",
            },
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            encoding="utf-8",
            start_new_session=True,
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        with suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGTERM)  # what runs in the background, too
        self._process.communicate()

    def run(self, command: str) -> tuple[str, int]:
        """Return what a command prints, errors included, and its exit status."""
        whole = (
            subprocess.run(["bash", "-n", "-c", command], capture_output=True, check=False).returncode == 0
        )
        assert whole, f"a shell would wait for the rest of {command!r}"
        assert self._process.stdin
        assert self._process.stdout
        self._process.stdin.write(
            f"{command}\n__status=$?; printf '{_MARK}%s {_MARK}\\n' \"$__status\"; (exit $__status)\n"
        )
        self._process.stdin.flush()
        printed = ""
        while not printed.endswith(f" {_MARK}\n"):
            line = self._process.stdout.readline()
            assert line, f"the shell ended after {command!r}: {printed}"
            printed += line
        output, status, _ = printed.rsplit(_MARK, 2)
        return output, int(status)
