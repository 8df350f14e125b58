"""A capture that is killed again and again, each time at a random moment, and gone on with."""

from __future__ import annotations

import json
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from typing import Any

from installed import registry
from live.capture.operated import OperatedAxis
from plugins.instruments.lines import plugged_in
from processes import PATIENCE, ZLMREPORT, group
from zlmreport.job.simulation import load_simulation
from zlmreport.model.simulation.files import read_description_of
from zlmreport.plugin.instrument import (
    JournalHistory,
    Scene,
    read_journal,
)

#: The share of kills before a capture follows the axis, and how long it takes until then, s.
_KILLED_EARLY, _BEGINNING = 0.25, 1.0
#: The longest time that one follows the axis, s, and how often it is looked at.
_LONGEST, _LOOK = 0.5, 0.01
#: After so long without a record the operator brings the axis to its target once more, s.
_UNSEEN = 5.0

_SIMULATION = """\
schema: zlmreport/simulation/1
seed: 3
axis: {{name: X, travel: [0, 40]}}
targets: {{count: 5}}
runs: {runs}
overrun: 4
feed: 6000
dwell: 2
effects: [{{backlash: {{lost_motion: -4}}}}]
noise: {{reading: 0.5}}
"""
_JOB = """\
schema: zlmreport/job/1
certificate: {{number: K-1, kind: report}}
axis: {{name: X, travel: [0, 40]}}
measurement:
  method: linear
  feed: 6000
  dwell: 2
  source:
    plugin: serial-interferometer
    journal: x.journal
    instrument: {{plugin: umd1, port: {port}, timeout: 60}}
    dwell: 0.1
plan: {{targets: {{positions: [0, 10, 20, 30, 40]}}, runs: {runs}, overrun: 4}}
evaluate: [iso230-2:2014]
output: {{directory: out, formats: [json]}}
"""


@dataclass
class Killed:
    """A capture that was killed.

    Attributes
    ----------
    axis
        What it followed.
    job, journal
        The files.
    kills
        How often it was killed.
    said
        The records that the processes had announced as written.
    seen
        What was in the journal at each kill.
    """

    axis: OperatedAxis
    job: Path
    journal: Path
    kills: int = 0
    said: list[dict[str, Any]] = field(default_factory=list)
    seen: list[bytes] = field(default_factory=list)

    @property
    def has_begun(self) -> bool:
        """Whether the journal holds a capture: its first line is whole."""
        return self.journal.exists() and read_journal(self.journal) is not None

    @property
    def history(self) -> JournalHistory:
        """What the journal says."""
        history = read_journal(self.journal)
        assert history is not None
        return history

    def is_followed_since(self, records: int) -> bool:
        """Tell whether a capture has written more records than there were, and knows its datum."""
        if not self.has_begun:
            return False
        history = self.history
        return len(history.entries) > records and history.progress.zero is not None


def killed_capture(folder: Path, kills: int, runs: int, seed: int = 1) -> Killed:
    """Capture a test in real time, killed so many times, or until it is complete."""
    random = Random(seed)
    simulation, job = folder / "simulation.yaml", folder / "job.yaml"
    simulation.write_text(_SIMULATION.format(runs=runs), encoding="utf-8")
    axis = OperatedAxis(read_description_of(load_simulation(simulation, registry()), registry().effect))
    done = Killed(axis, job, folder / "x.journal")
    began = time.monotonic()

    def now() -> float:
        return time.monotonic() - began

    with plugged_in(registry().instrument("umd1").emulator(Scene(axis)), clock=now) as port:
        job.write_text(_JOB.format(port=port, runs=runs), encoding="utf-8")
        while not (done.has_begun and done.history.progress.is_over):
            _sitting(done, now, random if done.kills < kills else None)
    return done


def _sitting(done: Killed, now: Callable[[], float], fate: Random | None) -> None:
    """Let a capture go on to its end, or until fate kills it; the operator runs the program beside it."""
    records = len(done.history.entries) if done.has_begun else 0
    visit = max(done.history.progress.taken - 1, 0) if done.has_begun else 0
    time.sleep(max(0.0, done.axis.go_back(visit, now()) - now()))
    command = (*ZLMREPORT, "capture", done.job, "--json")
    errors = done.job.with_suffix(".err")
    with (
        done.job.with_suffix(".out").open("wb+") as out,
        errors.open("wb") as wrong,
        group(*command, *(["--resume"] if done.has_begun else []), stdout=out, stderr=wrong) as capture,
    ):
        if fate and fate.random() < _KILLED_EARLY:
            time.sleep(fate.uniform(0.0, _BEGINNING))
        else:
            while not done.is_followed_since(records):
                assert capture.poll() is None, errors.read_text(encoding="utf-8")
                time.sleep(_LOOK)
            _run_program(done, visit, now, capture, fate.uniform(0.0, _LONGEST) if fate else float("inf"))
        if capture.poll() is None:
            capture.kill()
            done.kills += 1
        capture.wait(PATIENCE)
        out.seek(0)
        done.said += [json.loads(line) for line in out.read().rpartition(b"\n")[0].splitlines()]
    if done.journal.exists():
        done.seen.append(done.journal.read_bytes())


def _run_program(
    done: Killed, visit: int, now: Callable[[], float], capture: subprocess.Popen[bytes], lasts: float
) -> None:
    """Let the axis go on to the next visit whenever the journal says that one is read."""
    until = time.monotonic() + lasts
    done.axis.go_to(visit, now())
    records, seen = len(done.history.entries), time.monotonic()
    while capture.poll() is None and time.monotonic() < until:
        history = done.history
        progress = history.progress
        if len(history.entries) > records:
            records, seen = len(history.entries), time.monotonic()
        elif time.monotonic() - seen > _UNSEEN:  # a busy computer did not see the axis arrive
            time.sleep(max(0.0, done.axis.go_back(visit, now()) - now()))
            done.axis.go_to(visit, now())
            seen = time.monotonic()
        if progress.taken > visit and not progress.must_check and visit + 1 < len(progress.visits):
            visit += 1
            done.axis.go_to(visit, now())
        time.sleep(_LOOK)
