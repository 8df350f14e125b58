"""The command line in processes that need not import it: one process imports all, and forks for each command.

What the pages show are hundreds of commands, and most of what each takes is its imports. The command
``zlmreport`` that `warm_command` puts into a folder hands its arguments, folder, variables and streams to
that process, passes signals on, and ends as the command ends.
"""

from __future__ import annotations

import atexit
import contextlib
import gc
import importlib
import json
import os
import pkgutil
import select
import shlex
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
import traceback
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
#: Ends when the process that holds its other end does, however that is.
_LIFELINE = 0


def write_command(folder: Path, address: Path) -> None:
    """Write a command ``zlmreport`` that asks the process at an address."""
    asks = folder / "asks.py"
    asks.write_text(_ASKS, encoding="utf-8")
    command = folder / "zlmreport"
    line = shlex.join([sys.executable, "-IS", str(asks), str(address)])
    command.write_text(f'#!/bin/sh\nexec {line} "$@"\n', encoding="utf-8")
    command.chmod(0o755)


def serve(address: str, *packages: str) -> None:
    """Import packages, say so, and answer commands until whoever started it is gone: stdin ends with it."""
    for package in packages:
        for module in pkgutil.walk_packages(importlib.import_module(package).__path__, f"{package}."):
            if not module.name.endswith(".__main__"):
                with contextlib.suppress(ImportError):  # of an extra
                    importlib.import_module(module.name)
    gc.collect()
    gc.freeze()  # a collection in a fork would copy every page of what is loaded here
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(address)
        server.listen(100)
        sys.stdout.write("ready\n")
        sys.stdout.flush()
        while server in select.select([server, _LIFELINE], [], [])[0]:
            caller, _ = server.accept()
            if os.fork():
                caller.close()
            else:
                server.close()
                signal.signal(signal.SIGCHLD, signal.SIG_DFL)
                _answer(caller)
                return


def _answer(caller: socket.socket) -> None:
    """Do what a caller asks in a process of its own; tell how it ended; end it with its caller."""
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
    while ended not in (ready := select.select([caller, ended, _LIFELINE], [], [])[0]):
        signals = b"" if _LIFELINE in ready else caller.recv(1)
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
    status = 1
    try:
        from zlmreport.cli import main

        status = main()
    except Exception:  # noqa: BLE001  # shown, as Python would
        traceback.print_exc()
    finally:  # the interpreter's own end would take all apart that is loaded: a second
        threading._shutdown()  # type: ignore[attr-defined]
        atexit._run_exitfuncs()
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)


@contextlib.contextmanager
def warm_command(folder: Path, **settings: Any) -> Iterator[Path]:
    """Yield a folder with the command."""
    with warm_server(folder, "zlmreport", "zlmreport_plugins", **settings):
        yield folder


@contextlib.contextmanager
def warm_server(folder: Path, *packages: str, **settings: Any) -> Iterator[Any]:
    """Yield the process behind the command that is written into a folder."""
    import processes

    address = folder / "s"
    write_command(folder, address)
    command = (processes.PYTHON, __file__, address, *packages)
    with processes.started(*command, stdin=subprocess.PIPE, **settings) as server:
        server.until("ready")
        yield server.process


if __name__ == "__main__":
    serve(*sys.argv[1:])
