"""Runs this program in a process of its own, as who works on a page asks for it."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

#: What is said of a command that told nothing of its end.
ENDED = "zlmreport ended unexpectedly"
_AS_IT_IS: Mapping[str, str] = MappingProxyType({})


def start_command(
    *arguments: str, plugins: Sequence[Path], stdin: int | None = None
) -> subprocess.Popen[str]:
    """Start a command of this program; what it prints and what it complains of can be read.

    `arguments`: As on the terminal.
    `plugins`: Files that are plugins, from the command line of the server.
    `stdin`: `subprocess.PIPE` for one that is spoken to.
    """
    options = (part for each in plugins for part in ("--plugin", str(each.resolve())))
    return start_module("zlmreport", *arguments, *options, stdin=stdin, stderr=subprocess.PIPE)


def start_module(
    module: str,
    *arguments: str,
    stdin: int | None = None,
    stderr: int | None = None,
    environment: Mapping[str, str] = _AS_IT_IS,
) -> subprocess.Popen[str]:
    """Start a module of this program as a program; what it prints can be read.

    `environment`: What is other than in that of the server.
    """
    return subprocess.Popen(  # noqa: S603 - this program itself
        [sys.executable, "-m", module, *arguments],
        stdin=stdin,
        stdout=subprocess.PIPE,
        stderr=stderr,
        encoding="utf-8",
        start_new_session=True,  # Ctrl-C on the terminal is for the server, which ends this one
        env={**os.environ, "PYTHONIOENCODING": "utf-8", **environment},
    )
