"""The machine that is not there for a job: its step gauge lies where the job's initial points say."""

from __future__ import annotations

import numpy as np

from zlmreport.emulation.coordinate_machine import Boxes, CoordinateMachine, errors_along
from zlmreport.errors import InputError
from zlmreport.job.job import Job
from zlmreport.quantities.arrays import FloatArray
from zlmreport.step_gauge.calibration_file import read_calibration
from zlmreport.step_gauge.gauge import StepGauge
from zlmreport.step_gauge.path_of_job import path_of_job
from zlmreport.step_gauge.path_plan import PlannedPath

#: By how much the tip seems smaller than it is, since the stylus bends until the probe triggers, m.
PRETRAVEL = 1.5e-6
#: Errors hold as far as any machine reaches, m.
_FAR = 100.0


def machine_of_job(job: Job, *, scale_error: float, noise: float) -> CoordinateMachine:
    """Return the machine.

    Parameters
    ----------
    job
        With a step gauge that is located by initial points; its faces stand where they were calibrated.
    scale_error
        Of the machine along the gauge: what is shown − where it is, over the distance from the first block.
    noise
        Standard deviation of a coordinate, m.

    Raises
    ------
    AccessError
        If a file of the gauge cannot be read.
    InputError
        If the path cannot be planned.
    """
    planned = path_of_job(job)
    keys = job.keys.step_gauge
    if keys is None:
        raise InputError.at(job.place_of("step_gauge"), "there is no step gauge; state step_gauge")
    gauge = read_calibration(keys.calibration).gauge
    machine = CoordinateMachine(
        boxes=_boxes(gauge, planned),
        errors=errors_along(
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


def _boxes(gauge: StepGauge, planned: PlannedPath) -> Boxes:
    """Return the blocks with their faces where they were calibrated, and the base."""
    lower, upper = planned.obstacles.lower.copy(), planned.obstacles.upper.copy()
    ends = {block: _ends(gauge, block) for block in planned.obstacles.blocks}
    first = planned.path.probings[0].face
    origin = sum(ends[(first + 1) // 2]) / 2
    for index, (low, high) in enumerate(ends.values()):
        lower[index, 0], upper[index, 0] = low - origin, high - origin
    return Boxes(planned.frame.origin, planned.frame.axes, _kept(lower), _kept(upper))


def _ends(gauge: StepGauge, block: int) -> tuple[float, float]:
    low, high = sorted(face.distance for face in gauge.faces if face.block == block)
    return low, high


def _kept(array: FloatArray) -> FloatArray:
    array.setflags(write=False)
    return array
