"""``zlmreport simulate --emulate``: a machine and an instrument that are not there."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from zlmreport.cli.line import put_on_line, refuse_two_lines, troubles_of
from zlmreport.cli.simulate_files import remarks, written
from zlmreport.cli.terminal import shown_path
from zlmreport.emulation.emulator import Scene
from zlmreport.errors import InputError, Place
from zlmreport.files import Document
from zlmreport.job.simulation import load_simulation
from zlmreport.language import Language
from zlmreport.planning.plan import Plan
from zlmreport.plugins import find_plugins
from zlmreport.simulation.files import description_of, live_job_text, readings_table
from zlmreport.simulation.machine import StartedMachine, emulated_machine

_COMMAND = "zlmreport simulate"
_SECONDS_A_MINUTE = 60
#: Over so many seconds a reading is averaged unless the job says otherwise.
_USUAL_DWELL = 1.0


def run_live(options: Namespace) -> int:
    """Let a machine carry out its plan before an instrument, until the user ends it.

    What the axis will really do is written first, and the job that captures it unless that is there.
    """
    refuse_two_lines(options, _COMMAND)
    if options.start < 0:
        raise InputError.at(Place(_COMMAND), f"--start {options.start:g} has gone by; state 0 or more")
    registry = find_plugins(files=options.plugin)
    instrument = registry.instrument(options.emulate)
    file = load_simulation(options.specification, registry)
    description = description_of(file, registry.effect)
    machine = emulated_machine(description, options.start)
    folder = options.output or options.specification.parent
    truth = folder / f"{options.specification.stem}-truth.csv"
    job = folder / file.keys.output.job

    def announce(address: str) -> Sequence[str]:
        port = address if options.link is None else str(options.link.absolute())
        source = _source(options, description.plan, {"plugin": instrument.identifier, "port": port})
        last = machine.duration / _SECONDS_A_MINUTE
        when = f"{options.start:g} s after somebody reads the port"
        head = remarks(file, "What a simulated axis really does; nothing here was measured.")
        return (
            *written(
                Document(truth, readings_table(machine.truth, head).encode()),
                Document(job, live_job_text(file, folder, description.plan, source).encode()),
            ),
            f"{instrument.identifier}: {instrument.title.in_language(Language.ENGLISH)}, emulated",
            f"port: {address}",
            f"machine: {len(machine.leaves)} readings in {last:.1f} min, from {when}; Ctrl-C ends",
            f"next, in another terminal: zlmreport capture {shown_path(job)}",
        )

    started = StartedMachine(machine)
    program = _program(started, options.start, machine.duration)
    emulator = instrument.emulator(Scene(started, troubles_of(options), started.conditions))
    return put_on_line(emulator, options, announce, lambda: next(program), started.start)


def _source(options: Namespace, plan: Plan, instrument: Mapping[str, str]) -> dict[str, Any]:
    """Return the keys of the job's source: of a short rest the first half is left to the axis to settle."""
    source = {
        "plugin": "serial-interferometer",
        "instrument": instrument,
        "journal": f"{options.specification.stem}.journal",
    }
    return source if plan.dwell > 2 * _USUAL_DWELL else source | {"dwell": plan.dwell / 2}


def _program(machine: StartedMachine, *moments: float) -> Iterator[None]:
    """Say when the program starts and when it ends; each step is a look at the machine."""
    for moment, what in zip(moments, ("the program has started", "the program has ended"), strict=True):
        while machine.elapsed is None or machine.elapsed < moment:
            yield
        print(what, flush=True)
    while True:
        yield
