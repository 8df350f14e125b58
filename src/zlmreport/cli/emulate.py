"""``zlmreport emulate``: an instrument that is not there, on a line."""

from __future__ import annotations

from argparse import Namespace

from zlmreport.cli.emulate_machine import IPPDME, refuse_options_of_machines, run_machine
from zlmreport.cli.line import put_on_line, refuse_two_lines, troubles_of
from zlmreport.emulation.emulator import MovingAxis, Scene
from zlmreport.errors import InputError, Place
from zlmreport.language import Language
from zlmreport.plugins import find_plugins
from zlmreport.quantities.formatting import general_number
from zlmreport.quantities.units import MICROMETRE, MILLIMETRE

_SECONDS_A_MINUTE = 60


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
