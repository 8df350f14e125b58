"""Motions of small planned tests, for the checks of part programs."""

from __future__ import annotations

from zlmreport.errors import Place
from zlmreport.measurement.axis import Axis
from zlmreport.planning.methods import Method
from zlmreport.planning.plan import Plan
from zlmreport.planning.programs import Motion, motion_of
from zlmreport.quantities.arrays import read_only_floats

#: Of the job, as it must stand in every program.
NUMBER = "KIT-7"
#: Where the kit asks for a program.
PLACE = Place("job.yaml", 12, 15)
_TARGETS = (-20.5, 3.125, 30.002, 58.25)


def sample_motion(
    method: Method = Method.LINEAR,
    *,
    axis: Axis | None = None,
    targets: tuple[float, ...] = _TARGETS,
    runs: int = 2,
    overrun: float = 5.0,
) -> Motion:
    """Return the motion of a test at 1500 mm/min (°/min) with 3.5 s at rest.

    Parameters
    ----------
    method
        The positioning method.
    axis
        A linear one, X, if it is not given.
    targets, overrun
        mm or °.
    runs
        How often each target is read in each direction.
    """
    axis = axis or Axis("X")
    to_si = axis.position_unit.to_si
    plan = Plan(
        targets=read_only_floats([to_si(target) for target in targets]),
        method=method,
        runs=runs,
        overrun=to_si(overrun),
        feed=to_si(1500.0) / 60,
        dwell=3.5,
    )
    return motion_of(NUMBER, axis, plan, PLACE)
