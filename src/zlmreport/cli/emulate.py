"""``zlmreport emulate``: an instrument, or a coordinate measuring machine, that is not there, on a line."""

from __future__ import annotations

import signal
from argparse import Namespace
from collections.abc import Callable, Sequence
from types import FrameType
from typing import NoReturn

from zlmreport.cli.terminal import visible
from zlmreport.emulation.channels import LocalSocket, PseudoTerminal, serve
from zlmreport.emulation.dme_server import DmeServer, PointFault
from zlmreport.emulation.emulator import Emulator, MovingAxis, Planned, Scene, Trouble, Troubles
from zlmreport.errors import InputError, Place
from zlmreport.job.loading import load
from zlmreport.job.machine_keys import STANDARD_PORT
from zlmreport.language import Language
from zlmreport.plugins import find_plugins
from zlmreport.probing.emulated import machine_of_job
from zlmreport.quantities.formatting import general_number
from zlmreport.quantities.units import MICROMETRE, MILLIMETRE

_SECONDS_A_MINUTE = 60
#: As the command line names the machine.
IPPDME = "ippdme"
_COMMAND = Place("zlmreport emulate")


def run(options: Namespace) -> int:
    """Emulate an instrument until it is unplugged, or the user ends it."""
    if options.instrument == IPPDME:
        return run_machine(options)
    refuse_options_of_machines(options)
    refuse_two_lines(options, "zlmreport emulate")
    axis = axis_of(options)
    instrument = find_plugins(files=options.plugin).instrument(options.instrument)
    title = instrument.title.in_language(Language.ENGLISH)
    course = ", ".join(general_number(MILLIMETRE.from_si(position)) for position in axis.course)
    return put_on_line(
        instrument.emulator(Scene(axis, troubles_of(options))),
        options,
        lambda address: (
            f"{instrument.identifier}: {title}, emulated",
            f"port: {address}",
            f"axis: {course} mm, {axis.dwell:g} s at each, over and over; Ctrl-C ends",
        ),
    )


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


def refuse_options_of_machines(options: Namespace) -> None:
    """Raise `InputError` if another instrument is given options that only the machine has."""
    wrong = next((name for name in ("job", "scale_error", "point_fault") if getattr(options, name)), None)
    if wrong:
        raise InputError.at(_COMMAND, f"--{wrong.replace('_', '-')} is for {IPPDME} alone; leave it out")


def run_machine(options: Namespace) -> int:
    """Emulate the machine until its connection is cut, or the user ends it."""
    if options.job is None or options.link is not None:
        raise InputError.at(
            _COMMAND,
            f"{IPPDME} needs the job whose gauge lies on it, and a TCP port: --job JOB.yaml --port "
            f"{STANDARD_PORT}",
        )
    if options.port is None:
        options.port = STANDARD_PORT
    job = load(options.job, find_plugins(files=options.plugin))
    machine = machine_of_job(
        job, scale_error=options.scale_error * 1e-6, noise=MICROMETRE.to_si(options.noise)
    )
    tool = getattr(getattr(job.source.options, "machine", None), "tool", None)
    faults = {number: PointFault(kind) for kind, number in options.point_fault}
    server = DmeServer(machine, ("RefTool", *([tool] if tool else [])), faults)

    def beat() -> None:
        if server.is_gone:
            raise _CutError

    try:
        return put_on_line(
            server,
            options,
            lambda address: (
                f"{IPPDME}: coordinate measuring machine, I++ DME, emulated",
                f"port: {address}",
                f"scale error: {general_number(options.scale_error)} µm/m along the gauge; Ctrl-C ends",
            ),
            beat,
        )
    except _CutError:
        print("the connection is cut")
        return 0


class _CutError(Exception):
    """The planned fault has cut the connection."""


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
    signal.signal(signal.SIGTERM, _as_after_ctrl_c)
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


def _as_after_ctrl_c(_number: int, _frame: FrameType | None) -> NoReturn:
    """End as after Ctrl-C, so that the name of the port is taken away."""
    raise KeyboardInterrupt
