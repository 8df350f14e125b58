"""An emulated measuring machine with a step gauge on it: its errors, its travel, what its probe touches.

The machine has errors: what it shows of a point is not where the point is. Its probe touches boxes, which
stand anywhere in its volume. A touch is found from the sphere and the boxes themselves, and no knowledge of a
planned path is in it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from random import Random
from typing import TypeAlias

import numpy as np

from zlmreport.plugin import FloatArray, InputError
from zlmreport.plugin.extension import Job
from zlmreport_step_gauge.calibration import read_calibration
from zlmreport_step_gauge.gauge import StepGauge
from zlmreport_step_gauge.paths.plan import PlannedPath, plan_path_of_job

#: Returns the error of the machine at true points, shape (..., 3), m: what is shown − where it is.
Errors: TypeAlias = Callable[[FloatArray], FloatArray]

#: Halvings of a move until a touch is found: 10⁻¹² of its length.
_HALVINGS = 40


def _give_no_errors(points: FloatArray) -> FloatArray:
    return np.zeros_like(points)


def make_errors_along(
    direction: FloatArray, origin: FloatArray, positions: FloatArray, deviations: FloatArray
) -> Errors:
    """Return errors that act along a line.

    `direction`, (3,): Of the line, a unit vector.
    `origin`, (3,): Where the positions count from, m.
    `positions`, `deviations`, (m,): Along the line, m; between them the deviation is interpolated, beyond it
        stays.
    """

    def errors(points: FloatArray) -> FloatArray:
        along = (points - origin) @ direction
        found: FloatArray = np.interp(along, positions, deviations)[..., None] * direction
        return found

    return errors


@dataclass(frozen=True, slots=True)
class Boxes:
    """Boxes that stand alike."""

    origin: FloatArray  #: (3,): Of their own coordinates, m.
    axes: FloatArray  #: (3, 3): Rows: the unit vectors of their own coordinates.
    #: lower and upper: (b, 3): Corners in their own coordinates, m.
    lower: FloatArray
    upper: FloatArray

    def measure_distance(self, point: FloatArray) -> float:
        """Return the distance of a point from the nearest box, m; 0 inside one."""
        own = self.axes @ (point - self.origin)
        outside = np.maximum(np.maximum(self.lower - own, own - self.upper), 0.0)
        return float(np.sqrt((outside**2).sum(axis=1)).min())


@dataclass(slots=True)
class CoordinateMachine:
    """The machine."""

    boxes: Boxes  #: What stands on it.
    errors: Errors = _give_no_errors  #: Of the machine.
    effective_radius: float = 2e-3  #: Of the tip when it touches, m.
    noise: float = 0.0  #: Standard deviation of a coordinate at a touch, m.
    #: First and last position in x, y and z, m.
    volume: tuple[tuple[float, float], ...] = ((-10.0, 10.0),) * 3
    #: (3,): Of the tip's centre, as the machine shows it, m.
    position: FloatArray = field(default_factory=lambda: np.zeros(3))
    seed: int = 1
    _random: Random = field(init=False)

    def __post_init__(self) -> None:
        self._random = Random(self.seed)  # noqa: S311 - no secret

    def can_reach(self, point: FloatArray) -> bool:
        """Return whether a point lies in the volume."""
        return all(low <= at <= high for at, (low, high) in zip(point.tolist(), self.volume, strict=True))

    def travel(self, to: FloatArray) -> bool:
        """Go straight to a point; return whether nothing was touched. The tip stays where it touched."""
        touched = self._find_first_touch(self.position, to)
        self.position = to if touched is None else touched
        return touched is None

    def probe(self, to: FloatArray) -> FloatArray | None:
        """Go slowly to a point until something is touched; return the tip's centre there, as it is shown."""
        touched = self._find_first_touch(self.position, to)
        self.position = to if touched is None else touched
        if touched is None:
            return None
        scattered = [self._random.gauss(at, self.noise) for at in touched.tolist()]
        return np.array(scattered)

    def _find_true(self, shown: FloatArray) -> FloatArray:
        """Return where the tip is when the machine shows a position: errors change little over errors."""
        return shown - self.errors(shown - self.errors(shown))

    def _find_first_touch(self, start: FloatArray, end: FloatArray) -> FloatArray | None:
        """Return the position shown at the first touch on a move; None if there is none.

        The move is looked at in steps of half the radius, between which no box can hide.
        """
        steps = max(1, int(np.ceil(np.linalg.norm(end - start) / (self.effective_radius / 2))))
        before = 0.0
        for share in np.linspace(0.0, 1.0, steps + 1)[1:].tolist():
            if self._measure_gap(start + share * (end - start)) < 0:
                return self._halve(start, end, before, share)
            before = share
        return None

    def _halve(self, start: FloatArray, end: FloatArray, free: float, touching: float) -> FloatArray:
        for _ in range(_HALVINGS):
            middle = (free + touching) / 2
            if self._measure_gap(start + middle * (end - start)) < 0:
                touching = middle
            else:
                free = middle
        return start + free * (end - start)

    def _measure_gap(self, shown: FloatArray) -> float:
        return self.boxes.measure_distance(self._find_true(shown)) - self.effective_radius


#: By how much the tip seems smaller than it is, since the stylus bends until the probe triggers, m.
PRETRAVEL = 1.5e-6
#: Errors hold as far as any machine reaches, m.
_FAR = 100.0


def make_machine_of_job(job: Job, *, scale_error: float, noise: float) -> CoordinateMachine:
    """Return the machine.

    `job`: With a step gauge that is located by initial points; its faces stand where they were calibrated.
    `scale_error`: Of the machine along the gauge: what is shown − where it is, over the distance from the
        first block.
    `noise`: Standard deviation of a coordinate, m.

    Raises `AccessError` if a file of the gauge cannot be read; `InputError` if the path cannot be planned.
    """
    keys = job.own_keys("step_gauge")
    if keys is None:
        raise InputError.at(job.place_of("step_gauge"), "there is no step gauge; state step_gauge")
    planned = plan_path_of_job(job, keys)
    gauge = read_calibration(keys.calibration).gauge
    machine = CoordinateMachine(
        boxes=_make_boxes(gauge, planned),
        errors=make_errors_along(
            planned.frame.axes[0],
            planned.frame.origin,
            np.array([-_FAR, _FAR]),
            np.array([-_FAR, _FAR]) * scale_error,
        ),
        effective_radius=planned.path.tip_radius - PRETRAVEL,
        noise=noise,
    )
    volume = planned.settings.working_volume
    if volume is not None:
        machine.volume = volume
    machine.position = np.array(planned.path.stops[0])
    return machine


def _make_boxes(gauge: StepGauge, planned: PlannedPath) -> Boxes:
    """Return the blocks with their faces where they were calibrated, and the base."""
    lower, upper = planned.obstacles.lower.copy(), planned.obstacles.upper.copy()
    ends = {block: _find_ends(gauge, block) for block in planned.obstacles.blocks}
    first = planned.path.probings[0].face
    origin = sum(ends[(first + 1) // 2]) / 2
    for index, (low, high) in enumerate(ends.values()):
        lower[index, 0], upper[index, 0] = low - origin, high - origin
    return Boxes(planned.frame.origin, planned.frame.axes, _keep(lower), _keep(upper))


def _find_ends(gauge: StepGauge, block: int) -> tuple[float, float]:
    low, high = sorted(face.distance for face in gauge.faces if face.block == block)
    return low, high


def _keep(array: FloatArray) -> FloatArray:
    array.setflags(write=False)
    return array
