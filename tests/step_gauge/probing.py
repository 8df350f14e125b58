"""Points on the faces of a gauge that lies along x and begins at x = 100 mm."""

from __future__ import annotations

from collections.abc import Callable

from zlmreport.plugin import Place
from zlmreport_step_gauge.deviations import Deviations, compute_deviations_of
from zlmreport_step_gauge.gauge import Side, StepGauge
from zlmreport_step_gauge.probed import Probed, ProbedPoint, arrange_on_grid
from zlmreport_step_gauge.set_up import GaugeSetUp

FILE = Place("probed.csv")
#: The true effective radius, m.
RADIUS = 1.9985e-3


def no_error(position: float, side: Side) -> float:  # noqa: ARG001 - as every error
    return 0.0


def touched(
    gauge: StepGauge,
    error: Callable[[float, Side], float] = no_error,
    cycles: int = 2,
    radius: float = RADIUS,
    growth: float = 0.0,
) -> list[ProbedPoint]:
    """Return the centres of the tip on a machine with an error of position and direction, m."""
    found = []
    for cycle in range(1, cycles + 1):
        for face in gauge.faces:
            at = 0.1 + face.distance * (1 + growth)
            x = at + face.side * radius + error(at, face.side)
            place = Place(FILE.file, len(found) + 2, 1)
            found.append(ProbedPoint(place, face.number, cycle, (x, 0.2, 0.3)))
    return found


def probed(points: list[ProbedPoint], gauge: StepGauge, *sides: Side) -> Probed:
    return arrange_on_grid(points, gauge, sides or tuple(Side), place=FILE)


def deviations(points: list[ProbedPoint], set_up: GaugeSetUp, *sides: Side) -> Deviations:
    return compute_deviations_of(probed(points, set_up.gauge, *sides), set_up, FILE, is_corrected=False)
