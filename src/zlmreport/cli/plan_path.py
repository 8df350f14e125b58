"""``zlmreport plan`` for a job with a step gauge: the path of the probe before it is run."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from zlmreport.cli.plan_files import chosen_programs
from zlmreport.cli.terminal import Colour, print_json, shown_path, wrapped
from zlmreport.errors import InputError, Problem
from zlmreport.files import Document, demand_free, write
from zlmreport.job.choices import ProgramChoice
from zlmreport.job.job import Job
from zlmreport.plugins import Registry
from zlmreport.quantities.formatting import fixed_number, general_number
from zlmreport.quantities.units import MILLIMETRE
from zlmreport.step_gauge.path import Point, Probing, ProbingPath
from zlmreport.step_gauge.path_of_job import path_of_job
from zlmreport.step_gauge.path_plan import PlannedPath
from zlmreport.step_gauge.path_safety import least_gap
from zlmreport.step_gauge.path_settings import PathKind

SCHEMA = "zlmreport/probing-path/1"
_MINUTE = 60.0
_KINDS = {
    PathKind.VERTICAL: "over the top of the blocks",
    PathKind.HORIZONTAL: "round the right side of the blocks, seen along the gauge",
}


def run_path(options: Namespace, job: Job, registry: Registry) -> int:
    """Plan the path over the step gauge of a job; its points need not exist."""
    if "plan" in job.tree.entries:
        raise InputError.at(
            job.place_of("plan"),
            "plan is about a test of target positions, and this job has a step gauge, whose path is "
            "step_gauge.path; take one of them out",
        )
    programs = chosen_programs(
        options.program, options.output, job.probing_programs, registry.probing_program, "dmis,ippdme"
    )
    planned = path_of_job(job)
    documents: tuple[Document, ...] = ()
    if options.output:
        documents = (
            *_files(options.output, job, planned),
            *_program_files(options.output, planned.path, programs, registry),
        )
    demand_free(document.path for document in documents)
    written = write(documents)
    if options.json:
        print_json(_values(planned, written))
        return 0
    print(*_lines(planned), sep="\n")
    print()
    if not options.output:
        names = ", ".join(each.identifier for each in programs)
        wait = f", probing programs for {names}" if names else ""
        print(f"a picture of the path{wait}: state a folder, --output DIR")
    for path in written:
        print(shown_path(path))
    print(f"next: look at the picture, probe the gauge, then zlmreport {shown_path(options.job)}")
    return 0


def _files(folder: Path, job: Job, planned: PlannedPath) -> tuple[Document, ...]:
    """Return the picture of the path, and its moves as a table."""
    from zlmreport.figures.draw_path import path_svg  # noqa: PLC0415 (brings the typeface)

    keys = job.keys.certificate
    texts = {
        "path.svg": path_svg(planned, keys.language),
        "path.csv": "".join(f"{line}\n" for line in _rows(planned.path)),
    }
    return tuple(Document(folder / f"{keys.number}-{name}", text.encode()) for name, text in texts.items())


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


def _program_files(
    folder: Path, path: ProbingPath, choices: Sequence[ProgramChoice], registry: Registry
) -> Iterator[Document]:
    """Yield the files of probing programs; refuse everything that one cannot say, at once."""
    problems: list[Problem] = []
    texts: list[Document] = []
    for choice in choices:
        program = registry.probing_program(choice.identifier)
        try:
            text = program.write(replace(path, place=choice.place), choice.options)
        except InputError as error:
            problems.extend(error.problems)
            continue
        texts.append(Document(folder / f"{path.number}{program.suffix}", text.encode("ascii")))
    if problems:
        raise InputError(problems)
    yield from texts


def _lines(planned: PlannedPath) -> Iterator[str]:
    path, settings = planned.path, planned.settings
    faces = sorted({probing.face for probing in path.probings})
    cycles = "1 cycle" if settings.cycles == 1 else f"{settings.cycles} cycles"
    count = f"{len(faces)} faces, {cycles}, {len(path.probings)} points"
    yield f"{Colour.BOLD.of(path.number)}  {path.gauge}: {count}"
    yield ""
    yield f"{Colour.BOLD.of('gauge')}  faces {faces[0]} to {faces[-1]}, mm"
    ends = [_said(probing.target) for probing in (path.probings[0], _of_face(path, faces[-1]))]
    axis = ", ".join(fixed_number(each, 6) for each in planned.frame.axes[0].tolist())
    yield from wrapped(f"from {ends[0]} to {ends[1]}")
    yield from wrapped(f"direction ({axis})")
    yield ""
    yield f"{Colour.BOLD.of('path')}  {settings.kind.value}, {_KINDS[settings.kind]}"
    yield from wrapped("each cycle takes front faces on the way forward and back faces on the way back")
    distances = ", ".join(
        f"{name} {general_number(_mm(value))} mm"
        for name, value in (
            ("tip radius", path.tip_radius),
            ("clearance", settings.clearance),
            ("approach", path.approach),
            ("retract", path.retract),
        )
    )
    yield from wrapped(distances)
    gap, name = least_gap(path, planned.room)
    yield from wrapped(f"free of collisions: the tip stays {fixed_number(_mm(gap), 2)} mm from {name}")
    speed, measuring = (general_number(_mm(each)) for each in (path.speed, path.measuring_speed))
    minutes = max(1, round(path.duration / _MINUTE))
    yield from wrapped(
        f"{len(path.moves)} moves, {fixed_number(path.length, 2)} m at {speed} mm/s, "
        f"measuring {measuring} mm/s: about {minutes} min"
    )


def _of_face(path: ProbingPath, face: int) -> Probing:
    return next(probing for probing in path.probings if probing.face == face)


def _said(point: Point) -> str:
    return f"({', '.join(fixed_number(_mm(at), 3) for at in point)})"


def _mm(length: float) -> float:
    return MILLIMETRE.from_si(length)


def _values(planned: PlannedPath, written: Sequence[Path]) -> dict[str, Any]:
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
        "files": [str(path) for path in written],
    }
