"""Capture on a bad line: no wrong reading is taken, and none is lost without being named."""

from __future__ import annotations

from pathlib import Path

import pytest

from live.capture.bad_lines import LINES, on_a_bad_line
from live.capture.calibration import BENCHES
from live.capture.faulty_line import FaultyLine
from zlmreport.live.capture.events import Missed, Recorded
from zlmreport.live.emulation.emulator import MovingAxis
from zlmreport.plugin.instrument import Scene
from zlmreport_plugins.instruments.umd import Setup, UmdDecoder
from zlmreport_plugins.instruments.umd.lines import MODELS, UmdEmulator

#: Together more than 10,000 faults.
LEAST = {"umd0": 1300, "umd1": 3300, "umd2": 5500, "nd28x": 60, "ids3010": 300, "text-readout": 100}
_LENGTH = 316e-9


@pytest.mark.long
@pytest.mark.parametrize("instrument", LINES)
def test_no_wrong_reading_is_taken_and_no_visit_is_lost_in_silence(instrument: str, tmp_path: Path) -> None:
    done, line = on_a_bad_line(instrument, tmp_path)
    assert line.faults.total() >= LEAST[instrument]
    # a garbled reading may keep within the stability range; four readings at least make a mean
    bench = BENCHES[instrument]
    allowed = bench.resolution + bench.stability * 1e-6 / 4
    assert max(map(abs, done.errors().values())) <= allowed
    visits = len(done.machine.leaves)
    named = [event.visit.number for event in done.events if isinstance(event, Recorded | Missed)]
    assert named == list(range(1, visits + 1))
    assert len(done.recorded) >= 0.97 * visits


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.identifier)
def test_every_sample_of_a_display_that_numbers_them_is_accounted_for(model: object) -> None:
    assert isinstance(model, type(MODELS[0]))
    display = UmdEmulator(model, Scene(MovingAxis((0.0, 0.01), dwell=0.5)), _LENGTH)
    decoder = UmdDecoder(model, Setup(0, _LENGTH, ("air_temperature", "axis_temperature")))
    line = FaultyLine(0.05, 0.02)
    readings = []
    samples = 0
    for beat in range(1, 3001):
        sent = display.unasked(beat / 100)
        samples += sent.count(b"\r\n")
        readings += decoder.feed(line(sent, beat / 100), beat / 100)
    usable = [reading for reading in readings if reading.is_usable]
    named = len(readings) - len(usable) + sum(reading.skipped for reading in usable)
    # before the first reading two turns of the low-speed channel go by
    assert len(usable) + named >= samples - 2 * model.slots - 5
    assert len(usable) >= 0.8 * samples
