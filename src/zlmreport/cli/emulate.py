"""``zlmreport emulate``: an instrument that is not there, on a line."""

from __future__ import annotations

import signal
from argparse import Namespace
from types import FrameType
from typing import NoReturn

from zlmreport.cli.messages import visible
from zlmreport.emulation.axis import MovingAxis
from zlmreport.emulation.channels import LocalSocket, PseudoTerminal
from zlmreport.emulation.emulator import Scene
from zlmreport.emulation.faults import Planned, Trouble, Troubles
from zlmreport.emulation.serve import serve
from zlmreport.errors import InputError, Place
from zlmreport.language import Language
from zlmreport.plugins import find_plugins
from zlmreport.quantities.formatting import general_number
from zlmreport.quantities.units import MICROMETRE, MILLIMETRE

_SECONDS_A_MINUTE = 60


def run(options: Namespace) -> int:
    """Emulate an instrument until it is unplugged, or the user ends it."""
    if options.link is not None and options.port is not None:
        raise InputError.at(
            Place("zlmreport emulate"), "--link names a pseudo-terminal, --port a TCP port: take one"
        )
    axis = axis_of(options)
    instrument = find_plugins(files=options.plugin).instrument(options.instrument)
    troubles = Troubles(tuple(Planned(Trouble(kind), start) for kind, start in options.fault))
    emulator = instrument.emulator(Scene(axis, troubles))
    signal.signal(signal.SIGTERM, _end)
    with PseudoTerminal(options.link) if options.port is None else LocalSocket(options.port) as channel:
        title = instrument.title.in_language(Language.ENGLISH)
        course = ", ".join(general_number(MILLIMETRE.from_si(position)) for position in axis.course)
        print(f"{instrument.identifier}: {title}, emulated")
        print(f"port: {visible(channel.address)}")
        print(f"axis: {course} mm, {axis.dwell:g} s at each, over and over; Ctrl-C ends", flush=True)
        try:
            serve(emulator, channel, troubles)
        except KeyboardInterrupt:
            return 0
    print("unplugged")
    return 0


def axis_of(options: Namespace) -> MovingAxis:
    """Return the axis that the command line describes; raise `InputError` for one that there cannot be."""
    wrong = next((name for name in ("dwell", "noise") if getattr(options, name) < 0), None)
    if wrong or options.feed <= 0:
        name = wrong or "feed"
        raise InputError.at(
            Place("zlmreport emulate"), f"--{name} {getattr(options, name):g} makes no axis; it is positive"
        )
    return MovingAxis(
        course=tuple(MILLIMETRE.to_si(position) for position in options.course),
        feed=MILLIMETRE.to_si(options.feed) / _SECONDS_A_MINUTE,
        dwell=options.dwell,
        noise=MICROMETRE.to_si(options.noise),
        drift=MICROMETRE.to_si(options.drift) / _SECONDS_A_MINUTE,
    )


def _end(_number: int, _frame: FrameType | None) -> NoReturn:
    """End as after Ctrl-C, so that the name of the port is taken away."""
    raise KeyboardInterrupt
