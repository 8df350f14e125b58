"""Whole calibrations of emulated machines: plan, capture and certificate, and the truth beside them."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from installed import registry
from live.capture.virtual import PORT, World, inhabited
from zlmreport.cli import main
from zlmreport.job.simulation import load_simulation
from zlmreport.live.capture.events import Event, Recorded
from zlmreport.model.planning.methods import Method
from zlmreport.model.simulation.files import read_description_of
from zlmreport.model.simulation.simulate import EmulatedMachine, make_emulated_machine
from zlmreport.plugin import Options
from zlmreport.plugin.instrument import JournalHistory, Scene, read_journal
from zlmreport.plugin.standard import evaluate

#: How long the machine rests before its program, s: µMD0 takes four of them to say what it
#: is, and a bad line may take more.
_LEAD = 12.0
STANDARD = "iso230-2:2014"


@dataclass(frozen=True, slots=True)
class Bench:
    """An instrument, and a test that suits its pace.

    Attributes
    ----------
    instrument
        Its identifier.
    resolution
        Of a reading, m.
    feed
        mm/min: a reading a tenth of a second must see the axis turn round.
    dwell, average
        How long the axis rests at a target, and over how long it is read, s.
    stability
        µm: of a reading that the axis gives on its last way to a target, at most so much enters the mean.
    """

    instrument: str
    resolution: float
    feed: float
    dwell: float
    average: float
    stability: float


_HALF_WAVE = 632.991372e-9 / 1.000271 / 2
BENCHES = {
    bench.instrument: bench
    for bench in (
        Bench("umd0", _HALF_WAVE / 4, 6000, 0.3, 0.15, 0.05),
        Bench("umd1", _HALF_WAVE / 256, 6000, 0.3, 0.15, 0.05),
        Bench("umd2", _HALF_WAVE / 2 / 65_536, 6000, 0.3, 0.15, 0.05),
        Bench("nd28x", 1e-7, 1000, 2.0, 0.8, 1.0),
        Bench("ids3010", 1e-12, 3000, 0.6, 0.3, 1.0),
        Bench("text-readout", 1e-7, 1000, 2.0, 0.8, 1.0),
    )
}

_SIMULATION = """\
schema: zlmreport/simulation/1
seed: 5
axis: {{name: X, travel: [0, 80]}}
targets: {{count: 21}}
method: {method}
runs: {runs}
overrun: 3
feed: {bench.feed}
dwell: {bench.dwell}
effects: [{effects}]
noise: {{reading: 0.5}}
"""
_SCALE_ERROR, _BACKLASH = "{scale-error: {slope: 40}}", "{backlash: {lost_motion: -4}}"
_JOB = """\
schema: zlmreport/job/1
certificate: {{number: E-1, kind: report}}
axis: {{name: X, travel: [0, 80]}}
measurement:
  method: {method}
  feed: {bench.feed}
  dwell: {bench.dwell}
  source:
    plugin: serial-interferometer
    journal: x.journal
    instrument: {{plugin: {bench.instrument}, port: "{port}"}}
    dwell: {bench.average}
    stability: {bench.stability}
plan: {{targets: {{positions: {positions}}}, runs: {runs}, overrun: 3}}
evaluate: [{standard}]
output: {{directory: out, formats: [json]}}
"""


@dataclass(frozen=True, slots=True)
class Calibration:
    """What came of a calibration.

    Attributes
    ----------
    machine
        The emulated machine, with what it really did.
    history
        What the journal says.
    parameters
        Of the certificate, m, by symbol.
    """

    machine: EmulatedMachine
    history: JournalHistory
    parameters: dict[str, float]

    @property
    def events(self) -> tuple[Event, ...]:
        return tuple(entry.event for entry in self.history.entries)

    @property
    def recorded(self) -> dict[int, Recorded]:
        """The readings, by the number of their visit."""
        return {event.visit.number: event for event in self.events if isinstance(event, Recorded)}

    def errors(self) -> dict[int, float]:
        """Return by how much each reading differs from where the axis really was, m."""
        deviation = self.machine.truth.deviation
        return {
            number: event.deviation - float(deviation[number - 1]) for number, event in self.recorded.items()
        }

    def true_parameters(self) -> dict[str, float]:
        """Return the parameters of the standard for what the axis really did, m."""
        found = evaluate(registry().standard(STANDARD), self.machine.truth, Options(), {})
        return {each.quantity.symbol: each.value for each in found.parameters}


def calibration(
    folder: Path,
    bench: Bench,
    method: Method,
    runs: int = 5,
    *,
    line: Callable[[bytes, float], bytes] | None = None,
) -> Calibration:
    """Calibrate an emulated machine by the commands of the product, in virtual time."""
    simulation, job = folder / "simulation.yaml", folder / "job.yaml"
    effects = [_SCALE_ERROR] if method is Method.UNIDIRECTIONAL else [_SCALE_ERROR, _BACKLASH]
    keys = {"bench": bench, "method": method, "runs": runs}
    simulation.write_text(_SIMULATION.format(**keys, effects=", ".join(effects)), encoding="utf-8")
    description = read_description_of(load_simulation(simulation, registry()), registry().effect)
    machine = make_emulated_machine(description, _LEAD)
    positions = np.round(description.plan.targets * 1e3, 9).tolist()
    job.write_text(_JOB.format(**keys, positions=positions, port=PORT, standard=STANDARD), encoding="utf-8")
    emulator = registry().instrument(bench.instrument).emulator(Scene(machine))
    with inhabited(World(emulator, machine.duration + _LEAD, line)):
        assert main(["capture", str(job)]) == 0
    assert main([str(job), "--quiet"]) == 0
    history = read_journal(folder / "x.journal")
    assert history is not None
    results = json.loads((folder / "out" / "E-1.json").read_text(encoding="utf-8"))
    (evaluation,) = results["evaluations"]
    parameters = {each["symbol"]: each["value"] * 1e-6 for each in evaluation["parameters"]}
    return Calibration(machine, history, parameters)
