"""An emulated machine on a TCP port of this computer, and who watches a run on it."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field

from processes import PATIENCE
from step_gauge.paths import planned
from zlmreport.live.emulation.channels import LocalSocket, serve
from zlmreport.live.emulation.troubles import Troubles
from zlmreport_step_gauge.machines.emulated import Boxes, CoordinateMachine
from zlmreport_step_gauge.machines.server import DmeServer, PointFault
from zlmreport_step_gauge.machines.session import MachineError
from zlmreport_step_gauge.paths.path import Point, Probing
from zlmreport_step_gauge.paths.plan import PlannedPath

RADIUS = 1.9985e-3


def machine(path: PlannedPath, radius: float = RADIUS) -> CoordinateMachine:
    """Return a machine on which the gauge of a path lies, its blocks where the path expects them."""
    boxes = path.obstacles
    return CoordinateMachine(
        Boxes(path.frame.origin, path.frame.axes, boxes.lower, boxes.upper), effective_radius=radius
    )


def small_path() -> PlannedPath:
    """Return the path over two blocks."""
    return planned(blocks=2, safe_position=(0.0, 0.0, 0.4))


@contextmanager
def on_a_port(server: DmeServer) -> Iterator[int]:
    """Serve until the context is left, or the connection is cut; the value is the port."""
    over = threading.Event()
    with LocalSocket(0) as channel:

        def run() -> None:
            serve(server, channel, Troubles(), is_over=lambda: over.is_set() or server.is_gone)
            channel.close()

        thread = threading.Thread(target=run, daemon=True)
        thread.start()
        try:
            yield int(channel.address.rpartition(":")[2])
        finally:
            over.set()
            thread.join(PATIENCE)


@dataclass
class Notes:
    """Writes down what it hears."""

    begun_with: list[tuple[int, int]] = field(default_factory=list)
    points: list[tuple[int, int, Point]] = field(default_factory=list)
    missing: list[tuple[int, int, int]] = field(default_factory=list)
    heard: list[str] = field(default_factory=list)

    def note_begin(self, done: int, points: int) -> None:
        self.begun_with.append((done, points))

    def note_probed(self, probing: Probing, centre: Point, done: int) -> None:
        assert done
        self.points.append((probing.face, probing.cycle, centre))

    def note_missed(self, probing: Probing, error: MachineError) -> None:
        self.missing.append((probing.face, probing.cycle, error.number))

    def note_told(self, text: str) -> None:
        self.heard.append(text)


def server(path: PlannedPath, **faults: int) -> DmeServer:
    """Return a server; faults by their names, with the measuring move at which each happens."""
    by_number = {number: PointFault(name.replace("_", "-")) for name, number in faults.items()}
    return DmeServer(machine(path), faults=by_number)
