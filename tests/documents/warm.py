"""The command line in processes that need not import it: one process imports all, and forks for each command.

What the pages show are hundreds of commands, and most of what each takes is its imports. The command
``zlmreport`` that `warm_command` puts into a folder hands its arguments, folder, variables and streams to
that process, passes signals on, and ends as the command ends.
"""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import pkgutil
import select
import shlex
import signal
import socket
import struct
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

_ASKS = """\
import json, os, signal, socket, sys
server = socket.socket(socket.AF_UNIX)
server.connect(sys.argv[1])
for number in (signal.SIGTERM, signal.SIGINT):
    signal.signal(number, lambda number, _: server.sendall(bytes([number])))
asked = json.dumps([sys.argv[2:], os.getcwd(), dict(os.environ)]).encode()
socket.send_fds(server, [len(asked).to_bytes(8, "big")], [0, 1, 2])
server.sendall(asked)
status = int.from_bytes(server.recv(4), "big", signed=True)
if status < 0:
    signal.signal(-status, signal.SIG_DFL)
    os.kill(os.getpid(), -status)
sys.exit(status)
"""


def write_command(folder: Path, address: Path) -> None:
    """Write a command ``zlmreport`` that asks the process at an address."""
    asks = folder / "asks.py"
    asks.write_text(_ASKS, encoding="utf-8")
    command = folder / "zlmreport"
    line = shlex.join([sys.executable, "-IS", str(asks), str(address)])
    command.write_text(f'#!/bin/sh\nexec {line} "$@"\n', encoding="utf-8")
    command.chmod(0o755)


def serve(address: str) -> None:
    """Import the project, say so, and answer commands until killed."""
    for package in ("zlmreport", "zlmreport_plugins"):
        for module in pkgutil.walk_packages(importlib.import_module(package).__path__, f"{package}."):
            if not module.name.endswith(".__main__"):
                with contextlib.suppress(ImportError):  # of an extra
                    importlib.import_module(module.name)
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(address)
        server.listen(100)
        sys.stdout.write("ready\n")
        sys.stdout.flush()
        while True:
            caller, _ = server.accept()
            if os.fork():
                caller.close()
            else:
                server.close()
                signal.signal(signal.SIGCHLD, signal.SIG_DFL)
                _answer(caller)
                return


def _answer(caller: socket.socket) -> None:
    """Do what a caller asks in a process of its own; tell how it ended; end it when the caller is gone."""
    head, streams, _, _ = socket.recv_fds(caller, 8, 3)
    asked = b""
    while len(asked) < int.from_bytes(head, "big"):
        asked += caller.recv(65536)
    child = os.fork()
    if not child:
        caller.close()
        _command(streams, *json.loads(asked))
    for stream in streams:
        os.close(stream)
    ended = os.pidfd_open(child)
    while ended not in (ready := select.select([caller, ended], [], [])[0]):
        signals = caller.recv(1) if ready else b""
        os.kill(child, signals[0] if signals else signal.SIGKILL)
        if not signals:
            break
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    with contextlib.suppress(OSError):  # the caller is gone
        caller.sendall(struct.pack("!i", status))
    os._exit(0)


def _command(streams: list[int], arguments: list[str], folder: str, variables: dict[str, str]) -> None:
    for number, stream in enumerate(streams):
        os.dup2(stream, number)
        os.close(stream)
    sys.stdin = os.fdopen(0, encoding="utf-8", closefd=False)
    sys.stdout = os.fdopen(1, "w", encoding="utf-8", closefd=False)
    sys.stderr = os.fdopen(2, "w", encoding="utf-8", errors="backslashreplace", closefd=False)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(variables)
    time.tzset()
    sys.argv = ["zlmreport", *arguments]
    from zlmreport.cli import main

    sys.exit(main())


@contextlib.contextmanager
def warm_command(folder: Path, **settings: Any) -> Iterator[Path]:
    """Yield a folder with the command."""
    import processes

    address = folder / "s"
    write_command(folder, address)
    with processes.started(processes.PYTHON, __file__, address, **settings) as server:
        server.until("ready")
        yield folder


if __name__ == "__main__":
    serve(sys.argv[1])
