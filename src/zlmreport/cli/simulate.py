"""``zlmreport simulate``: readings of an axis that never was, or the axis itself to be read."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from zlmreport.cli.emulate import make_troubles_of, put_on_line, refuse_two_lines
from zlmreport.cli.terminal import show_path
from zlmreport.errors import InputError, Place, count_in_words
from zlmreport.files import Document, write
from zlmreport.job.simulation import SimulationFile, load_simulation
from zlmreport.language import Language
from zlmreport.live.emulation.emulator import Scene
from zlmreport.measurement.units import SECONDS_PER_MINUTE
from zlmreport.model.planning.plan import AxisPlan
from zlmreport.model.simulation.files import (
    read_description_of,
    write_job_text,
    write_live_job_text,
    write_readings_table,
)
from zlmreport.model.simulation.simulate import StartedMachine, make_emulated_machine, simulate
from zlmreport.plugin.registry import find_plugins

_COMMAND = "zlmreport simulate"
#: Over so many seconds a reading is averaged unless the job says otherwise.
_USUAL_DWELL = 1.0


def run(options: Namespace) -> int:
    """Write the readings anew, and the job unless it is there; or emulate the machine and its instrument."""
    if options.emulate is not None:
        return _run_live(options)
    registry = find_plugins(files=options.plugin)
    file = load_simulation(options.specification, registry)
    measurements = simulate(read_description_of(file, registry.effect)).measurements
    folder = options.output or options.specification.parent
    readings = folder / (file.keys.output.readings or f"{options.specification.stem}.csv")
    job = folder / file.keys.output.job
    head = list_remarks(file, "Simulated readings, not measurements.")
    print(
        *_write_table(
            Document(readings, write_readings_table(measurements, head).encode()),
            Document(job, write_job_text(file, folder, readings.name).encode()),
        ),
        sep="\n",
    )
    print(f"next: zlmreport {show_path(job)}")
    return 0


def _run_live(options: Namespace) -> int:
    """Let a machine carry out its plan before an instrument, until the user ends it.

    What the axis will really do is written first, and the job that captures it unless that is there.
    """
    refuse_two_lines(options, _COMMAND)
    if options.start < 0:
        raise InputError.at(Place(_COMMAND), f"--start {options.start:g} has gone by; state 0 or more")
    registry = find_plugins(files=options.plugin)
    instrument = registry.instrument(options.emulate)
    file = load_simulation(options.specification, registry)
    description = read_description_of(file, registry.effect)
    machine = make_emulated_machine(description, options.start)
    folder = options.output or options.specification.parent
    truth = folder / f"{options.specification.stem}-truth.csv"
    job = folder / file.keys.output.job

    def announce(address: str) -> Sequence[str]:
        port = address if options.link is None else str(options.link.absolute())
        source = _make_source_keys(options, description.plan, {"plugin": instrument.identifier, "port": port})
        last = machine.duration / SECONDS_PER_MINUTE
        when = f"{options.start:g} s after somebody reads the port"
        head = list_remarks(file, "What a simulated axis really does; nothing here was measured.")
        return (
            *_write_table(
                Document(truth, write_readings_table(machine.truth, head).encode()),
                Document(job, write_live_job_text(file, folder, description.plan, source).encode()),
            ),
            f"{instrument.identifier}: {instrument.title.in_language(Language.ENGLISH)}, emulated",
            f"port: {address}",
            (
                f"machine: {count_in_words(len(machine.leaves), 'reading')} in {last:.1f} min, from {when}; "
                "Ctrl-C ends"
            ),
            f"next, in another terminal: zlmreport capture {show_path(job)}",
        )

    started = StartedMachine(machine)
    program = _log_program(started, options.start, machine.duration)
    emulator = instrument.emulator(Scene(started, make_troubles_of(options), started.conditions))
    return put_on_line(emulator, options, announce, lambda: next(program), started.start)


def _make_source_keys(options: Namespace, plan: AxisPlan, instrument: Mapping[str, str]) -> dict[str, Any]:
    """Return the keys of the job's source: of a short rest the first half is left to the axis to settle."""
    source = {
        "plugin": "serial-interferometer",
        "instrument": instrument,
        "journal": f"{options.specification.stem}.journal",
    }
    return source if plan.dwell > 2 * _USUAL_DWELL else source | {"dwell": plan.dwell / 2}


def _log_program(machine: StartedMachine, *moments: float) -> Iterator[None]:
    """Say when the program starts and when it ends; each step is a look at the machine."""
    for moment, what in zip(moments, ("the program has started", "the program has ended"), strict=True):
        while machine.elapsed is None or machine.elapsed < moment:
            yield
        print(what, flush=True)
    while True:
        yield


def _write_table(table: Document, job: Document) -> Iterator[str]:
    """Write a table anew, and a job unless it is there, for somebody may have worked on it.

    Yields
    ------
    str
        What is printed of each.
    """
    is_new = not job.path.exists()
    yield from (show_path(path) for path in write([table, job] if is_new else [table]))
    if not is_new:
        yield f"{show_path(job.path)} is there already and was left as it is"


def list_remarks(file: SimulationFile, kind: str) -> tuple[str, ...]:
    """Return what the head of a table says of its origin.

    `kind`: What the table holds, in a sentence.
    """
    origin = f"sha256 {file.source.sha256[:16]}…, seed {file.keys.seed}"
    return kind, f"Source: zlmreport simulate {file.source.name} ({origin})"
