"""A capture that is killed again and again: ``./run benchmark kills``."""

from __future__ import annotations

import argparse
import statistics
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from zlmreport.live.capture.events import Missed, Recorded

sys.path.append(str(Path(__file__).parents[1] / "tests"))
from live.capture.killing import killed_capture


def main(arguments: Sequence[str]) -> None:
    """Kill captures, and say what was lost and what is there twice."""
    parser = argparse.ArgumentParser(
        prog="./run benchmark kills",
        description="Capture from an emulated instrument in real time; kill the capture at random moments, "
        "and go on with it until the test is complete.",
    )
    parser.add_argument("--kills", type=int, default=50, help="how often (%(default)s)")
    parser.add_argument(
        "--runs", type=int, default=10, help="of the test: each has 10 readings (%(default)s)"
    )
    options = parser.parse_args(arguments)
    begin = time.monotonic()
    with TemporaryDirectory() as folder:
        done = killed_capture(Path(folder), options.kills, options.runs)
        history = done.history
    events = [entry.event for entry in history.entries]
    lasted = time.monotonic() - begin
    recorded = [event for event in events if isinstance(event, Recorded)]
    numbers = [event.visit.number for event in recorded]
    planned = range(1, len(history.header.visits) + 1)
    errors = [abs(event.deviation - done.axis.deviation[event.visit.number - 1]) for event in recorded]
    lost, twice = len(set(planned) - set(numbers)), len(numbers) - len(set(numbers))
    print(f"killed {done.kills} times in {lasted:.0f} s")
    print(f"visits {len(planned)}, lost {lost}, twice {twice}")
    print(f"missed by name {sum(isinstance(event, Missed) for event in events)}")
    print(f"worst reading {max(errors) * 1e9:.2f} nm, median {statistics.median(errors) * 1e9:.2f} nm")
