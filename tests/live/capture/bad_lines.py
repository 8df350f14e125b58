"""Calibrations on lines that are bad: for the test, and for the benchmark that says what it costs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from live.capture.calibration import BENCHES, Calibration, calibration
from live.capture.faulty_line import FaultyLine, LineFault
from zlmreport.model.planning.methods import Method

#: Share of lines that something happens to, and how long a delayed one takes, s. A question that is not
#: answered leaves an instrument blind for its patience; displays that stream only lose the line.
LINES = {
    "umd0": (0.07, 0.02),
    "umd1": (0.07, 0.02),
    "umd2": (0.07, 0.02),
    "nd28x": (0.01, 0.15),
    "ids3010": (0.01, 0.15),
    "text-readout": (0.03, 0.15),
}
#: What a network delivers is as it was sent, or is not delivered.
_KINDS = {"ids3010": (LineFault.DROPPED, LineFault.DOUBLED, LineFault.DELAYED)}
#: Where questions are asked the axis is slow and rests long, for half a second in the dark must not hide it.
_POLLED = frozenset({"nd28x", "ids3010"})


def on_a_bad_line(instrument: str, folder: Path, runs: int = 0) -> tuple[Calibration, FaultyLine]:
    """Return a calibration by the linear method; without a number of runs, 5, or 2 of a slow axis."""
    bench = BENCHES[instrument]
    if instrument in _POLLED:
        bench = replace(bench, feed=300, dwell=5.0, average=1.8)
    share, delay = LINES[instrument]
    kinds = _KINDS.get(instrument, tuple(LineFault))
    line = FaultyLine(share, delay, kinds, has_parity=instrument == "nd28x")
    runs = runs or (2 if instrument in _POLLED else 5)
    return calibration(folder, bench, Method.LINEAR, runs=runs, line=line), line
