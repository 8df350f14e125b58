"""A PostgreSQL server of the test's own, where its programs are installed."""

from __future__ import annotations

import contextlib
import os
import pwd
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest


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

        def run(*command: str | Path) -> None:
            subprocess.run(
                command,
                check=True,
                user=user,
                cwd=folder,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )

        run(programs / "initdb", "--no-sync", "-U", "zlmreport", "-A", "trust", "-D", data)
        options = f"-k {folder} -c listen_addresses='' -c fsync=off"
        run(programs / "pg_ctl", "-w", "-D", data, "-o", options, "-l", folder / "log", "start")
        try:
            yield f"postgresql+psycopg://zlmreport@/postgres?host={folder}"
        finally:
            run(programs / "pg_ctl", "-w", "-D", data, "-m", "immediate", "stop")
    finally:
        shutil.rmtree(folder, ignore_errors=True)
