"""A PostgreSQL server of the test's own, where its programs are installed."""

from __future__ import annotations

import contextlib
import os
import pwd
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from typing import Any

import pytest

from processes import run, started


def _programs() -> Path | None:
    """Return the folder of the newest server's programs; None if there is none."""
    found = sorted(Path("/usr/lib/postgresql").glob("*/bin/initdb"), key=lambda path: int(path.parts[-3]))
    return found[-1].parent if found else None


@contextlib.contextmanager
def server() -> Iterator[str]:
    """Run a server that listens on a socket in a folder, and yield the URL of an empty database.

    A server refuses to be root: then it is the user postgres, who comes with its package.
    """
    programs = _programs()
    if programs is None:
        pytest.skip("PostgreSQL is not installed")
    user = "postgres" if os.geteuid() == 0 else None
    if user and not any(each.pw_name == user for each in pwd.getpwall()):
        pytest.skip("there is no user postgres, and the server refuses to be root")
    folder = Path(tempfile.mkdtemp(prefix="zlmreport-pg-", dir="/tmp"))  # a socket's path is short
    try:
        if user:
            shutil.chown(folder, user)
        data = folder / "data"
        whose: dict[str, Any] = {"user": user, "cwd": folder}
        init = (programs / "initdb", "--no-sync", "-U", "zlmreport", "-A", "trust", "-D", data)
        run(*init, check=True, **whose)
        settings = (f"unix_socket_directories={folder}", "listen_addresses=", "fsync=off")
        options = chain.from_iterable(("-c", setting) for setting in (*settings, "log_min_messages=log"))
        serve = (programs / "postgres", "-D", data, *options)
        with started(*serve, stderr=subprocess.STDOUT, **whose) as running:
            running.until("ready to accept connections")
            yield f"postgresql+psycopg://zlmreport@/postgres?host={folder}"
            running.ended(signal.SIGINT)  # at once, and nothing of it stays in memory
    finally:
        shutil.rmtree(folder, ignore_errors=True)
