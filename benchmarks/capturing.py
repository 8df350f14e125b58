"""Live capture: how fast lines are decoded, how soon a reading is on the disk, and what a bad line does."""

from __future__ import annotations

import contextlib
import datetime as dt
import io
import sys
import threading
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from measure import Measured, Sizes, median, that_count, timed
from zlmreport.live.capture.events import Recorded
from zlmreport.live.capture.follower import Follower
from zlmreport.live.capture.journal import Journal, capture
from zlmreport.live.capture.records import Header
from zlmreport.live.capture.visits import Settings, number_visits
from zlmreport.live.emulation.channels import PseudoTerminal, serve
from zlmreport.live.emulation.emulator import Emulator, MovingAxis, Scene
from zlmreport.live.emulation.troubles import Troubles
from zlmreport.live.ports.dialogue import Decoder
from zlmreport.measurement.axis import Axis, AxisKind
from zlmreport.model.planning.methods import Method
from zlmreport.model.planning.plan import AxisPlan
from zlmreport.model.simulation.description import Description
from zlmreport.model.simulation.simulate import make_emulated_machine
from zlmreport.plugin.registry import find_plugins
from zlmreport_plugins.instruments.text_readout import TextDecoder, TextReadoutOptions
from zlmreport_plugins.instruments.umd import Setup, UmdDecoder
from zlmreport_plugins.instruments.umd.lines import MODELS

sys.path.append(str(Path(__file__).parents[1] / "tests"))
from live.capture.bad_lines import LINES, on_a_bad_line
from live.capture.wandering import trial

#: 100 times the fastest device's 1000 samples a second: µs for each.
_LONGEST = 10.0
_LENGTH = 316e-9
_CHUNK = 256
#: µs of a second, nm of a metre.
_MICRO, _NANO = 1e6, 1e9


def measure(sizes: Sizes) -> list[Measured]:
    """Measure decoders, the way to the disk, and the proof on a bad line."""
    is_small = sizes.rounds == 1
    return [
        *_decoding(sizes),
        *_latency(1 if is_small else 5),
        *_bad_lines(1 if is_small else 0),
        *_wandering(2 if is_small else 2600),
    ]


def _wandering(seeds: int) -> Iterator[Measured]:
    """Yield what became of programs with skips, silences, repeats, feed holds and new beginnings."""
    done = [trial(method, seed) for method in Method for seed in range(seeds)]
    count = len(done)
    for what, found in (
        ("readings filed wrongly", sum(len(each.misfiled) for each in done)),
        ("visits lost that were seen", sum(len(each.lost) for each in done)),
        ("visits lost and not named", sum(len(each.unnamed) for each in done)),
        ("questions asked", sum(each.questions for each in done)),
    ):
        yield Measured(f"{count} programs that do not go as planned, {what}", float(found))


def _decoding(sizes: Sizes) -> Iterator[Measured]:
    registry = find_plugins()
    setup = Setup(0, _LENGTH, ("air_temperature", "temperature_2"))
    decoders: dict[str, Callable[[], Decoder]] = {
        model.identifier: lambda model=model: UmdDecoder(model, setup) for model in MODELS
    }
    decoders["text-readout"] = lambda: TextDecoder(TextReadoutOptions(port="none"))
    for name, decoder in decoders.items():
        axis = MovingAxis((0.0, 0.1), dwell=1.0)
        sent = registry.instrument(name).emulator(Scene(axis)).unasked(60.0)
        lines = sent.count(b"\n")
        action = partial(_decoded, decoder, sent)
        costs = [timed(action)[0].cpu for _ in range(sizes.rounds)]
        yield Measured(
            f"{name}, a sample decoded", median(that_count(costs)) / lines * _MICRO, "µs", _LONGEST
        )


def _decoded(make: Callable[[], Decoder], sent: bytes) -> int:
    decoder = make()
    return sum(len(decoder.feed(sent[at : at + _CHUNK], 0.0)) for at in range(0, len(sent), _CHUNK))


def _latency(runs: int) -> Iterator[Measured]:
    """Yield how soon after the dwell of an axis its reading is on the disk, in real time."""
    plan = AxisPlan(np.linspace(0.0, 0.04, 5), runs=runs, overrun=4e-3, feed=0.1, dwell=0.4)
    machine = make_emulated_machine(Description(Axis("X", travel=(0.0, 0.04)), plan, seed=1), 2.0)
    settings = Settings(1e-3, 1e-6, 0.2, 0.04, 0.4)
    instrument = find_plugins().instrument("umd1")
    header = Header(
        "L",
        "",
        "X",
        AxisKind.LINEAR,
        {},
        "",
        dt.datetime.now(dt.UTC),
        "",
        settings,
        plan.stops[0].position,
        number_visits(plan),
    )
    late = []
    with TemporaryDirectory() as folder, _plugged_in(instrument.emulator(Scene(machine))) as (port, began):
        options = instrument.options.model_validate({"port": port})
        with instrument.open(options) as connection, Journal.begin(Path(folder) / "j", header) as journal:
            follower = Follower(journal.progress, settings)
            for event in capture(connection.readings(), follower, journal, lambda moment: moment):
                if isinstance(event, Recorded):
                    still = began + float(machine.arrives[event.visit.number - 1]) + settings.dwell
                    late.append((time.monotonic() - still) * 1e3)
    yield Measured("from stable to recorded, median", median(late), "ms")
    yield Measured("from stable to recorded, 95 %", float(np.quantile(late, 0.95)), "ms")


@contextlib.contextmanager
def _plugged_in(emulator: Emulator) -> Iterator[tuple[str, float]]:
    """Put an emulated instrument on a pseudo-terminal; yield its path, and when its time began."""
    ended = threading.Event()
    channel = PseudoTerminal()
    began = time.monotonic()

    def run() -> None:
        with channel:
            serve(emulator, channel, Troubles(), is_over=ended.is_set)

    thread = threading.Thread(target=run)
    thread.start()
    try:
        yield channel.address, began
    finally:
        ended.set()
        thread.join()


def _bad_lines(runs: int) -> Iterator[Measured]:
    """Yield how many faults there were, and the worst reading that was taken; 0 runs are the test's own."""
    faults = 0
    for name in LINES:
        with TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
            done, line = on_a_bad_line(name, Path(folder), runs)
        faults += line.faults.total()
        visits = len(done.machine.leaves)
        worst = max(map(abs, done.errors().values()))
        yield Measured(f"{name} on a bad line, worst reading", worst * _NANO, "nm")
        yield Measured(f"{name} on a bad line, visits missed of {visits}", float(visits - len(done.recorded)))
    yield Measured("faults on these lines", float(faults))
