"""Small probing paths, for the checks of probing programs."""

from __future__ import annotations

from zlmreport.errors import Place
from zlmreport.quantities.temperature import REFERENCE_TEMPERATURE
from zlmreport.step_gauge.gauge import Face, Location, Side, StepGauge
from zlmreport.step_gauge.path import ProbingPath
from zlmreport.step_gauge.path_plan import plan_path
from zlmreport.step_gauge.path_settings import PathKind, PathSettings

#: Where the kit asks for a program.
PLACE = Place("job.yaml", 14, 9)
_STEP = 0.01
#: Not along an axis of the machine: 2, 1, 2 over 3, and a top that looks as far upwards as it can.
_DIRECTION = (2 / 3, 1 / 3, 2 / 3)
_UPWARD = (-2 / 3, 2 / 3, 1 / 3)


def sample_path(
    kind: PathKind = PathKind.VERTICAL,
    *,
    number: str = "KIT-7",
    gauge: str = "Step gauge",
    radius_correction: bool = False,
) -> ProbingPath:
    """Return the path over three blocks of 10 mm, two cycles, askew in the machine.

    Parameters
    ----------
    kind
        Over the top, or round the side.
    number
        Of the job.
    gauge
        Name of the gauge.
    radius_correction
        Whether the machine is to report points of the surface.
    """
    faces = tuple(
        Face(index + 1, Side.BACK if index % 2 else Side.FRONT, index * _STEP, index * _STEP, 2e-7)
        for index in range(6)
    )
    whole = StepGauge(gauge, "", "", faces, None, None, REFERENCE_TEMPERATURE, _STEP, _STEP, PLACE)
    begin = (0.3, 0.04, 0.2)
    x, y, z = (at + 4 * _STEP * by for at, by in zip(begin, _DIRECTION, strict=True))
    front, back = tuple(-each for each in _DIRECTION), _DIRECTION
    location = Location(begin, (x, y, z), _DIRECTION, _UPWARD, (front[0], front[1], front[2]), back, 1e-5)
    settings = PathSettings(
        kind=kind,
        clearance=5e-3,
        approach=2.5e-3,
        search=4e-3,
        retract=2e-3,
        depth=None,
        lead_in=0.0,
        cycles=2,
        tip_radius=2e-3,
        stylus_allowance=5e-4,
        speed=0.03,
        measuring_speed=0.003,
        radius_correction=radius_correction,
        safe_position=(0.0, 0.0, 0.4),
    )
    return plan_path(whole, whole, location, settings, size=(_STEP, _STEP), number=number, place=PLACE).path
