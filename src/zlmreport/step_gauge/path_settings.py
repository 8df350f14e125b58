"""How the faces of a step gauge are to be probed."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from zlmreport.step_gauge.path import Point


class PathKind(Enum):
    """How the probe goes from face to face."""

    VERTICAL = "vertical"
    HORIZONTAL = "horizontal"


@dataclass(frozen=True, slots=True)
class PathSettings:
    """How faces are probed. Lengths in m; distances are of the tip's surface.

    Attributes
    ----------
    kind
        Over the top, or round the side (the right one of who looks along the gauge).
    clearance
        Distance from the blocks while the tip passes them.
    approach, search, retract
        As those of `ProbingPath`.
    depth
        How far below the top of the blocks their faces are probed; None for half their height.
    lead_in
        How far before the first face a path round the side comes into the line of the gauge; 0 if it comes
        from the side.
    cycles
        How often each face is probed.
    tip_radius
        Nominal.
    stylus_allowance
        What must stay free between the tip and everything that it does not measure.
    speed, measuring_speed
        m/s.
    radius_correction
        As that of `ProbingPath`.
    safe_position
        Where the path begins and ends; None for over the first face and over the last one that is probed.
    working_volume
        What the tip's centre can reach: first and last position in x, y and z; None for anywhere.
    """

    kind: PathKind
    clearance: float
    approach: float
    search: float
    retract: float
    depth: float | None
    lead_in: float
    cycles: int
    tip_radius: float
    stylus_allowance: float
    speed: float
    measuring_speed: float
    radius_correction: bool
    safe_position: Point | None = None
    working_volume: tuple[tuple[float, float], tuple[float, float], tuple[float, float]] | None = None
