"""``zlmreport capture`` for a job whose step gauge is probed live by a coordinate measuring machine."""

from __future__ import annotations

import json
import sys
from argparse import Namespace
from typing import Any

from zlmreport.cli.terminal import Colour, shown_path, visible
from zlmreport.errors import InputError, Place
from zlmreport.probing.answers import MachineError
from zlmreport.probing.run import LiveProbing, Watcher, run_probing
from zlmreport.quantities.formatting import fixed_number
from zlmreport.quantities.units import MILLIMETRE
from zlmreport.step_gauge.path import Point, Probing


def run(probing: LiveProbing, options: Namespace) -> int:
    """Probe what is missing; the same command goes on where it ended."""
    wrong = next((name for name in ("end", "journal") if getattr(options, name)), None)
    if wrong:
        raise InputError.at(
            Place("zlmreport capture"),
            f"--{wrong} is of no use with a step gauge: its points stand beside the job's file of points "
            "until all are there; leave it out",
        )
    watcher: Watcher = _JsonLines() if options.json else _PlainLines()
    if not options.json:
        machine = probing.machine
        gauge = probing.planned.path.gauge
        print(f"{machine.host}:{machine.port}  {gauge}; Ctrl-C stops the machine", flush=True)
    result = run_probing(probing, watcher)
    if not options.json:
        print(shown_path(result))
        print(f"next: zlmreport {shown_path(options.job)}")
    return 0


class _PlainLines:
    """Prints a line for what happens."""

    def __init__(self) -> None:
        self._points = 0

    def begun(self, done: int, points: int) -> None:
        self._points = points
        print(f"{points} points, {done} of them probed already" if done else f"{points} points", flush=True)

    def probed(self, probing: Probing, centre: Point, done: int) -> None:
        where = "  ".join(fixed_number(MILLIMETRE.from_si(at), 4) for at in centre)
        count = f"{done:>{len(str(self._points))}}/{self._points}"
        print(f"  {count}  cycle {probing.cycle}  face {probing.face:>3}  {where} mm", flush=True)

    def missed(self, probing: Probing, error: MachineError) -> None:
        words = f"face {probing.face}, cycle {probing.cycle}: {visible(str(error))}"
        print(f"  {Colour.YELLOW.of('missed')}  {words}", flush=True)

    def told(self, text: str) -> None:
        print(f"  the machine says: {visible(text)}", flush=True)


class _JsonLines:
    """Prints what happens as JSON, a line each."""

    def begun(self, done: int, points: int) -> None:
        self._print({"event": "begun", "done": done, "points": points})

    def probed(self, probing: Probing, centre: Point, done: int) -> None:
        where = [MILLIMETRE.from_si(at) for at in centre]
        self._print(
            {"event": "probed", "face": probing.face, "cycle": probing.cycle, "to": where, "done": done}
        )

    def missed(self, probing: Probing, error: MachineError) -> None:
        self._print({"event": "missed", "face": probing.face, "cycle": probing.cycle, "error": error.number})

    def told(self, text: str) -> None:
        self._print({"event": "told", "text": text})

    @staticmethod
    def _print(values: dict[str, Any]) -> None:
        json.dump(values, sys.stdout)
        print(flush=True)
