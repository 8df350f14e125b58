"""Commands of live probing: what is told meanwhile, and the one that emulates a machine."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from zlmreport.plugin import (
    MICROMETRE,
    MILLIMETRE,
    InputError,
    Place,
    counted,
    did_you_mean,
    fixed_number,
    general_number,
    quoted,
)
from zlmreport.plugin.extension import Command, CommandHost, CommandOption, Happening, LiveRun
from zlmreport_step_gauge.keys import STANDARD_PORT
from zlmreport_step_gauge.machines.emulated import make_machine_of_job
from zlmreport_step_gauge.machines.run import LiveProbing, run_probing
from zlmreport_step_gauge.machines.server import DmeServer, PointFault
from zlmreport_step_gauge.machines.session import MachineError
from zlmreport_step_gauge.paths.path import Point, Probing

#: As the command line names the machine.
IPPDME = "ippdme"
_WHOLE_NUMBER = re.compile("[0-9]{1,9}")
_PER_METRE = 1e-6  # of µm/m


def make_live_run(probing: LiveProbing) -> LiveRun:
    """Return a run of a machine as ``zlmreport capture`` shows it."""
    machine = probing.machine
    return LiveRun(
        heading=f"{machine.host}:{machine.port}  {probing.planned.path.gauge}; Ctrl-C stops the machine",
        run=lambda tell: run_probing(probing, _Told(tell)),
        without_journal="with a step gauge: its points stand beside the job's file of points until all are "
        "there",
    )


class _Told:
    """Makes happenings of what a run tells."""

    def __init__(self, tell: Callable[[Happening], None]) -> None:
        self._tell = tell
        self._points = 0

    def note_begin(self, done: int, points: int) -> None:
        self._points = points
        line = f"{counted(points, 'point')}{f', {done} of them probed already' if done else ''}"
        self._tell(Happening({"event": "begun", "done": done, "points": points}, line))

    def note_probed(self, probing: Probing, centre: Point, done: int) -> None:
        to = [MILLIMETRE.from_si(at) for at in centre]
        where = "  ".join(fixed_number(at, 4) for at in to)
        count = f"{done:>{len(str(self._points))}}/{self._points}"
        values = {"event": "probed", "face": probing.face, "cycle": probing.cycle, "to": to, "done": done}
        line = f"  {count}  cycle {probing.cycle}  face {probing.face:>3}  {where} mm"
        self._tell(Happening(values, line))

    def note_missed(self, probing: Probing, error: MachineError) -> None:
        values = {"event": "missed", "face": probing.face, "cycle": probing.cycle, "error": error.number}
        line = f"face {probing.face}, cycle {probing.cycle}: {error}"
        self._tell(Happening(values, line, warning="missed"))

    def note_told(self, text: str) -> None:
        self._tell(Happening({"event": "told", "text": text}, f"  the machine says: {text}"))


def _emulate(values: Mapping[str, Any], host: CommandHost) -> int:
    """Emulate the machine until its connection is cut, or the user ends it."""
    if values["job"] is None:
        raise InputError.at(
            Place("zlmreport emulate"),
            f"{IPPDME} needs the job whose gauge lies on it: --job JOB.yaml; its TCP port is {STANDARD_PORT} "
            "without --port",
        )
    job = host.load(values["job"])
    scale_error = values["scale-error"]
    machine = make_machine_of_job(
        job, scale_error=scale_error * _PER_METRE, noise=MICROMETRE.to_si(values["noise"])
    )
    tool = getattr(getattr(job.source.options, "machine", None), "tool", None)
    server = DmeServer(machine, ("RefTool", *([tool] if tool else [])), dict(values["point-fault"]))
    announced = (
        f"{IPPDME}: coordinate measuring machine, I++ DME, emulated",
        "port: {address}",
        f"scale error: {general_number(scale_error)} µm/m along the gauge; Ctrl-C ends",
    )
    return host.serve(server, STANDARD_PORT, announced, lambda: server.is_gone)


def _read_number(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ValueError(f"{quoted(text)} is no number; write such as 5")
    return value


def _read_noise(text: str) -> float:
    value = _read_number(text)
    if value < 0:
        raise ValueError(f"{quoted(text)} is negative, and no standard deviation is; write such as 0.05")
    return value


def _point_fault(text: str) -> tuple[int, PointFault]:
    """Read a fault of a coordinate measuring machine and the measuring move at which it happens."""
    kind, _, number = text.partition("@")
    known = [each.value for each in PointFault]
    if kind not in known:
        raise ValueError(f"{quoted(kind)} is no fault; {did_you_mean(kind, known)}")
    if not (_WHOLE_NUMBER.fullmatch(number) and int(number)):
        raise ValueError(f"{quoted(text)} does not say at which move; write such as {kind}@7")
    return int(number), PointFault(kind)


EMULATE = Command(
    words=f"emulate {IPPDME}",
    description="Put a coordinate measuring machine that is not there on a TCP port of this computer. It\n"
    "speaks I++ DME, and on it lies the step gauge of a job, where its initial points say. It runs\n"
    "until Ctrl-C.",
    examples="example:\n  zlmreport emulate ippdme --job gauge.yaml --scale-error 5",
    options=(
        CommandOption(
            "job",
            "JOB.yaml",
            f"the job whose step gauge lies on the machine; its port is {STANDARD_PORT} without --port",
            Path,
        ),
        CommandOption(
            "scale-error",
            "E",
            "error of the machine along the gauge, micrometres a metre; 0 without it",
            _read_number,
            0.0,
        ),
        CommandOption(
            "noise",
            "U",
            "standard deviation of a coordinate, micrometres; 0.05 without it",
            _read_noise,
            0.05,
        ),
        CommandOption(
            "point-fault",
            "KIND@N",
            f"what goes wrong at the N-th measuring move: {', '.join(PointFault)}; may be given several "
            "times",
            _point_fault,
            several=True,
        ),
    ),
    run=_emulate,
)
