"""Runs the workbench until Ctrl-C."""

from __future__ import annotations

import socket
import webbrowser
from collections.abc import Callable

import uvicorn

from zlmreport.errors import AccessError, Place
from zlmreport.web.app import Workbench
from zlmreport.web.guard import HOST, Door


def serve(workbench: Workbench, port: int, ready: Callable[[str], None], *, open_browser: bool) -> None:
    """Listen on the loopback address until the user ends it.

    Parameters
    ----------
    workbench
        What answers.
    port
        On which; 0 for any free one.
    ready
        Is told the address as soon as somebody may open it.
    open_browser
        Whether to open it at once.
    """
    with _listening(port) as listener:
        door = Door.at(listener.getsockname()[1])
        server = uvicorn.Server(uvicorn.Config(workbench.app(door), log_level="warning", access_log=False))
        workbench.diagnoses.warm_up()
        ready(door.address)  # the socket listens already: who comes early waits
        if open_browser:
            webbrowser.open(door.address)
        try:
            server.run(sockets=[listener])
        finally:
            workbench.diagnoses.end()
            workbench.certificates.end()


def _listening(port: int) -> socket.socket:
    """Return a socket on the loopback address, and on no other."""
    listener = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((HOST, port))
        listener.listen()
    except OSError as error:
        listener.close()
        reason = (error.strerror or str(error)).lower()
        raise AccessError.at(
            Place("zlmreport workbench"), f"port {port} cannot be used: {reason}; choose another with --port"
        ) from error
    return listener
