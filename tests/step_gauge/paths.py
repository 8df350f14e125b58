"""Paths over gauges that lie anywhere, for the tests of planning and of what is made of a plan."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from zlmreport.plugin import Place
from zlmreport_step_gauge.gauge import Face, GaugeLocation, Side, StepGauge
from zlmreport_step_gauge.paths.path import PathKind, PathSettings, Point
from zlmreport_step_gauge.paths.plan import PlannedPath, plan_path

PLACE = Place("job.yaml", 8, 3)
#: 10 mm blocks of 10 mm × 10 mm every 20 mm, a tip of 4 mm.
SETTINGS = PathSettings(
    kind=PathKind.VERTICAL,
    clearance=3e-3,
    approach=2.5e-3,
    search=4e-3,
    retract=2e-3,
    depth=None,
    lead_in=0.0,
    cycles=1,
    tip_radius=2e-3,
    stylus_allowance=0.5e-3,
    speed=0.03,
    measuring_speed=0.003,
    radius_correction=False,
)
#: Along x, y, z, and along a diagonal of the volume; what looks out of the top.
ORIENTATIONS = {
    "x": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "y": ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
    "z": ((0.0, 0.0, 1.0), (0.0, -1.0, 0.0)),
    "against y": ((0.0, -1.0, 0.0), (0.0, 0.0, 1.0)),
    "diagonal": ((2 / 3, 1 / 3, 2 / 3), (-2 / 3, 2 / 3, 1 / 3)),
}


def step_gauge(blocks: int, pitch: float = 0.02) -> StepGauge:
    """Return a gauge of so many blocks of half a pitch."""
    faces = tuple(
        Face(index + 1, Side.BACK if index % 2 else Side.FRONT, index * pitch / 2, index * pitch / 2, 2e-7)
        for index in range(2 * blocks)
    )
    return StepGauge("Gauge", "7", "", faces, None, None, 293.15, 0.01, 0.01, PLACE)


def part(gauge: StepGauge, first: int, last: int) -> StepGauge:
    """Return some blocks of a gauge."""
    return replace(gauge, faces=tuple(face for face in gauge.faces if first <= face.block <= last))


def location(begin: Point, direction: Point, upward: Point, length: float) -> GaugeLocation:
    """Return a location: a gauge of a length from its first to its last block's centre."""
    unit = np.array(direction) / np.linalg.norm(direction)
    x, y, z = (np.array(begin) + length * unit).tolist()
    i, j, k = unit.tolist()
    return GaugeLocation(begin, (x, y, z), (i, j, k), upward, 0.0)


def planned(
    *,
    blocks: int = 4,
    section: tuple[int, int] | None = None,
    begin: Point = (0.3, 0.2, 0.2),
    orientation: str = "y",
    **changes: Any,
) -> PlannedPath:
    """Return a planned path; `changes` are those of `SETTINGS`."""
    gauge = step_gauge(blocks)
    first, last = section or (1, blocks)
    direction, upward = ORIENTATIONS[orientation]
    return plan_path(
        gauge,
        part(gauge, first, last),
        location(begin, direction, upward, 0.02 * (last - first)),
        replace(SETTINGS, **changes),
        size=(0.01, 0.01),
        number="P-1",
        place=PLACE,
    )
