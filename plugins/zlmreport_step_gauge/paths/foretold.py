"""What a planned path says of itself before it is run: in sentences, as JSON, as a table of its moves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from zlmreport.plugin import (
    MILLIMETRE,
    ExtensionPlan,
    InputError,
    Job,
    Language,
    fixed_number,
    general_number,
)
from zlmreport_step_gauge.keys import StepGaugeKeys
from zlmreport_step_gauge.paths.path import PathKind, Point, Probing, ProbingPath
from zlmreport_step_gauge.paths.plan import PlannedPath, path_of_job
from zlmreport_step_gauge.paths.room import least_gap

SCHEMA = "zlmreport/probing-path/1"
_MINUTE = 60.0
_KINDS = {
    PathKind.VERTICAL: "over the top of the blocks",
    PathKind.HORIZONTAL: "round the right side of the blocks, seen along the gauge",
}


def foretold(job: Job, keys: StepGaugeKeys) -> ExtensionPlan:
    """Return the plan of the path over the step gauge of a job; its points need not exist."""
    if "plan" in job.tree.entries:
        raise InputError.at(
            job.place_of("plan"),
            "plan is about a test of target positions, and this job has a step gauge, whose path is "
            "step_gauge.path; take one of them out",
        )
    planned = path_of_job(job, keys)
    path = planned.path
    faces = {probing.face for probing in path.probings}
    cycles = "1 cycle" if planned.settings.cycles == 1 else f"{planned.settings.cycles} cycles"
    return ExtensionPlan(
        heading=(path.number, f"{path.gauge}: {len(faces)} faces, {cycles}, {len(path.probings)} points"),
        parts=(
            ("gauge", f"faces {min(faces)} to {max(faces)}, mm", tuple(_of_gauge(planned))),
            (
                "path",
                f"{planned.settings.kind.value}, {_KINDS[planned.settings.kind]}",
                tuple(_of_path(planned)),
            ),
        ),
        values=_values(planned),
        subject=lambda place: replace(path, place=place),
        files=lambda: _files(planned, job.keys.certificate.language),
        files_in_words="a picture of the path",
        next_step="look at the picture, probe the gauge",
    )


def _files(planned: PlannedPath, language: Language) -> dict[str, str]:
    """Return the picture of the path, and its moves as a table."""
    from zlmreport_step_gauge.paths.picture import path_svg  # noqa: PLC0415 (brings the typeface)

    return {
        "path.svg": path_svg(planned, language),
        "path.csv": "".join(f"{line}\n" for line in _rows(planned.path)),
    }


def _rows(path: ProbingPath) -> Iterator[str]:
    yield "# moves of the tip's centre, and the points of the surface that measuring moves lead to, mm"
    yield "move,kind,face,cycle,x,y,z,i,j,k"
    for number, move in enumerate(path.moves, start=1):
        is_probing = isinstance(move, Probing)
        point = move.target if isinstance(move, Probing) else move.to
        normal = [f"{each:.7f}" for each in move.normal] if isinstance(move, Probing) else ["", "", ""]
        kind = "measure" if is_probing else "move"
        which = [str(each or "") for each in (move.face, move.cycle)]
        yield ",".join([str(number), kind, *which, *(f"{_mm(at):.5f}" for at in point), *normal])


def _of_gauge(planned: PlannedPath) -> Iterator[str]:
    path = planned.path
    last = max(probing.face for probing in path.probings)
    ends = [_said(probing.target) for probing in (path.probings[0], _of_face(path, last))]
    yield f"from {ends[0]} to {ends[1]}"
    yield f"direction ({', '.join(fixed_number(each, 6) for each in planned.frame.axes[0].tolist())})"


def _of_path(planned: PlannedPath) -> Iterator[str]:
    path = planned.path
    yield "each cycle takes front faces on the way forward and back faces on the way back"
    yield ", ".join(
        f"{name} {general_number(_mm(value))} mm"
        for name, value in (
            ("tip radius", path.tip_radius),
            ("clearance", planned.settings.clearance),
            ("approach", path.approach),
            ("retract", path.retract),
        )
    )
    gap, name = least_gap(path, planned.room)
    yield f"free of collisions: the tip stays {fixed_number(_mm(gap), 2)} mm from {name}"
    speed, measuring = (general_number(_mm(each)) for each in (path.speed, path.measuring_speed))
    minutes = max(1, round(path.duration / _MINUTE))
    yield (
        f"{len(path.moves)} moves, {fixed_number(path.length, 2)} m at {speed} mm/s, "
        f"measuring {measuring} mm/s: about {minutes} min"
    )


def _of_face(path: ProbingPath, face: int) -> Probing:
    return next(probing for probing in path.probings if probing.face == face)


def _said(point: Point) -> str:
    return f"({', '.join(fixed_number(_mm(at), 3) for at in point)})"


def _mm(length: float) -> float:
    return MILLIMETRE.from_si(length)


def _values(planned: PlannedPath) -> dict[str, Any]:
    """Return a path as plain values for JSON, mm and s."""
    path = planned.path
    gap, name = least_gap(path, planned.room)
    return {
        "schema": SCHEMA,
        "certificate": {"number": path.number},
        "gauge": path.gauge,
        "units": {"position": "mm", "time": "s"},
        "kind": planned.settings.kind.value,
        "cycles": planned.settings.cycles,
        "faces": sorted({probing.face for probing in path.probings}),
        "direction": planned.frame.axes[0].tolist(),
        "travelled": _mm(path.length),
        "duration": path.duration,
        "least_gap": {"value": _mm(gap), "beside": name},
        "moves": [
            {
                "kind": "measure" if isinstance(move, Probing) else "move",
                "face": move.face or None,
                "cycle": move.cycle or None,
                "to": [_mm(at) for at in (move.target if isinstance(move, Probing) else move.to)],
                "normal": list(move.normal) if isinstance(move, Probing) else None,
            }
            for move in path.moves
        ],
    }
