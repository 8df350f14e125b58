"""The probing path that a job asks for."""

from __future__ import annotations

from zlmreport.errors import InputError, Problem
from zlmreport.job.job import Job
from zlmreport.job.step_gauge_keys import ProbingPathKeys, StepGaugeKeys
from zlmreport.quantities.units import MICROMETRE, MILLIMETRE
from zlmreport.step_gauge.calibration_file import read_calibration, section
from zlmreport.step_gauge.initial_points import read_initial_points
from zlmreport.step_gauge.location import locate
from zlmreport.step_gauge.path_plan import PlannedPath, plan_path
from zlmreport.step_gauge.path_settings import PathKind, PathSettings


def path_of_job(job: Job) -> PlannedPath:
    """Return the path over the step gauge of a job.

    Raises
    ------
    AccessError
        If a file cannot be read.
    InputError
        If the job says too little, the gauge cannot be located, or the path is not free.
    """
    keys = job.keys.step_gauge
    place = job.place_of("step_gauge")
    if keys is None:
        raise InputError.at(place, "there is no step gauge; state step_gauge")
    missing = {
        "initial_points": "where the gauge lies is not stated; state step_gauge.initial_points",
        "tip_radius": "the tip is not stated; state step_gauge.tip_radius",
    }
    problems = [Problem(place, text) for name, text in missing.items() if getattr(keys, name) is None]
    if problems or keys.initial_points is None or keys.tip_radius is None:
        raise InputError(problems)
    gauge = read_calibration(keys.calibration).gauge
    part = section(gauge, keys.first_block, keys.last_block, place)
    radius = MILLIMETRE.to_si(keys.tip_radius)
    located = locate(
        read_initial_points(keys.initial_points),
        part,
        0.0 if keys.radius_correction else radius,
        MICROMETRE.to_si(keys.initial_points_uncertainty),
    )
    touched = (located.begin, located.end)
    return plan_path(
        gauge,
        part,
        located.location,
        _settings(keys, keys.path, radius),
        size=(
            gauge.block_width or max(float(block.width) for block in touched),
            gauge.block_height or max(float(block.height) for block in touched),
        ),
        number=job.keys.certificate.number,
        place=job.place_of("step_gauge.path"),
    )


def _settings(keys: StepGaugeKeys, path: ProbingPathKeys, radius: float) -> PathSettings:
    metres = MILLIMETRE.to_si
    safe, volume = path.safe_position, path.working_volume
    return PathSettings(
        kind=PathKind(path.kind),
        clearance=metres(path.clearance),
        approach=metres(path.approach),
        search=metres(path.search),
        retract=metres(path.retract),
        depth=None if path.depth is None else metres(path.depth),
        lead_in=metres(path.lead_in or 0.0),
        cycles=path.cycles,
        tip_radius=radius,
        stylus_allowance=metres(path.stylus_allowance),
        speed=metres(path.speed),
        measuring_speed=metres(path.measuring_speed),
        radius_correction=keys.radius_correction,
        safe_position=None if safe is None else (metres(safe[0]), metres(safe[1]), metres(safe[2])),
        working_volume=None
        if volume is None
        else (
            (metres(volume[0][0]), metres(volume[0][1])),
            (metres(volume[1][0]), metres(volume[1][1])),
            (metres(volume[2][0]), metres(volume[2][1])),
        ),
    )
