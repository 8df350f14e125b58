"""``zlmreport emulate``: an instrument that is not there, on a line; its axis moves and shakes."""

from __future__ import annotations

import signal
from argparse import Namespace
from collections.abc import Callable, Sequence
from types import FrameType
from typing import NoReturn

from zlmreport.cli.terminal import make_visible
from zlmreport.errors import InputError, Place
from zlmreport.language import Language
from zlmreport.language.formatting import write_stated_number
from zlmreport.live.emulation.channels import LocalSocket, PseudoTerminal, serve
from zlmreport.live.emulation.emulator import Emulator, MovingAxis, Scene
from zlmreport.live.emulation.troubles import Troubles
from zlmreport.measurement.units import MILLIMETRE
from zlmreport.plugin.registry import find_plugins

#: Standard deviation of what shakes the axis, m.
_NOISE = 0.05e-6


def run(options: Namespace) -> int:
    """Emulate an instrument until it is unplugged, or the user ends it."""
    refuse_two_lines(options, "zlmreport emulate")
    axis = make_axis_of(options)
    instrument = find_plugins(files=options.plugin).instrument(options.instrument)
    title = instrument.title.in_language(Language.ENGLISH)
    course = ", ".join(write_stated_number(MILLIMETRE.from_si(position)) for position in axis.course)
    return put_on_line(
        instrument.emulator(Scene(axis, make_troubles_of(options))),
        options,
        lambda address: (
            f"{instrument.identifier}: {title}, emulated",
            f"port: {address}",
            f"axis: {course} mm, {axis.dwell:g} s at each, over and over; Ctrl-C ends",
        ),
    )


def make_axis_of(options: Namespace) -> MovingAxis:
    """Return the axis that the command line describes; raise `InputError` for one that there cannot be."""
    if options.dwell < 0:
        raise InputError.at(
            Place("zlmreport emulate"), f"--dwell {options.dwell:g} makes no axis; it is positive"
        )
    course = tuple(MILLIMETRE.to_si(position) for position in options.course)
    return MovingAxis(course, dwell=options.dwell, noise=_NOISE)


def refuse_two_lines(options: Namespace, command: str) -> None:
    """Raise `InputError` if the command line names a pseudo-terminal and a TCP port."""
    if options.link is not None and options.port is not None:
        raise InputError.at(Place(command), "--link names a pseudo-terminal, --port a TCP port: take one")


def make_troubles_of(options: Namespace) -> Troubles:
    """Return what the command line says that goes wrong."""
    return Troubles(tuple(options.fault))


def put_on_line(
    emulator: Emulator,
    options: Namespace,
    announce: Callable[[str], Sequence[str]],
    beat: Callable[[], None] = lambda: None,
    heard: Callable[[], None] = lambda: None,
) -> int:
    """Let an emulated instrument speak until it is unplugged, or the user ends it; return the exit code.

    `options`: Of the command: ``link`` or ``port``, and ``fault``.
    `announce`: Returns what is printed once the line is there, from its address.
    `heard`: Called with it from when somebody reads the instrument.
    """
    signal.signal(signal.SIGTERM, _end_as_after_ctrl_c)
    troubles = make_troubles_of(options)
    with PseudoTerminal(options.link) if options.port is None else LocalSocket(options.port) as channel:

        def is_over() -> bool:
            if channel.is_read:
                heard()
            beat()
            return False

        try:
            print("\n".join(announce(make_visible(channel.address))), flush=True)
            serve(emulator, channel, troubles, is_over=is_over)
        except KeyboardInterrupt:
            return 0
    print("unplugged")
    return 0


def _end_as_after_ctrl_c(_number: int, _frame: FrameType | None) -> NoReturn:
    """End as after Ctrl-C, so that the name of the port is taken away."""
    raise KeyboardInterrupt
