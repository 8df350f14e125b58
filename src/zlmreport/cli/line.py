"""An emulated instrument on a line, for the commands that put one there."""

from __future__ import annotations

import signal
from argparse import Namespace
from collections.abc import Callable, Sequence
from types import FrameType
from typing import NoReturn

from zlmreport.cli.terminal import visible
from zlmreport.emulation.channels import LocalSocket, PseudoTerminal, serve
from zlmreport.emulation.emulator import Emulator, Planned, Trouble, Troubles
from zlmreport.errors import InputError, Place


def refuse_two_lines(options: Namespace, command: str) -> None:
    """Raise `InputError` if the command line names a pseudo-terminal and a TCP port."""
    if options.link is not None and options.port is not None:
        raise InputError.at(Place(command), "--link names a pseudo-terminal, --port a TCP port: take one")


def troubles_of(options: Namespace) -> Troubles:
    """Return what the command line says that goes wrong."""
    return Troubles(tuple(Planned(Trouble(kind), start) for kind, start in options.fault))


def put_on_line(
    emulator: Emulator,
    options: Namespace,
    announce: Callable[[str], Sequence[str]],
    beat: Callable[[], None] = lambda: None,
    heard: Callable[[], None] = lambda: None,
) -> int:
    """Let an emulated instrument speak until it is unplugged, or the user ends it; return the exit code.

    Parameters
    ----------
    emulator
        The instrument.
    options
        Of the command: ``link`` or ``port``, and ``fault``.
    announce
        Returns what is printed once the line is there, from its address.
    beat
        Called many times a second.
    heard
        Called with it from when somebody reads the instrument.
    """
    signal.signal(signal.SIGTERM, _end)
    troubles = troubles_of(options)
    with PseudoTerminal(options.link) if options.port is None else LocalSocket(options.port) as channel:

        def is_over() -> bool:
            if channel.is_read:
                heard()
            beat()
            return False

        try:
            print("\n".join(announce(visible(channel.address))), flush=True)
            serve(emulator, channel, troubles, is_over=is_over)
        except KeyboardInterrupt:
            return 0
    print("unplugged")
    return 0


def _end(_number: int, _frame: FrameType | None) -> NoReturn:
    """End as after Ctrl-C, so that the name of the port is taken away."""
    raise KeyboardInterrupt
